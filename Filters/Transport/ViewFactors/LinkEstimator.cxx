// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/LinkEstimator.h"

#include "Geometry/SceneRayCaster.h"
#include "Geometry/ShaftCuller.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/UnoccludedPairs.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

//------------------------------------------------------------------------------
// How much the means of the kernel vary over a receiver; `area` is that of the sender.
double GetVariance(const double* means, double area, double highest)
{
  const double mean = std::accumulate(means, means + Points, 0.0) / Points;
  double sum = 0.0;
  for (int k = 0; k < Points; ++k)
  {
    sum += (means[k] - mean) * (means[k] - mean) / (Points - 1);
  }
  // No more than everything arrives.
  const double most = std::min(highest, 1.0 / area);
  const bool mayMiss = most > NearRatio * *std::max_element(means, means + Points);
  return mayMiss ? sum + NearShare * (most - mean) * (most - mean) : sum;
}
} // namespace

//------------------------------------------------------------------------------
LinkEstimator::LinkEstimator(const PatchScene& scene, const LinkSlots& slots,
  const SceneRayCaster& caster, const UnoccludedPairs& open, const ShaftCuller& culler)
  : Scene(scene), Slots(slots), Caster(caster), Open(open), Culler(culler), Sampler(scene, slots)
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
LinkEstimator::Estimate LinkEstimator::Look(const Pair& pair, double highest, double& rays) const
{
  return this->Weigh(pair, highest, this->TakeMeans(pair, rays));
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
LinkEstimator::Means LinkEstimator::TakeMeans(const Pair& pair, double& rays) const
{
  ClusterSampler::Randomness random(pair.I, pair.J);
  const ClusterSampler::Samples a = this->Sampler.Take(pair.I, random);
  const ClusterSampler::Samples b = this->Sampler.Take(pair.J, random);
  Means means;
  for (int i = 0; i < Points; ++i)
  {
    for (int j = 0; j < Points; ++j)
    {
      double kernel = this->GetKernel(a[i], b[j]);
      means.Open += kernel;
      if (kernel > 0.0 && !pair.IsFree)
      {
        ++rays;
        kernel =
          this->Caster.IsOccluded(a[i].Point, b[j].Point, a[i].Patch, b[j].Patch) ? 0.0 : kernel;
      }
      means.Seen += kernel;
      means.Rows[i] += kernel / Points;
      means.Columns[j] += kernel / Points;
    }
  }
  means.Open /= Points * Points;
  means.Seen /= Points * Points;
  return means;
}

//------------------------------------------------------------------------------
// From the kernel to the irradiance that counts.
LinkEstimator::Estimate LinkEstimator::Weigh(const Pair& pair, double highest,
  const Means& means) const
{
  const double areaI = this->Slots.GetArea(pair.I);
  const double areaJ = this->Slots.GetArea(pair.J);
  const double sentI = areaI * this->Brightness[pair.I];
  const double sentJ = areaJ * this->Brightness[pair.J];
  const double varianceI = GetVariance(means.Rows, areaJ, highest);
  const double varianceJ = GetVariance(means.Columns, areaI, highest);
  const double unseen = pair.IsFree ? 0.0 : means.Open * UnseenShare;
  // The mean is off by about half of how much rows and columns vary, in both directions.
  const double mean = (varianceI + varianceJ) / (2 * Points) + unseen * unseen;
  Estimate estimate;
  estimate.Value = means.Seen;
  estimate.ErrorI = (varianceI + mean) * areaI * sentJ * sentJ;
  estimate.ErrorJ = (varianceJ + mean) * areaJ * sentI * sentI;
  estimate.Mean = mean * (areaI * sentJ * sentJ + areaJ * sentI * sentI);
  for (int k = 0; k < Points; ++k)
  {
    estimate.DeviationsI[k] = (means.Rows[k] - means.Seen) * sentJ;
    estimate.DeviationsJ[k] = (means.Columns[k] - means.Seen) * sentI;
  }
  return estimate;
}

//------------------------------------------------------------------------------
LinkEstimator::Estimate LinkEstimator::Integrate(const Pair& pair, double threshold,
  PairVisibility& visibility) const
{
  const vtkIdType i = this->Slots.GetPatch(pair.I);
  const vtkIdType j = this->Slots.GetPatch(pair.J);
  const double areaI = this->Scene.GetAreas()[i];
  const double areaJ = this->Scene.GetAreas()[j];
  const double open = this->Open.Compute(i, j).Value;
  Estimate estimate;
  estimate.Value = open / (areaI * areaJ);
  if (pair.IsFree || estimate.Value <= 0.0 || !this->Culler.HasOccluders())
  {
    return estimate;
  }
  std::vector<ShaftCuller::Occluder> between;
  this->Culler.FindBetween(i, j, between);
  if (between.empty())
  {
    return estimate;
  }
  if (!visibility.SetPair(this->Scene, i, j, this->Culler.GetWalls(), between,
        PairVisibility::GetKey(i, j), open))
  {
    return estimate;
  }
  PairVisibility::Share share = visibility.Look();
  const double sentI = open / areaJ * this->Brightness[pair.I];
  const double sentJ = open / areaI * this->Brightness[pair.J];
  const double weight = areaI * sentJ * sentJ + areaJ * sentI * sentI;
  const double allowed = weight > 0.0 ? std::sqrt(threshold / weight) : 1.0;
  if (share.Error > allowed)
  {
    share = visibility.Integrate(allowed, share.Value);
  }
  estimate.Value *= share.Value;
  estimate.ErrorI = share.Error * share.Error * areaI * sentJ * sentJ;
  estimate.ErrorJ = share.Error * share.Error * areaJ * sentI * sentI;
  return estimate;
}
} // namespace LightTransport
