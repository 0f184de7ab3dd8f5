// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDenseLinkOperator.h"

#include "Operators/TileKernels.h"
#include "Shared/Threads.h"
#include "vtkExchangeMatrix.h"
#include "vtkObjectFactory.h"

#include <Eigen/Core>

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkDenseLinkOperator);

namespace
{
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
// Few tiles a task: a core that is busy with something else must not hold up the others.
constexpr vtkIdType TilesPerTask = 8;
constexpr float RowOfZeros[N] = {};

using Array = Eigen::Map<Eigen::ArrayXd>;
using ConstArray = Eigen::Map<const Eigen::ArrayXd>;

//------------------------------------------------------------------------------
// What the threads have summed, each for itself.
void AddUp(Threads::Local<std::vector<double>>& sums, double* target, long size)
{
  Array total(target, size);
  total.setZero();
  sums.ForEach([&](const std::vector<double>& sum) { total += ConstArray(sum.data(), size); });
}

//------------------------------------------------------------------------------
// Products with a range of tiles, summed into a vector of each thread's own.
struct TileProducts
{
  const std::vector<vtkExchangeMatrix::Tile>& Tiles;
  const std::vector<double>& Remainders;
  int Kernels;
  int Bands;
  long Stride;
  const double* X;
  double* Y;
  Threads::Local<std::vector<double>> Sums;

  void Initialize() { this->Sums.Get().assign(this->Bands * this->Stride, 0.0); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    double* y = this->Sums.Get().data();
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkExchangeMatrix::Tile& tile = this->Tiles[index];
      if (tile.Row == tile.Column && !this->Remainders.empty())
      {
        this->AddRemainders(tile.Row * N, y);
      }
      if (!tile.Values)
      {
        continue;
      }
      for (int kernel = 0; kernel < this->Kernels; ++kernel)
      {
        const long offset = kernel * this->Stride;
        this->MultiplyKernel(tile, tile.Values + kernel * N * N, this->X + offset, y + offset);
      }
    }
  }

  void AddRemainders(vtkIdType row, double* y) const
  {
    const auto end = std::min(row + N, static_cast<vtkIdType>(this->Remainders.size()));
    for (int band = 0; band < this->Bands; ++band)
    {
      const long offset = band * this->Stride;
      for (vtkIdType i = row; i < end; ++i)
      {
        y[offset + i] += this->Remainders[i] * this->X[offset + i];
      }
    }
  }

  // All bands of a kernel, which lie that many bands apart.
  void MultiplyKernel(const vtkExchangeMatrix::Tile& tile, const float* values, const double* x,
    double* y) const
  {
    const int bands = this->Bands / this->Kernels;
    const long stride = this->Kernels * this->Stride;
    const vtkIdType row = tile.Row * N;
    const vtkIdType column = tile.Column * N;
    if (row == column)
    {
      TileKernels::MultiplyTileRows(values, bands, stride, x + row, y + row);
    }
    else
    {
      TileKernels::MultiplyTile(values, bands, stride, x + row, x + column, y + row, y + column);
    }
  }

  void Reduce() { AddUp(this->Sums, this->Y, this->Bands * this->Stride); }
};

//------------------------------------------------------------------------------
// What one row of tiles gathers from all others, for a Gauss-Seidel sweep.
struct RowOfTiles
{
  const vtkExchangeMatrix& Exchange;
  vtkIdType Row;
  int Bands;
  long Stride;
  const double* X;
  double* Y; // Bands x N
  Threads::Local<std::vector<double>> Sums;

  void Initialize() { this->Sums.Get().assign(this->Bands * N, 0.0); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    std::vector<double> x(this->Bands * N);
    double* y = this->Sums.Get().data();
    for (vtkIdType other = begin; other < end; ++other)
    {
      const float* values = this->FindTile(other);
      if (other == this->Row || !values)
      {
        continue;
      }
      for (int band = 0; band < this->Bands; ++band)
      {
        const double* source = this->X + band * this->Stride + other * N;
        std::copy(source, source + N, x.begin() + band * N);
      }
      this->Gather(values, other < this->Row, x.data(), y);
    }
  }

  const float* FindTile(vtkIdType other) const
  {
    const vtkIdType index =
      this->Exchange.GetTileIndex(std::min(this->Row, other), std::max(this->Row, other));
    return this->Exchange.GetTiles()[index].Values;
  }

