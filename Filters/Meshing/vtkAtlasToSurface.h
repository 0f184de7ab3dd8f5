// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkAtlasToSurface
 * @brief texels of an atlas to cell and point arrays of its surface, without gain or loss
 *
 * Input port 0 is the surface, as vtkSurfaceAtlas makes it: triangles that go around
 * counter-clockwise in atlas coordinates (point array "AtlasCoordinates", 2 components, 0 to 1, or,
 * where there is none, the active texture coordinates), and cell array "ChartId", without which the
 * surface counts as one chart. Input port 1 is an image with one point per texel, as
 * vtkSurfaceToAtlas makes it or a level of its mip pyramid: R x R, R a power of two down to one
 * texel per chart, row 0 at the bottom. Only its number of points counts, not its origin or
 * spacing.
 *
 * The output is the surface and, for each numeric point array of the image, one cell and one point
 * array of that name (vtkDoubleArray, components as in the image), which replace what the surface
 * had under the name. Left out are the texel maps that come with vtkSurfaceToAtlas ("Position",
 * "Normal", "Area", "ChartId") and ghost arrays. With the texels constant on the surface that they
 * cover, and all triangles cut along their borders,
 * - a cell's value is the mean over its area;
 * - a point's value is the mean over the triangles around it, weighted with the hat function of the
 *   point (1 there, linear, 0 at all other points), integrated exactly over the pieces.
 * So the integral over the surface of the cell array, of the linear interpolation of the point
 * array, and of the texels are the same to rounding, and a constant stays exactly what it is.
 * Points on seams are there once for each chart, and each copy has the mean over its own chart's
 * side. What is not finite stays with the triangles and points whose texels have it. Points that no
 * triangle uses get 0.
 *
 * Errors, each with an empty output: no or other cells than triangles, missing coordinates or ones
 * that are not in [0,1], triangles that are turned over in the atlas, an image that is empty, not
 * square, not a power of two up to 32768 wide, or so coarse that a texel would belong to two
 * charts.
 *
 * @sa vtkSurfaceToAtlas, vtkSurfaceAtlas
 */
#ifndef vtkAtlasToSurface_h
#define vtkAtlasToSurface_h

#include "vtkLightTransportMeshingModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkAtlasToSurface : public vtkPolyDataAlgorithm
{
public:
  static vtkAtlasToSurface* New();
  vtkTypeMacro(vtkAtlasToSurface, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkAtlasToSurface();
  ~vtkAtlasToSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkAtlasToSurface(const vtkAtlasToSurface&) = delete;
  void operator=(const vtkAtlasToSurface&) = delete;
};

#endif
