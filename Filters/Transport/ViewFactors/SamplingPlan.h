// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How sampled links are made: rays of each patch, and which patches get exact rows. From a solution
 * with fewer rays, and how wrong that is, follows what keeps an accuracy in the least time: the
 * square of the error comes from the patches by A B^2 (what differs from the mean, which closed
 * rows carry without error), and falls with the power 1.24 of the number of rays; a row costs what
 * some twenty rays of all patches do, and the first of them sixty more.
 */
#ifndef SamplingPlan_h
#define SamplingPlan_h

#include <cstddef>
#include <vector>

namespace LightTransport
{
struct SamplingPlan
{
  int RaysPerPatch = 0;
  std::vector<bool> Bright; ///< one flag for each patch, or none at all
  double Tolerance = 0.0;   ///< of exact rows

  /// The first look.
  static SamplingPlan Begin();

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
    return this->RaysPerPatch == other.RaysPerPatch && this->Bright == other.Bright;
  }

private:
  double SumSampled(const std::vector<double>& variances) const;
  double FindRays(double excess) const;
  std::size_t FindCheapest(const std::vector<double>& variances,
    const std::vector<std::size_t>& order, double excess, int& bestRays) const;
};
} // namespace LightTransport

#endif
