// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDenseLinkOperator.h"

#include "vtkCommunicator.h"
#include "vtkExchangeMatrix.h"
#include "vtkLinkKernels.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkSMPThreadLocal.h"
#include "vtkTransportThreads.h"

#include <Eigen/Core>

#include <algorithm>

vtkStandardNewMacro(vtkDenseLinkOperator);

namespace
{
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
// Keeps the same patch of different bands at different offsets within a page of memory: processors
// take equal ones for a store followed by a load of the same address, and wait.
constexpr vtkIdType StridePadding = 40;
// Few tiles a task: a core that is busy with something else must not hold up the others.
constexpr vtkIdType TilesPerTask = 8;
constexpr float RowOfZeros[N] = {};

using Array = Eigen::Map<Eigen::ArrayXd>;
using ConstArray = Eigen::Map<const Eigen::ArrayXd>;

//------------------------------------------------------------------------------
// What the threads have summed, each for itself.
void AddUp(vtkSMPThreadLocal<std::vector<double>>& sums, double* target, long size)
{
  Array total(target, size);
  total.setZero();
  for (const std::vector<double>& sum : sums)
  {
    total += ConstArray(sum.data(), size);
  }
}

//------------------------------------------------------------------------------
// Products with a range of tiles, summed into a vector of each thread's own.
struct TileProducts
{
  const std::vector<vtkExchangeMatrix::Tile>& Tiles;
  int Kernels;
  int Bands;
  long Stride;
  const double* X;
  double* Y;
  vtkSMPThreadLocal<std::vector<double>> Sums;

  void Initialize() { this->Sums.Local().assign(this->Bands * this->Stride, 0.0); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    double* y = this->Sums.Local().data();
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkExchangeMatrix::Tile& tile = this->Tiles[index];
      if (!tile.Values)
      {
        continue;
      }
      if (this->Kernels == 1)
      {
        this->MultiplyKernel(tile, tile.Values, this->Bands, this->X, y);
        continue;
      }
      for (int kernel = 0; kernel < this->Kernels; ++kernel)
      {
        const long offset = kernel * this->Stride;
        this->MultiplyKernel(tile, tile.Values + kernel * N * N, 1, this->X + offset, y + offset);
      }
    }
  }

