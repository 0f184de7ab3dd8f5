// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/SamplingPlan.h"

#include "ViewFactors/RayHits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

namespace LightTransport
{
namespace
{
// The variance falls with this power of the number of rays; of what a patch sends, where it alone
// casts more, with that one: what its rays meet is no even part of others.
constexpr double VariancePower = 1.33;
constexpr double OwnPower = 0.9;
// Of one ray of each patch, relative to the square of what light differs by from its mean: by this
// a first look is chosen (from .03 to 1 was measured).
constexpr double FirstVariance = 0.25;
// What is aimed at, of the accuracy: an error that is estimated comes out larger now and then.
constexpr double Aim = 0.9;
// The cost of an exact pair, in rays, and what it costs that there are any at all, in rays of each
// patch.
constexpr double RaysPerPair = 18.0;
constexpr double RaysForRows = 60.0;
// In rays of each patch: beyond that nothing is looked for.
constexpr double Unaffordable = 1e15;
// What differs less from the mean than so many times what all do on average is smooth light, of
// whose errors neighbours cancel a part.
constexpr double Outstanding = 10.0;
constexpr double SmoothPart = 0.5;
// The first look: at this accuracy and below, or above.
constexpr double LowAccuracy = 2e-2;
constexpr int UsualRays = 64;
// Numbers of rays between two powers of two are as good as so many times as few.
constexpr double OddRays = 0.88;
// How many times a patch casts twice as many rays as others, at most; and how finely is searched
// for what it must add to the error for that.
constexpr int MostDoublings = 12;
constexpr double ShareStep = 0.7;
constexpr double SmallestShare = 1e-9;
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
    double whole = std::accumulate(here.begin(), here.end(), 0.0);
    for (std::size_t patch = 0; patch < patches; ++patch)
    {
      here[patch] *=
        here[patch] < Outstanding * whole * trial.Areas[patch] / area ? SmoothPart : 1.0;
    }
    whole = std::accumulate(here.begin(), here.end(), 0.0);
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
// How many times a patch may cast twice as many rays as others, which cast so many.
int GetMostDoublings(std::int64_t rays)
{
  int doublings = 0;
  while (doublings < MostDoublings && (rays << (doublings + 1)) <= RayHits::MostRays)
  {
    ++doublings;
  }
  return doublings;
}

//------------------------------------------------------------------------------
// By what more rays from a patch than from others lower what it adds: its links know both.
double GetFall(int doublings)
{
  return std::pow(0.5 * ((1 << doublings) + 1), -OwnPower);
}

//------------------------------------------------------------------------------
// The next number of rays: powers of two, and one between each two.
std::int64_t GetNextRays(std::int64_t rays)
{
  const bool isPower = (rays & (rays - 1)) == 0;
  return isPower ? (rays > RayHits::FewestRays ? rays / 2 * 3 : 2 * rays) : rays / 3 * 4;
}

//------------------------------------------------------------------------------
// As many as would be as good in a row of powers of two.
double GetWorth(std::int64_t rays)
{
  return (rays & (rays - 1)) == 0 ? static_cast<double>(rays) : OddRays * static_cast<double>(rays);
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

//------------------------------------------------------------------------------
// What patches add to the square of the error, the most first, for sums over those that get as many
// rays.
class Shares
{
public:
  Shares(const std::vector<double>& variances, const std::vector<std::size_t>& order)
    : Sky(variances.back()), Sums(1, 0.0)
  {
    for (const std::size_t patch : order)
    {
      this->Each.push_back(variances[patch]);
      this->Sums.push_back(this->Sums.back() + variances[patch]);
    }
  }

  /// Without the first `rows`, where those of at least `least` cast twice as many rays as others,
  /// and so on (GetLeast).
  struct Whole
  {
    double Variance;
    double Rays; ///< of all patches, where most cast one
  };
  Whole Add(std::size_t rows, double least, int mostDoublings) const
  {
    Whole whole{ this->Sky, 0.0 };
    std::size_t begin = rows;
    for (int doublings = mostDoublings; doublings >= 0; --doublings)
    {
      const std::size_t end = doublings == 0
        ? this->Each.size()
        : std::max(begin, this->Find(GetLeast(least, doublings)));
      whole.Variance += GetFall(doublings) * (this->Sums[end] - this->Sums[begin]);
      whole.Rays += static_cast<double>(end - begin) * (1 << doublings);
      begin = end;
    }
    return whole;
  }

  /// What a patch adds that is worth so many doublings, where that for one is known: its rays grow
  /// with the power of it by which error and cost fall and rise together.
  static double GetLeast(double first, int doublings)
  {
    return first * std::exp2((doublings - 1) * (1.0 + OwnPower));
  }

  double GetLargest() const { return this->Each.front(); }

private:
  // How many add at least that.
  std::size_t Find(double least) const
  {
    const auto end = std::partition_point(this->Each.begin(), this->Each.end(),
      [=](double v) { return v >= least; });
    return end - this->Each.begin();
  }

  double Sky;
  std::vector<double> Each;
  std::vector<double> Sums; ///< of the first ones
};
} // namespace

//------------------------------------------------------------------------------
SamplingPlan SamplingPlan::Begin(double accuracy)
{
  SamplingPlan plan;
  plan.Rays.Each = accuracy > LowAccuracy ? RayHits::FewestRays : UsualRays;
  return plan;
}

//------------------------------------------------------------------------------
// How wrong it is follows from what light there may be. Where that is wrong by much, few rays have
// been cast in vain.
SamplingPlan SamplingPlan::Begin(double accuracy, const Guess& guess)
{
  SamplingPlan plan = Begin(accuracy);
  const double variance = FirstVariance * std::pow(plan.Rays.Each, -VariancePower);
  double error = 0.0;
  const std::size_t bands = guess.Radiosity.size() / guess.Areas.size();
  for (std::size_t band = 0; band < bands; ++band)
  {
    double area = 0.0, sum = 0.0, squares = 0.0, reflected = 0.0;
    for (std::size_t k = band; k < guess.Radiosity.size(); k += bands)
    {
      const double here = guess.Areas[k / bands];
      const double sent = guess.Radiosity[k];
      area += here;
      sum += here * sent;
      squares += here * sent * sent;
      reflected += here * std::pow(sent - guess.Emission[k], 2);
    }
    const double uneven = std::max(0.0, squares - sum * sum / area);
    error = std::max(error, reflected > 0.0 ? std::sqrt(variance * uneven / reflected) : 0.0);
  }
  const std::vector<double> closed(guess.Areas.size(), 0.0);
  const std::vector<double> nothing;
  const Trial trial{ guess.Areas, guess.Radiosity, nothing, closed, error };
  if (error > accuracy)
  {
    const SamplingPlan better = plan.Improve(trial, accuracy);
    plan.Rays.Each = better.Bright.empty() ? std::min(better.Rays.Each, UsualRays) : plan.Rays.Each;
    plan.Rays.Doublings = better.Rays.Doublings;
  }
  return plan;
}

//------------------------------------------------------------------------------
// What all patches but those with exact rows add to the square of the error now.
double SamplingPlan::SumSampled(const std::vector<double>& variances) const
{
  double sum = variances.back();
  for (std::size_t k = 0; k + 1 < variances.size(); ++k)
  {
    const int doublings = this->Rays.Doublings.empty() ? 0 : this->Rays.Doublings[k];
    sum += k < this->Bright.size() && this->Bright[k] ? 0.0 : variances[k] * GetFall(doublings);
  }
  return sum;
}

//------------------------------------------------------------------------------
// The number of exact rows for which they and the rays cost least together, and how these rays are
// shared: so many times more of all patches, and more from those that add much. Rays that cannot be
// cast cost as well: rows have to stand in for them where too few are to be had.
SamplingPlan::Costs SamplingPlan::FindCheapest(const std::vector<double>& variances,
  const std::vector<std::size_t>& order, double excess) const
{
  const Shares shares(variances, order);
  const double now = std::max(this->SumSampled(variances), std::numeric_limits<double>::min());
  const auto patches = static_cast<double>(order.size());
  Costs best;
  best.Cost = Unaffordable;
  best.Rays = RayHits::MostRays;
  for (std::size_t rows = 0; rows <= GetMostRows(order.size()); ++rows)
  {
    if (!AreWhole(rows, variances, order))
    {
      continue;
    }
    const double forRows = rows > 0 ? RaysForRows + RaysPerPair * static_cast<double>(rows) : 0.0;
    for (std::int64_t each = this->Rays.Each; forRows + static_cast<double>(each) < best.Cost;
         each = GetNextRays(each))
    {
      const double growth = GetWorth(each) / GetWorth(this->Rays.Each);
      const double allowed = now / excess * std::pow(growth, VariancePower);
      const int most = GetMostDoublings(each);
      double least = std::numeric_limits<double>::infinity();
      Shares::Whole whole = shares.Add(rows, least, 0);
      // Fewer and fewer have to add less and less.
      for (double next = shares.GetLargest();
           whole.Variance > allowed && most > 0 && next > SmallestShare * shares.GetLargest();
           next *= ShareStep)
      {
        least = next;
        whole = shares.Add(rows, least, most);
      }
      const double cost = forRows + static_cast<double>(each) * whole.Rays / patches;
      if (whole.Variance <= allowed && cost < best.Cost)
      {
        best = { cost, rows, static_cast<int>(std::min<std::int64_t>(each, RayHits::MostRays)),
          least, most };
      }
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// What has been cast already stays.
void SamplingPlan::ShareRays(const SamplingPlan& before, const Costs& costs,
  const std::vector<double>& variances, const std::vector<std::size_t>& order)
{
  const std::size_t patches = order.size();
  std::vector<unsigned char> doublings(patches, 0);
  this->Rays.Each = costs.Rays;
  for (std::size_t place = 0; place < patches; ++place)
  {
    const std::size_t patch = order[place];
    const int had = before.Rays.Get(static_cast<vtkIdType>(patch));
    unsigned char& more = doublings[patch];
    while (more < costs.MostDoublings &&
      (2 * (costs.Rays << more) <= had ||
        (place >= costs.Rows && variances[patch] >= Shares::GetLeast(costs.Least, more + 1))))
    {
      ++more;
    }
  }
  const bool areMore = std::any_of(doublings.begin(), doublings.end(), [](int d) { return d > 0; });
  this->Rays.Doublings = areMore ? doublings : std::vector<unsigned char>();
}

//------------------------------------------------------------------------------
SamplingPlan SamplingPlan::Improve(const Trial& trial, double accuracy) const
{
  const std::size_t patches = trial.Areas.size();
  const std::vector<double> variances = FindVariances(trial);
  const std::vector<std::size_t> order = SortPatches(variances);
  const double excess = std::max(1.0, std::pow(trial.Error / (Aim * accuracy), 2));
  SamplingPlan better = *this;
  const Costs best = this->FindCheapest(variances, order, excess);
  better.ShareRays(*this, best, variances, order);
  if (best.Rows > 0)
  {
    better.Bright.resize(patches, false);
    better.Tolerance = FindRowTolerance(accuracy, patches);
  }
  std::for_each(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(best.Rows),
    [&](std::size_t patch) { better.Bright[patch] = true; });
  if (better == *this && this->Rays.Each < RayHits::MostRays)
  {
    better.Rays.Each = static_cast<int>(GetNextRays(better.Rays.Each));
  }
  return better;
}
} // namespace LightTransport
