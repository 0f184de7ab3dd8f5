// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Two triangles in parallel planes, as both sides of a sheet or a slab have them: a profile of
 * distance integrated over both. All pairs of points that are displaced by r in direction theta
 * along the planes make up the area that one triangle and the other one, moved back by r, have in
 * common: K(r, theta), quadratic in r between the displacements at which a corner meets an edge.
 * That leaves two integrals, over r and theta, whose integrands are smooth however many mean free
 * paths wide the triangles are: the work does not grow with their width.
 */
#ifndef ParallelTriangles_h
#define ParallelTriangles_h

#include "Geometry/FlatRegion.h"
#include "Shared/GaussLegendre.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace LightTransport
{
class ParallelTriangles
{
public:
  using Vector = Eigen::Vector3d;
  using Bands = Eigen::Array4d;
  /// The profile of a squared distance.
  using Profile = std::function<Bands(double)>;

  /// False where the planes are not parallel, to a profile that changes over `scale` or, down to
  /// the smallest one, over the distance itself, or are one plane in which the two do not overlap.
  bool Set(const Vector a[3], const Vector b[3], double scale, double smallest);

  /// Over which the profile changes along the planes.
  double GetScale() const { return this->Scale; }

  /// With a rule for each range of directions between those that lead from corner to corner.
  Bands Integrate(const Profile& profile, const GaussLegendre& rule) const;

private:
  using Point = FlatRegion::Point;

  void FindDirections();
  std::vector<double> FindMeetings(const Point& direction) const;
  double GetCommonArea(const Point& displacement) const;
  Bands IntegrateRay(const Profile& profile, const Point& direction) const;

  FlatRegion::Region Regions[2];
  double SquaredDistance = 0.0;
  double Scale = 1.0;
  /// Of a whole turn, in order; the last is the first again.
  std::vector<double> Directions;
};
} // namespace LightTransport

#endif
