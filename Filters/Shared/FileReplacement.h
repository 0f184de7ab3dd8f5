// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The one way to write a file: beside its place, under a name that nobody can foresee, and moved
 * there when all of it is on the disk. Whatever fails before, an older file stays as it was and
 * nothing is left beside it.
 *
 * Symbolic links stay; what they lead to is replaced. The older file's mode (and owner, where the
 * system lets us) are kept, a new one gets what the umask leaves. Refused are names of what is no
 * regular file (a device, a pipe), of a file with several hard links (the others would keep the old
 * content) and of one that may not be written.
 *
 *   FileReplacement file;
 *   Outcome outcome = file.Begin(fileName);
 *   if (outcome)
 *   {
 *     file.Write(data, size); // what fails here, Finish tells
 *     outcome = file.Finish();
 *   }
 */
#ifndef FileReplacement_h
#define FileReplacement_h

#include "Shared/Outcome.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace LightTransport
{
class FileReplacement
{
public:
  FileReplacement() = default;
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;
  ~FileReplacement() { this->Discard(); }

  /// Look at the file to be replaced, and open the new one. Failures name problem and remedy, as a
  /// part of a sentence.
  Outcome Begin(const std::string& fileName);

  ///@{
  /// Write, or go to a place before the end. False from the first failure on.
  bool Write(const void* data, std::size_t bytes);
  bool Seek(std::uint64_t position);
  ///@}

  std::uint64_t GetPosition() const { return this->Position; }
  bool HasFailed() const { return this->Problem != 0; }

  /// Put the new file in its place. Without this it is gone with the object.
  Outcome Finish();

private:
  using Path = std::filesystem::path;

  Outcome Resolve(const std::string& fileName);
  Outcome CheckTarget();
  Outcome Create();
  bool Keep(bool good);
  void TakeModeOver();
  void Discard();
  static std::string Describe(int problem)
  {
    return std::error_code(problem, std::generic_category()).message();
  }
  static Outcome FailToCreate()
  {
    return Outcome::Failed(
      "it cannot be created (" + Describe(errno) + "); the folder must exist and let you write");
  }

  Path Target;
  Path Temporary;
  /// Of the older file; a mode of 0 where there is none.
  struct stat Older = {};
  std::FILE* Stream = nullptr;
  std::uint64_t Position = 0;
  /// The first error number.
  int Problem = 0;
};

//------------------------------------------------------------------------------
inline Outcome FileReplacement::Begin(const std::string& fileName)
{
  Outcome outcome = this->Resolve(fileName);
  outcome = outcome ? this->CheckTarget() : outcome;
  return outcome ? this->Create() : outcome;
}

//------------------------------------------------------------------------------
// The end of a chain of links, also of one that leads to nothing yet.
inline Outcome FileReplacement::Resolve(const std::string& fileName)
{
  this->Target = std::filesystem::u8path(fileName);
  std::error_code problem;
  constexpr int longestChain = 40;
  for (int i = 0; std::filesystem::is_symlink(this->Target, problem); ++i)
  {
    const Path next = std::filesystem::read_symlink(this->Target, problem);
    if (problem || i == longestChain)
    {
      return Outcome::Failed("it is a symbolic link that leads nowhere; remove the link");
    }
    this->Target = this->Target.parent_path() / next;
  }
  return this->Target.has_filename()
    ? Outcome::Done()
    : Outcome::Failed("the name is that of a folder or device; choose another");
}

//------------------------------------------------------------------------------
// An older file, or what else has the name, must be one that may be replaced.
inline Outcome FileReplacement::CheckTarget()
{
  if (::stat(this->Target.c_str(), &this->Older) != 0)
  {
    this->Older = {};
    return errno == ENOENT ? Outcome::Done() : FailToCreate();
  }
  if (!S_ISREG(this->Older.st_mode))
  {
    return Outcome::Failed("the name is that of a folder or device; choose another");
  }
  if (this->Older.st_nlink > 1)
  {
    return Outcome::Failed("the file has " + std::to_string(this->Older.st_nlink) +
      " names (hard links), of which the others would keep the old content; choose another "
      "name, or remove the file first");
  }
  if (::faccessat(AT_FDCWD, this->Target.c_str(), W_OK, AT_EACCESS) != 0)
  {
    return Outcome::Failed("the file is there and may not be written (" + Describe(errno) +
      "); choose another name, or change its permissions");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
inline Outcome FileReplacement::Create()
{
  std::random_device random;
  // An older file may be private; its mode comes at the end. The umask does the rest.
  const mode_t mode = this->Older.st_mode == 0 ? 0666 : 0600;
  constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  constexpr int tries = 100;
  int file = -1;
  errno = EEXIST;
  for (int i = 0; file < 0 && errno == EEXIST && i < tries; ++i)
  {
    const std::string name = std::to_string(random()) + '-' + std::to_string(random());
    const Path path = this->Target.parent_path() / (".unfinished-" + name);
    file = ::open(path.c_str(), flags, mode);
    if (file >= 0)
    {
      this->Temporary = path;
    }
  }
  if (file < 0)
  {
    return FailToCreate();
  }
  this->Stream = ::fdopen(file, "wb");
  if (!this->Stream)
  {
    Outcome failed = FailToCreate();
    ::close(file);
    this->Discard();
    return failed;
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
inline bool FileReplacement::Keep(bool good)
{
  if (!good && this->Problem == 0)
  {
    this->Problem = errno == 0 ? EIO : errno;
  }
  return this->Problem == 0;
}

//------------------------------------------------------------------------------
inline bool FileReplacement::Write(const void* data, std::size_t bytes)
{
  if (bytes > 0 && this->Keep(this->Stream != nullptr))
  {
    errno = 0;
    this->Position += bytes;
    this->Keep(std::fwrite(data, 1, bytes, this->Stream) == bytes);
  }
  return this->Problem == 0;
}

//------------------------------------------------------------------------------
inline bool FileReplacement::Seek(std::uint64_t position)
{
  if (this->Keep(this->Stream != nullptr))
  {
    errno = 0;
    this->Position = position;
    this->Keep(::fseeko(this->Stream, static_cast<off_t>(position), SEEK_SET) == 0);
  }
  return this->Problem == 0;
}

//------------------------------------------------------------------------------
// The owner first: changing it takes the bits of set-user-id away.
inline void FileReplacement::TakeModeOver()
{
  const int file = ::fileno(this->Stream);
  struct stat current = {};
  if (this->Older.st_mode == 0 || !this->Keep(::fstat(file, &current) == 0))
  {
    return;
  }
  const bool otherOwner = current.st_uid != this->Older.st_uid;
  const bool otherGroup = current.st_gid != this->Older.st_gid;
  const bool given =
    (!otherOwner && !otherGroup) || ::fchown(file, this->Older.st_uid, this->Older.st_gid) == 0;
  // Who does not own the file may still keep its group; rights of another group would be wrong.
  const bool grouped =
    given || !otherGroup || ::fchown(file, static_cast<uid_t>(-1), this->Older.st_gid) == 0;
  constexpr mode_t all = 07777;
  constexpr mode_t group = 0070;
  constexpr mode_t plain = 0777;
  const mode_t mode = this->Older.st_mode & (given ? all : plain);
  this->Keep(::fchmod(file, grouped ? mode : mode & ~group) == 0);
}

//------------------------------------------------------------------------------
inline Outcome FileReplacement::Finish()
{
  errno = 0;
  if (this->Keep(this->Stream && std::fflush(this->Stream) == 0))
  {
    this->TakeModeOver();
    // Some file systems know no fsync.
    this->Keep(::fsync(::fileno(this->Stream)) == 0 || errno == EINVAL || errno == ENOSYS);
  }
  if (this->Stream)
  {
    errno = 0;
    this->Keep(std::fclose(this->Stream) == 0);
    this->Stream = nullptr;
    if (this->Keep(
          this->Problem == 0 && ::rename(this->Temporary.c_str(), this->Target.c_str()) == 0))
    {
      this->Temporary.clear();
    }
  }
  this->Discard();
  return this->Problem == 0
    ? Outcome::Done()
    : Outcome::Failed("the data cannot be written (" + Describe(this->Problem) +
        "); make room on the disk, or write elsewhere");
}

//------------------------------------------------------------------------------
inline void FileReplacement::Discard()
{
  if (this->Stream)
  {
    std::fclose(this->Stream);
    this->Stream = nullptr;
  }
  if (!this->Temporary.empty())
  {
    ::unlink(this->Temporary.c_str());
    this->Temporary.clear();
  }
}
} // namespace LightTransport

#endif
