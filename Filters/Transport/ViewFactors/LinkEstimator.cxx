// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/LinkEstimator.h"

#include "Geometry/SceneRayCaster.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

constexpr int Points = ClusterSampler::Points;
// How far the visible part may be off where all rays agree: the standard deviation of a share of
// which 16 samples showed nothing.
constexpr double UnseenShare = 0.05;
// Where the kernel may be this much larger than any sample, the points are taken to miss what is
// near: a share of the receiver (squared deviation) gets as much as is possible.
constexpr double NearRatio = 2.0;
constexpr double NearShare = 0.003;
// Where the kernel has no bound, in single precision.
constexpr double MostKernel = std::numeric_limits<float>::max();

//------------------------------------------------------------------------------
// How much the means of the kernel vary over a receiver; `area` is that of the sender.
double GetVariance(const float* means, double area, double highest)
{
  const double mean = std::accumulate(means, means + Points, 0.0) / Points;
  double sum = 0.0;
  for (int k = 0; k < Points; ++k)
  {
    const double deviation = static_cast<double>(means[k]) - mean;
    sum += deviation * deviation / (Points - 1);
  }
  // No more than everything arrives.
  const double most = std::min(highest, 1.0 / area);
  const bool mayMiss =
    most > NearRatio * static_cast<double>(*std::max_element(means, means + Points));
  return mayMiss ? sum + NearShare * (most - mean) * (most - mean) : sum;
}
} // namespace

//------------------------------------------------------------------------------
LinkEstimator::LinkEstimator(const PatchScene& scene, const LinkSlots& slots,
  const SceneRayCaster& caster, const UnoccludedPairs& open, const ShaftCuller& culler)
  : Scene(scene), Slots(slots), Caster(caster), Pairs(scene, open, culler), Sampler(scene, slots)
{
}

//------------------------------------------------------------------------------
// A cluster's is the root of the mean square of its patches'.
void LinkEstimator::SetBrightness(const std::vector<double>& brightness)
{
  const double most = *std::max_element(brightness.begin(), brightness.end());
  const std::vector<double>& areas = this->Scene.GetAreas();
  std::vector<double> before(1, 0.0);
  for (std::size_t patch = 0; patch < brightness.size(); ++patch)
  {
    const double relative = most > 0.0 ? brightness[patch] / most : 0.0;
    before.push_back(before.back() + areas[patch] * relative * relative);
  }
  this->SquaredBrightness = before.back();
  this->Brightness.clear();
  for (const PatchTree::Node& node : this->Scene.GetTree().GetNodes())
  {
    this->Brightness.push_back(std::sqrt((before[node.Last] - before[node.First]) / node.Area));
  }
  for (const double value : brightness)
  {
    this->Brightness.push_back(most > 0.0 ? value / most : 0.0);
  }
}

//------------------------------------------------------------------------------
double LinkEstimator::GetKernel(const ClusterSampler::Sample& a,
  const ClusterSampler::Sample& b) const
{
  const Vector ray = b.Point - a.Point;
  const double cosines = std::max(this->Scene.GetNormal(a.Patch).dot(ray), 0.0) *
    std::max(-this->Scene.GetNormal(b.Patch).dot(ray), 0.0);
  const double squared = ray.squaredNorm();
  return cosines > 0.0 ? cosines / (vtkMath::Pi() * squared * squared) : 0.0;
}

