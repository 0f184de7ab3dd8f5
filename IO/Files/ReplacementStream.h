// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// OpenEXR's way into a file that is to replace another.
#ifndef ReplacementStream_h
#define ReplacementStream_h

#include "Shared/FileReplacement.h"

#include <Iex.h>
#include <ImfIO.h>

#include <cstdint>

namespace LightTransport
{
class ReplacementStream : public Imf::OStream
{
public:
  ReplacementStream(FileReplacement& file, const char* name) : Imf::OStream(name), File(file) {}

  void write(const char data[], int count) override
  {
    Check(this->File.Write(data, static_cast<std::size_t>(count)));
  }
  std::uint64_t tellp() override { return this->File.GetPosition(); }
  void seekp(std::uint64_t position) override { Check(this->File.Seek(position)); }

private:
  // That ends OpenEXR's work; the reason is with the file.
  static void Check(bool good)
  {
    if (!good)
    {
      throw Iex::IoExc("the data cannot be written");
    }
  }

  FileReplacement& File;
};
} // namespace LightTransport

#endif
