// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How good an atlas is, whoever made it: see vtkSurfaceAtlas for what the numbers mean.
#ifndef AtlasMetrics_h
#define AtlasMetrics_h

#include "Shared/Monitor.h"

class vtkDataArray;
class vtkPolyData;

namespace LightTransport
{
struct AtlasMetrics
{
  double L2Stretch = 0.0;
  double LInfinityStretch = 0.0;
  double AreaDistortion = 0.0;
  /// Share of the unit square that triangles cover.
  double TexelUse = 0.0;

  /// `surface` has triangles only; texture coordinates lie in [0,1]^2, and no triangle is without
  /// area there. A chart may be turned over, as others than vtkSurfaceAtlas do it.
  /// Throws Heartbeat::Stopped when the monitor says so.
  AtlasMetrics(vtkPolyData* surface, vtkDataArray* textureCoordinates,
    const Monitor& monitor = {});
};
} // namespace LightTransport

#endif