  void Gather(const float* values, bool transposed, const double* x, double* y) const
  {
    const int kernels = this->Exchange.GetNumberOfKernels();
    for (int kernel = 0; kernel < kernels; ++kernel)
    {
      const auto multiply =
        transposed ? TileKernels::MultiplyTileColumns : TileKernels::MultiplyTileRows;
      multiply(values + kernel * N * N, this->Bands / kernels, kernels * N, x + kernel * N,
        y + kernel * N);
    }
  }

  void Reduce() { AddUp(this->Sums, this->Y, this->Bands * N); }
};
} // namespace

//------------------------------------------------------------------------------
vtkDenseLinkOperator::vtkDenseLinkOperator() = default;

//------------------------------------------------------------------------------
vtkDenseLinkOperator::~vtkDenseLinkOperator() = default;

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::TakeExchange(vtkExchange* exchange)
{
  this->Exchange = vtkExchangeMatrix::SafeDownCast(exchange);
  return this->Exchange != nullptr;
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::DropExchange()
{
  this->Exchange = nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkDenseLinkOperator::GetPaddedSize()
{
  return this->Exchange->GetNumberOfTileRows() * N;
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::MultiplyPart(const Vector& x, Vector& y)
{
  const std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
  if (tiles.empty())
  {
    // A rank may hold none.
    std::fill(y.begin(), y.end(), 0.0);
    return;
  }
  TileProducts products{ tiles, this->Exchange->GetRemainders(), this->NumberOfKernels,
    this->NumberOfBands, this->Stride, x.data(), y.data(), {} };
  Threads::For(0, static_cast<vtkIdType>(tiles.size()), TilesPerTask, products);
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::GatherOffDiagonal(vtkIdType tileRow, const Vector& x, Vector& sums)
{
  sums.resize(this->NumberOfBands * N);
  RowOfTiles gather{ *this->Exchange, tileRow, this->NumberOfBands, this->Stride, x.data(),
    sums.data(), {} };
  Threads::For(0, this->Exchange->GetNumberOfTileRows(), 0, gather);
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Sweep(int x, int e, int left)
{
  Vector* solution = this->FindVector(x);
  const Vector* source = this->FindVector(e);
  const Vector* scaling = this->FindVector(left);
  if (!solution || !source || !scaling)
  {
    return false;
  }
  if (this->Exchange->GetNumberOfParts() > 1)
  {
    vtkErrorMacro("A sweep needs the whole matrix: Gauss-Seidel and Southwell run on one process; "
                  "use Jacobi, Chebyshev or ConjugateGradient on several.");
    return false;
  }
  const std::vector<double>& remainders = this->Exchange->GetRemainders();
  Vector sums;
  for (vtkIdType row = 0; row < this->Exchange->GetNumberOfTileRows(); ++row)
  {
    this->GatherOffDiagonal(row, *solution, sums);
    const vtkExchangeMatrix::Tile& tile =
      this->Exchange->GetTiles()[this->Exchange->GetTileIndex(row, row)];
    const int patches = static_cast<int>(std::min(N, this->NumberOfPatches - row * N));
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      const int kernel = band % this->NumberOfKernels;
      const long offset = band * this->Stride + row * N;
      double* block = solution->data() + offset;
      for (int i = 0; i < patches; ++i)
      {
        const float* g = tile.Values ? tile.Values + (kernel * N + i) * N : RowOfZeros;
        double sum = sums[band * N + i];
        sum += remainders.empty() ? 0.0 : remainders[row * N + i] * block[i];
        for (int j = 0; j < patches; ++j)
        {
          sum += g[j] * block[j];
        }
        block[i] = (*source)[offset + i] + (*scaling)[offset + i] * sum;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::FillRow(vtkIdType i, int kernel, double* row)
{
  for (vtkIdType column = 0; column < this->Exchange->GetNumberOfTileRows(); ++column)
  {
    const vtkIdType count = std::min(N, this->NumberOfPatches - column * N);
    for (vtkIdType j = 0; j < count; ++j)
    {
      row[column * N + j] = this->Exchange->GetValue(i, column * N + j, kernel);
    }
  }
}

//------------------------------------------------------------------------------
const char* vtkDenseLinkOperator::GetInstructionSet()
{
  return TileKernels::GetInstructionSet();
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Exchange: " << this->Exchange.Get() << "\n";
}
