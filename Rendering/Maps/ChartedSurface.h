// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A surface with the charts of its atlas (vtkSurfaceAtlas), as numbers that shaders take.
#ifndef ChartedSurface_h
#define ChartedSurface_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace LightTransport
{
struct ChartedSurface
{
  /// Position from Center, normal of the triangle, place in the atlas, surface on a unit of it (as
  /// a part of Area), chart, number of the point.
  static constexpr int FloatsPerCorner = 11;

  /// Fails, with the remedy, for what is no surface with an atlas.
  Outcome Read(vtkPolyData* surface);

  /// Another number where what Read looks at is modified or replaced.
  static std::uint64_t GetStamp(vtkPolyData* surface);

  /// Of all that was read: filters that run again make new objects of the same shape.
  std::uint64_t GetHash() const;

  std::vector<float> Corners; ///< of triangles, one after another
  /// Two RGBA texels of each point: its place in the atlas; lower left corner and size of the block
  /// of its chart, all of which is within [0, 1].
  std::vector<float> Points;
  std::array<double, 3> Center = {}; ///< of the bounding box
  double Area = 0.0;                 ///< of all triangles
  int SmallestMap = 1;               ///< texels a side at which each chart has one

private:
  struct Chart;
  struct Source;

  static Outcome FindArrays(Source& source);
  static Outcome FindBlocks(const Source& source, std::vector<Chart>& charts,
    std::vector<int>& chartOfPoint);
  Outcome AddCorners(const Source& source);
  void AddPoints(const Source& source, const std::vector<Chart>& charts,
    const std::vector<int>& chartOfPoint);
};
} // namespace LightTransport

#endif
