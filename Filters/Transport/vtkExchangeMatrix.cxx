// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExchangeMatrix.h"

#include "Shared/Threads.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

vtkStandardNewMacro(vtkExchangeMatrix);

namespace
{
constexpr vtkIdType TileValues =
  static_cast<vtkIdType>(vtkExchangeMatrix::TileSize) * vtkExchangeMatrix::TileSize;

// Large pages, where the system has them: a product reads the whole matrix, and with small pages it
// waits for address look-ups for about a third of the time.
constexpr std::align_val_t LargePage{ std::size_t(2) << 20 };

// Chunks start with one large page (for one kernel) and double, so that neither small matrices nor
// large ones ask the system for much more, or much more often, than they need.
constexpr vtkIdType TilesOfFirstChunk = 8;
constexpr vtkIdType TilesOfLargestChunk = 256;

//------------------------------------------------------------------------------
vtkIdType CountTileRows(vtkIdType numberOfPatches)
{
  return (numberOfPatches + vtkExchangeMatrix::TileSize - 1) / vtkExchangeMatrix::TileSize;
}

//------------------------------------------------------------------------------
// Tiles of all parts, stored or not.
double CountTiles(vtkIdType numberOfPatches)
{
  const double rows = static_cast<double>(CountTileRows(numberOfPatches));
  return rows * (rows + 1.0) / 2.0;
}

//------------------------------------------------------------------------------
double GetTileBytes(int numberOfKernels)
{
  return static_cast<double>(TileValues) * sizeof(float) * numberOfKernels;
}
} // namespace

//------------------------------------------------------------------------------
vtkExchangeMatrix::vtkExchangeMatrix() = default;

//------------------------------------------------------------------------------
vtkExchangeMatrix::~vtkExchangeMatrix() = default;

//------------------------------------------------------------------------------
void vtkExchangeMatrix::FreeChunk::operator()(float* chunk) const
{
  ::operator delete(chunk, LargePage);
}

