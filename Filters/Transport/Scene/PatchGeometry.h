// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The patches of a scene in flat arrays: corners, and what follows from them.
#ifndef PatchGeometry_h
#define PatchGeometry_h

#include "Scene/PatchPlane.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
class PatchGeometry
{
public:
  using Vector = Eigen::Vector3d;

  /// Corners that a patch may have (they are clipped in arrays of fixed size).
  static constexpr int MaximumCorners = 30;

  vtkIdType GetNumberOfPatches() const { return static_cast<vtkIdType>(this->Areas.size()); }
  const std::vector<Vector>& GetPoints() const { return this->Points; }
  int GetNumberOfCorners(vtkIdType patch) const
  {
    return static_cast<int>(this->Offsets[patch + 1] - this->Offsets[patch]);
  }
  /// The first corner of each patch among all corners, and after them their number.
  const std::vector<vtkIdType>& GetOffsets() const { return this->Offsets; }
  /// Indices into GetPoints(), counter-clockwise seen from the front.
  const vtkIdType* GetCorners(vtkIdType patch) const
  {
    return &this->Corners[this->Offsets[patch]];
  }
  /// Those of all patches, one patch after the other.
  const std::vector<vtkIdType>& GetCorners() const { return this->Corners; }
  const Vector& GetCorner(vtkIdType patch, int corner) const
  {
    return this->Points[this->Corners[this->Offsets[patch] + corner]];
  }

  const std::vector<double>& GetAreas() const { return this->Areas; }
  const Vector& GetNormal(vtkIdType patch) const { return this->Normals[patch]; }
  const Vector& GetCentroid(vtkIdType patch) const { return this->Centroids[patch]; }
  /// Radius around the centroid of a sphere that holds the patch.
  double GetRadius(vtkIdType patch) const { return this->Radii[patch]; }
  PatchPlane GetPlane(vtkIdType patch) const
  {
    return { this->Centroids[patch], this->Normals[patch], this->Roundings[patch],
      this->Slopes[patch], this->SlopesAlong[patch], this->NarrowAxes[patch] };
  }
  /// How far edges of a patch may be from where they should be.
  double GetEdgeRounding(vtkIdType patch) const { return this->EdgeRoundings[patch]; }

protected:
  /// How far a coordinate may be from the right one, along each axis: to be set before patches are
  /// computed.
  Vector CoordinateRounding = Vector::Zero();

  /// Make room for areas, normals, centroids and radii of the patches that Offsets has.
  void AllocatePatches();
  /// Find them for one patch, which has an area; in the plane of this normal, where it is not null.
  void ComputePatch(vtkIdType patch, const Vector* plane);

  std::vector<Vector> Points;
  std::vector<vtkIdType> Offsets;
  std::vector<vtkIdType> Corners;

private:
  void ComputeWorth(vtkIdType patch);

  std::vector<double> Areas;
  std::vector<Vector> Normals;
  std::vector<Vector> Centroids;
  std::vector<double> Radii;
  ///@{ What the coordinates are worth, see PatchPlane.
  std::vector<double> Roundings;
  std::vector<double> Slopes;
  std::vector<double> SlopesAlong;
  std::vector<Vector> NarrowAxes;
  std::vector<double> EdgeRoundings;
  ///@}
};
} // namespace LightTransport

#endif
