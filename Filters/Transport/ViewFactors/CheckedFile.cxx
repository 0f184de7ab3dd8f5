// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/CheckedFile.h"

#include "Shared/TransportMemory.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace LightTransport
{
namespace CheckedFile
{
namespace
{
constexpr Count ByteOrder = 0x0102030405060708;
constexpr Count SwappedByteOrder = 0x0807060504030201;

//------------------------------------------------------------------------------
std::string MakeLine(const Format& format)
{
  std::string line = std::string(format.Name) + format.Version;
  line.resize(Start::LineLength - 1, ' ');
  return line + '\n';
}

//------------------------------------------------------------------------------
// What streams do not tell.
std::error_code GetSystemError()
{
  return { errno == 0 ? EIO : errno, std::generic_category() };
}
} // namespace

//------------------------------------------------------------------------------
void Checksum::Add(const void* data, std::size_t bytes)
{
  const auto* next = static_cast<const char*>(data);
  for (; bytes >= sizeof(Count); bytes -= sizeof(Count), next += sizeof(Count))
  {
    this->AddWord(next, sizeof(Count));
  }
  if (bytes > 0)
  {
    this->AddWord(next, bytes);
  }
}

//------------------------------------------------------------------------------
void Checksum::AddWord(const char* data, std::size_t bytes)
{
  Count word = 0;
  std::memcpy(&word, data, bytes);
  this->State = (this->State ^ word) * 0x100000001b3;
  this->State ^= this->State >> 32;
}

//------------------------------------------------------------------------------
Outcome Writer::Finish()
{
  const Count sum = this->Sum.Get();
  this->Put(&sum, sizeof(sum));
  return this->File.Finish();
}

//------------------------------------------------------------------------------
Start Writer::MakeStart(const Format& format)
{
  Start start;
  MakeLine(format).copy(start.Line, Start::LineLength);
  start.Order = ByteOrder;
  return start;
}

//------------------------------------------------------------------------------
bool Reader::IsOf(const std::string& fileName, const Format& format)
{
  const std::string name = format.Name;
  std::string start(name.size(), ' ');
  const std::filesystem::path path = std::filesystem::u8path(fileName);
  // Nobody may ever write to a pipe.
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem))
  {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == name;
}

//------------------------------------------------------------------------------
Outcome Reader::Fail(const std::string& problem)
{
  return Outcome::Failed(
    problem + " Compute the view factors again and save them, or take another copy.");
}

//------------------------------------------------------------------------------
Outcome Reader::FailVersion(const Format& format)
{
  return Outcome::Failed(std::string("its format is not version ") + format.Version +
    ", the one that this version of vtkLightTransport reads. Compute the view factors again and "
    "save them.");
}

//------------------------------------------------------------------------------
Outcome Reader::CheckMemory(double bytes)
{
  const double available = TransportMemory::GetAvailableBytes();
  return bytes <= available
    ? Outcome::Done()
    : Outcome::Failed("it needs " + TransportMemory::Format(bytes) + " of memory and " +
        TransportMemory::Format(available) + " are free. Load it on a machine with more memory.");
}

//------------------------------------------------------------------------------
Outcome Reader::Open(const std::string& fileName)
{
  // Nothing but a file has a length to check all sizes against.
  const std::filesystem::path path = std::filesystem::u8path(fileName);
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem))
  {
    return Outcome::Failed("there is no such file. Check the name and the folder.");
  }
  this->Remaining = std::filesystem::file_size(path, problem);
  if (problem)
  {
    return Outcome::Failed("its length is not known (" + problem.message() + ").");
  }
  errno = 0;
  this->Stream.open(path, std::ios::binary);
  if (!this->Stream)
  {
    return Outcome::Failed(
      "it cannot be opened (" + GetSystemError().message() + "). Check its permissions.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::GetHead(const Format& format, void* head, std::size_t bytes, const Start& start)
{
  const std::string line = MakeLine(format);
  const std::size_t name = std::strlen(format.Name);
  const Count there = std::min<Count>(this->Remaining, bytes);
  if (Outcome got = this->Get(head, there); !got)
  {
    return got;
  }
  if (line.compare(0, name, start.Line, name) != 0)
  {
    return Outcome::Failed(
      std::string("it is not a file of ") + format.Contents + ". Check the name.");
  }
  if (there < bytes)
  {
    return FailTooShort();
  }
  if (start.Order == SwappedByteOrder)
  {
    return Outcome::Failed(
      "it comes from a machine with the other order of bytes. Compute the view "
      "factors on this one.");
  }
  if (line.compare(0, Start::LineLength, start.Line, Start::LineLength) != 0)
  {
    return FailVersion(format);
  }
  return start.Order == ByteOrder ? Outcome::Done() : FailDamaged();
}

//------------------------------------------------------------------------------
Outcome Reader::Get(void* data, Count bytes)
{
  if (bytes > this->Remaining)
  {
    return FailTooShort();
  }
  errno = 0;
  if (!this->Stream.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes)))
  {
    return Fail("reading fails (" + GetSystemError().message() + ").");
  }
  this->Sum.Add(data, static_cast<std::size_t>(bytes));
  this->Remaining -= bytes;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::ExpectLast(Count bytes) const
{
  const Count expected = bytes + sizeof(Count);
  return this->Remaining < expected ? FailTooShort()
    : this->Remaining > expected    ? Fail("something follows behind its end.")
                                    : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::GetChecksum()
{
  const Count expected = this->Sum.Get();
  Count sum = 0;
  Outcome got = this->Get(&sum, sizeof(sum));
  return got && sum != expected ? Fail("it is damaged: its checksum is wrong.") : got;
}
} // namespace CheckedFile
} // namespace LightTransport
