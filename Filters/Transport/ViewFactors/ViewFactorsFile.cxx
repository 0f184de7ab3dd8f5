// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorsFile.h"

#include "Links/Links.h"
#include "Shared/TransportMemory.h"
#include "ViewFactors/CheckedFile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <utility>

namespace LightTransport
{
namespace
{
using CheckedFile::Count;
using CheckedFile::Reader;
using Tile = vtkExchangeMatrix::Tile;

constexpr int N = vtkExchangeMatrix::TileSize;
constexpr CheckedFile::Format Format{ "vtkLightTransport view factors ", "3", "view factors" };

/// More than anybody needs; a file that wants more is damaged.
constexpr Count MaximumSummaries = 1000;
constexpr Count MaximumNameLength = 1000;

struct Header
{
  CheckedFile::Start Begin;
  Count TileSize;
  Count Fingerprint;
  double Tolerance;
  Count NumberOfPatches;
  Count NumberOfSummaries;
  Count NumberOfTiles;
};
static_assert(sizeof(Header) == sizeof(CheckedFile::Start) + 6 * sizeof(Count),
  "a header without gaps");

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
class MatrixWriter
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
    this->File.PutValues(links.Matrix->GetAreas());
    for (Row row : Rows)
    {
      this->File.PutValues(links.*row);
    }
    std::vector<double> remainders = links.Matrix->GetRemainders();
    remainders.resize(links.Matrix->GetAreas().size(), 0.0);
    this->File.PutValues(remainders);
    for (const auto& [name, value] : links.Summaries)
    {
      const Count length = name.size();
      this->File.Put(&length, sizeof(length));
      this->File.Put(name.data(), name.size());
      this->File.Put(&value, sizeof(value));
    }
    for (const Tile& tile : links.Matrix->GetTiles())
    {
      if (tile.Values && !this->File.HasFailed())
      {
        const TileName name{ static_cast<Count>(tile.Row), static_cast<Count>(tile.Column) };
        this->File.Put(&name, sizeof(name));
        this->File.Put(tile.Values, sizeof(float) * N * N);
      }
    }
    return this->File.Finish();
  }

private:
  void PutHeader(const Links& links)
  {
    Header header;
    header.Begin = CheckedFile::Writer::MakeStart(Format);
    header.TileSize = N;
    header.Fingerprint = links.Fingerprint;
    header.Tolerance = links.Tolerance;
    header.NumberOfPatches = static_cast<Count>(links.Matrix->GetNumberOfPatches());
    header.NumberOfSummaries = links.Summaries.size();
    header.NumberOfTiles = static_cast<Count>(links.Matrix->GetNumberOfStoredTiles());
    this->File.Put(&header, sizeof(header));
  }

  CheckedFile::Writer File;
};

//------------------------------------------------------------------------------
// Reads one file from its beginning to its end; a failure's message begins after the file's name.
class MatrixReader
{
public:
  Links Result;

  Outcome Read(const std::string& fileName)
  {
    Outcome outcome = this->File.Open(fileName);
    for (const auto step : { &MatrixReader::GetHeader, &MatrixReader::CheckSizes,
           &MatrixReader::GetRows, &MatrixReader::GetSummaries, &MatrixReader::MakeMatrix,
           &MatrixReader::GetTiles, &MatrixReader::GetChecksum })
    {
      outcome = outcome ? (this->*step)() : outcome;
    }
    return outcome;
  }

private:
  Outcome GetValues(std::vector<double>& values)
  {
    values.resize(static_cast<std::size_t>(this->Head.NumberOfPatches));
    return this->File.Get(values.data(), this->Head.NumberOfPatches * sizeof(double));
  }

  Outcome GetHeader();
  Outcome CheckSizes();
  Outcome GetRows();
  Outcome GetSummaries();
  Outcome MakeMatrix();
  Outcome GetTiles();
  Outcome GetChecksum();

  Reader File;
  Header Head;
  std::vector<double> Areas;
  std::vector<double> Remainders;
};

