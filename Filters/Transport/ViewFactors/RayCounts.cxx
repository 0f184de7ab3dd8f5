// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/RayCounts.h"

#include "Links/LinkOperators.h"
#include "Links/LinkSlots.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/BrightRows.h"
#include "ViewFactors/RayHits.h"
#include "ViewFactors/RayTally.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace LightTransport
{
namespace
{
// Rows that a thread takes at a time.
constexpr vtkIdType RowsPerTurn = 256;
// The deviation of a share by N scrambled points falls with this power of N, where it is an edge
// that they resolve.
constexpr double DeviationPower = 0.625;

//------------------------------------------------------------------------------
// How well a share is known, of which `met` of `rays` are.
double GetDeviation(double met, double rays)
{
  const double share = (met + 1.0) / (rays + 2.0);
  return std::sqrt(share * (1.0 - share)) * std::pow(rays, -DeviationPower);
}
} // namespace

//------------------------------------------------------------------------------
RayCounts::Rows RayCounts::Rows::Transpose() const
{
  Rows other;
  other.Offsets.assign(this->Offsets.size(), 0);
  for (const int column : this->Columns)
  {
    ++other.Offsets[column + 1];
  }
  std::partial_sum(other.Offsets.begin(), other.Offsets.end(), other.Offsets.begin());
  other.Columns.resize(this->Columns.size());
  other.Counts.resize(this->Columns.size());
  std::vector<std::int64_t> ends(other.Offsets.begin(), other.Offsets.end() - 1);
  for (std::size_t row = 0; row + 1 < this->Offsets.size(); ++row)
  {
    Pulse::Beat(row);
    for (std::int64_t k = this->Offsets[row]; k < this->Offsets[row + 1]; ++k)
    {
      const std::int64_t place = ends[this->Columns[k]]++;
      other.Columns[place] = static_cast<int>(row);
      other.Counts[place] = this->Counts[k];
    }
  }
  return other;
}

//------------------------------------------------------------------------------
// Rows of one turn after another.
struct RayCounts::Counter
{
  const RayHits& Hits;
  Links& AllLinks;
  std::vector<double>& SampledShares;
  vtkIdType NumberOfPatches;
  std::vector<Rows> Turns;
  Threads::Local<RayTally> Tallies;

  void operator()(vtkIdType begin, vtkIdType end)
  {
    RayTally& tally = this->Tallies.Get();
    tally.SetNumberOfPatches(this->NumberOfPatches);
    Rows& rows = this->Turns[(begin - this->Hits.GetFirst()) / RowsPerTurn];
    rows.Offsets.push_back(0);
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      Pulse::Beat(patch);
      const int cast = this->AllLinks.Rays.Get(patch);
      const double rays = cast;
      this->Hits.Visit(patch, 0, cast, tally);
      const double sky = tally.Sky / rays;
      const double back = static_cast<double>(tally.Behind.size()) / rays;
      this->AllLinks.SkyFractions[patch] = sky;
      this->AllLinks.BackFaceFractions[patch] = back;
      this->AllLinks.OpeningErrors[patch] = sky + back > 0.0 ? GetDeviation(sky + back, rays) : 0.0;
      rows.Behind.insert(rows.Behind.end(), tally.Behind.begin(), tally.Behind.end());
      std::sort(tally.Met.begin(), tally.Met.end());
      tally.Finish(
        [&](int other, int met)
        {
          this->SampledShares[patch] += this->AllLinks.IsApart(other) ? 0.0 : met / rays;
          rows.Columns.push_back(other);
          rows.Counts.push_back(met);
        });
      rows.Offsets.push_back(rows.GetSize());
    }
  }
};

