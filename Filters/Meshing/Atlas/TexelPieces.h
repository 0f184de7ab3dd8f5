// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The pieces into which the texels of a square map cut the triangles of a surface that has atlas
 * coordinates: exact clipping, so that triangles smaller than a texel count, too. Texel maps, their
 * areas, and the transfer of arrays both ways are sums over these pieces.
 *
 * Atlas coordinates are the point array "AtlasCoordinates" or, where there is none, the active
 * texture coordinates. Charts are told apart by the cell array "ChartId"; without it the surface is
 * one chart.
 */
#ifndef TexelPieces_h
#define TexelPieces_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <array>
#include <functional>

class vtkDataArray;
class vtkPolyData;

namespace LightTransport
{
class TexelPieces
{
public:
  struct Piece
  {
    vtkIdType Texel; ///< column + resolution * row
    vtkIdType Cell;
    /// Area on the surface, in the square of its unit. Positive, if only by the smallest number,
    /// so that a texel that only triangles without area cover still has a mean.
    double Area;
    /// Barycentric coordinates, in the cell, of the centroid of the piece. None is negative.
    std::array<double, 3> Weights;
  };
  using Visitor = std::function<void(const Piece&)>;

  static constexpr int MaximumResolution = 32768;

  /**
   * Fails unless the surface is an atlas (only triangles, whose coordinates lie in [0,1]^2 and go
   * around counter-clockwise) and `resolution` is a power of two, not above the maximum, at which
   * no texel belongs to two charts.
   */
  static Outcome Check(vtkPolyData* surface, int resolution, const Monitor& monitor = {});

  /// The fewest texels a side, a power of two, at which the rectangles around all charts end
  /// between texels; more than the maximum if there is none. Surfaces whose charts fill blocks of a
  /// quadtree have at least one texel per chart from here on.
  static int GetSmallestResolution(vtkPolyData* surface);

  /**
   * Visit all pieces, cell after cell, of a surface that has passed the check. The areas of a
   * cell's pieces add up to its area, and the means of their weights, so weighted, to 1/3, both to
   * rounding. No piece lies in a texel that only touches the cell, whatever the rounding. Throws
   * Heartbeat::Stopped when the monitor says so.
   */
  static void Visit(vtkPolyData* surface, int resolution, const Visitor& visitor,
    const Monitor& monitor = {});
};
} // namespace LightTransport

#endif
