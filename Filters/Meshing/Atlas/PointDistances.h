// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Distances on a piece of a surface whose faces may be thin: from point to point through the faces,
 * by fast marching. Ways from centre to centre are far too long beside thin faces.
 *
 * A point on creases has a distance on each side of them, so that crossing one can cost something.
 */
#ifndef PointDistances_h
#define PointDistances_h

#include "Atlas/AtlasSurface.h"

#include <array>
#include <queue>
#include <utility>
#include <vector>

namespace LightTransport
{
class PointDistances
{
public:
  /**
   * `faces` are those of the piece; all else is numbered as they are: the `neighbors` of each, and
   * what it costs to cross each edge. All must outlive this object.
   */
  PointDistances(const AtlasSurface& surface, const std::vector<int>& faces,
    const std::vector<std::array<int, 3>>& neighbors,
    const std::vector<std::array<double, 3>>& costs, const Watch& watch);

  /// The centre of a face is so far away, unless it is nearer by other ways.
  void Reach(int face, double distance);
  /// The mean of its corners.
  double GetDistance(int face) const;

private:
  using Entry = std::pair<double, int>;
  /// A corner of a face, as 3 * face + corner.
  using Corner = int;
  struct Bridge
  {
    int From;
    int To;
    double Cost;
  };

  void FindSides(const std::vector<std::array<int, 3>>& neighbors,
    const std::vector<std::array<double, 3>>& costs);
  void Shorten(int side, double distance);
  void Leave(int side);
  void CrossFace(Corner from);

  const AtlasSurface& Surface;
  const std::vector<int>& Faces;
  const Watch& Watcher;
  /// The side of a point that each corner is on.
  std::vector<int> Sides;
  /// The corners of each side, from FirstCorner[side] to FirstCorner[side + 1].
  std::vector<int> FirstCorner;
  std::vector<Corner> CornersOfSides;
  std::vector<Bridge> Bridges;   ///< sorted by From
  std::vector<double> Distances; ///< of the sides
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> Queue;
};
} // namespace LightTransport

#endif
