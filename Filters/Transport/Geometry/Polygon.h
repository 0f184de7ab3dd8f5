// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A planar convex polygon with room for what clipping adds.
#ifndef Polygon_h
#define Polygon_h

#include "Scene/PatchGeometry.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <array>

namespace LightTransport
{
struct Polygon
{
  using Vector = Eigen::Vector3d;

  /// Corners that a patch may have; clipping with one plane adds one.
  static constexpr int MaximumCorners = PatchGeometry::MaximumCorners;

  std::array<Vector, MaximumCorners + 2> Corners;
  int Count = 0;
  Vector Normal;

  /// Make this a patch.
  void Set(const PatchGeometry& patches, vtkIdType patch);

  /// Cut away what lies behind a plane. Corners within its tolerance count as on it. Returns false
  /// when nothing with an area is left.
  bool Clip(const PatchPlane& plane);

  /// Two patches, each cut at the plane of the other. Returns false when one of them has nothing in
  /// front of it.
  static bool SetToClippedPair(const PatchGeometry& patches, vtkIdType i, vtkIdType j, Polygon& a,
    Polygon& b);

  /// Whether the distance from another polygon is less than `distance`.
  bool IsCloser(const Polygon& other, double distance) const;

  double GetArea() const;
  /// The mean of the corners.
  Vector GetMiddle() const;
};
} // namespace LightTransport

#endif
