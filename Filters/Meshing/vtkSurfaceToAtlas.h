// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceToAtlas
 * @brief arrays of a surface to texels of its atlas, without gain or loss
 *
 * The input is a surface as vtkSurfaceAtlas makes it, with whatever arrays it has got since. Of it
 * are used
 * - the triangles, which must go around counter-clockwise in atlas coordinates;
 * - point array "AtlasCoordinates" (2 components, 0 to 1) or, where there is none, the active
 *   texture coordinates;
 * - cell array "ChartId" (1 component); without it the surface counts as one chart;
 * - field data array "AtlasResolution" (1 value), unless Resolution is set.
 *
 * The output is an image with one point at the center of each texel: texel (i, j) of R x R covers
 * [i/R, (i+1)/R] x [j/R, (j+1)/R] in atlas coordinates, row 0 is the bottom one. Its point arrays
 * are
 * - the texel maps "Position" (vtkDoubleArray, 3 components: the centroid of the surface in the
 *   texel), "Normal" (vtkDoubleArray, 3: the mean normal of its triangles, of length 1), "Area"
 *   (vtkDoubleArray, 1: the area of surface in the texel, in the square of the surface's unit) and
 *   "ChartId" (vtkIntArray, 1; -1 in texels without surface, all else is 0 there);
 * - every numeric cell array (vtkDoubleArray): its mean over the surface in the texel, weighted by
 *   area. The sum of value x "Area" over the texels is that of value x area over the cells;
 * - every numeric point array (vtkDoubleArray): the mean, in the same sense, of its linear
 *   interpolation in the triangles. Integrals are kept here, too.
 * Triangles are cut along the borders of the texels, so that means and areas are exact to rounding
 * however small the triangles. A constant stays exactly what it is; what is not finite stays within
 * the texels it touches. A map of fewer texels holds the means of the texels of a finer one,
 * weighted by "Area" (of "Normal": normalized again).
 *
 * Where a cell and a point array have one name, the cell array is taken: filters that make both
 * have the exact one there. Left out are the arrays named like a texel map, ids
 * ("OriginalPointIds", "OriginalCellIds", global and pedigree ids), ghost arrays, texture
 * coordinates, normals and tangents, and arrays that are not numbers.
 *
 * Errors, each with an empty output: no or other cells than triangles, missing coordinates or ones
 * that are not in [0,1], triangles that are turned over in the atlas, a Resolution that is not a
 * power of two from the smallest at which no texel belongs to two charts to 32768, and Resolution 0
 * for a surface without "AtlasResolution".
 *
 * @sa vtkAtlasToSurface, vtkSurfaceAtlas
 */
#ifndef vtkSurfaceToAtlas_h
#define vtkSurfaceToAtlas_h

#include "vtkImageAlgorithm.h"
#include "vtkLightTransportMeshingModule.h" // for export macro

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkSurfaceToAtlas : public vtkImageAlgorithm
{
public:
  static vtkSurfaceToAtlas* New();
  vtkTypeMacro(vtkSurfaceToAtlas, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Texels a side: a power of two. Default 0: "AtlasResolution" of the surface; the size of the
   * output is then only known when the surface is, so the filter updates its input as soon as it is
   * asked for information.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

protected:
  vtkSurfaceToAtlas();
  ~vtkSurfaceToAtlas() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  int Resolution = 0;

private:
  vtkSurfaceToAtlas(const vtkSurfaceToAtlas&) = delete;
  void operator=(const vtkSurfaceToAtlas&) = delete;
};

#endif
