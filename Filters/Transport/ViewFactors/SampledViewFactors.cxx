// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/SampledViewFactors.h"

#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/RayCounts.h"
#include "ViewFactors/RaySamples.h"
#include "ViewFactors/ViewFactorClosure.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace LightTransport
{
namespace
{
// The stages as fractions of the progress.
constexpr double RaysDone = 0.6; // where there are exact rows
constexpr double RowsDone = 0.95;
// Openings move by this power of what links move by.
constexpr double OpenPower = 0.1;
// What is left of gaps before exact links are there, and of closed rows.
constexpr double RoughGap = 1e-5;
constexpr double Rounding = 1e-11;
// What is left of a row beside what is exact is at least this much; beside what many rays tell, of
// which there may seem to be too much, this part of what its own rays say.
constexpr double SmallestRest = 1e-6;
constexpr double SmallestPart = 0.5;
// Rays of which a tolerance is the error of the irradiance: (share / tolerance)^power.
constexpr double ErrorOfOneRay = 0.5;
constexpr double RayPower = 1.6;
constexpr int FewestForTolerance = 64;

//------------------------------------------------------------------------------
// What links that stand apart leave of a row its own rays divide between openings and what they
// sample there; nothing that others have met is nothing. Returns what both are to sum to.
std::vector<double> DivideRests(const RayCounts& counts, Links& links)
{
  std::vector<double> targets = counts.GetSampledShares();
  for (std::size_t row = 0; row < targets.size(); ++row)
  {
    const bool isApart = links.IsApart(static_cast<vtkIdType>(row));
    const double apart = counts.HaveApart() ? counts.GetSumsApart()[row] : 0.0;
    const double leastShare = 0.5 / links.Rays.Get(static_cast<vtkIdType>(row));
    const double sampled =
      !isApart && links.RowSums[row] > 0.0 ? std::max(targets[row], leastShare) : 0.0;
    double& sky = links.SkyFractions[row];
    double& back = links.BackFaceFractions[row];
    const double share = sampled + sky + back;
    const double leastRest = links.Rays.Doublings.empty() ? SmallestRest : SmallestPart * share;
    const double rest = std::max(1.0 - apart, isApart ? 0.0 : leastRest);
    const double scale = share > 0.0 ? rest / share : 0.0;
    sky *= scale;
    back *= scale;
    targets[row] = isApart ? 0.0 : share * scale;
  }
  return targets;
}

//------------------------------------------------------------------------------
// What cannot be closed is light that nobody knows the way of: it leaves. Openings give what rows
// have too much.
void SendRestToSky(Links& links)
{
  double rest = 0.0;
  for (std::size_t row = 0; row < links.RowSums.size(); ++row)
  {
    double& sky = links.SkyFractions[row];
    double& back = links.BackFaceFractions[row];
    const double open = sky + back;
    const double left = 1.0 - links.RowSums[row] - open;
    if (left > Rounding)
    {
      sky += left;
      rest = std::max(rest, left);
    }
    else if (left < -Rounding && open > 0.0)
    {
      const double scale = std::max(0.0, 1.0 + left / open);
      sky *= scale;
      back *= scale;
    }
  }
  links.Summaries.emplace_back("ClosureRest", rest);
}
} // namespace

//------------------------------------------------------------------------------
SampledViewFactors::SampledViewFactors(SamplingPlan plan, std::shared_ptr<RaySamples> samples)
  : Plan(std::move(plan)), Samples(std::move(samples))
{
}

//------------------------------------------------------------------------------
int SampledViewFactors::GetRaysFor(double tolerance)
{
  const double rays = std::pow(ErrorOfOneRay / tolerance, RayPower);
  int count = FewestForTolerance;
  while (count < rays && count < RayHits::MostRays)
  {
    count *= 2;
  }
  return count;
}

//------------------------------------------------------------------------------
LinkKey SampledViewFactors::GetKey() const
{
  LinkKey key{ "SampledViewFactors",
    { static_cast<double>(this->Plan.Rays.Each), this->Plan.Tolerance }, {} };
  key.Parameters.insert(key.Parameters.end(), this->Plan.Rays.Doublings.begin(),
    this->Plan.Rays.Doublings.end());
  for (std::size_t patch = 0; patch < this->Plan.Bright.size(); ++patch)
  {
    if (this->Plan.Bright[patch])
    {
      key.Parameters.push_back(static_cast<double>(patch));
    }
  }
  return key;
}

//------------------------------------------------------------------------------
// Openings are scaled little: what the rays of each patch say is better known than what both
// directions give others. Nor are links that stand apart part of what is scaled: first the others
// are, to what is left of each row, then all together by what the errors of those apart leave.
Outcome SampledViewFactors::Close(const RayCounts& counts, const Ranks& ranks, Links& links) const
{
  const BrightRows& exact = this->Samples->Exact;
  ViewFactorClosure::Scaling scaling;
  scaling.OpenPower = OpenPower;
  scaling.Targets = DivideRests(counts, links);
  if (counts.HaveApart())
  {
    ViewFactorClosure::Scaling rough = scaling;
    rough.Goal = RoughGap;
    ViewFactorClosure::Report report;
    Outcome scaled = ViewFactorClosure::Scale(links, rough, ranks, report);
    const std::vector<double> weights = links.Hierarchy->GetWeights();
    scaled = scaled ? counts.Store(exact, weights, ranks, links.Hierarchy) : scaled;
    scaled = scaled ? links.SumRows(ranks) : scaled;
    if (!scaled)
    {
      return scaled;
    }
    scaling.Targets.clear();
  }
  Outcome closed = ViewFactorClosure::ScaleHierarchy(links, scaling, ranks);
  if (closed)
  {
    SendRestToSky(links);
  }
  return closed;
}

//------------------------------------------------------------------------------
// What rays meet, and exact rows, as far as they are not there already.
Outcome SampledViewFactors::Gather(const PatchScene& scene, const Ranks& ranks,
  const Monitor& monitor) const
{
  const bool hasBright = !this->Plan.Bright.empty();
  auto rays = this->Samples->Rays.lock();
  rays = rays ? rays : std::make_shared<PatchRays>();
  Outcome outcome = this->Samples->Hits.CastTo(this->Plan.Rays, scene, *rays, ranks,
    monitor.GetStage(0.0, hasBright ? RaysDone : RowsDone));
  return outcome ? this->Samples->Exact.Fill(scene, this->Plan.Bright, this->Plan.Tolerance, ranks,
                     monitor.GetStage(RaysDone, RowsDone))
                 : outcome;
}

//------------------------------------------------------------------------------
// As they are before any closure, without links that stand apart.
Outcome SampledViewFactors::Count(RayCounts& counts, const Ranks& ranks, Links& links) const
{
  const BrightRows& exact = this->Samples->Exact;
  links.Rays = this->Plan.Rays;
  links.ExactPatches = this->Plan.Bright;
  counts.Count(this->Samples->Hits, exact, ranks, links);
  links.Hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  Outcome outcome = counts.Store(exact, {}, ranks, links.Hierarchy);
  outcome = outcome ? links.SumRows(ranks) : outcome;
  links.RawRowSums = links.RowSums;
  if (outcome && counts.HaveApart())
  {
    std::transform(links.RawRowSums.begin(), links.RawRowSums.end(), counts.GetSumsApart().begin(),
      links.RawRowSums.begin(), std::plus<double>());
  }
  // What rays that meet nothing else tell of an opening is all that rows are not sure of.
  links.RowErrors = links.OpeningErrors;
  return outcome;
}

//------------------------------------------------------------------------------
void SampledViewFactors::Summarize(const Ranks& ranks, Links& links) const
{
  std::vector<double> sizes{ static_cast<double>(links.Hierarchy->GetNumberOfLinks()),
    links.Hierarchy->GetNumberOfBytes() };
  ranks.Sum(sizes);
  const vtkIdType patches = links.Hierarchy->GetNumberOfPatches();
  links.Summaries.insert(links.Summaries.begin(),
    { { "RaysPerPatch", this->Plan.Rays.Each }, { "RaysCast", this->Plan.Rays.Sum(patches) },
      { "ExactRows",
        static_cast<double>(std::count(this->Plan.Bright.begin(), this->Plan.Bright.end(), true)) },
      { "NumberOfLinks", sizes[0] }, { "MatrixBytes", sizes[1] },
      { "DenseMatrixBytes", vtkExchangeMatrix::GetEstimatedBytes(patches, 1) } });
}

//------------------------------------------------------------------------------
Outcome SampledViewFactors::Build(const PatchScene& scene, const Ranks& ranks,
  const Monitor& monitor, Links& links) const
{
  const double begin = vtkTimerLog::GetUniversalTime();
  RayCounts counts(scene);
  Outcome outcome = this->Gather(scene, ranks, monitor);
  outcome = outcome ? this->Count(counts, ranks, links) : outcome;
  outcome = outcome ? this->Close(counts, ranks, links) : outcome;
  if (!outcome)
  {
    return outcome;
  }
  this->Summarize(ranks, links);
  links.Summaries.emplace_back("ViewFactorSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return monitor.Check(1.0);
}
} // namespace LightTransport
