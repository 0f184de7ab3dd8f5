// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExchangeMatrix.h"

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

//------------------------------------------------------------------------------
// Zeros, or nullptr when the memory is not there.
float* AllocateBlock(std::size_t count)
{
  const std::size_t bytes = count * sizeof(float);
  auto* block = static_cast<float*>(::operator new(bytes, LargePage, std::nothrow));
  if (block)
  {
#if defined(__linux__)
    // Advice: where it is not taken everything still works.
    madvise(block, bytes, MADV_HUGEPAGE);
#endif
    std::fill_n(block, count, 0.0f);
  }
  return block;
}

//------------------------------------------------------------------------------
vtkIdType CountTileRows(vtkIdType numberOfPatches)
{
  return (numberOfPatches + vtkExchangeMatrix::TileSize - 1) / vtkExchangeMatrix::TileSize;
}
} // namespace

//------------------------------------------------------------------------------
vtkExchangeMatrix::vtkExchangeMatrix() = default;

//------------------------------------------------------------------------------
vtkExchangeMatrix::~vtkExchangeMatrix() = default;

//------------------------------------------------------------------------------
void vtkExchangeMatrix::FreeBlock::operator()(float* block) const
{
  ::operator delete(block, LargePage);
}

//------------------------------------------------------------------------------
bool vtkExchangeMatrix::Allocate(const std::vector<double>& areas, int numberOfKernels, int part,
  int numberOfParts)
{
  this->Areas = areas;
  this->Tiles.clear();
  this->Storage.reset();
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
  const std::size_t values = static_cast<std::size_t>(TileValues) * numberOfKernels;
  this->Storage.reset(AllocateBlock(values * this->Tiles.size()));
  if (!this->Storage)
  {
    this->Areas.clear();
    this->Tiles.clear();
    return false;
  }
  float* next = this->Storage.get();
  for (Tile& tile : this->Tiles)
  {
    tile.Values = next;
    next += values;
  }
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
double vtkExchangeMatrix::GetEstimatedBytes(vtkIdType numberOfPatches, int numberOfKernels,
  int numberOfParts)
{
  const double rows = static_cast<double>(CountTileRows(numberOfPatches));
  const double tiles = rows * (rows + 1.0) / 2.0;
  return tiles * TileValues * sizeof(float) * numberOfKernels / numberOfParts;
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
  const Tile& tile = this->Tiles[index / this->NumberOfParts];
  return tile.Values[kernel * TileValues + (i % TileSize) * TileSize + j % TileSize];
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
double vtkExchangeMatrix::GetNumberOfBytes() const
{
  return static_cast<double>(this->Tiles.size()) * TileValues * sizeof(float) *
    this->NumberOfKernels;
}

//------------------------------------------------------------------------------
void vtkExchangeMatrix::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPatches: " << this->GetNumberOfPatches() << "\n";
  os << indent << "NumberOfKernels: " << this->NumberOfKernels << "\n";
  os << indent << "Part: " << this->Part << " of " << this->NumberOfParts << "\n";
  os << indent << "NumberOfTiles: " << this->Tiles.size() << "\n";
}
