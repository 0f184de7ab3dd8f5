// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A number that tells one sequence of 64-bit words from another.
#ifndef BitHash_h
#define BitHash_h

#include "vtkObject.h"

#include <cstdint>
#include <cstring>
#include <initializer_list>

namespace LightTransport
{
class BitHash
{
public:
  void Add(std::uint64_t bits)
  {
    this->Value = (this->Value ^ bits) * 0x9E3779B97F4A7C15ull;
    this->Value ^= this->Value >> 29;
  }
  /// By its bits: 0 and -0 differ.
  void AddNumber(double number)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof(bits));
    this->Add(bits);
  }
  template <typename Values>
  void AddAll(const Values& values)
  {
    for (const auto value : values)
    {
      this->Add(static_cast<std::uint64_t>(value));
    }
  }
  /// Who they are, and when they were last changed; they may be nullptr. So one that is replaced by
  /// an older one tells, too.
  void AddObjects(std::initializer_list<vtkObject*> objects)
  {
    for (vtkObject* object : objects)
    {
      this->Add(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(object)));
      this->Add(object ? object->GetMTime() : 0);
    }
  }
  std::uint64_t Get() const { return this->Value; }

private:
  std::uint64_t Value = 0xCBF29CE484222325ull;
};
} // namespace LightTransport

#endif
