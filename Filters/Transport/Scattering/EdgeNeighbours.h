// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Two triangles with edges on one line, as neighbours in a mesh have them, at any angle: a profile
 * of distance integrated over both. With s and t the heights over the line and w the way along it
 * from a point of one to a point of the other, the distance is
 * sqrt(w^2 + s^2 + t^2 - 2 s t cos(angle)), and what both have in common along the line is linear
 * in pieces of (s, t, w). In spherical coordinates of these three the integral over the radius is
 * exact, by the moments of the profile, and the integral over directions is smooth however many
 * mean free paths wide the triangles are: the work does not grow with their width.
 */
#ifndef EdgeNeighbours_h
#define EdgeNeighbours_h

#include "Scattering/ProfileMoments.h"
#include "Shared/GaussLegendre.h"

#include <Eigen/Core>

namespace LightTransport
{
class EdgeNeighbours
{
public:
  using Vector = Eigen::Vector3d;
  using Bands = ProfileMoments::Bands;

  /// False where no edges of the two have a part in common, or where the triangles are almost
  /// folded onto each other.
  bool Set(const Vector a[3], const Vector b[3]);

  /// What the two have in common of the line.
  double GetSharedLength() const { return this->SharedLength; }

  /// The integral of profiles over their totals, with a rule for each part of the directions.
  Bands Integrate(const ProfileMoments& moments, const GaussLegendre& rule) const;

private:
  /// A triangle over the line: from Begin + BeginSlope h to End + EndSlope h at the height h.
  struct Shadow
  {
    double Begin;
    double BeginSlope;
    double End;
    double EndSlope;
  };
  /// Along a ray from the origin of (s, t, w): what both have in common is the least of four.
  struct Line
  {
    double Start;
    double Slope;
    double At(double radius) const { return this->Start + this->Slope * radius; }
  };

  bool SetEdges(const Vector a[3], int edgeOfA, const Vector b[3], int edgeOfB);
  void SetParts(double s, double t, double bounds[4]) const;
  Bands IntegrateRay(const ProfileMoments& moments, const Vector& direction) const;
  /// All parts of the ray on which both have something in common, one after the other; `direction`
  /// is (s, t, w).
  template <typename Segment>
  void VisitRay(const Vector& direction, const Segment& visit) const;

  Shadow Shadows[2];
  double CosineOfAngle = 0.0;
  double SharedLength = 0.0;
};
} // namespace LightTransport

#endif
