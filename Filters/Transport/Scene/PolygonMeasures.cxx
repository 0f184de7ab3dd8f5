// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PolygonMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// A polygon whose corners leave its plane, or the convex, by no more than this part of its radius
// (plus what single precision coordinates of the whole scene lose) is plane and convex.
constexpr double ShapeTolerance = 1e-4;
constexpr double CoordinateTolerance = 1e-6;
// Below this part of the longest edge squared an area is rounding noise.
constexpr double AreaTolerance = 1e-13;
// Of what coordinates may be off by: corners that are as far apart as coordinates can be told
// apart still have an area.
constexpr double RoundingPart = 0.25;
} // namespace

//------------------------------------------------------------------------------
PolygonMeasures::PolygonMeasures(const Vector* corners, int numberOfCorners, const Vector* plane)
  : Corners(corners), NumberOfCorners(numberOfCorners)
{
  const Vector& origin = corners[0];
  Vector twiceArea = Vector::Zero();
  for (int corner = 0; corner < numberOfCorners; ++corner)
  {
    const Vector a = corners[corner] - origin;
    const Vector b = corners[(corner + 1) % numberOfCorners] - origin;
    twiceArea += a.cross(b);
    this->LongestEdgeSquared = std::max(this->LongestEdgeSquared, (b - a).squaredNorm());
  }
  this->Area = 0.5 * (plane ? twiceArea.dot(*plane) : twiceArea.norm());
  if (!this->HasArea(0.0))
  {
    return;
  }
  this->Normal = plane ? *plane : twiceArea.normalized();
  Vector moment = Vector::Zero();
  for (int corner = 1; corner + 1 < numberOfCorners; ++corner)
  {
    const Vector a = corners[corner] - origin;
    const Vector b = corners[corner + 1] - origin;
    moment += 0.5 * a.cross(b).dot(this->Normal) * (a + b) / 3.0;
  }
  this->Centroid = origin + moment / this->Area;
  for (int corner = 0; corner < numberOfCorners; ++corner)
  {
    this->Radius = std::max(this->Radius, (corners[corner] - this->Centroid).norm());
  }
}

//------------------------------------------------------------------------------
// Of a triangle twice the area over the longest edge is its least height.
bool PolygonMeasures::HasArea(double rounding) const
{
  return this->Area > AreaTolerance * this->LongestEdgeSquared &&
    2.0 * this->Area > RoundingPart * rounding * std::sqrt(this->LongestEdgeSquared);
}

//------------------------------------------------------------------------------
double PolygonMeasures::GetTolerance() const
{
  return ShapeTolerance * this->Radius + CoordinateTolerance;
}

//------------------------------------------------------------------------------
bool PolygonMeasures::IsPlane() const
{
  const double tolerance = this->GetTolerance();
  return this->NumberOfCorners == 3 ||
    std::all_of(this->Corners, this->Corners + this->NumberOfCorners,
      [&](const Vector& corner)
      { return std::abs((corner - this->Centroid).dot(this->Normal)) <= tolerance; });
}

//------------------------------------------------------------------------------
bool PolygonMeasures::IsConvex() const
{
  if (this->NumberOfCorners == 3)
  {
    return true;
  }
  const Vector& first = this->Corners[0];
  const double tolerance = this->GetTolerance();
  for (int corner = 0; corner < this->NumberOfCorners; ++corner)
  {
    const Vector& a = this->Corners[corner];
    const Vector& b = this->Corners[(corner + 1) % this->NumberOfCorners];
    const Vector& c = this->Corners[(corner + 2) % this->NumberOfCorners];
    const double turn = (b - a).cross(c - b).dot(this->Normal);
    // A star turns the same way at all corners, but winds around more than once.
    const double fan = (a - first).cross(b - first).dot(this->Normal);
    if (turn < -tolerance * ((b - a).norm() + (c - b).norm()) ||
      fan < -tolerance * ((a - first).norm() + (b - first).norm()))
    {
      return false;
    }
  }
  return true;
}
} // namespace LightTransport
