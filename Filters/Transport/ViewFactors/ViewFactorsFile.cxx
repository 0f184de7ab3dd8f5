// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorsFile.h"

#include "Links/Links.h"
#include "Shared/FileReplacement.h"
#include "Shared/TransportMemory.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <system_error>

namespace LightTransport
{
namespace
{
using Count = std::uint64_t;
using Tile = vtkExchangeMatrix::Tile;

constexpr int N = vtkExchangeMatrix::TileSize;
constexpr std::size_t LineLength = 40;
constexpr char Format[] = "vtkLightTransport view factors ";
constexpr char Version[] = "3";
constexpr Count ByteOrder = 0x0102030405060708;
constexpr Count SwappedByteOrder = 0x0807060504030201;

/// More than anybody needs; a file that wants more is damaged.
constexpr Count MaximumSummaries = 1000;
constexpr Count MaximumNameLength = 1000;

constexpr char Again[] = " Compute the view factors again and save them, or take another copy.";

struct Header
{
  char Line[LineLength];
  Count Order;
  Count TileSize;
  Count Fingerprint;
  double Tolerance;
  Count NumberOfPatches;
  Count NumberOfSummaries;
  Count NumberOfTiles;
};
static_assert(sizeof(Header) == LineLength + 7 * sizeof(Count), "a header without gaps");

struct TileName
{
  Count Row;
  Count Column;
};
constexpr Count BytesPerTile = sizeof(TileName) + sizeof(float) * N * N;

/// One value for each patch.
using Row = std::vector<double> Links::*;
constexpr Row Rows[] = { &Links::RawRowSums, &Links::RowSums, &Links::RowErrors,
  &Links::SkyFractions, &Links::BackFaceFractions, &Links::OpeningErrors, &Links::FrontHits,
  &Links::BackHits };
/// Beside the rows: areas and remainders.
constexpr Count BytesPerPatch = sizeof(double) * (2 + std::size(Rows));
/// The largest remainder of a row, relative to its area.
constexpr double LargestRemainder = 1e-6;

//------------------------------------------------------------------------------
std::string MakeLine()
{
  std::string line = std::string(Format) + Version;
  line.resize(LineLength - 1, ' ');
  return line + '\n';
}

//------------------------------------------------------------------------------
// What streams do not tell.
std::error_code GetSystemError()
{
  return { errno == 0 ? EIO : errno, std::generic_category() };
}

//------------------------------------------------------------------------------
// A hash of 64-bit words (in the manner of FNV-1a, with a shift that brings high bits down). Each
// step is a one-to-one map, so that a change within one word can never go unnoticed.
class Checksum
{
public:
  void Add(const void* data, std::size_t bytes)
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

  Count Get() const { return this->State; }

private:
  void AddWord(const char* data, std::size_t bytes)
  {
    Count word = 0;
    std::memcpy(&word, data, bytes);
    this->State = (this->State ^ word) * 0x100000001b3;
    this->State ^= this->State >> 32;
  }

