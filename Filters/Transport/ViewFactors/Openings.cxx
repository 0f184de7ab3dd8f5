// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/Openings.h"

#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/BackFaceSearch.h"
#include "ViewFactors/PatchOutlook.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
// Rays that a tolerance is worth, over it, and at most.
constexpr double MostWork = 100.0;
constexpr int MostRays = 32768;
// Rays that know what is open this much worse than the row's sum does have no say in it.
constexpr double WorseThanSums = 30.0;
// Rays after which a kind of opening that none of them has met is not there, or what a row misses
// is no opening: as many as would meet one of the size of the tolerance, and at most.
constexpr int MostRaysForNothing = 512;
constexpr int MostRaysForMissing = 4096;
// What estimates of the errors of row sums are in standard deviations: they are bounds, measured
// against exact rows in canyons, cities and craters.
constexpr double EstimatePerDeviation = 6.0;
// The deviation of fractions beside that of links between clusters: the square of both is what
// counts.
constexpr double ClusterShare = 0.7;
// Patches that tell whether a scene has openings at all.
constexpr vtkIdType PatchesThatLook = 2000;
// Patches that one rank takes at a time.
constexpr vtkIdType PatchesPerTurn = 64;

//------------------------------------------------------------------------------
using Estimate = PatchOutlook::Estimate;

// The mean by their variances of two estimates of one number, neither of them below 0.
Estimate Combine(const Estimate& a, const Estimate& b)
{
  const double varianceA = a.Deviation * a.Deviation;
  const double varianceB = b.Deviation * b.Deviation;
  const double sum = varianceA + varianceB;
  // Both weights are 1 where neither is known to have an error.
  const double weight = sum > 0.0 ? varianceB / sum : 0.5;
  return { std::max(0.0, b.Value + weight * (a.Value - b.Value)),
    sum > 0.0 ? std::sqrt(varianceA * weight) : 0.0 };
}

//------------------------------------------------------------------------------
int GetRaysForNothing(double tolerance)
{
  return static_cast<int>(std::min<double>(1.0 / tolerance, MostRaysForNothing));
}
} // namespace

//------------------------------------------------------------------------------
// What is known of one patch.
struct Openings::Row
{
  bool MayBeOpen = false;
  bool IsSumBetter = false; ///< than any rays
  bool IsCertain = false;   ///< that it is open, though no ray found how
  Estimate Open;
  Estimate Sky; ///< of what is open
  double Gap = 0.0;

  // By its sum, as far as that is known, and by its rays.
  Row(const Estimate& missing, double error, const PatchOutlook& outlook)
  {
    const Estimate found = outlook.GetOpen();
    this->Gap = std::max(0.0,
      std::abs(found.Value - missing.Value) - 2.0 * Confidence * found.Deviation - error);
    this->MayBeOpen = missing.Value > error;
    this->IsSumBetter = found.Deviation >= WorseThanSums * missing.Deviation;
    if (found.Value > 0.0)
    {
      this->Open = Combine(missing, found);
      this->Sky = outlook.GetSky();
    }
    else if (missing.Value > WorseThanSums * error)
    {
      // Too small for rays to meet, but certain: the sum knows it.
      this->IsCertain = true;
      this->Open = missing;
      this->Sky = { 1.0, 0.0 };
      this->Gap = 0.0;
    }
  }

  double GetSky() const { return this->Open.Value * this->Sky.Value; }
  double GetBackFaces() const { return this->Open.Value * (1.0 - this->Sky.Value); }
  // The deviation of the fraction that is known less well.
  double GetDeviation() const
  {
    const double larger = std::max(this->Sky.Value, 1.0 - this->Sky.Value);
    return std::hypot(larger * this->Open.Deviation, this->Open.Value * this->Sky.Deviation);
  }

  // Whether the rays of a patch may end: `fewest` would have met both kinds of openings.
  bool IsSettled(const PatchOutlook& outlook, int fewest, double deviation) const
  {
    const int rays = outlook.GetNumberOfRays();
    if (!outlook.SeesSky() && !outlook.SeesBackFaces())
    {
      return rays >= (this->MayBeOpen && !this->IsCertain ? MostRaysForMissing : fewest);
    }
    const bool knowsKinds = outlook.SeesSky() && outlook.SeesBackFaces();
    const double left =
      this->IsSumBetter ? this->Open.Value * this->Sky.Deviation : this->GetDeviation();
    return (knowsKinds || rays >= fewest) && left <= deviation;
  }
};