//------------------------------------------------------------------------------
void RayCounts::Count(const RayHits& hits, const BrightRows& exact, const Ranks& ranks,
  Links& links)
{
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  this->Rays = links.Rays;
  const auto results = { &this->SampledShares, &links.SkyFractions, &links.BackFaceFractions,
    &links.OpeningErrors, &links.FrontHits, &links.BackHits };
  for (auto* values : results)
  {
    values->assign(patches, 0.0);
  }
  const vtkIdType mine = hits.GetLast() - hits.GetFirst();
  Counter counter{ hits, links, this->SampledShares, patches,
    std::vector<Rows>((mine + RowsPerTurn - 1) / RowsPerTurn), {} };
  Threads::For(hits.GetFirst(), hits.GetLast(), RowsPerTurn, counter);
  this->Met = Rows();
  this->Met.Offsets.assign(hits.GetFirst() + 1, 0);
  for (Rows& turn : counter.Turns)
  {
    const std::int64_t before = this->Met.GetSize();
    std::transform(turn.Offsets.begin() + 1, turn.Offsets.end(),
      std::back_inserter(this->Met.Offsets), [=](std::int64_t end) { return before + end; });
    this->Met.Columns.insert(this->Met.Columns.end(), turn.Columns.begin(), turn.Columns.end());
    this->Met.Counts.insert(this->Met.Counts.end(), turn.Counts.begin(), turn.Counts.end());
    for (const int patch : turn.Behind)
    {
      ++links.BackHits[patch];
    }
    turn = Rows();
  }
  this->Met.Offsets.resize(patches + 1, this->Met.GetSize());
  for (std::int64_t k = 0; k < this->Met.GetSize(); ++k)
  {
    links.FrontHits[this->Met.Columns[k]] += this->Met.Counts[k];
  }
  for (auto* values : results)
  {
    ranks.Sum(*values);
  }
  this->SumApart(exact, ranks);
}

//------------------------------------------------------------------------------
void RayCounts::SumApart(const BrightRows& exact, const Ranks& ranks)
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  this->SumsApart.clear();
  if (!this->Rays.Doublings.empty())
  {
    this->SumsApart.assign(areas.size(), 0.0);
    for (vtkIdType patch = 0; patch < static_cast<vtkIdType>(areas.size()); ++patch)
    {
      Pulse::Beat(patch);
      for (std::int64_t k = this->Met.Offsets[patch]; k < this->Met.Offsets[patch + 1]; ++k)
      {
        const vtkIdType other = this->Met.Columns[k];
        const bool isBright = this->Rays.IsBright(patch) || this->Rays.IsBright(other);
        if (isBright && !exact.Has(patch) && !exact.Has(other))
        {
          const double exchange = this->Met.Counts[k] / this->Rays.GetDensity(patch, other, areas);
          this->SumsApart[patch] += exchange * areas[other];
          this->SumsApart[other] += exchange * areas[patch];
        }
      }
    }
    ranks.Sum(this->SumsApart);
  }
  if (!exact.IsEmpty())
  {
    this->SumsApart.resize(areas.size(), 0.0);
    std::transform(this->SumsApart.begin(), this->SumsApart.end(), exact.GetSums().begin(),
      this->SumsApart.begin(), std::plus<double>());
  }
}

//------------------------------------------------------------------------------
// Rows of a hierarchy: what rays of a patch met, and whose rays met it, or what is exact.
struct RayCounts::Merger
{
  const std::vector<double>& Areas;
  const std::vector<double>& Weights;
  const BrightRows& Exact;
  const RayNumbers& Rays;
  int FirstSlot;
  const Rows& Met;
  const Rows& Meeting;
  std::vector<std::int64_t> Offsets;
  std::vector<int> Columns;
  std::vector<float> Values;

  // sampled(other patch, how often the two have met) in ascending order.
  template <typename Sampled>
  void VisitSampled(vtkIdType patch, Sampled&& sampled) const
  {
    std::int64_t a = this->Met.Offsets[patch];
    std::int64_t b = this->Meeting.Offsets[patch];
    const std::int64_t lastA = this->Met.Offsets[patch + 1];
    const std::int64_t lastB = this->Meeting.Offsets[patch + 1];
    while (a < lastA || b < lastB)
    {
      const bool isA =
        b == lastB || (a < lastA && this->Met.Columns[a] <= this->Meeting.Columns[b]);
      const bool isB =
        a == lastA || (b < lastB && this->Meeting.Columns[b] <= this->Met.Columns[a]);
      const int other = isA ? this->Met.Columns[a] : this->Meeting.Columns[b];
      const int count = (isA ? this->Met.Counts[a] : 0) + (isB ? this->Meeting.Counts[b] : 0);
      a += isA ? 1 : 0;
      b += isB ? 1 : 0;
      sampled(other, count);
    }
  }

