// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the links of each slot leave out of its irradiance: the sum of the deviations of its
 * quarters, with their signs, and the sum of the links' squared errors apart. Sums are in whole
 * numbers of small parts, so that they do not depend on the order of threads and ranks.
 */
#ifndef SlotErrors_h
#define SlotErrors_h

#include "ViewFactors/ClusterSampler.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace LightTransport
{
class Ranks;

class SlotErrors
{
public:
  /// Set all sums of a number of slots to 0.
  void Clear(int slots);

  /// Add a link's squared error and its deviations of the quarters. May be called from several
  /// threads.
  void Add(int slot, double squaredError, const double* deviations);

  /// Collective.
  void AddUp(const Ranks& ranks);

  /// The mean over the quarters of the square of what deviations sum to.
  double GetCoherent(int slot) const;
  /// The sum of the squared errors.
  double GetApart(int slot) const;

private:
  static constexpr int Points = ClusterSampler::Points;
  using Sums = std::unique_ptr<std::atomic<std::int64_t>[]>;

  std::size_t NumberOfSlots = 0;
  Sums Deviations; ///< Points for each slot
  Sums Squares;
};
} // namespace LightTransport

#endif
