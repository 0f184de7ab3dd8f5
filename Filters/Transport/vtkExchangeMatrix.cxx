// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExchangeMatrix.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <new>

vtkStandardNewMacro(vtkExchangeMatrix);

namespace
{
constexpr vtkIdType TileValues =
  static_cast<vtkIdType>(vtkExchangeMatrix::TileSize) * vtkExchangeMatrix::TileSize;

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
bool vtkExchangeMatrix::Allocate(const std::vector<double>& areas, int numberOfKernels, int part,
  int numberOfParts)
{
  this->Areas = areas;
  this->Tiles.clear();
  this->Storage.clear();
  this->NumberOfKernels = numberOfKernels;
  this->Part = part;
  this->NumberOfParts = numberOfParts;

  const std::size_t values = static_cast<std::size_t>(TileValues) * numberOfKernels;
  const vtkIdType rows = this->GetNumberOfTileRows();
  for (vtkIdType row = 0, index = 0; row < rows; ++row)
  {
    for (vtkIdType column = row; column < rows; ++column, ++index)
    {
      if (index % numberOfParts != part)
      {
        continue;
      }
      std::unique_ptr<float[]> storage(new (std::nothrow) float[values]());
      if (!storage)
      {
        this->Areas.clear();
        this->Tiles.clear();
        this->Storage.clear();
        return false;
      }
      this->Tiles.push_back({ row, column, storage.get() });
      this->Storage.push_back(std::move(storage));
    }
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