  // link(other patch, exchange, whether it stands apart: else it is relative to both areas).
  template <typename Link>
  void Visit(vtkIdType patch, Link&& link) const
  {
    const BrightRows::Entry* next = this->Exact.Begin(patch);
    const BrightRows::Entry* last = this->Exact.End(patch);
    const auto passExact = [&](int before)
    {
      for (; next != last && next->Column < before; ++next)
      {
        link(next->Column, static_cast<double>(next->Exchange), true);
      }
    };
    if (!this->Exact.Has(patch))
    {
      this->VisitSampled(patch,
        [&](int other, int count)
        {
          if (!this->Exact.Has(other))
          {
            passExact(other);
            const bool isBright = this->Rays.IsBright(patch) || this->Rays.IsBright(other);
            const double whole = isBright ? this->Areas[patch] * this->Areas[other] : 1.0;
            link(other, whole * count / this->Rays.GetDensity(patch, other, this->Areas), isBright);
          }
        });
    }
    passExact(std::numeric_limits<int>::max());
  }

  double GetValueApart(vtkIdType patch, int other, double exchange) const
  {
    return this->Weights.empty() ? 0.0 : exchange / (this->Weights[patch] * this->Weights[other]);
  }

  void Run()
  {
    const auto patches = static_cast<vtkIdType>(this->Areas.size());
    auto count = [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType patch = begin; patch < end; ++patch)
      {
        std::int64_t& links = this->Offsets[this->FirstSlot + patch + 1];
        this->Visit(patch, [&links](int, double, bool) { ++links; });
      }
    };
    Threads::For(0, patches, RowsPerTurn, count);
    std::partial_sum(this->Offsets.begin(), this->Offsets.end(), this->Offsets.begin());
    this->Columns.resize(this->Offsets.back());
    this->Values.resize(this->Offsets.back());
    auto fill = [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType patch = begin; patch < end; ++patch)
      {
        std::int64_t place = this->Offsets[this->FirstSlot + patch];
        this->Visit(patch,
          [&](int other, double value, bool isApart)
          {
            this->Columns[place] = this->FirstSlot + other;
            this->Values[place++] =
              static_cast<float>(isApart ? this->GetValueApart(patch, other, value) : value);
          });
      }
    };
    Threads::For(0, patches, RowsPerTurn, fill);
  }
};

//------------------------------------------------------------------------------
Outcome RayCounts::Store(const BrightRows& exact, const std::vector<double>& weights,
  const Ranks& ranks, vtkExchangeHierarchy* hierarchy) const
{
  const LinkSlots slots(this->Scene);
  std::vector<double> entries{ 2.0 * static_cast<double>(this->Met.GetSize()) +
    static_cast<double>(exact.GetNumberOfEntries()) };
  ranks.Sum(entries);
  if (Outcome fits = LinkOperators::CheckRows(entries[0], 1, ranks); !fits)
  {
    return fits;
  }
  const Rows meeting = this->Met.Transpose();
  Merger merger{ this->Scene.GetAreas(), weights, exact, this->Rays, slots.GetNumberOfNodes(),
    this->Met, meeting, std::vector<std::int64_t>(slots.GetNumberOfSlots() + 1, 0), {}, {} };
  merger.Run();
  const bool stored = hierarchy->SetTree(this->Scene.GetAreas(), slots.GetNodes(), ranks.GetMine(),
                        ranks.GetNumber()) &&
    hierarchy->SetRows(std::move(merger.Offsets), std::move(merger.Columns),
      std::move(merger.Values), true);
  if (stored && !weights.empty())
  {
    hierarchy->SetWeights(weights);
  }
  return ranks.Agree(
    stored ? Outcome::Done() : Outcome::Failed("The links of rays do not fit the scene's tree."));
}
} // namespace LightTransport
