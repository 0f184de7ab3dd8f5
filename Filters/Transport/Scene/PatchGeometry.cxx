// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchGeometry.h"

#include "Scene/PolygonMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
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
  this->SlopesAlong.resize(patches);
  this->NarrowAxes.resize(patches);
  this->EdgeRoundings.resize(patches);
}

//------------------------------------------------------------------------------
void PatchGeometry::ComputePatch(vtkIdType patch, const Vector* plane)
{
  const int corners = this->GetNumberOfCorners(patch);
  Vector places[MaximumCorners];
  for (int corner = 0; corner < corners; ++corner)
  {
    places[corner] = this->GetCorner(patch, corner);
  }
  const PolygonMeasures measures(places, corners, plane);
  this->Areas[patch] = measures.Area;
  this->Normals[patch] = measures.Normal;
  this->Centroids[patch] = measures.Centroid;
  this->Radii[patch] = measures.Radius;
  this->ComputeWorth(patch);
}

//------------------------------------------------------------------------------
// A plane and a point over it are each off by what coordinates lose along its normal; corners that
// are not in one plane tell the more of it, once for each of two sides whose planes differ by that.
void PatchGeometry::ComputeWorth(vtkIdType patch)
{
  const Vector& normal = this->Normals[patch];
  double unevenness = 0.0;
  Vector furthest = Vector::Zero();
  for (int corner = 0; corner < this->GetNumberOfCorners(patch); ++corner)
  {
    const Vector offset = this->GetCorner(patch, corner) - this->Centroids[patch];
    unevenness = std::max(unevenness, std::abs(offset.dot(normal)));
    furthest = offset.squaredNorm() > furthest.squaredNorm() ? offset : furthest;
  }
  const double width = this->Areas[patch] / (2.0 * this->Radii[patch]);
  const double most = LargestPart * width;
  const double lost = std::min(2.0 * normal.cwiseAbs().dot(this->CoordinateRounding), most);
  this->Roundings[patch] = lost + 2.0 * unevenness + HeightRounding;
  this->Slopes[patch] = std::min(this->Roundings[patch] / width, LargestPart);
  this->SlopesAlong[patch] = 0.5 * this->Slopes[patch] * width / this->Radii[patch];
  this->NarrowAxes[patch] = normal.cross(furthest).normalized();
  this->EdgeRoundings[patch] = std::min(this->CoordinateRounding.norm(), most);
}
} // namespace LightTransport
