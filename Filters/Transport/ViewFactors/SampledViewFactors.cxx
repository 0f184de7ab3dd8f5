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
// What is left of a row beside what is exact is at least this much.
constexpr double SmallestRest = 1e-6;
// Rays of which a tolerance is the error of the irradiance: (share / tolerance)^power.
constexpr double ErrorOfOneRay = 0.5;
constexpr double RayPower = 1.6;

//------------------------------------------------------------------------------
// What exact links leave of a row its own rays divide between openings and what they sample there;
// nothing that others have met is nothing. Returns what both are to sum to.
std::vector<double> DivideRests(const BrightRows& exact, const RayCounts& counts, Links& links)
{
  const double leastShare = 0.5 / links.RaysPerPatch;
  std::vector<double> targets = counts.GetSampledShares();
  for (std::size_t row = 0; row < targets.size(); ++row)
  {
    const bool isExact = exact.Has(static_cast<vtkIdType>(row));
    const double rest =
      std::max(1.0 - (exact.IsEmpty() ? 0.0 : exact.GetSums()[row]), isExact ? 0.0 : SmallestRest);
    const double sampled =
      !isExact && links.RowSums[row] > 0.0 ? std::max(targets[row], leastShare) : 0.0;
    double& sky = links.SkyFractions[row];
    double& back = links.BackFaceFractions[row];
    const double share = sampled + sky + back;
    const double scale = share > 0.0 ? rest / share : 0.0;
    sky *= scale;
    back *= scale;
    targets[row] = isExact ? 0.0 : share * scale;
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
  int count = RayHits::FewestRays;
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
    { static_cast<double>(this->Plan.RaysPerPatch), this->Plan.Tolerance }, {} };
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
// directions give others. Nor are exact links part of what is scaled: first the others are, to what
// is left of each row, then all together by what rounding and the errors of exact rows leave.
Outcome SampledViewFactors::Close(const RayCounts& counts, const Ranks& ranks, Links& links) const
{
  const BrightRows& exact = this->Samples->Exact;
  ViewFactorClosure::Scaling scaling;
  scaling.OpenPower = OpenPower;
  scaling.Targets = DivideRests(exact, counts, links);
  if (!exact.IsEmpty())
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
  Outcome outcome = this->Samples->Hits.CastTo(this->Plan.RaysPerPatch, scene, ranks,
    monitor.GetStage(0.0, hasBright ? RaysDone : RowsDone));
  return outcome ? this->Samples->Exact.Fill(scene, this->Plan.Bright, this->Plan.Tolerance, ranks,
                     monitor.GetStage(RaysDone, RowsDone))
                 : outcome;
}

//------------------------------------------------------------------------------
// As they are before any closure, with exact links left out.
Outcome SampledViewFactors::Count(RayCounts& counts, const Ranks& ranks, Links& links) const
{
  const BrightRows& exact = this->Samples->Exact;
  links.RaysPerPatch = this->Plan.RaysPerPatch;
  links.ExactPatches = this->Plan.Bright;
  counts.Count(this->Samples->Hits, ranks, links);
  links.Hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  Outcome outcome = counts.Store(exact, {}, ranks, links.Hierarchy);
  outcome = outcome ? links.SumRows(ranks) : outcome;
  links.RawRowSums = links.RowSums;
  if (outcome && !exact.IsEmpty())
  {
    std::transform(links.RawRowSums.begin(), links.RawRowSums.end(), exact.GetSums().begin(),
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
  const double rays = this->Plan.RaysPerPatch;
  const vtkIdType patches = links.Hierarchy->GetNumberOfPatches();
  links.Summaries.insert(links.Summaries.begin(),
    { { "RaysPerPatch", rays }, { "RaysCast", static_cast<double>(patches) * rays },
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
