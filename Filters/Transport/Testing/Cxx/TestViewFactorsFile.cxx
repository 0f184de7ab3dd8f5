// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// View factors written and read back bit by bit; files that are cut short, damaged or made up are
// refused; a failed write leaves nothing behind.
#include "LightTransportTesting.h"
#include "Links/Links.h"
#include "OutcomeTesting.h"
#include "ViewFactors/ViewFactorsFile.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#if defined(__unix__)
#include <csignal>
#include <sys/resource.h>
#endif

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
namespace fs = std::filesystem;

constexpr int N = vtkExchangeMatrix::TileSize;
// Where things are in the file (see ViewFactorsFile.h).
constexpr std::size_t Line = 40;
constexpr std::size_t Order = Line, Tolerance = Line + 24, Patches = Line + 32,
                      Summaries = Line + 40, Tiles = Line + 48, Areas = Line + 56;

/// A folder of the test's own, removed with all that is in it.
struct Folder
{
  fs::path Path =
    fs::temp_directory_path() / ("TestViewFactorsFile-" + std::to_string(std::random_device()()));
  Folder() { fs::create_directory(this->Path); }
  ~Folder() { fs::remove_all(this->Path); }
  std::string Get(const std::string& name) const { return (this->Path / name).u8string(); }
  std::ptrdiff_t GetNumberOfFiles() const
  {
    return std::distance(fs::directory_iterator(this->Path), fs::directory_iterator());
  }
};

