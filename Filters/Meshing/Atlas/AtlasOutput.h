// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Turns the charts of a quadtree into data objects: see vtkSurfaceAtlas for the arrays.
#ifndef AtlasOutput_h
#define AtlasOutput_h

#include "Atlas/AtlasQuadtree.h"
#include "Shared/Monitor.h"

class vtkPolyData;
class vtkTable;

namespace LightTransport
{
class AtlasOutput
{
public:
  /// `soup` was read from `input`, and `surface` and `quadtree` were made of it.
  AtlasOutput(vtkPolyData* input, const TriangleSoup& soup, const AtlasSurface& surface,
    const AtlasQuadtree& quadtree);

  /// Throws Heartbeat::Stopped when the monitor says so.
  void WriteSurface(vtkPolyData* output, const Monitor& monitor) const;
  void WriteTable(vtkTable* table) const;

private:
  class SurfaceWriter;

  vtkPolyData* Input;
  const TriangleSoup& Soup;
  const AtlasSurface& Surface;
  const AtlasQuadtree& Quadtree;
};
} // namespace LightTransport

#endif
