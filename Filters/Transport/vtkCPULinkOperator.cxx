// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCPULinkOperator.h"

#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "vtkDenseLinkOperator.h"
#include "vtkExchangeHierarchy.h"
#include "vtkHierarchicalLinkOperator.h"
#include "vtkMultiProcessController.h"

#include <Eigen/Core>

#include <algorithm>

using namespace LightTransport;

namespace
{
// Keeps the same patch of different bands at different offsets within a page of memory: processors
// take equal ones for a store followed by a load of the same address, and wait.
constexpr vtkIdType StridePadding = 40;

using Array = Eigen::Map<Eigen::ArrayXd>;
using ConstArray = Eigen::Map<const Eigen::ArrayXd>;
} // namespace

//------------------------------------------------------------------------------
vtkCPULinkOperator::vtkCPULinkOperator() = default;

//------------------------------------------------------------------------------
vtkCPULinkOperator::~vtkCPULinkOperator()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkCPULinkOperator, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCPULinkOperator> vtkCPULinkOperator::NewFor(vtkExchange* exchange)
{
  if (vtkExchangeHierarchy::SafeDownCast(exchange))
  {
    return vtkSmartPointer<vtkHierarchicalLinkOperator>::New();
  }
  return vtkSmartPointer<vtkDenseLinkOperator>::New();
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::Initialize(vtkExchange* exchange, int numberOfBands)
{
  this->Release();
  if (!exchange || numberOfBands < 1)
  {
    vtkErrorMacro("A link operator needs an exchange matrix and at least one band.");
    return false;
  }
  const int kernels = exchange->GetNumberOfKernels();
  if (kernels < 1 || numberOfBands % kernels != 0)
  {
    vtkErrorMacro("The exchange has " << kernels << " kernels for " << numberOfBands
                                      << " bands: the bands must be a multiple of the kernels.");
    return false;
  }
  if (exchange->GetNumberOfParts() > 1 &&
    Ranks(this->Controller).GetNumber() != exchange->GetNumberOfParts())
  {
    vtkErrorMacro("The exchange matrix is in "
      << exchange->GetNumberOfParts()
      << " parts: set the controller of the ranks that hold them (SetController).");
    return false;
  }
  if (!this->TakeExchange(exchange))
  {
    vtkErrorMacro(<< this->GetClassName() << " does not apply a " << exchange->GetClassName()
                  << ": use vtkCPULinkOperator::NewFor.");
    return false;
  }
  this->NumberOfPatches = exchange->GetNumberOfPatches();
  this->NumberOfBands = numberOfBands;
  this->NumberOfKernels = kernels;
  this->NumberOfParts = exchange->GetNumberOfParts();
  this->Stride = static_cast<long>(this->GetPaddedSize() + StridePadding);
  return true;
}

//------------------------------------------------------------------------------
void vtkCPULinkOperator::Release()
{
  this->DropExchange();
  this->Vectors.clear();
  this->NumberOfPatches = 0;
  this->NumberOfBands = 0;
}

//------------------------------------------------------------------------------
vtkCPULinkOperator::Vector* vtkCPULinkOperator::FindVector(int slot)
{
  if (this->NumberOfBands == 0)
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
vtkCPULinkOperator::Vector& vtkCPULinkOperator::MakeVector(int slot)
{
  Vector& vector = this->Vectors[slot];
  vector.resize(this->NumberOfBands * this->Stride, 0.0);
  return vector;
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::SetVector(int slot, const double* values)
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
bool vtkCPULinkOperator::GetVector(int slot, double* values)
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
bool vtkCPULinkOperator::Multiply(int y, int x)
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
  this->MultiplyPart(*source, target);
  return this->NumberOfParts == 1 ||
    Ranks(this->Controller).Sum(target.data(), static_cast<std::size_t>(target.size()));
}

//------------------------------------------------------------------------------
// Call operation(band, x, y) with the bands of two vectors as Eigen arrays.
template <typename Operation>
bool vtkCPULinkOperator::ForEachBand(int x, int y, Operation&& operation)
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
bool vtkCPULinkOperator::Combine(int z, const double* a, int x, const double* b, int y)
{
  double* target = this->MakeVector(z).data();
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { Array(target + band * this->Stride, this->Stride) = a[band] * first + b[band] * second; });
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::Scale(int z, int x, int y)
{
  double* target = this->MakeVector(z).data();
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { Array(target + band * this->Stride, this->Stride) = first * second; });
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::Dot(int x, int y, double* result)
{
  return this->ForEachBand(x, y,
    [&](int band, const ConstArray& first, const ConstArray& second)
    { result[band] = (first * second).sum(); });
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::MaxNorm(int x, double* result)
{
  return this->ForEachBand(x, x,
    [&](int band, const ConstArray& first, const ConstArray&)
    { result[band] = first.abs().maxCoeff<Eigen::PropagateNaN>(); });
}

//------------------------------------------------------------------------------
bool vtkCPULinkOperator::GetRow(vtkIdType i, int band, double* row)
{
  if (this->NumberOfBands == 0 || this->NumberOfParts > 1)
  {
    vtkErrorMacro("A row needs all links: call Initialize with an exchange in a single part.");
    return false;
  }
  this->FillRow(i, band % this->NumberOfKernels, row);
  return true;
}

//------------------------------------------------------------------------------
int vtkCPULinkOperator::GetNumberOfThreads()
{
  int threads = 1;
  Threads::Run([&]() { threads = vtkSMPTools::GetEstimatedNumberOfThreads(); });
  return threads;
}

//------------------------------------------------------------------------------
void vtkCPULinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Vectors: " << this->Vectors.size() << "\n";
}
