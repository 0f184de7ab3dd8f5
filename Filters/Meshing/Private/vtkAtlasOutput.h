// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Turns the charts of a quadtree into data objects: see vtkSurfaceAtlas for the arrays.
#ifndef vtkAtlasOutput_h
#define vtkAtlasOutput_h

#include "vtkAtlasQuadtree.h"

class vtkPolyData;
class vtkTable;

class vtkAtlasOutput
{
public:
  /// `soup` was read from `input`, and `surface` and `quadtree` were made of it.
  vtkAtlasOutput(vtkPolyData* input, const vtkTriangleSoup& soup, const vtkAtlasSurface& surface,
    const vtkAtlasQuadtree& quadtree);

  void WriteSurface(vtkPolyData* output) const;
  void WriteTable(vtkTable* table) const;

private:
  class SurfaceWriter;

  vtkPolyData* Input;
  const vtkTriangleSoup& Soup;
  const vtkAtlasSurface& Surface;
  const vtkAtlasQuadtree& Quadtree;
};

#endif
