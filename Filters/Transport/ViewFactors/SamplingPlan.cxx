// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/SamplingPlan.h"

#include "ViewFactors/RayHits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
constexpr double RaysPerPair = 18.0;
constexpr double RaysForRows = 60.0;
// Patches that are nearly as bright as the last that gets an exact row are of the same lamp, which
// should not be left in part, unless it has more patches than this.
constexpr double AsBright = 0.5;
constexpr std::size_t RowsAtOnce = 64;
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

//------------------------------------------------------------------------------
std::size_t GetMostRows(std::size_t patches)
{
  return std::min(MostRows, patches / PatchesPerRow);
}

//------------------------------------------------------------------------------
// Patches, those first that add most.
std::vector<std::size_t> SortPatches(const std::vector<double>& variances)
{
  std::vector<std::size_t> order(variances.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return variances[a] > variances[b]; });
  return order;
}

//------------------------------------------------------------------------------
// Whether the first so many of the patches are whole lamps, or enough.
bool AreWhole(std::size_t rows, const std::vector<double>& variances,
  const std::vector<std::size_t>& order)
{
  return rows % RowsAtOnce == 0 || rows == order.size() ||
    variances[order[rows]] <= AsBright * variances[order[rows - 1]];
}

//------------------------------------------------------------------------------
double FindRowTolerance(double accuracy, std::size_t patches)
{
  const double averaged =
    RowTolerance * std::min(1.0, std::sqrt(static_cast<double>(patches) / ManyPatches));
  return std::min(std::max(averaged * accuracy, LeastTolerance), MostTolerance);
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
// What all patches but those with exact rows add to the square of the error now.
double SamplingPlan::SumSampled(const std::vector<double>& variances) const
{
  double sum = 0.0;
  for (std::size_t k = 0; k < variances.size(); ++k)
  {
    sum += k < this->Bright.size() && this->Bright[k] ? 0.0 : variances[k];
  }
  return sum;
}

//------------------------------------------------------------------------------
// Rays that keep what is aimed at where the error's square, times the power of their number, is so
// many times what it should be: maybe more than a patch can cast.
double SamplingPlan::FindRays(double excess) const
{
  const double more = std::pow(std::max(excess, 1.0), 1.0 / VariancePower);
  return this->RaysPerPatch * std::exp2(std::ceil(std::log2(more)));
}

//------------------------------------------------------------------------------
// The number of exact rows for which they and the rays cost least together; and those rays. Rays
// that cannot be cast cost as well: rows have to stand in for them where too few are to be had.
std::size_t SamplingPlan::FindCheapest(const std::vector<double>& variances,
  const std::vector<std::size_t>& order, double excess, int& bestRays) const
{
  const double now = std::max(this->SumSampled(variances), std::numeric_limits<double>::min());
  double left = std::accumulate(variances.begin(), variances.end(), 0.0);
  double least = std::numeric_limits<double>::infinity();
  std::size_t bestRows = 0;
  for (std::size_t rows = 0; rows <= GetMostRows(order.size()); ++rows)
  {
    const double rays = this->FindRays(excess * left / now);
    const double cost =
      (rows > 0 ? RaysForRows + RaysPerPair * static_cast<double>(rows) : 0.0) + rays;
    if (cost < least && AreWhole(rows, variances, order))
    {
      least = cost;
      bestRows = rows;
      bestRays = static_cast<int>(std::min<double>(rays, RayHits::MostRays));
    }
    left -= rows < order.size() ? variances[order[rows]] : 0.0;
  }
  return bestRows;
}

//------------------------------------------------------------------------------
SamplingPlan SamplingPlan::Improve(const Trial& trial, double accuracy) const
{
  const std::size_t patches = trial.Areas.size();
  const std::vector<double> variances = FindVariances(trial);
  const std::vector<std::size_t> order = SortPatches(variances);
  const double excess = std::pow(trial.Error / (Aim * accuracy), 2);
  SamplingPlan better = *this;
  const std::size_t rows = this->FindCheapest(variances, order, excess, better.RaysPerPatch);
  if (rows > 0)
  {
    better.Bright.resize(patches, false);
    better.Tolerance = FindRowTolerance(accuracy, patches);
  }
  std::for_each(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(rows),
    [&](std::size_t patch) { better.Bright[patch] = true; });
  if (better == *this && this->RaysPerPatch < RayHits::MostRays)
  {
    better.RaysPerPatch *= 2;
  }
  return better;
}
} // namespace LightTransport
