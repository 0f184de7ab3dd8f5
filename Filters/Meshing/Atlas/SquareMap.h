// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A bijective map of a topological disc onto the whole unit square, with low stretch.
 *
 * It begins with a map by positive weights, which is one-to-one exactly when no edge inside the
 * disc joins two points of one side of the square (Floater, "One-to-one piecewise linear mappings
 * over triangulations", 2003); such edges are halved first. SquareLayout then lowers the
 * stretch. CGAL's parameterizers fix the border by arc length: on 124 parts of scans with the same
 * corners they had six times (mean value coordinates), and one and a half times (iterative
 * authalic), the stretch in the geometric mean, and iterative authalic failed on 20.
 */
#ifndef SquareMap_h
#define SquareMap_h

#include "Common/TriangleSoup.h"
#include "Common/Watch.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace LightTransport
{
class SquareMap
{
public:
  using Point = TriangleSoup::Point;
  using Triangle = TriangleSoup::Triangle;
  using Coordinates = std::array<double, 2>;

  /// Consistently oriented triangles of positive area whose union is a disc: connected, one border
  /// that visits no point twice, Euler characteristic 1. Every point is used.
  struct Disc
  {
    std::vector<Point> Points;
    std::vector<Triangle> Triangles;
    /// The triangle of the given disc that each triangle is a part of; Map() keeps it up to date.
    std::vector<std::size_t> Sources;
    /// The edges that Map() has halved, in order: point size() - number of edges + i of Points is
    /// the middle of edge i. An edge may end at a point that an earlier one made. The border is
    /// never touched.
    std::vector<std::array<std::size_t, 2>> HalvedEdges;
  };

  /**
   * Map the disc; the corners of the square are chosen among the points of the border. Returns
   * false, with the reason in words in `problem`, when the border has fewer than four points or
   * when rounding leaves a triangle without area or turned over (decided by exact predicates)
   * whatever weights are tried.
   */
  bool Map(Disc& disc, std::string& problem, const Watch& watch = {});

  /// One per point of the disc, in [0,1]^2; triangles keep their orientation.
  const std::vector<Coordinates>& GetCoordinates() const { return this->UV; }

  ///@{
  /// Stretch of Sander et al., "Texture Mapping Progressive Meshes" (2001): root mean square, and
  /// largest, over the disc, of how much the square's lengths grow on the surface; divided by what
  /// an isometry up to scale has, so that 1 is ideal.
  double GetL2Stretch() const { return this->L2Stretch; }
  double GetLInfinityStretch() const { return this->LInfinityStretch; }
  ///@}

private:
  std::vector<Coordinates> UV;
  double L2Stretch = 0.0;
  double LInfinityStretch = 0.0;
};
} // namespace LightTransport

#endif