//------------------------------------------------------------------------------
// Any tile but that of the last row is stored or not; values are anything that may be.
Links MakeResult(vtkIdType patches)
{
  std::mt19937_64 generator(static_cast<unsigned>(patches));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto row = [&]()
  {
    std::vector<double> values(patches);
    std::generate(values.begin(), values.end(), [&]() { return uniform(generator); });
    return values;
  };
  Links result;
  result.Fingerprint = generator();
  result.Tolerance = 1e-4;
  result.Matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
  result.Matrix->AllocateSparse(row(), 1);
  for (auto* values :
    { &result.RawRowSums, &result.RowSums, &result.RowErrors, &result.SkyFractions,
      &result.BackFaceFractions, &result.OpeningErrors, &result.FrontHits, &result.BackHits })
  {
    *values = row();
  }
  std::vector<double> remainders = row();
  for (std::size_t k = 0; k < remainders.size(); ++k)
  {
    remainders[k] = (remainders[k] - 0.5) * 1e-7 * result.Matrix->GetAreas()[k];
  }
  result.Matrix->SetRemainders(remainders);
  result.Summaries = { { "NumberOfPairs", 1e15 / 3.0 }, { "", -0.0 },
    { "MaximumRowError", std::numeric_limits<double>::infinity() } };
  for (vtkExchangeMatrix::Tile& tile : result.Matrix->GetTiles())
  {
    if ((tile.Row + tile.Column) % 3 == 1)
    {
      continue;
    }
    result.Matrix->AllocateTile(tile);
    for (int i = 0; i < N && tile.Row * N + i < patches; ++i)
    {
      for (int j = tile.Row == tile.Column ? i : 0; j < N && tile.Column * N + j < patches; ++j)
      {
        vtkExchangeMatrix::SetValue(tile, i, j, 0, uniform(generator) * 1e-3);
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
bool IsSame(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

//------------------------------------------------------------------------------
bool IsSame(const vtkExchangeMatrix* a, const vtkExchangeMatrix* b)
{
  return IsSame(a->GetAreas(), b->GetAreas()) && IsSame(a->GetRemainders(), b->GetRemainders()) &&
    b->GetNumberOfKernels() == 1 && b->GetNumberOfParts() == 1 &&
    std::equal(a->GetTiles().begin(), a->GetTiles().end(), b->GetTiles().begin(),
      b->GetTiles().end(),
      [](const vtkExchangeMatrix::Tile& s, const vtkExchangeMatrix::Tile& t)
      {
        return s.Row == t.Row && s.Column == t.Column && !s.Values == !t.Values &&
          (!s.Values || std::memcmp(s.Values, t.Values, sizeof(float) * N * N) == 0);
      });
}

//------------------------------------------------------------------------------
bool IsSame(const Links& a, const Links& b)
{
  return a.Fingerprint == b.Fingerprint && a.Tolerance == b.Tolerance &&
    IsSame(a.RawRowSums, b.RawRowSums) && IsSame(a.RowSums, b.RowSums) &&
    IsSame(a.RowErrors, b.RowErrors) && IsSame(a.SkyFractions, b.SkyFractions) &&
    IsSame(a.BackFaceFractions, b.BackFaceFractions) && IsSame(a.OpeningErrors, b.OpeningErrors) &&
    IsSame(a.FrontHits, b.FrontHits) && IsSame(a.BackHits, b.BackHits) &&
    a.Summaries == b.Summaries && IsSame(a.Matrix, b.Matrix);
}

//------------------------------------------------------------------------------
std::string GetBytes(const std::string& fileName)
{
  std::ifstream stream;
  if (fs::is_regular_file(fs::u8path(fileName)))
  {
    stream.open(fs::u8path(fileName), std::ios::binary);
  }
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

//------------------------------------------------------------------------------
void PutBytes(const std::string& fileName, const std::string& bytes)
{
  std::ofstream stream(fs::u8path(fileName), std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

//------------------------------------------------------------------------------
template <typename Value>
std::string Replace(std::string bytes, std::size_t offset, Value value)
{
  std::memcpy(&bytes[offset], &value, sizeof(value));
  return bytes;
}

//------------------------------------------------------------------------------
// The file's checksum, written down a second time: whoever makes up a file makes it right.
std::string Sign(std::string bytes)
{
  std::uint64_t sum = 0xcbf29ce484222325;
  const auto add = [&sum](const char* data, std::size_t size)
  {
    for (std::size_t done = 0; done < size; done += 8)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, data + done, std::min<std::size_t>(8, size - done));
      sum = (sum ^ word) * 0x100000001b3;
      sum ^= sum >> 32;
    }
  };
  // The pieces that the file is written in; only names are not whole words.
  std::uint64_t patches, summaries, length;
  std::memcpy(&patches, &bytes[Patches], 8);
  std::memcpy(&summaries, &bytes[Summaries], 8);
  std::size_t next = Areas + 80 * patches;
  add(bytes.data(), next);
  for (; summaries > 0; --summaries)
  {
    std::memcpy(&length, &bytes[next], 8);
    add(&bytes[next], 8);
    add(&bytes[next + 8], length);
    add(&bytes[next + 8 + length], 8);
    next += 16 + length;
  }
  add(&bytes[next], bytes.size() - 8 - next);
  return Replace(bytes, bytes.size() - 8, sum);
}

//------------------------------------------------------------------------------
// The message names the file and the problem; what was there before stays.
void ExpectError(const std::string& fileName, const std::string& problem, const std::string& what)
{
  Links result;
  result.Fingerprint = 77;
  const Outcome read = ViewFactorsFile::Read(fileName, result);
  const std::string& error = read.GetMessage();
  Check(read.HasFailed() && result.Fingerprint == 77 && !result.Matrix, what + " is refused");
  Check(error.find(fileName) != std::string::npos && error.find(problem) != std::string::npos,
    what + " gives the message: " + error);
}

//------------------------------------------------------------------------------
void TestRoundTrip(const Folder& folder)
{
  const std::string name = folder.Get("r\xc3\xb6und.lt");
  for (const vtkIdType patches : { 0, 1, 255, 256, 257, 1000 })
  {
    const std::string what = std::to_string(patches) + " patches: ";
    const Links result = MakeResult(patches);
    CheckDone(ViewFactorsFile::Write(name, result), what);
    Links again = MakeResult(3);
    CheckDone(ViewFactorsFile::Read(name, again), what);
    Check(IsSame(result, again), what + "the same bits");
    Check(folder.GetNumberOfFiles() == 1, what + "one file");
  }
  const std::string bytes = GetBytes(name);
  Check(bytes.rfind("vtkLightTransport view factors 3", 0) == 0 && bytes[Line - 1] == '\n',
    "a line to read");
  const Links result = MakeResult(1000);
  CheckClose(static_cast<double>(bytes.size()),
    Areas + 80.0 * 1000 + 3 * 16 + 13 + 15 + 16.0 * result.Matrix->GetNumberOfStoredTiles() +
      result.Matrix->GetNumberOfBytes() + 8,
    0.0, "length of the file");
  Check(Sign(bytes) == bytes, "the checksum is what its description says");
}

//------------------------------------------------------------------------------
void TestTruncation(const Folder& folder, const std::string& bytes)
{
  const std::string name = folder.Get("short");
  const std::size_t end = bytes.size();
  for (const std::size_t length : { std::size_t(0), std::size_t(1), std::size_t(31), Line, Line + 1,
         Order + 8, Tiles, Areas - 1, Areas, Areas + 8, Areas + 80 * 300 - 1, Areas + 80 * 300,
         Areas + 80 * 300 + 8, Areas + 80 * 300 + 60, Areas + 80 * 300 + 90, end - 4 * N * N - 30,
         end - 4 * N * N - 9, end - 4 * N * N - 8, end - 12, end - 8, end - 1 })
  {
    PutBytes(name, bytes.substr(0, length));
    ExpectError(name, length < 31 ? "not a file of view factors" : "cut short",
      "a file of " + std::to_string(length) + " bytes");
  }
  PutBytes(name, bytes + '\0');
  ExpectError(name, "follows behind its end", "a byte too many");
}

//------------------------------------------------------------------------------
// Every change of a byte is found: in the first part of the file all bytes, then some everywhere.
void TestFlippedBytes(const Folder& folder, const std::string& bytes)
{
  const std::string name = folder.Get("flipped");
  std::mt19937_64 generator(5);
  for (std::size_t k = 0; k < 900; ++k)
  {
    const std::size_t offset = k < Areas + 16 ? k
      : k < 600                               ? generator() % (Areas + 80 * 300 + 100)
                                              : generator() % bytes.size();
    std::string damaged = bytes;
    damaged[offset] = static_cast<char>(damaged[offset] ^ (1 << (generator() % 8)));
    PutBytes(name, damaged);
    Links result;
    Check(!ViewFactorsFile::Read(name, result).GetMessage().empty(),
      "byte " + std::to_string(offset) + " is changed");
  }
  // The same bit of two words: what a plain sum or exclusive or would not see.
  std::string damaged = bytes;
  damaged[Areas + 8 * 300 + 7] = static_cast<char>(damaged[Areas + 8 * 300 + 7] ^ 1);
  damaged[Areas + 8 * 300 + 15] = static_cast<char>(damaged[Areas + 8 * 300 + 15] ^ 1);
  PutBytes(name, damaged);
  ExpectError(name, "checksum", "two changed bytes");
}

//------------------------------------------------------------------------------
// Contents that no writer makes, with a checksum that is right.
void TestMadeUp(const Folder& folder, const std::string& bytes)
{
  const std::string name = folder.Get("made up");
  const auto expect = [&](const std::string& content, const char* problem, const char* what)
  {
    PutBytes(name, content);
    ExpectError(name, problem, what);
  };
  const std::uint64_t huge[] = { ~std::uint64_t(0), std::uint64_t(1) << 63, std::uint64_t(1) << 60,
    std::uint64_t(1) << 40, 301 };
  for (const std::uint64_t count : huge)
  {
    expect(Replace(bytes, Tiles, count), "cut short", "tiles that are not there");
    expect(Replace(bytes, Summaries, count), count == 301 ? "" : "damaged",
      "summaries that are not there");
    expect(Replace(bytes, Areas + 80 * 300, count), count == 301 ? "" : "damaged",
      "a name that is not there");
    expect(Replace(bytes, Patches, count), count == 301 ? "" : "cut short",
      "patches that are not there");
  }
  expect(Replace(bytes, Tiles, std::uint64_t(0)), "behind its end", "no tiles");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : { -1.0, nan, infinity, -infinity })
  {
    expect(Sign(Replace(bytes, Tolerance, value)), "damaged", "a tolerance that cannot be");
    for (std::size_t row = 0; row < 4; ++row)
    {
      expect(Sign(Replace(bytes, Areas + 8 * (300 * row + 7), value)), "areas or sums",
        "a row value that cannot be");
    }
  }
  for (std::size_t row = 4; row < 9; ++row)
  {
    expect(Sign(Replace(bytes, Areas + 8 * (300 * row + 299), nan)), "areas or sums", "a NaN");
  }
  for (const double value : { nan, infinity, 1e-3, -1e-3 })
  {
    expect(Sign(Replace(bytes, Areas + 8 * (300 * 9 + 11), value)), "areas or sums",
      "a remainder that cannot be");
  }

  // Two tiles are stored: (0, 0) and, at the end, (1, 1).
  const std::size_t last = bytes.size() - 8 - 4 * N * N, first = last - 16 - 4 * N * N;
  for (const float value :
    { -1e-9f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() })
  {
    expect(Sign(Replace(bytes, first, value)), "cannot be (negative", "an exchange that cannot be");
  }
  expect(Sign(Replace(bytes, first + 4 * 5, 0.5f)), "not reciprocal", "a tile without symmetry");
  expect(Sign(Replace(bytes, last + 4 * 44, 0.5f)), "cannot be (", "a column of padding");
  expect(Sign(Replace(bytes, last + 4 * (44 * N + 44), 0.5f)), "cannot be (", "a row of padding");
  for (const std::uint64_t index : { std::uint64_t(2), std::uint64_t(1) << 62, ~std::uint64_t(0) })
  {
    expect(Sign(Replace(bytes, last - 8, index)), "a block", "a column that is not there");
    expect(Sign(Replace(bytes, last - 16, index)), "a block", "a row that is not there");
  }
  const std::string twice = Replace(bytes, last - 16, std::uint64_t(0));
  expect(Sign(Replace(twice, last - 8, std::uint64_t(0))), "a block", "a tile twice");
  expect(Sign(Replace(bytes, first - 16, std::uint64_t(1))), "a block", "below the diagonal");
  PutBytes(name, Sign(bytes));
  Links result;
  CheckDone(ViewFactorsFile::Read(name, result), "the untouched file is read");
}

//------------------------------------------------------------------------------
// A file that is mostly a hole, as long as it says, whose list of tiles is larger than any memory.
void TestMemory(const Folder& folder, const std::string& bytes)
{
  const std::string name = folder.Get("large");
  constexpr std::uint64_t patches = std::uint64_t(1) << 27;
  std::string head = Replace(bytes, Patches, patches).substr(0, Areas);
  head = Replace(head, Summaries, std::uint64_t(0));
  head = Replace(head, Tiles, std::uint64_t(0));
  PutBytes(name, head);
  std::error_code problem;
  fs::resize_file(fs::u8path(name), Areas + 80 * patches + 8, problem);
  if (!problem)
  {
    ExpectError(name, "of memory", "a great many patches");
    fs::remove(fs::u8path(name));
  }
}

//------------------------------------------------------------------------------
void TestForeign(const Folder& folder, const std::string& bytes)
{
  const std::string name = folder.Get("foreign");
  const auto expect = [&](const std::string& content, const char* problem, const char* what)
  {
    PutBytes(name, content);
    ExpectError(name, problem, what);
  };
  expect(std::string(100000, '\0'), "not a file of view factors", "zeros");
  expect("# vtk DataFile Version 5.1\n", "not a file of view factors", "another format");
  expect(Replace(bytes, 31, '4'), "not version 3", "a later version");
  expect(Replace(bytes, Order + 8, std::uint64_t(128)), "not version 3", "another size of tiles");
  std::string swapped = bytes;
  for (std::size_t word = Order; word < Areas; word += 8)
  {
    std::reverse(&swapped[word], &swapped[word] + 8);
  }
  expect(swapped, "order of bytes", "another byte order");
  expect(Replace(bytes, Order, std::uint64_t(5)), "damaged", "no byte order");
  ExpectError(folder.Get("nothing"), "no such file", "a missing file");
  ExpectError(folder.Path.u8string(), "no such file", "a folder");
  ExpectError("", "no such file", "no name");
}

//------------------------------------------------------------------------------
// Also says that an older file of the name stays and that nothing else is left.
void ExpectWriteError(const Folder& folder, const std::string& name, const Links& result,
  const std::string& what)
{
  const std::ptrdiff_t files = folder.GetNumberOfFiles();
  const std::string before = GetBytes(name);
  const Outcome written = ViewFactorsFile::Write(name, result);
  const std::string& error = written.GetMessage();
  Check(written.HasFailed(), what + " fails");
  Check(error.find(name) != std::string::npos, what + " gives the message: " + error);
  Check(folder.GetNumberOfFiles() == files && GetBytes(name) == before, what + " leaves nothing");
}

//------------------------------------------------------------------------------
void TestWriteErrors(const Folder& folder)
{
  const Links good = MakeResult(300);
  const std::string name = folder.Get("kept");
  CheckDone(ViewFactorsFile::Write(name, good), "the first file");
  ExpectWriteError(folder, folder.Get("missing/file"), good, "a missing folder");
  ExpectWriteError(folder, name + "/file", good, "a file as folder");
  fs::create_directory(folder.Path / "taken");
  PutBytes(folder.Get("taken/inside"), "x");
  ExpectWriteError(folder, folder.Get("taken"), good, "a folder as file");
#if defined(__unix__)
  // As when the disk is full: a limit on the size of files.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t length : { rlim_t(0), rlim_t(10000), rlim_t(300000) })
  {
    const rlimit limit{ length, before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
    ExpectWriteError(folder, name, good, "a full disk");
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
#endif
  const auto expect = [&](const std::function<void(Links&)>& change, const char* what)
  {
    Links result = MakeResult(300);
    change(result);
    ExpectWriteError(folder, name, result, what);
  };
  expect([](auto& result) { result.Matrix = nullptr; }, "no matrix");
  expect([](auto& result) { result.RowErrors.pop_back(); }, "a row that is not complete");
  expect([](auto& result) { result.RowSums[5] = vtkMath::Nan(); }, "a NaN");
  expect([](auto& result) { result.Tolerance = -1.0; }, "a tolerance that cannot be");
  expect([](auto& result) { result.Matrix->GetTiles()[0].Values[3] = -1.0f; }, "a negative");
  expect([](auto& result) { result.Matrix->SetRemainders({ 0.0 }); }, "remainders of few rows");
  expect([](auto& result) { result.Summaries.resize(1001); }, "too many summaries");
  expect([](auto& result) { result.Summaries[0].first.resize(1001); }, "too long a name");
  const std::vector<double> areas(300, 1.0);
  expect([&](auto& result) { result.Matrix->AllocateSparse(areas, 2); }, "two kernels");
  expect([&](auto& result) { result.Matrix->AllocateSparse(areas, 1, 0, 2); }, "two parts");
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactorsFile(int, char*[])
{
  const Folder folder;
  TestRoundTrip(folder);
  const std::string name = folder.Get("file");
  CheckDone(ViewFactorsFile::Write(name, MakeResult(300)), "the first file");
  const std::string bytes = GetBytes(name);
  TestTruncation(folder, bytes);
  TestFlippedBytes(folder, bytes);
  TestMadeUp(folder, bytes);
  TestMemory(folder, bytes);
  TestForeign(folder, bytes);
  TestWriteErrors(folder);
  return Result();
}
