// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/SamplingPlan.h"

#include "ViewFactors/RayHits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace LightTransport
{
namespace
{
// The variance falls with this power of the number of rays.
constexpr double VariancePower = 1.24;
// What is aimed at, of the accuracy: an error that is estimated comes out larger now and then.
constexpr double Aim = 0.95;
// The cost of an exact pair, in rays, and what it costs that there are any at all, in rays of each
// patch.
constexpr double RaysPerPair = 30.0;
constexpr double RaysForRows = 150.0;
// Patches that are nearly as bright as the last that gets an exact row are of the same lamp, which
// should not be left in part; so many more rows at most, beside a part of their number.
constexpr double AsBright = 0.5;
constexpr std::size_t MoreRows = 12;
constexpr std::size_t PartOfRows = 4;
// Rows that are exact, at most, and patches of which they are a part at least.
constexpr std::size_t MostRows = 4096;
constexpr std::size_t PatchesPerRow = 4;
// The tolerance of exact rows relative to the accuracy, where errors of many pairs average out: in
// a scene of as many patches or more. And its range.
constexpr double RowTolerance = 10.0;
constexpr double ManyPatches = 4000.0;
constexpr double LeastTolerance = 1e-6;
constexpr double MostTolerance = 0.1;

//------------------------------------------------------------------------------
// What each patch adds to the square of the error, of all bands, each relative to the whole; the
// sky is the last.
std::vector<double> FindVariances(const SamplingPlan::Trial& trial)
{
  const std::size_t patches = trial.Areas.size();
  const std::size_t bands = trial.Radiosity.size() / patches;
  const double area = std::accumulate(trial.Areas.begin(), trial.Areas.end(), 0.0);
  std::vector<double> variances(patches + 1, 0.0);
  for (std::size_t band = 0; band < bands; ++band)
  {
    const auto get = [&](std::size_t patch) { return trial.Radiosity[patch * bands + band]; };
    double mean = 0.0, open = 0.0;
    for (std::size_t patch = 0; patch < patches; ++patch)
    {
      mean += trial.Areas[patch] * get(patch) / area;
      open += trial.Areas[patch] * trial.SkyFractions[patch];
    }
    const double sky = trial.Background.empty() ? 0.0 : trial.Background[band];
    std::vector<double> here(patches + 1, open * (sky - mean) * (sky - mean));
    for (std::size_t patch = 0; patch < patches; ++patch)
    {
      here[patch] = trial.Areas[patch] * (get(patch) - mean) * (get(patch) - mean);
    }
    const double whole = std::accumulate(here.begin(), here.end(), 0.0);
    for (std::size_t k = 0; whole > 0.0 && k <= patches; ++k)
    {
      variances[k] += here[k] / whole;
    }
  }
  return variances;
}
} // namespace

//------------------------------------------------------------------------------
SamplingPlan SamplingPlan::Begin()
{
  SamplingPlan plan;
  plan.RaysPerPatch = RayHits::FewestRays;
  return plan;
}

//------------------------------------------------------------------------------
SamplingPlan SamplingPlan::Improve(const Trial& trial, double accuracy) const
{
  const std::size_t patches = trial.Areas.size();
  const std::vector<double> variances = FindVariances(trial);
  std::vector<std::size_t> order(patches);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return variances[a] > variances[b]; });
  double now = 0.0;
  for (std::size_t k = 0; k <= patches; ++k)
  {
    now += k < patches && !this->Bright.empty() && this->Bright[k] ? 0.0 : variances[k];
  }
  const double excess = std::pow(trial.Error / (Aim * accuracy), 2);
  double left = std::accumulate(variances.begin(), variances.end(), 0.0);
  double least = std::numeric_limits<double>::infinity();
  std::size_t bestRows = 0;
  int bestRays = this->RaysPerPatch;
  const std::size_t mostRows = std::min(MostRows, patches / PatchesPerRow);
  for (std::size_t rows = 0; rows <= mostRows; ++rows)
  {
    const double needed = this->RaysPerPatch *
      std::pow(excess * std::max(left, 0.0) / std::max(now, 1e-300), 1.0 / VariancePower);
    int rays = RayHits::FewestRays;
    while (rays < needed && rays < RayHits::MostRays)
    {
      rays *= 2;
    }
    const double cost =
      (rows > 0 ? RaysForRows + RaysPerPair * static_cast<double>(rows) : 0.0) + rays;
    if (cost < least)
    {
      least = cost;
      bestRows = rows;
      bestRays = rays;
    }
    left -= rows < patches ? variances[order[rows]] : 0.0;
  }
  const std::size_t more = bestRows + bestRows / PartOfRows + MoreRows;
  while (bestRows > 0 && bestRows < std::min(more, mostRows) &&
    variances[order[bestRows]] > AsBright * variances[order[bestRows - 1]])
  {
    ++bestRows;
  }
  SamplingPlan better;
  better.RaysPerPatch = std::max(bestRays, this->RaysPerPatch);
  better.Bright = this->Bright;
  better.Tolerance = this->Tolerance;
  if (bestRows > 0)
  {
    better.Bright.resize(patches, false);
    for (std::size_t k = 0; k < bestRows; ++k)
    {
      better.Bright[order[k]] = true;
    }
    const double averaged =
      RowTolerance * std::min(1.0, std::sqrt(static_cast<double>(patches) / ManyPatches));
    better.Tolerance = std::min(std::max(averaged * accuracy, LeastTolerance), MostTolerance);
  }
  if (better == *this && this->RaysPerPatch < RayHits::MostRays)
  {
    better.RaysPerPatch *= 2;
  }
  return better;
}
} // namespace LightTransport