//------------------------------------------------------------------------------
bool vtkExchangeMatrix::Allocate(const std::vector<double>& areas, int numberOfKernels, int part,
  int numberOfParts)
{
  this->AllocateSparse(areas, numberOfKernels, part, numberOfParts);
  const auto tiles = static_cast<vtkIdType>(this->Tiles.size());
  if (!this->AddChunk(tiles))
  {
    this->AllocateSparse({}, numberOfKernels, part, numberOfParts);
    return false;
  }
  for (Tile& tile : this->Tiles)
  {
    tile.Values = this->FreeTiles.back();
    this->FreeTiles.pop_back();
  }
  // The system hands out memory as it is written, which for a large matrix takes seconds.
  auto clear = [this](vtkIdType begin, vtkIdType end)
  {
    const vtkIdType values = TileValues * this->NumberOfKernels;
    std::for_each(this->Tiles.begin() + begin, this->Tiles.begin() + end,
      [values](const Tile& tile) { std::fill_n(tile.Values, values, 0.0f); });
  };
  LightTransport::Threads::For(0, tiles, 1, clear);
  return true;
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::AllocateSparse(const std::vector<double>& areas, int numberOfKernels,
  int part, int numberOfParts)
{
  this->Areas = areas;
  this->Tiles.clear();
  this->Remainders.clear();
  this->FreeTiles.clear();
  this->Chunks.clear();
  this->TilesOfNextChunk = TilesOfFirstChunk;
  this->NumberOfKernels = numberOfKernels;
  this->Part = part;
  this->NumberOfParts = numberOfParts;

  const vtkIdType rows = this->GetNumberOfTileRows();
  for (vtkIdType row = 0, index = 0; row < rows; ++row)
  {
    for (vtkIdType column = row; column < rows; ++column, ++index)
    {
      if (index % numberOfParts == part)
      {
        this->Tiles.push_back({ row, column, nullptr });
      }
    }
  }
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkExchangeMatrix::AddChunk(vtkIdType numberOfTiles)
{
  const auto tiles = static_cast<std::size_t>(numberOfTiles);
  const std::size_t values = static_cast<std::size_t>(TileValues) * this->NumberOfKernels;
  const std::size_t bytes = tiles * values * sizeof(float);
  auto* chunk = static_cast<float*>(::operator new(bytes, LargePage, std::nothrow));
  if (!chunk)
  {
    return false;
  }
  this->Chunks.emplace_back(chunk);
#if defined(__linux__)
  // Advice: where it is not taken everything still works.
  madvise(chunk, bytes, MADV_HUGEPAGE);
#endif
  for (std::size_t tile = tiles; tile > 0; --tile)
  {
    this->FreeTiles.push_back(chunk + (tile - 1) * values);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkExchangeMatrix::AllocateTile(Tile& tile)
{
  if (tile.Values)
  {
    return true;
  }
  {
    const std::lock_guard<std::mutex> lock(this->StorageMutex);
    if (this->FreeTiles.empty())
    {
      if (!this->AddChunk(this->TilesOfNextChunk))
      {
        return false;
      }
      this->TilesOfNextChunk = std::min(2 * this->TilesOfNextChunk, TilesOfLargestChunk);
    }
    tile.Values = this->FreeTiles.back();
    this->FreeTiles.pop_back();
  }
  std::fill_n(tile.Values, TileValues * this->NumberOfKernels, 0.0f);
  return true;
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::ReleaseTile(Tile& tile)
{
  if (tile.Values)
  {
    const std::lock_guard<std::mutex> lock(this->StorageMutex);
    this->FreeTiles.push_back(tile.Values);
    tile.Values = nullptr;
  }
}

//------------------------------------------------------------------------------
double vtkExchangeMatrix::GetEstimatedBytes(vtkIdType numberOfPatches, int numberOfKernels,
  int numberOfParts)
{
  return CountTiles(numberOfPatches) * GetTileBytes(numberOfKernels) / numberOfParts;
}

//------------------------------------------------------------------------------
double vtkExchangeMatrix::GetEstimatedSparseBytes(vtkIdType numberOfPatches, int numberOfKernels,
  vtkIdType numberOfTiles, int numberOfParts)
{
  return static_cast<double>(numberOfTiles) * GetTileBytes(numberOfKernels) +
    CountTiles(numberOfPatches) * sizeof(Tile) / numberOfParts;
}

//------------------------------------------------------------------------------
vtkIdType vtkExchangeMatrix::GetNumberOfTileRows() const
{
  return CountTileRows(this->GetNumberOfPatches());
}

//------------------------------------------------------------------------------
vtkIdType vtkExchangeMatrix::GetTileIndex(vtkIdType row, vtkIdType column) const
{
  return row * this->GetNumberOfTileRows() - row * (row - 1) / 2 + (column - row);
}

//------------------------------------------------------------------------------
double vtkExchangeMatrix::GetValue(vtkIdType i, vtkIdType j, int kernel) const
{
  if (i / TileSize > j / TileSize)
  {
    std::swap(i, j);
  }
  const vtkIdType index = this->GetTileIndex(i / TileSize, j / TileSize);
  if (index % this->NumberOfParts != this->Part)
  {
    return 0.0;
  }
  const double remainder = i == j && !this->Remainders.empty() ? this->Remainders[i] : 0.0;
  const float* values = this->Tiles[index / this->NumberOfParts].Values;
  return remainder +
    (values ? values[kernel * TileValues + (i % TileSize) * TileSize + j % TileSize] : 0.0);
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::SetRemainders(const std::vector<double>& remainders)
{
  this->Remainders = remainders;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::SetValue(Tile& tile, int row, int column, int kernel, double value)
{
  float* values = tile.Values + kernel * TileValues;
  values[row * TileSize + column] = static_cast<float>(value);
  if (tile.Row == tile.Column)
  {
    values[column * TileSize + row] = static_cast<float>(value);
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkExchangeMatrix::GetNumberOfStoredTiles() const
{
  return static_cast<vtkIdType>(std::count_if(this->Tiles.begin(), this->Tiles.end(),
    [](const Tile& tile) { return tile.Values != nullptr; }));
}

//------------------------------------------------------------------------------
double vtkExchangeMatrix::GetNumberOfBytes() const
{
  return static_cast<double>(this->GetNumberOfStoredTiles()) * GetTileBytes(this->NumberOfKernels);
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPatches: " << this->GetNumberOfPatches() << "\n";
  os << indent << "NumberOfKernels: " << this->NumberOfKernels << "\n";
  os << indent << "Part: " << this->Part << " of " << this->NumberOfParts << "\n";
  os << indent << "NumberOfTiles: " << this->Tiles.size() << "\n";
  os << indent << "NumberOfStoredTiles: " << this->GetNumberOfStoredTiles() << "\n";
}
