// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The bytes of an OpenEXR file, as OpenEXRFileCheck walks over them.
#ifndef OpenEXRInput_h
#define OpenEXRInput_h

#include "Files/OpenEXRFileCheck.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace LightTransport
{
namespace OpenEXRFileCheck
{
constexpr std::size_t LongestName = 255;

/// Thrown here and caught by Check(): every byte that is read may be the one that is missing, and
/// returning that through all numbers and names would hide the layout that is walked over.
struct Error
{
  Fault Kind;
  std::string Problem;
};

//------------------------------------------------------------------------------
/// Little-endian reading that never goes beyond the end of the file.
class Input
{
public:
  explicit Input(const std::string& fileName)
  {
    // A pipe would keep us waiting for its other end.
    std::error_code status;
    const bool regular = std::filesystem::is_regular_file(fileName, status);
    const std::uintmax_t length = regular ? std::filesystem::file_size(fileName, status) : 0;
    if (regular && !status)
    {
      this->Stream.open(fileName, std::ios::binary);
    }
    if (!this->Stream.is_open())
    {
      throw Error{ Fault::CannotOpen, "the file does not exist or cannot be opened" };
    }
    this->Length = static_cast<std::int64_t>(length);
  }

  std::int64_t GetLength() const { return this->Length; }
  std::int64_t GetPosition() const { return this->Position; }
  std::int64_t GetRemaining() const { return this->Length - this->Position; }

  void Need(std::int64_t count)
  {
    if (count > this->GetRemaining())
    {
      throw Error{ Fault::Truncated,
        "the file is truncated: it ends within its header or its table of offsets" };
    }
  }

  void Skip(std::int64_t count)
  {
    this->Need(count);
    if (count > 0)
    {
      this->Seek(this->Position + count);
    }
  }

  std::uint8_t ReadByte()
  {
    this->Need(1);
    ++this->Position;
    return static_cast<std::uint8_t>(this->Stream.get());
  }

  std::uint32_t ReadInt()
  {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8)
    {
      value |= static_cast<std::uint32_t>(this->ReadByte()) << shift;
    }
    return value;
  }

  std::int64_t ReadLong()
  {
    const std::uint64_t low = this->ReadInt();
    const std::uint64_t high = this->ReadInt();
    return static_cast<std::int64_t>(high << 32 | low);
  }

  std::string ReadName()
  {
    std::string name;
    for (std::uint8_t c = this->ReadByte(); c != 0; c = this->ReadByte())
    {
      name.push_back(static_cast<char>(c));
      if (name.size() > LongestName)
      {
        throw Error{ Fault::Damaged, "the header holds a name of more than 255 characters" };
      }
    }
    return name;
  }

  std::string ReadText(std::int64_t size)
  {
    this->Need(size);
    std::string text;
    for (std::int64_t i = 0; i < size && text.size() <= LongestName; ++i)
    {
      text.push_back(static_cast<char>(this->ReadByte()));
    }
    return text;
  }

  void Seek(std::int64_t position)
  {
    this->Position = position;
    this->Stream.seekg(position);
  }

private:
  std::ifstream Stream;
  std::int64_t Length = 0;
  std::int64_t Position = 0;
};
} // namespace OpenEXRFileCheck
} // namespace LightTransport

#endif
