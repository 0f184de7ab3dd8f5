// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface before it is remeshed, as triangles that know their neighbours: tells the place on it
 * that a point of the remeshed surface comes from.
 *
 * Places are looked for from a known one near by and only through edges that are not kept. So the
 * opposite side of a thin wall is never found, however near it is.
 */
#ifndef SourceSurface_h
#define SourceSurface_h

#include "Common/TriangleSoup.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace LightTransport
{
class SourceSurface
{
public:
  using Point = TriangleSoup::Point;
  using Triangle = TriangleSoup::Triangle;
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  std::vector<Point> Points;
  std::vector<Triangle> Triangles;
  /// The triangle beyond the side from each corner to the next one; None beyond an edge to keep.
  std::vector<std::array<std::size_t, 3>> Neighbours;
  /// The part of the surface, bounded by the edges to keep, that each triangle belongs to.
  std::vector<std::size_t> Parts;
  /// The triangle of the soup that each triangle lies on.
  std::vector<std::size_t> Sources;

  /// Take down which triangles each point has, once the vectors above are filled.
  void Link();

  /// The triangles around a point.
  struct Range
  {
    const std::size_t* First;
    const std::size_t* Last;
    const std::size_t* begin() const { return this->First; }
    const std::size_t* end() const { return this->Last; }
  };
  Range GetTrianglesAround(std::size_t point) const;

  struct Place
  {
    std::size_t Triangle = None;
    /// Barycentric coordinates.
    Point Weights{ 1.0, 0.0, 0.0 };
    Point Position{ 0.0, 0.0, 0.0 };
  };
  /**
   * The place that is closest to `position` among the triangles that can be reached from `starts`
   * without leaving the ball around `position` in which the first one found lies.
   */
  Place Find(const std::vector<std::size_t>& starts, const Point& position) const;

  Point GetNormal(std::size_t triangle) const;
  double GetArea(std::size_t triangle) const;

  /// The place in a triangle that is closest to a position.
  static Place GetClosest(const Point& a, const Point& b, const Point& c, const Point& position);

private:
  std::vector<std::size_t> FirstTriangle;
  std::vector<std::size_t> TrianglesOfPoints;
  mutable std::vector<std::size_t> Visits;
  mutable std::vector<std::size_t> Queue;
  mutable std::size_t NumberOfSearches = 0;
};
} // namespace LightTransport

#endif