//------------------------------------------------------------------------------
LinkEstimator::View LinkEstimator::Look(const Pair& pair, double highest, double& rays) const
{
  ClusterSampler::Randomness random(pair.I, pair.J);
  const ClusterSampler::Samples a = this->Sampler.Take(pair.I, random);
  const ClusterSampler::Samples b = this->Sampler.Take(pair.J, random);
  double open = 0.0;
  double rows[Points] = {};
  double columns[Points] = {};
  for (int i = 0; i < Points; ++i)
  {
    for (int j = 0; j < Points; ++j)
    {
      double kernel = this->GetKernel(a[i], b[j]) / Points;
      open += kernel / Points;
      if (kernel > 0.0 && !pair.IsFree)
      {
        ++rays;
        kernel =
          this->Caster.IsOccluded(a[i].Point, b[j].Point, a[i].Patch, b[j].Patch) ? 0.0 : kernel;
      }
      rows[i] += kernel;
      columns[j] += kernel;
    }
  }
  View view;
  const auto round = [](double value) { return static_cast<float>(value); };
  std::transform(rows, rows + Points, view.Rows, round);
  std::transform(columns, columns + Points, view.Columns, round);
  view.Open = round(open);
  view.Highest = round(std::min(highest, MostKernel));
  return view;
}

//------------------------------------------------------------------------------
// From the kernel to the irradiance that counts.
LinkEstimator::Estimate LinkEstimator::Weigh(const Pair& pair, const View& view) const
{
  const double areaI = this->Slots.GetArea(pair.I);
  const double areaJ = this->Slots.GetArea(pair.J);
  const double sentI = areaI * this->Brightness[pair.I];
  const double sentJ = areaJ * this->Brightness[pair.J];
  const double varianceI = GetVariance(view.Rows, areaJ, view.Highest);
  const double varianceJ = GetVariance(view.Columns, areaI, view.Highest);
  const double unseen = pair.IsFree ? 0.0 : view.Open * UnseenShare;
  // The mean is off by about half of how much rows and columns vary, in both directions.
  const double mean = (varianceI + varianceJ) / (2 * Points) + unseen * unseen;
  Estimate estimate;
  estimate.Value = std::accumulate(view.Rows, view.Rows + Points, 0.0) / Points;
  estimate.ErrorI = (varianceI + mean) * areaI * sentJ * sentJ;
  estimate.ErrorJ = (varianceJ + mean) * areaJ * sentI * sentI;
  estimate.Mean = mean * (areaI * sentJ * sentJ + areaJ * sentI * sentI);
  for (int k = 0; k < Points; ++k)
  {
    estimate.DeviationsI[k] = (view.Rows[k] - estimate.Value) * sentJ;
    estimate.DeviationsJ[k] = (view.Columns[k] - estimate.Value) * sentI;
  }
  return estimate;
}

//------------------------------------------------------------------------------
PatchPairs::View LinkEstimator::LookAtPatches(const Pair& pair, PairVisibility& visibility) const
{
  return this->Pairs.Look(this->Slots.GetPatch(pair.I), this->Slots.GetPatch(pair.J), pair.IsFree,
    visibility);
}

//------------------------------------------------------------------------------
// Powers of 2, so that thresholds that are hardly finer do not ask anew.
LinkEstimator::Estimate LinkEstimator::WeighPatches(const Pair& pair, double threshold,
  PairVisibility& visibility, PatchPairs::View& view) const
{
  const double areaI = this->Slots.GetArea(pair.I);
  const double areaJ = this->Slots.GetArea(pair.J);
  const double sentI = view.Kernel * areaI * this->Brightness[pair.I];
  const double sentJ = view.Kernel * areaJ * this->Brightness[pair.J];
  const double weight = areaI * sentJ * sentJ + areaJ * sentI * sentI;
  const double allowed =
    weight > 0.0 ? std::exp2(std::round(0.5 * std::log2(threshold / weight))) : 1.0;
  const PatchPairs::View::Share share = this->Pairs.See(this->Slots.GetPatch(pair.I),
    this->Slots.GetPatch(pair.J), allowed, visibility, view);
  const double squared = static_cast<double>(share.Error) * share.Error;
  Estimate estimate;
  estimate.Value = static_cast<double>(view.Kernel) * share.Value;
  estimate.ErrorI = squared * areaI * sentJ * sentJ;
  estimate.ErrorJ = squared * areaJ * sentI * sentI;
  return estimate;
}
} // namespace LightTransport
