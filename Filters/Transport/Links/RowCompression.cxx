// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/RowCompression.h"

#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "Support/SplitMix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace LightTransport
{
namespace
{
constexpr std::int16_t Exact = -1;
// Links that the book is trained on, about.
constexpr double Samples = 32768.0;
// Rows of a tile: fewer would pay as much for the list of slots as they save, more would be much
// work for one thread.
constexpr int FewestRows = 16;
constexpr int MostRows = 256;
constexpr vtkIdType RowsPerTask = 256;

//------------------------------------------------------------------------------
std::vector<int> GetOrder(const std::vector<std::uint64_t>& keys)
{
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}
} // namespace

//------------------------------------------------------------------------------
double RowCompression::Compress(vtkExchangeHierarchy& hierarchy, double tolerance,
  const Ranks& ranks)
{
  RowCompression compression(hierarchy, tolerance, ranks);
  compression.SumAreas();
  compression.MeasureKernels();
  compression.TrainBook();
  compression.Code();
  const double error = compression.GetError();
  compression.CutRows();
  compression.Replace();
  return error;
}

//------------------------------------------------------------------------------
RowCompression::RowCompression(vtkExchangeHierarchy& hierarchy, double tolerance,
  const Ranks& ranks)
  : Hierarchy(hierarchy), Tolerance(tolerance), AllRanks(ranks),
    Kernels(hierarchy.GetNumberOfKernels()), Offsets(hierarchy.GetOffsets()),
    Columns(hierarchy.GetColumns()), Book(this->Kernels, 0, {}, {})
{
}

//------------------------------------------------------------------------------
void RowCompression::SumAreas()
{
  const auto nodes = static_cast<std::size_t>(this->Hierarchy.GetNumberOfNodes());
  const std::vector<double>& weights = this->Hierarchy.GetWeights();
  this->Areas.assign(nodes, 0.0);
  this->Areas.insert(this->Areas.end(), weights.begin(), weights.end());
  for (std::size_t slot = this->Areas.size(); slot-- > 1;)
  {
    this->Areas[this->Hierarchy.GetParents()[slot]] += this->Areas[slot];
  }
}

//------------------------------------------------------------------------------
// One over the mean square of the row sums; values of the largest link become at most 1, which
// single precision can square.
void RowCompression::MeasureKernels()
{
  std::vector<double> squares(this->Kernels, 0.0);
  std::vector<double> largest(this->Kernels, 0.0);
  std::vector<double> sums(this->Kernels);
  for (int row = 0; row < this->Hierarchy.GetNumberOfSlots(); ++row)
  {
    Pulse::Beat(row);
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
    {
      for (int kernel = 0; kernel < this->Kernels; ++kernel)
      {
        const double value = std::abs(static_cast<double>(this->GetValues(link)[kernel]));
        if (std::isfinite(value))
        {
          sums[kernel] += this->Areas[this->Columns[link]] * value;
          largest[kernel] = std::max(largest[kernel], value);
        }
      }
    }
    for (int kernel = 0; kernel < this->Kernels; ++kernel)
    {
      squares[kernel] += this->Areas[row] * sums[kernel] * sums[kernel];
    }
  }
  this->AllRanks.Sum(squares);
  double most = 0.0;
  for (int kernel = 0; kernel < this->Kernels; ++kernel)
  {
    const double scale = squares[kernel] > 0.0 ? 1.0 / std::sqrt(squares[kernel]) : 0.0;
    this->Scales.push_back(scale);
    most = std::max(most, scale * this->AllRanks.GetLargest(largest[kernel]));
  }
  for (double& scale : this->Scales)
  {
    scale = most > 0.0 ? scale / most : 0.0;
  }
}

//------------------------------------------------------------------------------
// Which links are looked at depends on their ends alone, so that any number of ranks takes the same
// ones.
void RowCompression::TrainBook()
{
  std::vector<vtkIdType> count = { static_cast<vtkIdType>(this->Columns.size()) };
  this->AllRanks.Sum(count);
  const double share = Samples / static_cast<double>(std::max<vtkIdType>(count[0], 1));
  const auto slots = static_cast<std::uint64_t>(this->Hierarchy.GetNumberOfSlots());
  std::vector<std::uint64_t> keys;
  std::vector<float> points;
  std::vector<double> weights;
  for (std::uint64_t row = 0; row < slots; ++row)
  {
    Pulse::Beat(row);
    for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
    {
      const std::uint64_t key = row * slots + static_cast<std::uint64_t>(this->Columns[link]);
      const float* values = this->GetValues(link);
      if (static_cast<double>(SplitMix(key).GetNext()) < share * 0x1p64 &&
        std::all_of(values, values + this->Kernels, [](float v) { return std::isfinite(v); }))
      {
        const double area = this->Areas[this->Columns[link]];
        keys.push_back(key);
        weights.push_back(this->Areas[row] * area * area);
        for (int kernel = 0; kernel < this->Kernels; ++kernel)
        {
          points.push_back(static_cast<float>(this->Scales[kernel] * values[kernel]));
        }
      }
    }
  }
  keys = this->AllRanks.Gather(keys);
  points = this->AllRanks.Gather(points);
  weights = this->AllRanks.Gather(weights);
  std::vector<float> sortedPoints;
  std::vector<double> sortedWeights;
  for (const int sample : GetOrder(keys))
  {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(sample) * this->Kernels;
    sortedPoints.insert(sortedPoints.end(), first, first + this->Kernels);
    sortedWeights.push_back(weights[sample]);
  }
  // Entry 0 is for nothing.
  this->Book = LinkCodeBook(this->Kernels, CodedRows::BookSize - 1, sortedPoints, sortedWeights);
  this->Coded.Book.assign(static_cast<std::size_t>(CodedRows::BookSize) * this->Kernels, 0.0f);
  for (int entry = 0; entry < this->Book.GetNumberOfEntries(); ++entry)
  {
    for (int kernel = 0; kernel < this->Kernels; ++kernel)
    {
      const double scale = this->Scales[kernel];
      this->Coded.Book[static_cast<std::size_t>(1 + entry) * this->Kernels + kernel] = scale > 0.0
        ? static_cast<float>(static_cast<double>(this->Book.Get(entry, kernel)) / scale)
        : 0.0f;
    }
  }
}

//------------------------------------------------------------------------------
void RowCompression::Code()
{
  const std::size_t slots = this->Areas.size();
  this->Codes.resize(this->Columns.size());
  this->Errors.assign(slots * this->Kernels, 0.0);
  this->Sizes.assign(slots * this->Kernels, 0.0);
  const auto code = [this](vtkIdType begin, vtkIdType end)
  {
    std::vector<float> point(static_cast<std::size_t>(this->Kernels));
    std::vector<float> distances(CodedRows::BookSize);
    for (vtkIdType row = begin; row < end; ++row)
    {
      for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
      {
        const float* values = this->GetValues(link);
        bool isFinite = this->Book.GetNumberOfEntries() > 0;
        bool isNothing = true;
        for (int kernel = 0; kernel < this->Kernels; ++kernel)
        {
          point[kernel] = static_cast<float>(this->Scales[kernel] * values[kernel]);
          isFinite = isFinite && std::isfinite(values[kernel]);
          isNothing = isNothing && values[kernel] == 0.0f;
        }
        this->Codes[link] = Exact;
        if (isNothing || isFinite)
        {
          this->Codes[link] = static_cast<std::int16_t>(
            isNothing ? 0 : 1 + this->Book.Find(point.data(), distances.data()));
        }
      }
      this->CodeRow(static_cast<int>(row));
    }
  };
  Threads::For(0, static_cast<vtkIdType>(slots), RowsPerTask, code);
}

//------------------------------------------------------------------------------
// Which links stay, and how far the others are off.
void RowCompression::CodeRow(int row)
{
  const std::int64_t first = this->Offsets[row];
  const std::int64_t last = this->Offsets[row + 1];
  std::vector<double> means(static_cast<std::size_t>(this->Kernels), 0.0);
  for (std::int64_t link = first; link < last; ++link)
  {
    for (int kernel = 0; kernel < this->Kernels; ++kernel)
    {
      means[kernel] += this->Areas[this->Columns[link]] *
        std::abs(static_cast<double>(this->GetValues(link)[kernel])) /
        static_cast<double>(last - first);
    }
  }
  for (std::int64_t link = first; link < last; ++link)
  {
    if (this->IsCoded(link) && this->Tolerance > 0.0 && this->IsMissed(link, means.data()))
    {
      this->Codes[link] = Exact;
    }
    for (int kernel = 0; kernel < this->Kernels; ++kernel)
    {
      const auto value = static_cast<double>(this->GetValues(link)[kernel]);
      const std::int16_t code = this->Codes[link];
      const double error = code == Exact
        ? 0.0
        : value - static_cast<double>(this->Coded.Book[code * this->Kernels + kernel]);
      const double area = this->Areas[this->Columns[link]];
      const double weight = this->Areas[row] * area * area;
      const std::size_t place = static_cast<std::size_t>(row) * this->Kernels + kernel;
      this->Errors[place] += weight * error * error;
      this->Sizes[place] += std::isfinite(value) ? weight * value * value : 0.0;
    }
  }
}

//------------------------------------------------------------------------------
bool RowCompression::IsMissed(std::int64_t link, const double* means) const
{
  const double area = this->Areas[this->Columns[link]];
  const float* values = this->GetValues(link);
  const float* entry =
    this->Coded.Book.data() + static_cast<std::ptrdiff_t>(this->Codes[link]) * this->Kernels;
  bool isMissed = false;
  for (int kernel = 0; kernel < this->Kernels; ++kernel)
  {
    const auto value = static_cast<double>(values[kernel]);
    const double most = 0.5 * this->Tolerance * (area * std::abs(value) + means[kernel]);
    isMissed = isMissed || !(area * std::abs(value - static_cast<double>(entry[kernel])) <= most);
  }
  return isMissed;
}

//------------------------------------------------------------------------------
double RowCompression::GetError() const
{
  std::vector<double> sums(2 * static_cast<std::size_t>(this->Kernels), 0.0);
  for (std::size_t place = 0; place < this->Errors.size(); ++place)
  {
    sums[place % this->Kernels] += this->Errors[place];
    sums[this->Kernels + place % this->Kernels] += this->Sizes[place];
  }
  this->AllRanks.Sum(sums);
  double worst = 0.0;
  for (int kernel = 0; kernel < this->Kernels; ++kernel)
  {
    const double size = sums[this->Kernels + kernel];
    worst = std::max(worst, size > 0.0 ? std::sqrt(sums[kernel] / size) : 0.0);
  }
  return worst;
}

//------------------------------------------------------------------------------
// Rows are in the order of the slots, which are neighbours there.
void RowCompression::CutRows()
{
  const int slots = this->Hierarchy.GetNumberOfSlots();
  this->TileOf.assign(slots, -1);
  this->RowOf.assign(slots, -1);
  this->Uses.assign(slots, 0);
  this->Places.assign(slots, 0);
  this->Coded.Bytes.reserve(2 * this->Columns.size());
  for (int row = 0; row < slots; ++row)
  {
    Pulse::Beat(row);
    const auto first = this->Codes.begin() + this->Offsets[row];
    const auto last = this->Codes.begin() + this->Offsets[row + 1];
    if (std::any_of(first, last, [](std::int16_t code) { return code > 0; }) &&
      !this->AddToTile(row))
    {
      this->CloseTile();
      this->AddToTile(row);
    }
  }
  this->CloseTile();
}

//------------------------------------------------------------------------------
// False where the row belongs into the next tile.
bool RowCompression::AddToTile(int row)
{
  if (this->TileRows == 0)
  {
    this->FirstRow = row;
  }
  const std::size_t before = this->TileSlots.size();
  for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
  {
    const int slot = this->Columns[link];
    if (this->IsCoded(link) && this->TileOf[slot] != this->FirstRow)
    {
      this->TileOf[slot] = this->FirstRow;
      this->Uses[slot] = 0;
      this->TileSlots.push_back(slot);
    }
  }
  if (row != this->FirstRow + this->TileRows || this->TileRows == MostRows ||
    (this->TileRows >= FewestRows && this->TileSlots.size() > std::size_t(CodedRows::BookSize)))
  {
    for (; this->TileSlots.size() > before; this->TileSlots.pop_back())
    {
      this->TileOf[this->TileSlots.back()] = -1;
    }
    return false;
  }
  for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
  {
    const int slot = this->Columns[link];
    if (this->IsCoded(link) && this->RowOf[slot] != row)
    {
      this->RowOf[slot] = row;
      ++this->Uses[slot];
    }
  }
  ++this->TileRows;
  return true;
}

//------------------------------------------------------------------------------
void RowCompression::CloseTile()
{
  std::vector<int>& slots = this->TileSlots;
  std::sort(slots.begin(), slots.end());
  const auto rest = std::stable_partition(slots.begin(), slots.end(),
    [&](int s) { return this->Uses[s] == this->TileRows; });
  const int all = static_cast<int>(rest - slots.begin());
  const int common = all - all % CodedRows::CommonStep;
  std::sort(slots.begin() + common, slots.end());
  const int count = static_cast<int>(slots.size());
  for (int place = 0; place < count; ++place)
  {
    this->Places[slots[place]] = place;
  }
  for (int first = 0; first < count; first += CodedRows::BookSize)
  {
    const int last = std::min(first + CodedRows::BookSize, count);
    this->WriteTile(std::min(std::max(common - first, 0), CodedRows::BookSize), first, last);
  }
  slots.clear();
  this->TileRows = 0;
}

//------------------------------------------------------------------------------
void RowCompression::WriteTile(int common, int firstPlace, int lastPlace)
{
  const auto size = [](const auto& table) { return static_cast<std::int64_t>(table.size()); };
  const int lastRow = this->FirstRow + this->TileRows;
  this->Coded.Tiles.push_back({ this->FirstRow, lastRow, lastPlace - firstPlace, common,
    size(this->Coded.Slots), size(this->Coded.Bytes) });
  this->Coded.WriteSlots(this->TileSlots.data() + firstPlace, this->TileSlots.data() + lastPlace,
    common);
  for (int row = this->FirstRow; row < lastRow; ++row)
  {
    this->WritePiece(row, common, firstPlace, lastPlace);
  }
}

//------------------------------------------------------------------------------
void RowCompression::WritePiece(int row, int common, int firstPlace, int lastPlace)
{
  std::vector<std::uint8_t>& codes = this->CommonCodes;
  codes.assign(static_cast<std::size_t>(common), 0);
  this->PairBytes.clear();
  for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
  {
    const int place = this->Places[this->Columns[link]];
    if (!this->IsCoded(link) || place < firstPlace || place >= lastPlace)
    {
      continue;
    }
    const auto within = static_cast<std::uint8_t>(place - firstPlace);
    const auto code = static_cast<std::uint8_t>(this->Codes[link]);
    ++this->Coded.NumberOfLinks;
    // A slot may have several links with a row.
    if (within < common && codes[within] == 0)
    {
      codes[within] = code;
    }
    else
    {
      this->PairBytes.insert(this->PairBytes.end(), { within, code });
    }
  }
  std::vector<std::uint8_t>& bytes = this->Coded.Bytes;
  CodedRows::WriteNumber(static_cast<std::uint32_t>(this->PairBytes.size() / 2), bytes);
  bytes.insert(bytes.end(), codes.begin(), codes.end());
  bytes.insert(bytes.end(), this->PairBytes.begin(), this->PairBytes.end());
}

//------------------------------------------------------------------------------
void RowCompression::Replace()
{
  std::vector<std::int64_t> offsets = { 0 };
  std::vector<int> columns;
  std::vector<float> values;
  for (std::size_t row = 0; row + 1 < this->Offsets.size(); ++row)
  {
    for (std::int64_t link = this->Offsets[row]; link < this->Offsets[row + 1]; ++link)
    {
      if (this->Codes[link] == Exact)
      {
        columns.push_back(this->Columns[link]);
        values.insert(values.end(), this->GetValues(link), this->GetValues(link) + this->Kernels);
      }
    }
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }
  this->Hierarchy.SetRows(std::move(offsets), std::move(columns), std::move(values));
  this->Coded.Bytes.shrink_to_fit();
  this->Coded.Slots.shrink_to_fit();
  this->Coded.Tiles.shrink_to_fit();
  this->Hierarchy.SetCodedRows(std::move(this->Coded));
}
} // namespace LightTransport
