// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What files of links have in common: a first line of 40 characters, the format's name and version,
 * padded with blanks; then 0x0102030405060708 in the order of bytes of the machine that writes, and
 * what the format has; at the end a checksum of all before. Counts have 64 bits. Nothing in a file
 * is believed.
 */
#ifndef CheckedFile_h
#define CheckedFile_h

#include "Shared/FileReplacement.h"
#include "Shared/Outcome.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace LightTransport
{
namespace CheckedFile
{
using Count = std::uint64_t;

struct Format
{
  const char* Name; ///< with a blank at its end
  const char* Version;
  const char* Contents; ///< what such files are, for a message
};

/// How the head of each file begins.
struct Start
{
  static constexpr std::size_t LineLength = 40;

  char Line[LineLength];
  Count Order;
};

/// A hash of 64-bit words (in the manner of FNV-1a, with a shift that brings high bits down). Each
/// step is a one-to-one map, so that a change within one word can never go unnoticed.
class Checksum
{
public:
  void Add(const void* data, std::size_t bytes);
  Count Get() const { return this->State; }

private:
  void AddWord(const char* data, std::size_t bytes);

  Count State = 0xcbf29ce484222325;
};

class Writer
{
public:
  /// As FileReplacement.
  Outcome Begin(const std::string& fileName) { return this->File.Begin(fileName); }

  void Put(const void* data, std::size_t bytes)
  {
    this->Sum.Add(data, bytes);
    this->File.Write(data, bytes);
  }
  template <typename Value>
  void PutValues(const std::vector<Value>& values)
  {
    this->Put(values.data(), values.size() * sizeof(Value));
  }

  /// A failure that Finish will tell.
  bool HasFailed() const { return this->File.HasFailed(); }

  /// With the checksum.
  Outcome Finish();

  static Start MakeStart(const Format& format);

private:
  FileReplacement File;
  Checksum Sum;
};

/// Reads one file from its beginning to its end; a failure's message begins after the file's name.
class Reader
{
public:
  /// Whether a file begins with the name of a format.
  static bool IsOf(const std::string& fileName, const Format& format);

  Outcome Open(const std::string& fileName);

  /// The head of a format, which begins with a Start named Begin.
  template <typename Head>
  Outcome GetHead(const Format& format, Head& head)
  {
    head = {};
    return this->GetHead(format, &head, sizeof(head), head.Begin);
  }

  Outcome Get(void* data, Count bytes);

  /// Bytes that have not been read; no count that a file has may stand for more.
  Count GetRemaining() const { return this->Remaining; }
  /// As many, and no more, must be there beside the checksum.
  Outcome ExpectLast(Count bytes) const;
  Outcome GetChecksum();

  ///@{ What else readers find.
  static Outcome FailDamaged() { return Fail("it is damaged."); }
  static Outcome FailTooShort() { return Fail("it has been cut short."); }
  static Outcome FailVersion(const Format& format);
  static Outcome Fail(const std::string& problem);
  /// Before memory is taken.
  static Outcome CheckMemory(double bytes);
  ///@}

private:
  Outcome GetHead(const Format& format, void* head, std::size_t bytes, const Start& start);

  std::ifstream Stream;
  Count Remaining = 0;
  Checksum Sum;
};
} // namespace CheckedFile
} // namespace LightTransport

#endif
