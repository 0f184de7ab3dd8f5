// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceAtlas
 * @brief unfolds a surface into a square texture whose mip-map levels are a hierarchy of the
 * surface
 *
 * The surface is quartered again and again into parts of about equal area, each connected where the
 * surface is; the square of the texels is quartered alike. A part that is a topological disc and
 * whose map onto its whole square block has low stretch becomes a *chart*. So
 *
 * - every texel of a chart, at every mip-map level down to the one at which the chart is a single
 *   texel, is the image of one connected piece of surface: no texel is empty and none belongs to
 * two charts, so means over texels (as graphics hardware makes mip-maps) are means over pieces of
 *   surface. A sampler must only clamp coordinates to the chart's block, half a texel of the
 *   sampled level inside (vtkOpenGLAtlasTexture does);
 * - texels are shared out by area, within a factor of 1.5 between charts where triangles are small
 *   enough, without any packing;
 * - the quadtree of the blocks is a tree of clusters of the surface, all the way up.
 *
 * The idea of an atlas whose mip-map is a surface hierarchy: Carr, Hall and Hart, "GPU Algorithms
 * for Radiosity and Subsurface Scattering" (2003). The maps: Floater, "One-to-one piecewise linear
 * mappings over triangulations" (2003), and Yoshizawa, Belyaev and Seidel, "A fast and simple
 * stretch-minimizing mesh parameterization" (2004).
 *
 * The input is a vtkPolyData of triangles, polygons and triangle strips, of any genus, open or
 * closed, with any number of components; its vertices and lines are ignored and ghost cells do not
 * count. Points with equal coordinates are one. It must be a manifold whose neighbours are oriented
 * alike and have area: vtkPatchMesher makes one of what is not. Edges that are long beside the
 * surface are halved, and so are the few that a map onto a square would flatten.
 *
 * Port 0, the surface as triangles, with
 * - point array "AtlasCoordinates" (double, 2 components, the active texture coordinates): within
 *   [0,1]^2; texel (i, j) of a map of R x R texels covers [i/R, (i+1)/R] x [j/R, (j+1)/R]. All
 *   triangles are counter-clockwise there and have area. Points on the seams between charts are
 * there once for each chart;
 * - point array "OriginalPointIds" (vtkIdType): the id of the input point; -1 for one on a halved
 * edge;
 * - cell arrays "ChartId" (int) and "OriginalCellIds" (vtkIdType);
 * - the input's point arrays (linear on halved edges), cell arrays and field data; field data
 *   "AtlasResolution" (int) and the metrics, of one value each:
 *   "NumberOfCharts" (int); "L2Stretch" and "LInfinityStretch" (double; Sander, Snyder, Gortler and
 *   Hoppe, "Texture Mapping Progressive Meshes", 2001: root mean square and largest growth of
 * lengths from texture to surface, divided by what an even isometry would have: 1 is ideal);
 *   "AreaDistortion" (double: mean over the surface of how many times too many or too few texels it
 *   has; 1 is ideal); "TexelUse" (double: share of texels that belong to charts);
 * "DeepestLeakFreeLevel" (int: the last mip-map level at which every chart has a texel of its own);
 * "AtlasSeconds" and "TexelMapSeconds" (double).
 *
 * Port 1, vtkTable "Charts", the quadtree: a row per node, parents before children:
 * "Chart" (int: the ChartId, -1 for a node that is divided), "Parent" (int: row, -1 for the root),
 * "Level" (int: the mip-map level at which the node is one texel), "X", "Y", "Size" (int: its block
 * in texels of level 0, from the lower left), "SurfaceArea" (double, square of the input's unit),
 * "Stretch" (double: the chart's own L2 stretch, NaN for a node that is divided).
 *
 * Port 2, vtkImageData of Resolution x Resolution points, one per texel, that lie where its atlas
 * coordinates are (none if TexelMaps is off): see vtkSurfaceToAtlas for "Position", "Normal",
 * "Area" and "ChartId".
 *
 * Same input, same output, whatever the number of threads.
 *
 * Errors, each with empty outputs: no polygons, coordinates that are not finite, a surface that is
 * no oriented manifold or has degenerate triangles (named and counted), areas whose squares no
 * double holds, more than 20 million triangles once long edges are halved (or 256 times those of
 * the input, but a million for any), a Resolution that is no power of two or too small for the
 * number of parts, texel maps that do not fit into memory, a MaximumStretch that is not above 1. A
 * run that is aborted has empty outputs, too, and no error.
 */
#ifndef vtkSurfaceAtlas_h
#define vtkSurfaceAtlas_h

#include "vtkLightTransportMeshingModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

namespace LightTransport
{
class Outcome;
}
class vtkImageData;
class vtkTable;

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkSurfaceAtlas : public vtkPolyDataAlgorithm
{
public:
  static vtkSurfaceAtlas* New();
  vtkTypeMacro(vtkSurfaceAtlas, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Names of the arrays that other filters look for.
  static const char* GetCoordinatesArrayName();
  static const char* GetChartArrayName();
  static const char* GetResolutionArrayName();

  ///@{
  /// Texels a side: a power of two up to 16384. Default 512.
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * A chart whose L2 stretch is larger is divided, unless it has only 8 x 8 texels or 16 triangles.
   * Lower values give more charts. Charts of more than 50,000 triangles are divided in any case, as
   * the time of a map grows faster than their number. Default 1.2; above 1.
   */
  vtkSetMacro(MaximumStretch, double);
  vtkGetMacro(MaximumStretch, double);
  ///@}

  ///@{
  /// Whether port 2 is filled. Default on.
  vtkSetMacro(TexelMaps, bool);
  vtkGetMacro(TexelMaps, bool);
  vtkBooleanMacro(TexelMaps, bool);
  ///@}

  ///@{
  /// The outputs on ports 1 and 2.
  vtkTable* GetCharts();
  vtkImageData* GetMaps();
  ///@}

protected:
  vtkSurfaceAtlas();
  ~vtkSurfaceAtlas() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkSurfaceAtlas(const vtkSurfaceAtlas&) = delete;
  void operator=(const vtkSurfaceAtlas&) = delete;

  struct Job;

  LightTransport::Outcome CheckProperties() const;
  LightTransport::Outcome Unfold(Job& job) const;
  LightTransport::Outcome Write(const Job& job) const;

  int Resolution = 512;
  double MaximumStretch = 1.2;
  bool TexelMaps = true;
};

#endif
