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
// Kernels, or bands that share one, and lights with kernels that one pass over the links serves.
constexpr int MaximumBands = 4;
constexpr int MaximumLights = 4;
// Rows that a thread takes at a time: rows differ in length.
constexpr vtkIdType RowsPerTask = 1024;
constexpr vtkIdType TilesPerTask = 16;
// Slots of one level that a thread takes at a time.
constexpr vtkIdType SlotsPerTask = 4096;

// What a pass over the links sums up: bands First to First + Count of each of some lights, which
// lie Kernels bands apart. Where there is one kernel all bands are those of one light.
struct Pass
{
  const vtkExchangeHierarchy& Hierarchy;
  int Bands; ///< of a slot
  int First;
  const double* Sent; ///< from the first band on
  double* Received;

  bool HasKernels() const { return this->Hierarchy.GetNumberOfKernels() > 1; }
  const double* GetSent(int slot) const
  {
    return this->Sent + static_cast<std::int64_t>(slot) * this->Bands;
  }
  double* GetReceived(vtkIdType slot) const { return this->Received + slot * this->Bands; }
};

//------------------------------------------------------------------------------
// Y_I = sum of K X_J for Count bands of some lights. Bands share one value of each link, or have
// kernels of their own.
template <int Count, int Lights, bool HasKernels>
struct Gather
{
  // Sums that do not wait for each other: an addition takes some four cycles.
  static constexpr int Chains = Count > 2 ? 2 : 8 / Count;

  const Pass& Work;

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    const vtkExchangeHierarchy& hierarchy = this->Work.Hierarchy;
    const int* columns = hierarchy.GetColumns().data();
    const float* values = hierarchy.GetValues().data() + (HasKernels ? this->Work.First : 0);
    const int kernels = HasKernels ? hierarchy.GetNumberOfKernels() : 1;
    for (vtkIdType slot = begin; slot < end; ++slot)
    {
      double sums[Chains][Lights * Count] = {};
      auto [link, last] = hierarchy.GetRow(static_cast<int>(slot));
      for (; link + Chains <= last; link += Chains)
      {
        for (int chain = 0; chain < Chains; ++chain)
        {
          this->Add(columns[link + chain], values + (link + chain) * kernels, kernels, sums[chain]);
        }
      }
      for (; link < last; ++link)
      {
        this->Add(columns[link], values + link * kernels, kernels, sums[0]);
      }
      double* received = this->Work.GetReceived(slot);
      for (int band = 0; band < Lights * Count; ++band)
      {
        double sum = 0.0;
        for (int chain = 0; chain < Chains; ++chain)
        {
          sum += sums[chain][band];
        }
        received[band / Count * kernels + band % Count] = sum;
      }
    }
  }

  void Add(int column, const float* values, int kernels, double* sums) const
  {
    const double* sent = this->Work.GetSent(column);
    for (int light = 0; light < Lights; ++light)
    {
      for (int band = 0; band < Count; ++band)
      {
        sums[light * Count + band] +=
          static_cast<double>(values[HasKernels ? band : 0]) * sent[light * kernels + band];
      }
    }
  }
};

//------------------------------------------------------------------------------
// Y_I += sum over the coded links of I, for Count bands of some lights. What a tile's rows hear is
// copied into one place first, so that nothing else than it, the book and the bytes are read.
template <int Count, int Lights>
struct GatherCodes
{
  using CodedRows = vtkExchangeHierarchy::CodedRows;
  // Three bands take as long as four, which are whole vectors.
  static constexpr int Lanes = Count + (Count == 3 ? 1 : 0);
  static constexpr int All = Lights * Lanes;

  const Pass& Work;
  const CodedRows& Coded;
  std::vector<double> Book; ///< Lanes values of each code

