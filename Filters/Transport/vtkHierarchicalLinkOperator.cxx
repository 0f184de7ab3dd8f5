// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHierarchicalLinkOperator.h"

#include "Shared/Threads.h"
#include "vtkExchangeHierarchy.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <functional>
#include <set>

using namespace LightTransport;

vtkStandardNewMacro(vtkHierarchicalLinkOperator);

namespace
{
// Bands that one pass over the links serves.
constexpr int MaximumBands = 4;
// Rows that a thread takes at a time: rows differ in length.
constexpr vtkIdType RowsPerTask = 1024;
constexpr vtkIdType TilesPerTask = 16;

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
// Y_I += sum over the coded links of I, for bands [0, Count) of `Bands`. What a tile's rows hear is
// copied into one place first, so that nothing else than it, the book and the bytes are read.
template <int Count>
struct GatherCodes
{
  using CodedRows = vtkExchangeHierarchy::CodedRows;
  // Three bands take as long as four, which are whole vectors.
  static constexpr int Lanes = Count + (Count == 3 ? 1 : 0);
  static constexpr int TileValues = Lanes * CodedRows::BookSize;

  const CodedRows& Coded;
  int Bands;
  const double* Sent;
  double* Received;
  std::vector<double> Book; ///< as MakeBook makes it

  static std::vector<double> MakeBook(const vtkExchangeHierarchy& hierarchy, int firstKernel)
  {
    const std::vector<float>& values = hierarchy.GetCodedRows().Book;
    const int kernels = hierarchy.GetNumberOfKernels();
    std::vector<double> book(TileValues, 0.0);
    for (int code = 0; code < CodedRows::BookSize; ++code)
    {
      for (int band = 0; band < Count; ++band)
      {
        const int kernel = kernels > 1 ? firstKernel + band : 0;
        book[code * Lanes + band] = static_cast<double>(values[code * kernels + kernel]);
      }
    }
    return book;
  }

  // Tiles of the same rows stay on one thread: they add to the same sums.
  void operator()(vtkIdType begin, vtkIdType end) const
  {
    std::vector<double> heard(TileValues, 0.0);
    const auto skip = [&](vtkIdType tile)
    {
      while (tile < static_cast<vtkIdType>(this->Coded.Tiles.size()) && this->Coded.Continues(tile))
      {
        ++tile;
      }
      return tile;
    };
    const vtkIdType last = skip(end);
    for (vtkIdType tile = skip(begin); tile < last; ++tile)
    {
      this->GatherTile(this->Coded.Tiles[tile], heard.data());
    }
  }

  void GatherTile(const CodedRows::Tile& tile, double* heard) const
  {
    for (int slot = tile.FirstSlot; slot < tile.LastSlot; ++slot)
    {
      const double* sent =
        this->Sent + static_cast<std::int64_t>(this->Coded.Slots[slot]) * this->Bands;
      std::copy(sent, sent + Count,
        heard + static_cast<std::int64_t>(slot - tile.FirstSlot) * Lanes);
    }
    const double* book = this->Book.data();
    this->Coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        double sums[Lanes] = {};
        CodedRows::VisitLinks(tile, bytes, pairs,
          [&](int place, int code)
          {
            for (int lane = 0; lane < Lanes; ++lane)
            {
              sums[lane] += book[code * Lanes + lane] * heard[place * Lanes + lane];
            }
          });
        double* received = this->Received + static_cast<std::int64_t>(row) * this->Bands;
        std::transform(sums, sums + Count, received, received, std::plus<double>());
      });
  }
};

//------------------------------------------------------------------------------
template <int Count>
void GatherBands(const vtkExchangeHierarchy& hierarchy, int bands, int first, const double* sent,
  double* received)
{
  double* target = received + first;
  if (hierarchy.GetNumberOfKernels() > 1)
  {
    Gather<Count, true> gather{ hierarchy, bands, sent + first, target, first };
    Threads::For(0, hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
  else
  {
    Gather<Count, false> gather{ hierarchy, bands, sent + first, target, 0 };
    Threads::For(0, hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
  const auto tiles = static_cast<vtkIdType>(hierarchy.GetCodedRows().Tiles.size());
  if (tiles > 0)
  {
    GatherCodes<Count> gather{ hierarchy.GetCodedRows(), bands, sent + first, target,
      GatherCodes<Count>::MakeBook(hierarchy, first) };
    Threads::For(0, tiles, TilesPerTask, gather);
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
  this->FillCodedRow(i, kernel);
  this->SweepDown(1);
  const std::vector<double>& weights = this->Hierarchy->GetWeights();
  for (vtkIdType patch = 0; patch < this->NumberOfPatches; ++patch)
  {
    row[patch] = weights[i] * weights[patch] * this->Received[nodes + patch];
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::FillCodedRow(vtkIdType i, int kernel)
{
  using CodedRows = vtkExchangeHierarchy::CodedRows;
  const CodedRows& coded = this->Hierarchy->GetCodedRows();
  std::set<int> rows;
  for (int slot = this->Hierarchy->GetNumberOfNodes() + static_cast<int>(i); slot >= 0;
       slot = this->Hierarchy->GetParents()[slot])
  {
    rows.insert(slot);
  }
  for (const CodedRows::Tile& tile : coded.Tiles)
  {
    coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        if (rows.count(row) > 0)
        {
          CodedRows::VisitLinks(tile, bytes, pairs,
            [&](int place, int code)
            {
              this->Received[coded.Slots[tile.FirstSlot + place]] += static_cast<double>(
                coded.Book[code * this->Hierarchy->GetNumberOfKernels() + kernel]);
            });
        }
      });
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Hierarchy: " << this->Hierarchy.Get() << "\n";
}