//------------------------------------------------------------------------------
bool Openings::Exist() const
{
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  const vtkIdType step = std::max<vtkIdType>(patches / PatchesThatLook, 1);
  PatchOutlook::Hits hits(patches);
  for (vtkIdType patch = 0; patch < patches; patch += step)
  {
    Pulse::Beat();
    if (PatchOutlook(this->Scene, this->Caster, patch, hits).GetOpen().Value > 0.0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
int Openings::GetMostRays(double tolerance)
{
  return static_cast<int>(
    std::max<double>(PatchOutlook::FirstRays, std::min<double>(MostWork / tolerance, MostRays)));
}

//------------------------------------------------------------------------------
void Openings::Clear(Links& links)
{
  for (auto* values : { &links.SkyFractions, &links.BackFaceFractions, &links.OpeningErrors,
         &links.FrontHits, &links.BackHits })
  {
    values->assign(links.RowSums.size(), 0.0);
  }
}

//------------------------------------------------------------------------------
void Openings::Skip(const std::vector<double>& errors, Links& links)
{
  Clear(links);
  double gap = 0.0;
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    gap = std::max(gap, std::abs(1.0 - links.RowSums[row]) - errors[row]);
  }
  links.Summaries.emplace_back("RaysCast", 0.0);
  links.Summaries.emplace_back("RowGap", gap);
}

//------------------------------------------------------------------------------
// Of a patch `judge` makes a row from what is known, `fewest` says how many rays it casts at least;
// others follow until a deviation is reached. Errors are `confidence` deviations. Returns those of
// what is open.
template <typename Judge, typename Fewest>
std::vector<double> Openings::CastRays(const Settings& settings, const Ranks& ranks, Links& links,
  const Judge& judge, const Fewest& fewest) const
{
  Clear(links);
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  PatchOutlook::Hits hits(patches);
  std::vector<double> errors(patches, 0.0), gaps(patches, 0.0), rays(patches, 0.0);
  const auto work = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      Pulse::Beat();
      if (patch / PatchesPerTurn % ranks.GetNumber() != ranks.GetMine())
      {
        continue;
      }
      PatchOutlook outlook(this->Scene, this->Caster, patch, hits);
      Row row = judge(patch, outlook);
      while (!row.IsSettled(outlook, fewest(patch), settings.Deviation) &&
        outlook.GetNumberOfRays() < settings.MostRays)
      {
        outlook.CastMore();
        row = judge(patch, outlook);
      }
      links.SkyFractions[patch] = row.GetSky();
      links.BackFaceFractions[patch] = row.GetBackFaces();
      links.OpeningErrors[patch] = settings.Confidence * row.GetDeviation();
      errors[patch] = settings.Confidence * row.Open.Deviation;
      gaps[patch] = row.Gap;
      rays[patch] = outlook.GetNumberOfRays();
    }
  };
  Threads::For(0, patches, PatchesPerTurn, work);
  std::copy(hits.Front.begin(), hits.Front.end(), links.FrontHits.begin());
  std::copy(hits.Back.begin(), hits.Back.end(), links.BackHits.begin());
  for (auto* values : { &links.SkyFractions, &links.BackFaceFractions, &links.OpeningErrors,
         &links.FrontHits, &links.BackHits, &errors, &gaps, &rays })
  {
    ranks.Sum(*values);
  }
  links.Summaries.emplace_back("RaysCast", std::accumulate(rays.begin(), rays.end(), 0.0));
  links.Summaries.emplace_back("RowGap", *std::max_element(gaps.begin(), gaps.end()));
  return errors;
}

//------------------------------------------------------------------------------
std::vector<double> Openings::Complete(double tolerance, const Ranks& ranks, Links& links) const
{
  const BackFaceSearch search(this->Scene);
  const auto judge = [&](vtkIdType patch, const PatchOutlook& outlook)
  {
    const double error = links.RowErrors[patch];
    return Row({ 1.0 - links.RowSums[patch], error / EstimatePerDeviation }, error, outlook);
  };
  const auto fewest = [&](vtkIdType patch)
  { return search.MaySeeBackFaces(patch) ? GetRaysForNothing(tolerance) : 0; };
  return this->CastRays({ GetMostRays(tolerance), tolerance / Confidence, Confidence }, ranks,
    links, judge, fewest);
}

//------------------------------------------------------------------------------
void Openings::CompleteClusters(double tolerance, double deviation, const Ranks& ranks,
  Links& links) const
{
  const auto judge = [&](vtkIdType patch, const PatchOutlook& outlook) {
    return Row({ 1.0 - links.RowSums[patch], deviation }, Confidence * deviation, outlook);
  };
  const auto fewest = [&](vtkIdType) { return GetRaysForNothing(tolerance); };
  this->CastRays({ GetMostRays(tolerance), ClusterShare * tolerance, 1.0 }, ranks, links, judge,
    fewest);
}

//------------------------------------------------------------------------------
void Openings::Survey(const Ranks& ranks, Links& links) const
{
  const auto judge = [](vtkIdType, const PatchOutlook& outlook)
  { return Row(outlook.GetOpen(), 1.0, outlook); };
  this->CastRays({ PatchOutlook::FirstRays, 0.0, Confidence }, ranks, links, judge,
    [](vtkIdType) { return 0; });
  // There are no sums that it could tell of.
  links.Summaries.pop_back();
}
} // namespace LightTransport