//------------------------------------------------------------------------------
Outcome MatrixReader::GetHeader()
{
  Outcome got = this->File.GetHead(Format, this->Head);
  if (got && this->Head.TileSize != N)
  {
    return Reader::FailVersion(Format);
  }
  return got && !AreUsable(&this->Head.Tolerance, 1, 0.0) ? Reader::FailDamaged() : got;
}

//------------------------------------------------------------------------------
// Before anything is allocated: the file is as long as what it announces, and there is the memory.
Outcome MatrixReader::CheckSizes()
{
  const Count patches = this->Head.NumberOfPatches;
  const Count tiles = this->Head.NumberOfTiles;
  if (patches > this->File.GetRemaining() / BytesPerPatch ||
    tiles > this->File.GetRemaining() / BytesPerTile || patches > static_cast<Count>(VTK_ID_MAX))
  {
    return Reader::FailTooShort();
  }
  if (this->Head.NumberOfSummaries > MaximumSummaries)
  {
    return Reader::FailDamaged();
  }
  const double bytes = static_cast<double>(patches * BytesPerPatch) +
    vtkExchangeMatrix::GetEstimatedSparseBytes(static_cast<vtkIdType>(patches), 1,
      static_cast<vtkIdType>(tiles));
  return Reader::CheckMemory(bytes);
}

//------------------------------------------------------------------------------
Outcome MatrixReader::GetRows()
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
  return got && !usable ? Reader::Fail("it holds areas or sums that are negative or not finite.")
                        : got;
}

//------------------------------------------------------------------------------
Outcome MatrixReader::GetSummaries()
{
  for (Count k = 0; k < this->Head.NumberOfSummaries; ++k)
  {
    Count length = 0;
    if (Outcome got = this->File.Get(&length, sizeof(length)); !got)
    {
      return got;
    }
    if (length > MaximumNameLength)
    {
      return Reader::FailDamaged();
    }
    this->Result.Summaries.emplace_back(std::string(static_cast<std::size_t>(length), ' '), 0.0);
    auto& [name, value] = this->Result.Summaries.back();
    Outcome got = this->File.Get(name.data(), length);
    got = got ? this->File.Get(&value, sizeof(value)) : got;
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
Outcome MatrixReader::MakeMatrix()
{
  if (Outcome all = this->File.ExpectLast(this->Head.NumberOfTiles * BytesPerTile); !all)
  {
    return all;
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
Outcome MatrixReader::GetTiles()
{
  vtkExchangeMatrix* exchange = this->Result.Matrix;
  const auto rows = static_cast<Count>(exchange->GetNumberOfTileRows());
  vtkIdType previous = -1;
  for (Count k = 0; k < this->Head.NumberOfTiles; ++k)
  {
    TileName name;
    if (Outcome got = this->File.Get(&name, sizeof(name)); !got)
    {
      return got;
    }
    const bool inside = name.Row <= name.Column && name.Column < rows;
    const vtkIdType index = inside ? exchange->GetTileIndex(static_cast<vtkIdType>(name.Row),
                                       static_cast<vtkIdType>(name.Column))
                                   : -1;
    if (index <= previous)
    {
      return Reader::Fail("it names a block of view factors that cannot be.");
    }
    previous = index;
    Tile& tile = exchange->GetTiles()[index];
    if (!exchange->AllocateTile(tile))
    {
      return Outcome::Failed("there is not enough memory. Load it on a machine with more.");
    }
    if (Outcome got = this->File.Get(tile.Values, sizeof(float) * N * N); !got)
    {
      return got;
    }
    if (!IsUsable(tile, exchange->GetNumberOfPatches()))
    {
      return Reader::Fail("it holds view factors that cannot be (negative, not finite, or not "
                          "reciprocal).");
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MatrixReader::GetChecksum()
{
  this->Result.Fingerprint = this->Head.Fingerprint;
  this->Result.Tolerance = this->Head.Tolerance;
  return this->File.GetChecksum();
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
    written = MatrixWriter().Write(fileName, links);
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
  MatrixReader reader;
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
