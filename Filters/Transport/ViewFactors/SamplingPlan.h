// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How sampled links are made: rays of each patch, more from bright ones, and which patches get
 * exact rows. From a solution with fewer rays, and how wrong that is, follows what keeps an
 * accuracy in the least time: the square of the error comes from the patches by A B^2 (what differs
 * from the mean, which closed rows carry without error), and falls with the power 1.24 of the
 * number of rays that know of a link; a row costs what some twenty rays of all patches do, and the
 * first of them sixty more.
 */
#ifndef SamplingPlan_h
#define SamplingPlan_h

#include "Links/RayNumbers.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace LightTransport
{
struct SamplingPlan
{
  RayNumbers Rays;
  std::vector<bool> Bright; ///< one flag for each patch, or none at all
  double Tolerance = 0.0;   ///< of exact rows

  /// The first look: few rays where little is asked for.
  static SamplingPlan Begin(double accuracy);
  /// What may be known before: patches x bands each.
  struct Guess
  {
    const std::vector<double>& Areas;
    const std::vector<double>& Radiosity;
    const std::vector<double>& Emission;
  };
  /// And more from what seems to be bright.
  static SamplingPlan Begin(double accuracy, const Guess& guess);

  /// What is known of a solution by this plan.
  struct Trial
  {
    const std::vector<double>& Areas;
    const std::vector<double>& Radiosity;    ///< patches x bands
    const std::vector<double>& Background;   ///< irradiance by it alone, one per band; empty: none
    const std::vector<double>& SkyFractions; ///< of the patches
    double Error;                            ///< as Accuracy counts it
  };

  /// A plan that should keep an accuracy where this one has not. The same where nothing more can be
  /// done.
  SamplingPlan Improve(const Trial& trial, double accuracy) const;

  bool operator==(const SamplingPlan& other) const
  {
    return this->Rays == other.Rays && this->Bright == other.Bright;
  }

private:
  /// What a number of exact rows costs, in rays of each patch.
  struct Costs
  {
    double Cost = 0.0;
    std::size_t Rows = 0;
    int Rays = 0; ///< of a patch, at least
    /// What a patch adds to the error that casts more.
    double Least = std::numeric_limits<double>::infinity();
    int MostDoublings = 0;
  };
  double SumSampled(const std::vector<double>& variances) const;
  void ShareRays(const SamplingPlan& before, const Costs& costs,
    const std::vector<double>& variances, const std::vector<std::size_t>& order);
  Costs FindCheapest(const std::vector<double>& variances, const std::vector<std::size_t>& order,
    double excess) const;
};
} // namespace LightTransport

#endif
