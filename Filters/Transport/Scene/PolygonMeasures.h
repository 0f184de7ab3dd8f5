// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What follows from the corners of a polygon, and whether it is plane and convex.
#ifndef PolygonMeasures_h
#define PolygonMeasures_h

#include <Eigen/Core>

namespace LightTransport
{
struct PolygonMeasures
{
  using Vector = Eigen::Vector3d;

  /// Of 3 corners or more, counter-clockwise seen from the front; any polygon, in units of the
  /// scene. `plane` is the normal of the plane to measure in, where it is known better than from
  /// these corners: of a piece of a larger polygon.
  PolygonMeasures(const Vector* corners, int numberOfCorners, const Vector* plane = nullptr);

  /// Whether there is more than rounding noise: also where coordinates may be off by `rounding`.
  bool HasArea(double rounding) const;
  /// Within the tolerance that makes a polygon one patch: of what single precision loses.
  bool IsPlane() const;
  bool IsConvex() const;

  Vector Normal = Vector::Zero();
  double Area = 0.0;
  Vector Centroid = Vector::Zero();
  /// Of a sphere around the centroid that holds the polygon.
  double Radius = 0.0;
  double LongestEdgeSquared = 0.0;

private:
  double GetTolerance() const;

  const Vector* Corners;
  int NumberOfCorners;
};
} // namespace LightTransport

#endif
