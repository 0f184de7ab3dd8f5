// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The pieces into which the texels of a square map cut the triangles of a surface that has atlas
 * coordinates: exact clipping, so that triangles smaller than a texel count, too. Texel maps, their
 * areas, and the transfer of arrays both ways are sums over these pieces.
 */
#ifndef vtkTexelPieces_h
#define vtkTexelPieces_h

#include "vtkLightTransportMeshingModule.h" // for export macro
#include "vtkType.h"

#include <array>
#include <functional>

class vtkPolyData;

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkTexelPieces
{
public:
  struct Piece
  {
    vtkIdType Texel; ///< column + resolution * row
    vtkIdType Cell;
    /// Area on the surface, in the square of its unit.
    double Area;
    /// Barycentric coordinates, in the cell, of the centroid of the piece.
    std::array<double, 3> Weights;
  };
  using Visitor = std::function<void(const Piece&)>;

  /// Visit all pieces, cell after cell. `surface` has only triangles and the atlas coordinates as
  /// its texture coordinates.
  static void Visit(vtkPolyData* surface, int resolution, const Visitor& visitor);
};

#endif
