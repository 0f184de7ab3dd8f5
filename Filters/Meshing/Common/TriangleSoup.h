// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Triangles that know their corners and the input cell they come from, and nothing of their
 * neighbours: what a surface is until its defects have been found and repaired.
 */
#ifndef TriangleSoup_h
#define TriangleSoup_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkPolyData;

namespace LightTransport
{
class TriangleSoup
{
public:
  using Point = std::array<double, 3>;
  using Triangle = std::array<std::size_t, 3>;

  std::vector<Point> Points;
  /// The input point that each point comes from: the first one of those that were merged.
  std::vector<vtkIdType> PointIds;
  /// Whether a point was a corner of a duplicate or an end of an edge with more than two triangles.
  std::vector<bool> SplitPoints;
  std::vector<Triangle> Triangles;
  /// The input cell that each triangle comes from.
  std::vector<vtkIdType> CellIds;
  /// Polygons that were left out, for their border crosses itself.
  std::vector<vtkIdType> CrossingCells;
  /// How far coordinates may be off, by their type, size and digits.
  double Rounding = 0.0;

  /**
   * Triangulate the polygons and strips of `input`, without its ghost cells, and merge points with
   * equal coordinates if asked to. Fails when there are no polygons, where they name points that do
   * not exist, and when coordinates are not finite or of a size that products of them are not.
   */
  Outcome Read(vtkPolyData* input, bool mergePoints = true, const Monitor& monitor = Monitor());

  /// What keeps the soup from being an oriented manifold, in words; empty when nothing does.
  std::string DescribeDefects() const;

  /// For each point, the first one with the same coordinates.
  std::vector<std::size_t> FindPlaces() const;

  /// For each triangle, whether none before it has corners in the same places.
  std::vector<bool> FindFirstOfDuplicates(const std::vector<std::size_t>& places) const;

  /// Length of the diagonal of the bounding box of the triangles.
  double GetDiagonal() const;
  /// Twice the area times the unit normal.
  Point GetNormal(const Triangle& triangle) const;
  /// Whether a triangle has no area, by exact arithmetic.
  bool IsDegenerate(const Triangle& triangle) const;
  static bool HasRepeatedPoint(const Triangle& triangle);
};
} // namespace LightTransport

#endif
