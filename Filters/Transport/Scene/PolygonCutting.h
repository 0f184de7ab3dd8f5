// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Polygons of any shape as convex plane pieces, which is what patches are. A polygon that is plane
 * and convex and has no more corners than a patch may have is one piece, as it is. Others are cut
 * into triangles by ear clipping in their plane (Meisters 1975), which takes concave polygons and
 * holes that are bridged to the border by a seam; triangles of a plane polygon are joined again to
 * convex pieces (Hertel and Mehlhorn 1983), those of a warped one stay, each in a plane of its own.
 * Convex pieces with too many corners are divided.
 */
#ifndef PolygonCutting_h
#define PolygonCutting_h

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
namespace PolygonCutting
{
using Vector = Eigen::Vector3d;

enum class Shape
{
  Whole,       ///< one piece, as it is
  Cut,         ///< in pieces that are all in one plane
  Warped,      ///< in triangles, since it is not plane
  WithoutArea, ///< no pieces: fewer than 3 corners, or no more area than rounding noise
  Crossing     ///< no pieces: its border crosses itself, so that nobody knows what is inside
};

struct Pieces
{
  Shape Is = Shape::WithoutArea;
  /// Of each piece, indices of the polygon's corners, in the polygon's direction.
  std::vector<std::vector<int>> Corners;
  Vector Normal = Vector::Zero(); ///< of the whole polygon
};

/// Cut a polygon. `mostCorners` of a piece, at least 3; `rounding` is how far coordinates may be
/// off: what is flat by that much has no area.
Pieces Cut(const std::vector<Vector>& corners, int mostCorners, double rounding);
} // namespace PolygonCutting
} // namespace LightTransport

#endif
