// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// A polygon whose corners leave its plane by more than this part of its radius (plus what single
// precision coordinates of the whole scene lose) is refused: view factors of a warped polygon are
// not defined.
constexpr double PlanarityTolerance = 1e-4;
constexpr double CoordinateTolerance = 1e-6;
// Below this part of the longest edge squared an area is rounding noise.
constexpr double AreaTolerance = 1e-13;
// Rounding in double precision of heights over a plane, whose normal comes from rounded corners,
// where the scene's diagonal is 1.
constexpr double HeightRounding = 24.0 * std::numeric_limits<double>::epsilon();
// The rounding of coordinates counts up to this part of the width of a patch: where they are worth
// less than that they are taken as they are, since nothing would be left in front of anything.
constexpr double LargestPart = 1.0 / 32.0;
} // namespace

//------------------------------------------------------------------------------
void PatchGeometry::AllocatePatches()
{
  const std::size_t patches = this->Offsets.size() - 1;
  this->Areas.resize(patches);
  this->Normals.resize(patches);
  this->Centroids.resize(patches);
  this->Radii.resize(patches);
  this->Roundings.resize(patches);
  this->Slopes.resize(patches);
  this->EdgeRoundings.resize(patches);
}

//------------------------------------------------------------------------------
const char* PatchGeometry::ComputePatch(vtkIdType patch)
{
  const int corners = this->GetNumberOfCorners(patch);
  if (corners < 3)
  {
    return "has fewer than 3 corners: remove degenerate cells (vtkCleanPolyData, or vtkPatchMesher "
           "with Repair on).";
  }
  if (corners > MaximumCorners)
  {
    return "has more than 30 corners: pass the input through vtkTriangleFilter first.";
  }
  const Vector& origin = this->GetCorner(patch, 0);
  Vector twiceArea = Vector::Zero();
  double longest = 0.0;
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector a = this->GetCorner(patch, corner) - origin;
    const Vector b = this->GetCorner(patch, (corner + 1) % corners) - origin;
    twiceArea += a.cross(b);
    longest = std::max(longest, (b - a).squaredNorm());
  }
  const double area = 0.5 * twiceArea.norm();
  if (area <= AreaTolerance * longest)
  {
    return "has no area: remove degenerate cells (vtkCleanPolyData, or vtkPatchMesher with Repair "
           "on).";
  }
  const Vector normal = twiceArea.normalized();
  Vector moment = Vector::Zero();
  for (int corner = 1; corner + 1 < corners; ++corner)
  {
    const Vector a = this->GetCorner(patch, corner) - origin;
    const Vector b = this->GetCorner(patch, corner + 1) - origin;
    moment += 0.5 * a.cross(b).dot(normal) * (a + b) / 3.0;
  }
  const Vector centroid = origin + moment / area;
  double radius = 0.0;
  for (int corner = 0; corner < corners; ++corner)
  {
    radius = std::max(radius, (this->GetCorner(patch, corner) - centroid).norm());
  }
  this->Areas[patch] = area;
  this->Normals[patch] = normal;
  this->Centroids[patch] = centroid;
  this->Radii[patch] = radius;
  this->ComputeWorth(patch);
  return this->CheckShape(patch);
}

//------------------------------------------------------------------------------
// A plane and a point over it are each off by what coordinates lose along its normal; corners that
// are not in one plane tell the more of it, once for each of two sides whose planes differ by that.
void PatchGeometry::ComputeWorth(vtkIdType patch)
{
  const Vector& normal = this->Normals[patch];
  double unevenness = 0.0;
  for (int corner = 0; corner < this->GetNumberOfCorners(patch); ++corner)
  {
    const double height = (this->GetCorner(patch, corner) - this->Centroids[patch]).dot(normal);
    unevenness = std::max(unevenness, std::abs(height));
  }
  const double width = this->Areas[patch] / (2.0 * this->Radii[patch]);
  const double most = LargestPart * width;
  const double lost = std::min(2.0 * normal.cwiseAbs().dot(this->CoordinateRounding), most);
  this->Roundings[patch] = lost + 2.0 * unevenness + HeightRounding;
  this->Slopes[patch] = std::min(this->Roundings[patch] / width, LargestPart);
  this->EdgeRoundings[patch] = std::min(this->CoordinateRounding.norm(), most);
}

//------------------------------------------------------------------------------
const char* PatchGeometry::CheckShape(vtkIdType patch) const
{
  const int corners = this->GetNumberOfCorners(patch);
  if (corners == 3)
  {
    return nullptr;
  }
  const Vector& normal = this->Normals[patch];
  const Vector& first = this->GetCorner(patch, 0);
  const double tolerance = PlanarityTolerance * this->Radii[patch] + CoordinateTolerance;
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector& a = this->GetCorner(patch, corner);
    const Vector& b = this->GetCorner(patch, (corner + 1) % corners);
    const Vector& c = this->GetCorner(patch, (corner + 2) % corners);
    if (std::abs((a - this->Centroids[patch]).dot(normal)) > tolerance)
    {
      return "is not planar: pass the input through vtkTriangleFilter first.";
    }
    const double turn = (b - a).cross(c - b).dot(normal);
    // A star turns the same way at all corners, but winds around more than once.
    const double fan = (a - first).cross(b - first).dot(normal);
    if (turn < -tolerance * ((b - a).norm() + (c - b).norm()) ||
      fan < -tolerance * ((a - first).norm() + (b - first).norm()))
    {
      return "is not convex: pass the input through vtkTriangleFilter first.";
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
bool PatchGeometry::AreTouching(vtkIdType i, vtkIdType j) const
{
  const vtkIdType* const endI = this->GetCorners(i) + this->GetNumberOfCorners(i);
  const vtkIdType* const endJ = this->GetCorners(j) + this->GetNumberOfCorners(j);
  return std::find_first_of(this->GetCorners(i), endI, this->GetCorners(j), endJ) != endI;
}
} // namespace LightTransport