  explicit GatherCodes(const Pass& pass)
    : Work(pass), Coded(pass.Hierarchy.GetCodedRows()), Book(Lanes * CodedRows::BookSize, 0.0)
  {
    const int kernels = pass.Hierarchy.GetNumberOfKernels();
    for (int code = 0; code < CodedRows::BookSize; ++code)
    {
      for (int band = 0; band < Count; ++band)
      {
        const int kernel = (pass.First + band) % kernels;
        this->Book[code * Lanes + band] =
          static_cast<double>(this->Coded.Book[code * kernels + kernel]);
      }
    }
  }

  // Tiles of the same rows stay on one thread: they add to the same sums.
  void operator()(vtkIdType begin, vtkIdType end) const
  {
    std::vector<double> heard(All * CodedRows::BookSize, 0.0);
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
    const int kernels = this->Work.Hierarchy.GetNumberOfKernels();
    this->Coded.VisitSlots(tile,
      [&](int place, int slot)
      {
        const double* sent = this->Work.GetSent(slot);
        double* target = heard + static_cast<std::int64_t>(place) * All;
        for (int light = 0; light < Lights; ++light)
        {
          std::copy_n(sent + light * kernels, Count, target + light * Lanes);
        }
      });
    const double* book = this->Book.data();
    this->Coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        double sums[All] = {};
        CodedRows::VisitLinks(tile, bytes, pairs,
          [&](int place, int code)
          {
            for (int lane = 0; lane < All; ++lane)
            {
              sums[lane] += book[code * Lanes + lane % Lanes] * heard[place * All + lane];
            }
          });
        double* received = this->Work.GetReceived(row);
        for (int light = 0; light < Lights; ++light)
        {
          const double* sum = sums + light * Lanes;
          double* target = received + light * kernels;
          std::transform(sum, sum + Count, target, target, std::plus<double>());
        }
      });
  }
};

//------------------------------------------------------------------------------
// Where all links join patches nothing goes up or down the tree.
bool LinksClusters(const vtkExchangeHierarchy& hierarchy)
{
  return !hierarchy.IsSymmetric() || hierarchy.GetOffsets()[hierarchy.GetNumberOfNodes()] > 0;
}

