// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light on the clusters of a body, for which links may be chosen. A link takes it for its mean, and
 * misses the covariance of light and profile over the cluster. Far away the profile changes along
 * the way to the receiver alone, and only light that does so, too, is missed: the slope of its
 * regression on that direction is known from the covariance of light and place. Of the rest of its
 * deviation some is missed where the profile is not linear.
 */
#ifndef ClusterLight_h
#define ClusterLight_h

#include "Scattering/ScatteringClusters.h"
#include "Scattering/ScatteringReceiver.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace LightTransport
{
class ClusterLight
{
public:
  using Bands = ScatteringClusters::Bands;

  /// `light`: patches x components, the bands of each of some lights one after another; none where
  /// it is empty. `clusters` must outlive this.
  ClusterLight(const ScatteringClusters& clusters, const std::vector<double>& light);

  std::size_t GetNumberOfComponents() const { return this->Components; }

  /// Adds what a link of this value from a slot brings, each component.
  void Add(int slot, const Bands& value, double* received) const;

  /// What errors of each component are relative to; 0 where nothing is wrong with it.
  void SetSizes(const std::vector<double>& sizes);
  bool HasSizes() const { return !this->Changes.empty(); }

  /// About what a link from a part misses, of the worst light in each band.
  Bands GetDeviation(const ScatteringReceiver& receiver,
    const ScatteringReceiver::Part& part) const;

private:
  static constexpr int NumberOfBands = ScatteringIntegrals::NumberOfBands;
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  /// Of the light that changes most over a slot, in each band; over its size.
  struct Change
  {
    Bands Deviation = Bands::Zero();
    Matrix Covariance = Matrix::Zero(); ///< with the place: a column for each band
    Matrix Spread = Matrix::Zero();     ///< of the place with itself
  };

  void FindSpreads();
  void FindChanges(std::size_t component, double size);

  const ScatteringClusters& Clusters;
  std::size_t Components = 0;
  std::vector<double> Means;   ///< slots x components
  std::vector<Change> Changes; ///< of slots
};
} // namespace LightTransport

#endif
