// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The polygons of a data object, of all its blocks and of all ranks, as plain numbers: what a scene
 * is made of. Ghost cells do not count. Texels of an atlas are polygons, too (TexelGathering).
 */
#ifndef PolygonGathering_h
#define PolygonGathering_h

#include "Shared/Outcome.h"
#include "Support/Ranks.h"
#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkDataArray;
class vtkDataObject;

namespace LightTransport
{
/// A polygon of this rank: which leaf (see Leaves) and which cell (of an image: point) of it.
struct LocalCell
{
  int Block;
  vtkIdType Cell;
};

/// A texel of this rank that a rank before has, too, and the polygon that it is.
struct CopiedCell
{
  LocalCell Cell;
  vtkIdType Polygon;
};

struct GatheredPolygons
{
  std::vector<LocalCell> LocalCells;
  vtkIdType FirstLocal = 0; ///< number of polygons on the ranks before this one
  bool AreTexels = false;
  std::vector<CopiedCell> CopiedCells; ///< of this rank
  ///@{ Of all ranks, polygon after polygon: corners, and their coordinates in the input's unit.
  std::vector<vtkIdType> Counts;
  std::vector<double> Coordinates;
  ///@}
  /// Depends on all but the coordinates: which points polygons have, or which texels of their
  /// images there are.
  std::uint64_t Topology = 0;
  /// What the coordinates of all ranks are worth, relative to the largest of them.
  double Precision = 0.0;
  ///@{ For the order of an atlas: the place of each polygon (PatchTree::GetCode), and the number of
  /// its surface.
  std::vector<std::uint64_t> Codes;
  std::vector<vtkIdType> Surfaces;
  ///@}
};

namespace PolygonGathering
{
/// Gather the polygons, with their places in atlases or without. Fails, on all ranks alike, for
/// data that are not polygonal (or, with `takesTexels`, texel images), strips, points that do not
/// exist or are not finite, and surfaces without an atlas. Collective.
Outcome Gather(vtkDataObject* input, const Ranks& ranks, bool withAtlas, bool takesTexels,
  GatheredPolygons& polygons);

/// What coordinates in such an array are worth, relative to the largest of them.
double GetPrecision(vtkDataArray* coordinates);

/// Whether all surfaces have an atlas that Gather takes. Collective.
bool HasAtlas(vtkDataObject* input, const Ranks& ranks);
} // namespace PolygonGathering
} // namespace LightTransport

#endif