  Count State = 0xcbf29ce484222325;
};

//------------------------------------------------------------------------------
// No value may be infinite, not a number, or below `lowest`.
template <typename Value>
bool AreUsable(const Value* values, std::size_t count, double lowest)
{
  return std::all_of(values, values + count,
    [lowest](Value value)
    { return value >= lowest && value <= std::numeric_limits<Value>::max(); });
}

//------------------------------------------------------------------------------
bool AreUsable(const std::vector<double>& values, Row row)
{
  const bool fractions = row == &Links::SkyFractions || row == &Links::BackFaceFractions;
  const double lowest = fractions ? std::numeric_limits<double>::lowest() : 0.0;
  return AreUsable(values.data(), values.size(), lowest);
}

//------------------------------------------------------------------------------
bool AreRemainders(const std::vector<double>& remainders, const std::vector<double>& areas)
{
  bool good = remainders.empty() || remainders.size() == areas.size();
  for (std::size_t row = 0; good && row < remainders.size(); ++row)
  {
    good = std::abs(remainders[row]) <= LargestRemainder * areas[row];
  }
  return good;
}

//------------------------------------------------------------------------------
// What the link operators count on: padding is zero, tiles of the diagonal are symmetric.
bool IsUsable(const Tile& tile, vtkIdType numberOfPatches)
{
  const vtkIdType rows = numberOfPatches - tile.Row * N;
  const vtkIdType columns = numberOfPatches - tile.Column * N;
  for (int i = 0; i < N; ++i)
  {
    const float* row = tile.Values + i * N;
    const vtkIdType used = i < rows ? std::min<vtkIdType>(columns, N) : 0;
    if (!AreUsable(row, N, 0.0) ||
      std::any_of(row + used, row + N, [](float value) { return value != 0.0f; }))
    {
      return false;
    }
    for (int j = 0; tile.Row == tile.Column && j < i; ++j)
    {
      if (row[j] != tile.Values[j * N + i])
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
class Writer
{
public:
  Outcome Write(const std::string& fileName, const Links& links)
  {
    Outcome begun = this->File.Begin(fileName);
    if (!begun)
    {
      return begun;
    }
    this->PutHeader(links);
    this->PutValues(links.Matrix->GetAreas());
    for (Row row : Rows)
    {
      this->PutValues(links.*row);
    }
    std::vector<double> remainders = links.Matrix->GetRemainders();
    remainders.resize(links.Matrix->GetAreas().size(), 0.0);
    this->PutValues(remainders);
    for (const auto& [name, value] : links.Summaries)
    {
      const Count length = name.size();
      this->Put(&length, sizeof(length));
      this->Put(name.data(), name.size());
      this->Put(&value, sizeof(value));
    }
    for (const Tile& tile : links.Matrix->GetTiles())
    {
      if (tile.Values && !this->File.HasFailed())
      {
        const TileName name{ static_cast<Count>(tile.Row), static_cast<Count>(tile.Column) };
        this->Put(&name, sizeof(name));
        this->Put(tile.Values, sizeof(float) * N * N);
      }
    }
    const Count sum = this->Sum.Get();
    this->Put(&sum, sizeof(sum));
    return this->File.Finish();
  }

private:
  void Put(const void* data, std::size_t bytes)
  {
    this->Sum.Add(data, bytes);
    this->File.Write(data, bytes);
  }

  void PutValues(const std::vector<double>& values)
  {
    this->Put(values.data(), values.size() * sizeof(double));
  }

  void PutHeader(const Links& links)
  {
    Header header;
    MakeLine().copy(header.Line, LineLength);
    header.Order = ByteOrder;
    header.TileSize = N;
    header.Fingerprint = links.Fingerprint;
    header.Tolerance = links.Tolerance;
    header.NumberOfPatches = static_cast<Count>(links.Matrix->GetNumberOfPatches());
    header.NumberOfSummaries = links.Summaries.size();
    header.NumberOfTiles = static_cast<Count>(links.Matrix->GetNumberOfStoredTiles());
    this->Put(&header, sizeof(header));
  }

  FileReplacement File;
  Checksum Sum;
};

//------------------------------------------------------------------------------
// Reads one file from its beginning to its end; a failure's message begins after the file's name.
class Reader
{
public:
  Links Result;

  Outcome Read(const std::string& fileName)
  {
    Outcome outcome = this->Open(fileName);
    for (const auto step : { &Reader::GetHeader, &Reader::CheckSizes, &Reader::GetRows,
           &Reader::GetSummaries, &Reader::MakeMatrix, &Reader::GetTiles, &Reader::GetChecksum })
    {
      outcome = outcome ? (this->*step)() : outcome;
    }
    return outcome;
  }

private:
  static Outcome FailDamaged() { return Outcome::Failed(std::string("it is damaged.") + Again); }

  static Outcome FailTooShort()
  {
    return Outcome::Failed(std::string("it has been cut short.") + Again);
  }

  Outcome Get(void* data, Count bytes)
  {
    if (bytes > this->Remaining)
    {
      return FailTooShort();
    }
    errno = 0;
    if (!this->Stream.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes)))
    {
      return Outcome::Failed("reading fails (" + GetSystemError().message() + ")." + Again);
    }
    this->Sum.Add(data, static_cast<std::size_t>(bytes));
    this->Remaining -= bytes;
    return Outcome::Done();
  }

  Outcome GetValues(std::vector<double>& values)
  {
    values.resize(static_cast<std::size_t>(this->Head.NumberOfPatches));
    return this->Get(values.data(), this->Head.NumberOfPatches * sizeof(double));
  }

  Outcome Open(const std::string& fileName);
  Outcome GetHeader();
  Outcome CheckSizes();
  Outcome GetRows();
  Outcome GetSummaries();
  Outcome MakeMatrix();
  Outcome GetTiles();
  Outcome GetChecksum();

  std::ifstream Stream;
  Count Remaining = 0;
  Checksum Sum;
  Header Head;
  std::vector<double> Areas;
  std::vector<double> Remainders;
};

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
Outcome Reader::GetHeader()
{
  const std::string line = MakeLine();
  const Count start = std::min<Count>(this->Remaining, sizeof(Header));
  this->Head = {};
  if (Outcome got = this->Get(&this->Head, start); !got)
  {
    return got;
  }
  if (line.compare(0, sizeof(Format) - 1, this->Head.Line, sizeof(Format) - 1) != 0)
  {
    return Outcome::Failed("it is not a file of view factors. Check the name.");
  }
  if (start < sizeof(Header))
  {
    return FailTooShort();
  }
  if (this->Head.Order == SwappedByteOrder)
  {
    return Outcome::Failed(
      "it comes from a machine with the other order of bytes. Compute the view "
      "factors on this one.");
  }
  if (line.compare(0, LineLength, this->Head.Line, LineLength) != 0 || this->Head.TileSize != N)
  {
    return Outcome::Failed(std::string("its format is not version ") + Version +
      ", the one that this version of vtkLightTransport reads. Compute the view factors again and "
      "save them.");
  }
  const bool good = this->Head.Order == ByteOrder && AreUsable(&this->Head.Tolerance, 1, 0.0);
  return good ? Outcome::Done() : FailDamaged();
}

//------------------------------------------------------------------------------
// Before anything is allocated: the file is as long as what it announces, and there is the memory.
Outcome Reader::CheckSizes()
{
  const Count patches = this->Head.NumberOfPatches;
  const Count tiles = this->Head.NumberOfTiles;
  if (patches > this->Remaining / BytesPerPatch || tiles > this->Remaining / BytesPerTile ||
    patches > static_cast<Count>(VTK_ID_MAX))
  {
    return FailTooShort();
  }
  if (this->Head.NumberOfSummaries > MaximumSummaries)
  {
    return FailDamaged();
  }
  const double bytes = static_cast<double>(patches * BytesPerPatch) +
    vtkExchangeMatrix::GetEstimatedSparseBytes(static_cast<vtkIdType>(patches), 1,
      static_cast<vtkIdType>(tiles));
  const double available = TransportMemory::GetAvailableBytes();
  return bytes <= available
    ? Outcome::Done()
    : Outcome::Failed("it needs " + TransportMemory::Format(bytes) + " of memory and " +
        TransportMemory::Format(available) + " are free. Load it on a machine with more memory.");
}

//------------------------------------------------------------------------------
Outcome Reader::GetRows()
{
  Outcome got = this->GetValues(this->Areas);
  bool usable = got && AreUsable(this->Areas.data(), this->Areas.size(), 0.0);
  for (Row row : Rows)
  {
    got = got ? this->GetValues(this->Result.*row) : got;
    usable = usable && got && AreUsable(this->Result.*row, row);
  }
  got = got ? this->GetValues(this->Remainders) : got;
  usable = usable && got && AreRemainders(this->Remainders, this->Areas);
  return got && !usable ? Outcome::Failed(std::string("it holds areas or sums that are negative or "
                                                      "not finite.") +
                            Again)
                        : got;
}

//------------------------------------------------------------------------------
Outcome Reader::GetSummaries()
{
  for (Count k = 0; k < this->Head.NumberOfSummaries; ++k)
  {
    Count length = 0;
    if (Outcome got = this->Get(&length, sizeof(length)); !got)
    {
      return got;
    }
    if (length > MaximumNameLength)
    {
      return FailDamaged();
    }
    this->Result.Summaries.emplace_back(std::string(static_cast<std::size_t>(length), ' '), 0.0);
    auto& [name, value] = this->Result.Summaries.back();
    Outcome got = this->Get(name.data(), length);
    got = got ? this->Get(&value, sizeof(value)) : got;
    if (!got)
    {
      return got;
    }
    // Only a closure leaves this summary behind.
    this->Result.AreRowsClosed = this->Result.AreRowsClosed || name == "ClosureChange";
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::MakeMatrix()
{
  const Count expected = this->Head.NumberOfTiles * BytesPerTile + sizeof(Count);
  if (this->Remaining < expected)
  {
    return FailTooShort();
  }
  if (this->Remaining > expected)
  {
    return Outcome::Failed(std::string("something follows behind its end.") + Again);
  }
  this->Result.Matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
  this->Result.Matrix->AllocateSparse(this->Areas, 1);
  if (std::any_of(this->Remainders.begin(), this->Remainders.end(),
        [](double remainder) { return remainder != 0.0; }))
  {
    this->Result.Matrix->SetRemainders(this->Remainders);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::GetTiles()
{
  vtkExchangeMatrix* exchange = this->Result.Matrix;
  const auto rows = static_cast<Count>(exchange->GetNumberOfTileRows());
  vtkIdType previous = -1;
  for (Count k = 0; k < this->Head.NumberOfTiles; ++k)
  {
    TileName name;
    if (Outcome got = this->Get(&name, sizeof(name)); !got)
    {
      return got;
    }
    const bool inside = name.Row <= name.Column && name.Column < rows;
    const vtkIdType index = inside ? exchange->GetTileIndex(static_cast<vtkIdType>(name.Row),
                                       static_cast<vtkIdType>(name.Column))
                                   : -1;
    if (index <= previous)
    {
      return Outcome::Failed(
        std::string("it names a block of view factors that cannot be.") + Again);
    }
    previous = index;
    Tile& tile = exchange->GetTiles()[index];
    if (!exchange->AllocateTile(tile))
    {
      return Outcome::Failed("there is not enough memory. Load it on a machine with more.");
    }
    if (Outcome got = this->Get(tile.Values, sizeof(float) * N * N); !got)
    {
      return got;
    }
    if (!IsUsable(tile, exchange->GetNumberOfPatches()))
    {
      return Outcome::Failed(
        std::string("it holds view factors that cannot be (negative, not finite, "
                    "or not reciprocal).") +
        Again);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome Reader::GetChecksum()
{
  const Count expected = this->Sum.Get();
  Count sum = 0;
  if (Outcome got = this->Get(&sum, sizeof(sum)); !got)
  {
    return got;
  }
  this->Result.Fingerprint = this->Head.Fingerprint;
  this->Result.Tolerance = this->Head.Tolerance;
  return sum == expected
    ? Outcome::Done()
    : Outcome::Failed(std::string("it is damaged: its checksum is wrong.") + Again);
}

//------------------------------------------------------------------------------
// What Read would refuse is not written.
bool CanBeWritten(const Links& links)
{
  const vtkExchangeMatrix* exchange = links.Matrix;
  if (!exchange || exchange->GetNumberOfKernels() != 1 || exchange->GetNumberOfParts() != 1 ||
    !AreUsable(&links.Tolerance, 1, 0.0))
  {
    return false;
  }
  const std::vector<double>& areas = exchange->GetAreas();
  bool good =
    AreUsable(areas.data(), areas.size(), 0.0) && AreRemainders(exchange->GetRemainders(), areas);
  for (Row row : Rows)
  {
    good = good && (links.*row).size() == areas.size() && AreUsable(links.*row, row);
  }
  good = good && links.Summaries.size() <= MaximumSummaries &&
    std::all_of(links.Summaries.begin(), links.Summaries.end(),
      [](const auto& summary) { return summary.first.size() <= MaximumNameLength; });
  const vtkIdType patches = exchange->GetNumberOfPatches();
  return good &&
    std::all_of(exchange->GetTiles().begin(), exchange->GetTiles().end(),
      [patches](const Tile& tile) { return !tile.Values || IsUsable(tile, patches); });
}
} // namespace

//------------------------------------------------------------------------------
Outcome ViewFactorsFile::Write(const std::string& fileName, const Links& links)
{
  if (!CanBeWritten(links))
  {
    return Outcome::Failed("Nothing is written to \"" + fileName +
      "\": the view factors are not complete, or negative, or not finite. Compute them again, in "
      "one process.");
  }
  Outcome written = Outcome::Done();
  try
  {
    written = Writer().Write(fileName, links);
  }
  catch (const std::bad_alloc&)
  {
    written = Outcome::Failed("there is not enough memory; save it on a machine with more");
  }
  return written
    ? written
    : Outcome::Failed("\"" + fileName + "\" cannot be written: " + written.GetMessage() +
        " (it takes " + TransportMemory::Format(links.Matrix->GetNumberOfBytes()) + ").");
}

//------------------------------------------------------------------------------
Outcome ViewFactorsFile::Read(const std::string& fileName, Links& links)
{
  Reader reader;
  Outcome read = Outcome::Done();
  try
  {
    read = reader.Read(fileName);
  }
  catch (const std::bad_alloc&)
  {
    read = Outcome::Failed("there is not enough memory. Load it on a machine with more.");
  }
  if (!read)
  {
    return Outcome::Failed(
      "No view factors can be read from \"" + fileName + "\": " + read.GetMessage());
  }
  links = std::move(reader.Result);
  return read;
}
} // namespace LightTransport
