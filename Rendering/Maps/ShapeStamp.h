// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Of what a shape consists of, to see whether it is still the same: another number where a part is
/// modified, or replaced by one that may be older.
#ifndef ShapeStamp_h
#define ShapeStamp_h

#include "vtkObject.h"

#include <cstdint>
#include <initializer_list>

namespace LightTransport
{
class ShapeStamp
{
public:
  /// Parts may be nullptr.
  void Add(std::initializer_list<vtkObject*> parts)
  {
    for (vtkObject* part : parts)
    {
      this->Mix(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(part)));
      this->Mix(part ? part->GetMTime() : 0);
    }
  }
  std::uint64_t Get() const { return this->Value; }

private:
  // Fowler, Noll and Vo, by words.
  void Mix(std::uint64_t word) { this->Value = (this->Value ^ word) * 0x100000001b3; }

  std::uint64_t Value = 0xcbf29ce484222325;
};
} // namespace LightTransport

#endif