//------------------------------------------------------------------------------
template <int Count, int Lights>
void GatherLights(const Pass& pass)
{
  if (pass.HasKernels())
  {
    Gather<Count, Lights, true> gather{ pass };
    Threads::For(0, pass.Hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
  else
  {
    Gather<Count, 1, false> gather{ pass };
    Threads::For(0, pass.Hierarchy.GetNumberOfSlots(), RowsPerTask, gather);
  }
  const auto tiles = static_cast<vtkIdType>(pass.Hierarchy.GetCodedRows().Tiles.size());
  if (tiles > 0)
  {
    GatherCodes<Count, Lights> gather(pass);
    Threads::For(0, tiles, TilesPerTask, gather);
  }
}

//------------------------------------------------------------------------------
template <int Count>
void GatherBands(Pass pass, int lights)
{
  const int kernels = pass.Hierarchy.GetNumberOfKernels();
  for (int done = 0; done < lights;)
  {
    const int left = lights - done;
    const int now = left >= MaximumLights ? MaximumLights : left >= 2 ? 2 : 1;
    now == 1     ? GatherLights<Count, 1>(pass)
      : now == 2 ? GatherLights<Count, 2>(pass)
                 : GatherLights<Count, MaximumLights>(pass);
    pass.Sent += now * kernels;
    pass.Received += now * kernels;
    done += now;
  }
}

//------------------------------------------------------------------------------
void GatherAll(const vtkExchangeHierarchy& hierarchy, int bands, const std::vector<double>& sent,
  std::vector<double>& received)
{
  const int kernels = hierarchy.GetNumberOfKernels();
  const int each = kernels > 1 ? kernels : bands;
  for (int first = 0; first < each; first += MaximumBands)
  {
    const Pass pass{ hierarchy, bands, first, sent.data() + first, received.data() + first };
    switch (std::min(each - first, MaximumBands))
    {
      case 1:
        GatherBands<1>(pass, bands / each);
        break;
      case 2:
        GatherBands<2>(pass, bands / each);
        break;
      case 3:
        GatherBands<3>(pass, bands / each);
        break;
      default:
        GatherBands<MaximumBands>(pass, bands / each);
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
  const auto weigh = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      for (int band = 0; band < bands; ++band)
      {
        patches[patch * bands + band] = weights[patch] * x[band * this->Stride + patch];
      }
    }
  };
  Threads::For(0, this->NumberOfPatches, SlotsPerTask, weigh);
  if (!LinksClusters(*this->Hierarchy))
  {
    std::fill(this->Sent.data(), patches, 0.0);
    return;
  }
  const auto sumUp = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType node = begin; node < end; ++node)
    {
      double* sum = this->Sent.data() + node * bands;
      std::fill(sum, sum + bands, 0.0);
      for (int child = nodes[node].First; child < nodes[node].Last; ++child)
      {
        const double* sent = this->Sent.data() + static_cast<std::size_t>(child) * bands;
        std::transform(sum, sum + bands, sent, sum, std::plus<double>());
      }
    }
  };
  const std::vector<int>& levels = this->Hierarchy->GetLevels();
  for (std::size_t level = levels.size() - 1; level-- > 0;)
  {
    Threads::For(levels[level], levels[level + 1], SlotsPerTask, sumUp);
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::SweepDown(int bands)
{
  if (!LinksClusters(*this->Hierarchy))
  {
    return;
  }
  const std::vector<vtkExchangeHierarchy::Node>& nodes = this->Hierarchy->GetNodes();
  const auto handDown = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType node = begin; node < end; ++node)
    {
      const double* received = this->Received.data() + node * bands;
      for (int child = nodes[node].First; child < nodes[node].Last; ++child)
      {
        double* sum = this->Received.data() + static_cast<std::size_t>(child) * bands;
        std::transform(sum, sum + bands, received, sum, std::plus<double>());
      }
    }
  };
  const std::vector<int>& levels = this->Hierarchy->GetLevels();
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
  {
    Threads::For(levels[level], levels[level + 1], SlotsPerTask, handDown);
  }
}

//------------------------------------------------------------------------------
void vtkHierarchicalLinkOperator::MultiplyPart(const Vector& x, Vector& y)
{
  const int bands = this->NumberOfBands;
  this->SweepUp(x);
  this->Received.resize(this->Sent.size());
  GatherAll(*this->Hierarchy, bands, this->Sent, this->Received);
  this->SweepDown(bands);
  const std::vector<double>& weights = this->Hierarchy->GetWeights();
  const double* patches =
    this->Received.data() + static_cast<std::size_t>(this->Hierarchy->GetNumberOfNodes()) * bands;
  const auto weigh = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      for (int band = 0; band < bands; ++band)
      {
        y[band * this->Stride + patch] = weights[patch] * patches[patch * bands + band];
      }
    }
  };
  Threads::For(0, this->NumberOfPatches, SlotsPerTask, weigh);
}

//------------------------------------------------------------------------------
// The links of the patch and of all nodes above it, swept down.
void vtkHierarchicalLinkOperator::FillRow(vtkIdType i, int kernel, double* row)
{
  this->Received.assign(this->Hierarchy->GetNumberOfSlots(), 0.0);
  const int nodes = this->Hierarchy->GetNumberOfNodes();
  for (int slot = nodes + static_cast<int>(i); slot >= 0;
       slot = this->Hierarchy->GetParents()[slot])
  {
    const auto [first, last] = this->Hierarchy->GetRow(slot);
    for (std::int64_t link = first; link < last; ++link)
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
  std::vector<int> slots(CodedRows::BookSize);
  for (const CodedRows::Tile& tile : coded.Tiles)
  {
    coded.VisitSlots(tile, [&](int place, int slot) { slots[place] = slot; });
    coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        if (rows.count(row) > 0)
        {
          CodedRows::VisitLinks(tile, bytes, pairs,
            [&](int place, int code)
            {
              this->Received[slots[place]] += static_cast<double>(
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
