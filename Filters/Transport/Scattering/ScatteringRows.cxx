// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringRows.h"

#include "Scattering/AirGaps.h"
#include "Scattering/RefinementOnDevice.h"
#include "Scattering/ScatteringReceiver.h"
#include "Scattering/ScatteringRefinement.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "Support/SplitMix.h"
#include "vtkExchangeHierarchy.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace LightTransport
{
namespace
{
using Values = ScatteringIntegrals::Bands;

/// Receivers that a thread takes at a time, and calls of the monitor.
constexpr vtkIdType BlockSize = 64;
constexpr vtkIdType NumberOfBatches = 100;
/// Links of a body that are looked at for air, about.
constexpr double MostAirSamples = 200000.0;
} // namespace

//------------------------------------------------------------------------------
ScatteringRows::ScatteringRows(const ScatteringRefinement& chosen,
  const ScatteringProfiles& profiles, const AirGaps& gaps)
  : Chosen(chosen), Clusters(chosen.GetClusters()), Areas(chosen.GetAreas()), Profiles(profiles),
    Gaps(gaps)
{
  for (int band = 0; band < Bands; ++band)
  {
    this->Totals[band] = profiles[band]->GetTotal();
  }
}

//------------------------------------------------------------------------------
bool ScatteringRows::IsOfRank(vtkIdType patch, const Ranks& ranks)
{
  return patch / BlockSize % ranks.GetNumber() == ranks.GetMine();
}

//------------------------------------------------------------------------------
struct ScatteringRows::Filler
{
  const ScatteringRows& Outer;
  const RefinementOnDevice* Device; ///< has looked, where there is one
  vtkIdType First;                  ///< block
  vtkIdType Step;                   ///< from one block to the next
  std::vector<Block>& Blocks;

  /// As between patches, to one of the patches of the cluster.
  void LookForAir(vtkIdType receiver, int slot, const Values& value, Block& block) const
  {
    if (!this->Outer.Gaps.MayBeThere())
    {
      return;
    }
    const double chance = std::min(this->Outer.GetAirSample() * value.maxCoeff(), 1.0);
    SplitMix number(static_cast<std::uint64_t>(receiver) *
        static_cast<std::uint64_t>(this->Outer.Clusters.GetSlots().GetNumberOfSlots()) +
      static_cast<std::uint64_t>(slot));
    if (!AirGaps::IsInSample(number, chance))
    {
      return;
    }
    const vtkIdType sender = this->Outer.Clusters.Pick(slot, number.GetNextHalf() * 0x1p-32);
    if (sender != receiver && this->Outer.Gaps.AreBetween(receiver, sender))
    {
      block.ThroughAir.push_back({ sender, this->Outer.Areas[receiver] / chance * value });
    }
  }

  void AddRow(const ScatteringReceiver& receiver, Block& block) const
  {
    const std::size_t before = block.Columns.size();
    receiver.Visit([&](const ScatteringReceiver::Part& part)
      { return this->Outer.Chosen.Divides(receiver, part); },
      [&](const ScatteringReceiver::Part& part)
      {
        if (part.IsLeftOut)
        {
          block.LeftOut += 1.0;
          return;
        }
        const ScatteringClusters& clusters = this->Outer.Clusters;
        const Values value = this->Outer.Chosen.GetValue(receiver, part);
        this->LookForAir(receiver.GetPatch(), part.Slot, value, block);
        block.Reused += part.IsKept ? 1.0 : 0.0;
        block.Columns.push_back(part.Slot);
        for (int band = 0; band < Bands; ++band)
        {
          block.Values.push_back(static_cast<float>(
            this->Outer.Totals[band] * value[band] / clusters.GetArea(part.Slot)));
        }
      });
    block.Counts.push_back(static_cast<int>(block.Columns.size() - before));
  }

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    const auto patches = static_cast<vtkIdType>(this->Outer.Areas.size());
    ScatteringReceiver receiver(this->Outer.Clusters, this->Outer.Chosen.GetLeaveOut());
    for (vtkIdType k = begin; k < end; ++k)
    {
      const vtkIdType first = (this->First + k * this->Step) * BlockSize;
      for (vtkIdType patch = first; patch < std::min(first + BlockSize, patches); ++patch)
      {
        Pulse::Beat();
        if (this->Device)
        {
          receiver.Adopt(patch, this->Device->GetWalk(patch));
        }
        else
        {
          this->Outer.Chosen.Look(patch, receiver);
        }
        this->AddRow(receiver, this->Blocks[k]);
      }
    }
  }
};

