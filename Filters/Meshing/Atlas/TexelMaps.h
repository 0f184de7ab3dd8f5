// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a surface is like in each texel of its atlas: means, over the piece of surface in the texel,
 * weighted by area and exact, since they are sums over TexelPieces.
 */
#ifndef TexelMaps_h
#define TexelMaps_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkPolyData;

namespace LightTransport
{
class TexelMaps
{
public:
  struct Source
  {
    vtkDataArray* Array;
    /// Whether it is interpolated linearly between points, or constant in each cell.
    bool OfPoints;
  };

  /**
   * Make an image of resolution^2 points, each the center of its texel ((0.5 + i) / resolution,
   * (0.5 + j) / resolution, 0), with the point arrays
   * - "Position" (vtkDoubleArray, 3 components): the centroid of the surface in the texel;
   * - "Normal" (vtkDoubleArray, 3): the mean normal of its triangles, of length 1;
   * - "Area" (vtkDoubleArray, 1): the area of surface, in the square of the surface's unit;
   * - "ChartId" (vtkIntArray, 1): that of its cells, 0 if they have none, -1 without surface;
   * - for each source, under its name, its mean (vtkDoubleArray, components as the source).
   * Texels without surface, in blocks that no chart has, hold 0.
   *
   * The surface must have passed TexelPieces::Check. Fails where there is no memory for the maps;
   * throws Heartbeat::Stopped when the monitor says so.
   */
  static Outcome Make(vtkPolyData* surface, int resolution, vtkImageData* maps,
    const Monitor& monitor, const std::vector<Source>& sources = {});

  /// Whether Make() itself makes an array of this name.
  static bool IsTexelMap(const std::string& name);
};
} // namespace LightTransport

#endif