  void MultiplyKernel(const vtkExchangeMatrix::Tile& tile, const float* values, int bands,
    const double* x, double* y) const
  {
    const vtkIdType row = tile.Row * N;
    const vtkIdType column = tile.Column * N;
    if (row == column)
    {
      vtkLinkKernels::MultiplyTileRows(values, bands, this->Stride, x + row, y + row);
    }
    else
    {
      vtkLinkKernels::MultiplyTile(values, bands, this->Stride, x + row, x + column, y + row,
        y + column);
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
  vtkSMPThreadLocal<std::vector<double>> Sums;

  void Initialize() { this->Sums.Local().assign(this->Bands * N, 0.0); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    std::vector<double> x(this->Bands * N);
    double* y = this->Sums.Local().data();
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
    const int bands = kernels == 1 ? this->Bands : 1;
    for (int kernel = 0; kernel < kernels; ++kernel)
    {
      const auto multiply =
        transposed ? vtkLinkKernels::MultiplyTileColumns : vtkLinkKernels::MultiplyTileRows;
      multiply(values + kernel * N * N, bands, N, x + kernel * N, y + kernel * N);
    }
  }

  void Reduce() { AddUp(this->Sums, this->Y, this->Bands * N); }
};
} // namespace

//------------------------------------------------------------------------------
vtkDenseLinkOperator::vtkDenseLinkOperator() = default;

//------------------------------------------------------------------------------
vtkDenseLinkOperator::~vtkDenseLinkOperator()
{
  this->Release();
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkDenseLinkOperator, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Initialize(vtkExchangeMatrix* exchange, int numberOfBands)
{
  this->Release();
  if (!exchange || numberOfBands < 1)
  {
    vtkErrorMacro("A link operator needs an exchange matrix and at least one band.");
    return false;
  }
  const int kernels = exchange->GetNumberOfKernels();
  if (kernels != 1 && kernels != numberOfBands)
  {
    vtkErrorMacro("The exchange matrix has " << kernels << " kernels for " << numberOfBands
                                             << " bands: give it one kernel, or one per band.");
    return false;
  }
  if (exchange->GetNumberOfParts() > 1 &&
    (!this->Controller || this->Controller->GetNumberOfProcesses() != exchange->GetNumberOfParts()))
  {
    vtkErrorMacro("The exchange matrix is in "
      << exchange->GetNumberOfParts()
      << " parts: set the controller of the ranks that hold them (SetController).");
    return false;
  }
  this->Exchange = exchange;
  this->Exchange->Register(this);
  this->NumberOfPatches = exchange->GetNumberOfPatches();
  this->NumberOfBands = numberOfBands;
  this->Stride = static_cast<long>(exchange->GetNumberOfTileRows() * N + StridePadding);
  return true;
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::Release()
{
  if (this->Exchange)
  {
    this->Exchange->UnRegister(this);
    this->Exchange = nullptr;
  }
  this->Vectors.clear();
  this->NumberOfPatches = 0;
  this->NumberOfBands = 0;
}

//------------------------------------------------------------------------------
vtkDenseLinkOperator::Vector* vtkDenseLinkOperator::FindVector(int slot)
{
  if (!this->Exchange)
  {
    vtkErrorMacro("The link operator has no links: call Initialize first.");
    return nullptr;
  }
  const auto found = this->Vectors.find(slot);
  if (found == this->Vectors.end())
  {
    vtkErrorMacro("Vector " << slot << " was read before it was written.");
    return nullptr;
  }
  return &found->second;
}

//------------------------------------------------------------------------------
vtkDenseLinkOperator::Vector& vtkDenseLinkOperator::MakeVector(int slot)
{
  Vector& vector = this->Vectors[slot];
  vector.resize(this->NumberOfBands * this->Stride, 0.0);
  return vector;
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::SetVector(int slot, const double* values)
{
  Vector& vector = this->MakeVector(slot);
  for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
  {
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      vector[band * this->Stride + patch] = values[patch * this->NumberOfBands + band];
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::GetVector(int slot, double* values)
{
  const Vector* vector = this->FindVector(slot);
  for (vtkIdType patch = 0; vector && patch < this->NumberOfPatches; ++patch)
  {
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      values[patch * this->NumberOfBands + band] = (*vector)[band * this->Stride + patch];
    }
  }
  return vector != nullptr;
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Multiply(int y, int x)
{
  const Vector* source = this->FindVector(x);
  if (!source)
  {
    return false;
  }
  if (x == y)
  {
    vtkErrorMacro("Multiply needs two different vectors.");
    return false;
  }
  Vector& target = this->MakeVector(y);
  const std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
  if (tiles.empty())
  {
    // A rank may hold none.
    std::fill(target.begin(), target.end(), 0.0);
  }
  else
  {
    TileProducts products{ tiles, this->Exchange->GetNumberOfKernels(), this->NumberOfBands,
      this->Stride, source->data(), target.data(), {} };
    vtkTransportThreads::For(0, static_cast<vtkIdType>(tiles.size()), TilesPerTask, products);
  }
  if (this->Exchange->GetNumberOfParts() > 1)
  {
    const Vector part = target;
    return this->Controller->AllReduce(part.data(), target.data(),
             static_cast<vtkIdType>(target.size()), vtkCommunicator::SUM_OP) != 0;
  }
  return true;
}

//------------------------------------------------------------------------------
// Call operation(band, x, y) with the bands of two vectors as Eigen arrays.
template <typename Operation>
bool vtkDenseLinkOperator::ForEachBand(int x, int y, Operation&& operation)
{
  const Vector* first = this->FindVector(x);
  const Vector* second = this->FindVector(y);
  if (!first || !second)
  {
    return false;
  }
  for (int band = 0; band < this->NumberOfBands; ++band)
  {
    const long offset = band * this->Stride;
    operation(band, ConstArray(first->data() + offset, this->Stride),
      ConstArray(second->data() + offset, this->Stride));
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Combine(int z, const double* a, int x, const double* b, int y)
{
  double* target = this->MakeVector(z).data();
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { Array(target + band * this->Stride, this->Stride) = a[band] * first + b[band] * second; });
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Scale(int z, int x, int y)
{
  double* target = this->MakeVector(z).data();
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { Array(target + band * this->Stride, this->Stride) = first * second; });
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::Dot(int x, int y, double* result)
{
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { result[band] = (first * second).sum(); });
}

//------------------------------------------------------------------------------
bool vtkDenseLinkOperator::MaxNorm(int x, double* result)
{
  return this->ForEachBand(x, x,
    [&](int band, const ConstArray& first, const ConstArray&)
    { result[band] = first.abs().maxCoeff<Eigen::PropagateNaN>(); });
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::GatherOffDiagonal(vtkIdType tileRow, const Vector& x, Vector& sums)
{
  sums.resize(this->NumberOfBands * N);
  RowOfTiles gather{ *this->Exchange, tileRow, this->NumberOfBands, this->Stride, x.data(),
    sums.data(), {} };
  vtkTransportThreads::For(0, this->Exchange->GetNumberOfTileRows(), 0, gather);
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
  Vector sums;
  for (vtkIdType row = 0; row < this->Exchange->GetNumberOfTileRows(); ++row)
  {
    this->GatherOffDiagonal(row, *solution, sums);
    const vtkExchangeMatrix::Tile& tile =
      this->Exchange->GetTiles()[this->Exchange->GetTileIndex(row, row)];
    const int patches = static_cast<int>(std::min(N, this->NumberOfPatches - row * N));
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      const int kernel = this->Exchange->GetNumberOfKernels() == 1 ? 0 : band;
      const long offset = band * this->Stride + row * N;
      double* block = solution->data() + offset;
      for (int i = 0; i < patches; ++i)
      {
        const float* g = tile.Values ? tile.Values + (kernel * N + i) * N : RowOfZeros;
        double sum = sums[band * N + i];
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
bool vtkDenseLinkOperator::GetRow(vtkIdType i, int band, double* row)
{
  if (!this->Exchange || this->Exchange->GetNumberOfParts() > 1)
  {
    vtkErrorMacro("A row needs the whole matrix: call Initialize with one in a single part.");
    return false;
  }
  const int kernel = this->Exchange->GetNumberOfKernels() == 1 ? 0 : band;
  for (vtkIdType column = 0; column < this->Exchange->GetNumberOfTileRows(); ++column)
  {
    const vtkIdType count = std::min(N, this->NumberOfPatches - column * N);
    for (vtkIdType j = 0; j < count; ++j)
    {
      row[column * N + j] = this->Exchange->GetValue(i, column * N + j, kernel);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
const char* vtkDenseLinkOperator::GetInstructionSet()
{
  return vtkLinkKernels::GetInstructionSet();
}

//------------------------------------------------------------------------------
int vtkDenseLinkOperator::GetNumberOfThreads()
{
  int threads = 1;
  vtkTransportThreads::Run([&]() { threads = vtkSMPTools::GetEstimatedNumberOfThreads(); });
  return threads;
}

//------------------------------------------------------------------------------
void vtkDenseLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Exchange: " << this->Exchange << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Vectors: " << this->Vectors.size() << "\n";
}