//------------------------------------------------------------------------------
// The monitor hears equally often on all ranks.
Outcome ScatteringRows::FillAll(vtkIdType blocks, const Filler& filler, const Monitor& monitor)
{
  Outcome goesOn = Outcome::Done();
  for (vtkIdType batch = 0; goesOn && batch < NumberOfBatches; ++batch)
  {
    Threads::For(blocks * batch / NumberOfBatches, blocks * (batch + 1) / NumberOfBatches, 1,
      filler);
    goesOn = monitor.Check(static_cast<double>(batch + 1) / static_cast<double>(NumberOfBatches));
  }
  return goesOn;
}

//------------------------------------------------------------------------------
Outcome ScatteringRows::FillFromDevice(RefinementOnDevice& device, const Filler& filler,
  const Monitor& monitor) const
{
  const auto patches = static_cast<vtkIdType>(this->Areas.size());
  Outcome goesOn = device.Initialize(this->Chosen.GetLeaveOut(), this->Chosen.GetLimits());
  for (vtkIdType first = 0; goesOn && first < patches;)
  {
    const vtkIdType blocks = device.GetBatchSize() / BlockSize;
    const vtkIdType last = std::min(first + blocks * BlockSize, patches);
    goesOn = device.Refine(first, last);
    if (goesOn)
    {
      Threads::For(first / BlockSize, (last + BlockSize - 1) / BlockSize, 1, filler);
      goesOn = monitor.Check(static_cast<double>(last) / static_cast<double>(patches));
    }
    first = last;
  }
  return goesOn;
}

//------------------------------------------------------------------------------
Outcome ScatteringRows::Fill(const Ranks& ranks, const Monitor& monitor, RefinementOnDevice* device,
  vtkExchangeHierarchy* exchange, Summary& summary) const
{
  const auto patches = static_cast<vtkIdType>(this->Areas.size());
  const vtkIdType all = (patches + BlockSize - 1) / BlockSize;
  const vtkIdType step = ranks.GetNumber();
  const vtkIdType mine = (all - ranks.GetMine() + step - 1) / step;
  std::vector<Block> blocks(mine);
  const Filler filler{ *this, device, ranks.GetMine(), step, blocks };
  Outcome filled = device ? this->FillFromDevice(*device, filler, monitor)
                          : ScatteringRows::FillAll(mine, filler, monitor);
  if (!filled)
  {
    return filled;
  }
  double counts[3] = {};
  for (const Block& block : blocks)
  {
    counts[0] += static_cast<double>(block.Columns.size());
    counts[1] += block.LeftOut;
    counts[2] += block.Reused;
  }
  ranks.Sum(counts, 3);
  summary.Links = counts[0];
  summary.LeftOut = counts[1];
  summary.Reused = counts[2];
  summary.ThroughAir = this->Gaps.StartSums(this->Areas, this->Profiles, this->GetAirSample());
  this->SumUpAir(blocks, summary.ThroughAir);
  return this->Store(blocks, ranks.GetMine(), ranks.GetNumber(), exchange);
}

//------------------------------------------------------------------------------
// Of large bodies fewer links of each patch.
double ScatteringRows::GetAirSample() const
{
  return std::min(AirGaps::SampleSize, MostAirSamples / static_cast<double>(this->Areas.size()));
}

//------------------------------------------------------------------------------
// One patch stands for its cluster: the whole square is variance.
void ScatteringRows::SumUpAir(const std::vector<Block>& blocks, LinksThroughAir& sums) const
{
  for (const Block& block : blocks)
  {
    for (const AirLink& link : block.ThroughAir)
    {
      for (int band = 0; band < Bands; ++band)
      {
        const double value = this->Totals[band] * link.Value[band];
        sums.Carried[link.Sender * Bands + band] += value;
        sums.Variances[link.Sender * Bands + band] += value * value;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Rows of nodes, and of receivers of other ranks, are empty.
Outcome ScatteringRows::Store(const std::vector<Block>& blocks, int mine, int ranks,
  vtkExchangeHierarchy* exchange) const
{
  std::vector<std::int64_t> offsets(exchange->GetNumberOfSlots() + 1, 0);
  std::vector<int> columns;
  std::vector<float> values;
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    const std::size_t first = (mine + k * ranks) * BlockSize + exchange->GetNumberOfNodes() + 1;
    std::copy(blocks[k].Counts.begin(), blocks[k].Counts.end(),
      offsets.begin() + static_cast<std::ptrdiff_t>(first));
  }
  for (std::size_t slot = 1; slot < offsets.size(); ++slot)
  {
    offsets[slot] += offsets[slot - 1];
  }
  columns.reserve(offsets.back());
  values.reserve(offsets.back() * Bands);
  for (const Block& block : blocks)
  {
    columns.insert(columns.end(), block.Columns.begin(), block.Columns.end());
    values.insert(values.end(), block.Values.begin(), block.Values.end());
  }
  return exchange->SetRows(std::move(offsets), std::move(columns), std::move(values))
    ? Outcome::Done()
    : Outcome::Failed("The links between clusters do not fit their tree.");
}
} // namespace LightTransport
