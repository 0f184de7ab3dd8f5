// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHierarchicalLinkOperator.h"

#include "Shared/Threads.h"
#include "vtkExchangeHierarchy.h"
#include "vtkObjectFactory.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkHierarchicalLinkOperator);

namespace
{
// Bands that one pass over the links serves.
constexpr int MaximumBands = 4;
// Rows that a thread takes at a time: rows differ in length.
constexpr vtkIdType RowsPerTask = 1024;

//------------------------------------------------------------------------------
// Y_I = sum of K X_J for bands [0, Count) of `Bands`. Bands share one value of each link, or have
// kernels of their own.
template <int Count, bool HasKernels>
struct Gather
{
  // Sums that do not wait for each other: an addition takes some four cycles.
  static constexpr int Chains = Count > 2 ? 2 : 8 / Count;

  const vtkExchangeHierarchy& Hierarchy;
  int Bands;
  const double* Sent;
  double* Received;
  int FirstKernel; ///< where bands have their own

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    const std::int64_t* offsets = this->Hierarchy.GetOffsets().data();
    const int* columns = this->Hierarchy.GetColumns().data();
    const float* values = this->Hierarchy.GetValues().data() + this->FirstKernel;
    const int kernels = HasKernels ? this->Hierarchy.GetNumberOfKernels() : 1;
    for (vtkIdType slot = begin; slot < end; ++slot)
    {
      double sums[Chains][Count] = {};
      std::int64_t link = offsets[slot];
      for (; link + Chains <= offsets[slot + 1]; link += Chains)
      {
        for (int chain = 0; chain < Chains; ++chain)
        {
          this->Add(columns[link + chain], values + (link + chain) * kernels, sums[chain]);
        }
      }
      for (; link < offsets[slot + 1]; ++link)
      {
        this->Add(columns[link], values + link * kernels, sums[0]);
      }
      for (int band = 0; band < Count; ++band)
      {
        double sum = 0.0;
        for (int chain = 0; chain < Chains; ++chain)
        {
          sum += sums[chain][band];
        }
        this->Received[slot * this->Bands + band] = sum;
      }
    }
  }

  void Add(int column, const float* values, double* sums) const
  {
    const double* sent = this->Sent + static_cast<std::int64_t>(column) * this->Bands;
    for (int band = 0; band < Count; ++band)
    {
      sums[band] += static_cast<double>(values[HasKernels ? band : 0]) * sent[band];
    }
  }
};

//------------------------------------------------------------------------------
template <int Count>
void GatherBands(const vtkExchangeHierarchy& hierarchy, int bands, int first, const double* sent,
  double* received)
{
  if (hierarchy.GetNumberOfKernels() > 1)
  {
    Gather<Count, true> gather{ hierarchy, bands, sent + first, received + first, first };
    Threads::For(0, hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
  else
  {
    Gather<Count, false> gather{ hierarchy, bands, sent + first, received + first, 0 };
    Threads::For(0, hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
}

//------------------------------------------------------------------------------
void GatherAll(const vtkExchangeHierarchy& hierarchy, int bands, const double* sent,
  double* received)
{
  for (int first = 0; first < bands; first += MaximumBands)
  {
    switch (std::min(bands - first, MaximumBands))
    {
      case 1:
        GatherBands<1>(hierarchy, bands, first, sent, received);
        break;
      case 2:
        GatherBands<2>(hierarchy, bands, first, sent, received);
        break;
      case 3:
        GatherBands<3>(hierarchy, bands, first, sent, received);
        break;
      default:
        GatherBands<MaximumBands>(hierarchy, bands, first, sent, received);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
vtkHierarchicalLinkOperator::vtkHierarchicalLinkOperator() = default;

//------------------------------------------------------------------------------
vtkHierarchicalLinkOperator::~vtkHierarchicalLinkOperator() = default;

//------------------------------------------------------------------------------
bool vtkHierarchicalLinkOperator::TakeExchange(vtkExchange* exchange)
{
  this->Hierarchy = vtkExchangeHierarchy::SafeDownCast(exchange);
  return this->Hierarchy != nullptr;
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::DropExchange()
{
  this->Hierarchy = nullptr;
  this->Sent.clear();
  this->Received.clear();
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::SweepUp(const Vector& x)
{
  const std::vector<double>& weights = this->Hierarchy->GetWeights();
  const std::vector<vtkExchangeHierarchy::Node>& nodes = this->Hierarchy->GetNodes();
  const int bands = this->NumberOfBands;
  this->Sent.resize(static_cast<std::size_t>(this->Hierarchy->GetNumberOfSlots()) * bands);
  double* patches = this->Sent.data() + nodes.size() * bands;
  for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
  {
    for (int band = 0; band < bands; ++band)
    {
      patches[patch * bands + band] = weights[patch] * x[band * this->Stride + patch];
    }
  }
  for (std::size_t node = nodes.size(); node-- > 0;)
  {
    double* sum = this->Sent.data() + node * bands;
    std::fill(sum, sum + bands, 0.0);
    for (int child = nodes[node].First; child < nodes[node].Last; ++child)
    {
      const double* sent = this->Sent.data() + static_cast<std::size_t>(child) * bands;
      std::transform(sum, sum + bands, sent, sum, std::plus<double>());
    }
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::SweepDown(int bands)
{
  const std::vector<vtkExchangeHierarchy::Node>& nodes = this->Hierarchy->GetNodes();
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    const double* received = this->Received.data() + node * bands;
    for (int child = nodes[node].First; child < nodes[node].Last; ++child)
    {
      double* sum = this->Received.data() + static_cast<std::size_t>(child) * bands;
      std::transform(sum, sum + bands, received, sum, std::plus<double>());
    }
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::MultiplyPart(const Vector& x, Vector& y)
{
  const int bands = this->NumberOfBands;
  this->SweepUp(x);
  this->Received.resize(this->Sent.size());
  GatherAll(*this->Hierarchy, bands, this->Sent.data(), this->Received.data());
  this->SweepDown(bands);
  const std::vector<double>& weights = this->Hierarchy->GetWeights();
  const double* patches =
    this->Received.data() + static_cast<std::size_t>(this->Hierarchy->GetNumberOfNodes()) * bands;
  for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
  {
    for (int band = 0; band < bands; ++band)
    {
      y[band * this->Stride + patch] = weights[patch] * patches[patch * bands + band];
    }
  }
}

//------------------------------------------------------------------------------
// The links of the patch and of all nodes above it, swept down.
void vtkHierarchicalLinkOperator::FillRow(vtkIdType i, int kernel, double* row)
{
  this->Received.assign(this->Hierarchy->GetNumberOfSlots(), 0.0);
  const int nodes = this->Hierarchy->GetNumberOfNodes();
  const std::vector<std::int64_t>& offsets = this->Hierarchy->GetOffsets();
  for (int slot = nodes + static_cast<int>(i); slot >= 0;
       slot = this->Hierarchy->GetParents()[slot])
  {
    for (std::int64_t link = offsets[slot]; link < offsets[slot + 1]; ++link)
    {
      this->Received[this->Hierarchy->GetColumns()[link]] +=
        this->Hierarchy->GetValues()[link * this->Hierarchy->GetNumberOfKernels() + kernel];
    }
  }
  this->SweepDown(1);
  const std::vector<double>& weights = this->Hierarchy->GetWeights();
  for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
  {
    row[patch] = weights[i] * weights[patch] * this->Received[nodes + patch];
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Hierarchy: " << this->Hierarchy.Get() << "\n";
}
