// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPatchMesher
 * @brief turns a surface into patches: triangles of nearly equal size that keep edges and materials
 *
 * The input is a vtkPolyData of triangles, polygons and triangle strips; its vertices and lines are
 * ignored and ghost cells do not count. Points with equal coordinates are merged, polygons are
 * triangulated, defects are repaired (see Repair) and the surface is remeshed with CGAL's isotropic
 * remeshing (Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", 2004).
 *
 * Three kinds of edges are kept as they are, except that they are first split evenly to at most 4/3
 * of the target edge length: borders, edges between two regions (see below), and edges sharper than
 * FeatureAngle. They are never collapsed: where such edges are much shorter than the target length,
 * the patches beside them are small too. The parts of the surface between these edges are remeshed
 * one by one and every new point is put onto the part that it belongs to, so planar faces stay
 * planar and two sides of a thin wall are never mixed up.
 *
 * *Regions*: a cell array, chosen with SetInputArrayToProcess(0, 0, 0,
 * vtkDataObject::FIELD_ASSOCIATION_CELLS, name), "Region" by default. Edges between cells of
 * different values are kept, so no patch ever lies in two regions. Any type, any number of
 * components. The default array is optional: without it the surface is one region. An array of
 * another name that is missing is an error; an empty name stands for the default.
 *
 * The output holds triangles, points in double precision, and
 * - every array of the input's cells, each patch with the tuple of the input cell it lies on (the
 *   one nearest to the patch's centroid, within the part of the surface that the patch belongs to);
 * - cell array "OriginalCellIds" (vtkIdTypeArray, 1 component): the id of that input cell;
 * - every numeric array of the input's points, interpolated linearly, except normals, tangents,
 *   texture coordinates and ids, which have no meaning on the new points and are left out. Where
 *   points were merged, the values of the first one count;
 * - the input's field data, and one-tuple field data arrays "NumberOfPatches",
 *   "NumberOfDroppedTriangles" (degenerate or duplicate), "NumberOfReversedTriangles",
 *   "NumberOfSplitPoints" (copies made to undo non-manifold edges and points; vtkIdTypeArray each)
 *   and "TargetEdgeLength" (vtkDoubleArray, the length that was used).
 *
 * Lengths are in the input's unit. The same input gives the same output.
 *
 * Errors, each with an empty output: no polygons, coordinates that are not finite, a negative or
 * infinite TargetEdgeLength, a length that would give more than 20 million triangles, a missing
 * region array, nothing left but degenerate triangles, and, with Repair off, a surface that needs
 * repair. An empty piece of a data set that is distributed over several processes is no error.
 */
#ifndef vtkPatchMesher_h
#define vtkPatchMesher_h

#include "vtkLightTransportMeshingModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <vector> // for std::vector

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkPatchMesher : public vtkPolyDataAlgorithm
{
public:
  static vtkPatchMesher* New();
  vtkTypeMacro(vtkPatchMesher, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The edge length that the patches should have, in the input's unit. Default 0: the diagonal of
   * the bounding box divided by 50. Edges come out between about 2/3 and 4/3 of it,
   * on average a little shorter than it.
   */
  vtkSetMacro(TargetEdgeLength, double);
  vtkGetMacro(TargetEdgeLength, double);
  ///@}

  ///@{
  /**
   * Edges whose two triangles have normals that differ by more than this angle, in degrees, are
   * kept. Default 60, range 0 to 180 (180 keeps no edge for its angle).
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * How often edges are split, collapsed and flipped and points moved. More iterations give
   * triangles that are more alike. Default 3, range 1 to 1000.
   */
  vtkSetClampMacro(NumberOfIterations, int, 1, 1000);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Whether defects of the input are repaired. Default on. Degenerate triangles are dropped without
   * opening the surface; of triangles with the same three points the first is kept; non-manifold
   * edges and points are split; where neighbours are oriented against each other, each connected
   * component is turned to the orientation that the larger part of its area has. A surface without
   * such defects is taken as it is: in particular a room whose normals point inward stays so. When
   * off, a surface with a defect is an error.
   */
  vtkSetMacro(Repair, bool);
  vtkGetMacro(Repair, bool);
  vtkBooleanMacro(Repair, bool);
  ///@}

  ///@{
  /// Whether all patches are turned over, after the repair. Default off.
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

protected:
  vtkPatchMesher();
  ~vtkPatchMesher() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  double TargetEdgeLength = 0.0;
  double FeatureAngle = 60.0;
  int NumberOfIterations = 3;
  bool Repair = true;
  bool FlipNormals = false;

private:
  vtkPatchMesher(const vtkPatchMesher&) = delete;
  void operator=(const vtkPatchMesher&) = delete;

  /// One number per input cell, equal for cells of the same region.
  std::vector<int> ReadRegions(vtkInformationVector** inputs);
  void Mesh(vtkPolyData* input, const std::vector<int>& regionOfCell, vtkPolyData* output);
};

#endif
