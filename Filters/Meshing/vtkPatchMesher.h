// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPatchMesher
 * @brief turns a surface into patches: good triangles of chosen size that keep edges and materials
 *
 * The input is a vtkPolyData, or a composite data set of them, of triangles, polygons and triangle
 * strips; its vertices and lines are ignored and ghost cells do not count. Points with equal
 * coordinates are merged, polygons are triangulated, defects are repaired (see Repair) and the
 * surface is remeshed: long edges are split, short ones collapsed, edges flipped and points moved
 * along the surface (Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", 2004),
 * with a length that may differ from place to place (Dunyach et al., "Adaptive remeshing for
 * real-time mesh deformation", 2013).
 *
 * Three kinds of edges are kept: borders, edges between two regions (see below), and edges sharper
 * than FeatureAngle. They are first split evenly to at most 4/3 of the edge length, and joined only
 * where they lie on one line. Where such edges are much shorter than that, the patches beside them
 * are small too, and grow away from them (see Grading). The parts of the surface between these
 * edges are remeshed one by one and every new point is put onto the part that it belongs to, so
 * planar faces stay planar and two sides of a thin wall are never mixed up. Where
 * the surface is smooth at the scale of the edge length there, patches and input are less than half
 * of it apart (measured, not proven); details finer than it are lost, and scans with such details
 * were up to 1.2 lengths apart.
 *
 * *Regions*: a cell array, chosen with SetInputArrayToProcess(0, 0, 0,
 * vtkDataObject::FIELD_ASSOCIATION_CELLS, name), "Region" by default. Edges between cells of
 * different values are kept, so no patch ever lies in two regions. Any type, any number of
 * components. The default array is optional: without it the surface is one region. An array of
 * another name that is missing is an error; an empty name stands for the default.
 *
 * *Edge lengths*, if SizeField is Array: a point array of one component, in the input's unit,
 * chosen with SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name),
 * "EdgeLength" by default: the length that edges should have at each point, interpolated linearly.
 *
 * The output holds triangles, points in double precision, and
 * - every array of the input's cells, each patch with the tuple of the input cell it lies on (the
 *   one nearest to the patch's centroid, within the part of the surface that the patch belongs to);
 * - cell array "OriginalCellIds" (vtkIdTypeArray, 1 component): the id of that input cell;
 * - every numeric array of the input's points, interpolated linearly, except normals, tangents,
 *   texture coordinates and ids, which have no meaning on the new points and are left out. Where
 *   points were merged, the values of the first one count;
 * - the input's field data, and one-tuple field data arrays "NumberOfPatches",
 *   "NumberOfDroppedTriangles" (degenerate, duplicate or crumbs), "NumberOfReversedTriangles",
 *   "NumberOfSplitPoints" (points beyond the first in places where surfaces only touch),
 *   "NumberOfWeldedPoints" (points that differed by no more than WeldTolerance from one that they
 *   became), "NumberOfSplitEdges" (edges cut where a corner of another triangle lies on them),
 *   "NumberOfSeamEdges" (along which a surface with one side only, as a Moebius band is, was cut),
 *   "NumberOfSkippedPolygons" (whose border crosses itself), "NumberOfFilledHoles",
 *   "NumberOfInputSelfIntersections" (pairs of triangles of one connected component that intersect,
 *   before they are resolved), "NumberOfSelfIntersections" (pairs of patches of one component that
 *   do), "NumberOfIntersectionsBetweenComponents" (pairs of patches of two components, which are no
 *   defect; vtkIdTypeArray each) and "TargetEdgeLength" (vtkDoubleArray, the length that was used;
 *   if SizeField is Array, the one with which as many equal triangles cover the surface).
 *
 * The input may be composite: its blocks are one scene. Default lengths are those of all blocks
 * together, and so is TargetNumberOfPatches; each block is repaired by itself. The output has the
 * structure of the input (GetOutputDataObject(0)); each block has the arrays above for itself, and
 * the field data of the whole have them for all blocks. Blocks without polygons come out empty.
 *
 * Patches are compared with the surface. Where some cross though the surface does not, as both
 * sides of a thin wall may, it is remeshed once more with half the lengths there, and at last with
 * patches that lie in the triangles of the surface. A warning tells which components lost more than
 * 5 % of their area or volume to long edges.
 *
 * Lengths are in the input's unit. The same input gives the same output. All that the repair
 * changed is summed up in one warning.
 *
 * Errors, each with an empty output: no polygons, coordinates that are not finite, a negative or
 * infinite length, a MinimumEdgeLength above TargetEdgeLength, a Grading that is not positive, a
 * length that would give more than 20 million triangles, a missing region array, a missing array of
 * edge lengths or one with other than positive, finite values, nothing left but degenerate
 * triangles, arrays of another length than there are cells or points, blocks of another type,
 * self-intersections (see SelfIntersections), patches that still cross, and, with Repair off, a
 * surface that needs repair. An empty piece of a data set that is distributed over several
 * processes is no error.
 */
#ifndef vtkPatchMesher_h
#define vtkPatchMesher_h

#include "vtkLightTransportMeshingModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <vector> // for std::vector

namespace LightTransport
{
class Monitor;
class Outcome;
struct PatchTarget;
} // namespace LightTransport

class VTKLIGHTTRANSPORTMESHING_EXPORT vtkPatchMesher : public vtkPolyDataAlgorithm
{
public:
  static vtkPatchMesher* New();
  vtkTypeMacro(vtkPatchMesher, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Makes an output of the input's type.
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  ///@{
  /**
   * The edge length that the patches should have, or the largest one if SizeField is Curvature, in
   * the input's unit. Default 0: the diagonal of the bounding box divided by 50, and less on small
   * components that would lose more than 5 % of their area or volume (down to a thousand patches or
   * so for each). Most edges come out between 4/5 and 4/3 of it. Without meaning if SizeField is
   * Array.
   */
  vtkSetMacro(TargetEdgeLength, double);
  vtkGetMacro(TargetEdgeLength, double);
  ///@}

  enum
  {
    SIZE_FIELD_UNIFORM = 0,
    SIZE_FIELD_CURVATURE = 1,
    SIZE_FIELD_ARRAY = 2
  };

  ///@{
  /**
   * Where the edge length comes from.
   * - Uniform (default): TargetEdgeLength everywhere.
   * - Curvature: sqrt(6 e / k - 3 e^2), e the ApproximationError and k the largest absolute normal
   *   curvature of the input, between MinimumEdgeLength and TargetEdgeLength. Inside planar regions
   *   larger than a few patches it is TargetEdgeLength.
   * - Array: a point array, see above.
   */
  vtkSetClampMacro(SizeField, int, SIZE_FIELD_UNIFORM, SIZE_FIELD_ARRAY);
  vtkGetMacro(SizeField, int);
  void SetSizeFieldToUniform() { this->SetSizeField(SIZE_FIELD_UNIFORM); }
  void SetSizeFieldToCurvature() { this->SetSizeField(SIZE_FIELD_CURVATURE); }
  void SetSizeFieldToArray() { this->SetSizeField(SIZE_FIELD_ARRAY); }
  ///@}

  ///@{
  /**
   * How far patches may lie from the surface that the input stands for, in the input's unit, if
   * SizeField is Curvature. Default 0: a hundredth of the TargetEdgeLength.
   */
  vtkSetMacro(ApproximationError, double);
  vtkGetMacro(ApproximationError, double);
  ///@}

  ///@{
  /**
   * The smallest edge length, in the input's unit, that curvature leads to. Default 0: a tenth of
   * the TargetEdgeLength.
   */
  vtkSetMacro(MinimumEdgeLength, double);
  vtkGetMacro(MinimumEdgeLength, double);
  ///@}

  ///@{
  /**
   * By how much the edge length may grow per unit of distance over the surface, whatever makes it
   * short: the size field or edges to keep that are short. Lengths that grow faster are
   * shortened. Default 0.3, more than 0.
   */
  vtkSetMacro(Grading, double);
  vtkGetMacro(Grading, double);
  ///@}

  ///@{
  /**
   * Whether planar regions (connected triangles in one plane, without edges to keep between them,
   * larger than a few patches) may have patches as large as Grading and the region's width allow;
   * along them, straight edges to keep are not split. Their borders are kept then. Default off.
   */
  vtkSetMacro(CoarsePlanarRegions, bool);
  vtkGetMacro(CoarsePlanarRegions, bool);
  vtkBooleanMacro(CoarsePlanarRegions, bool);
  ///@}

  ///@{
  /**
   * How many patches should come out: all edge lengths of the size field are multiplied by the same
   * factor, then the longest edges are split or the shortest collapsed, so that the number is met
   * within 5 %, or as nearly as the edges to keep allow (a warning then). "TargetEdgeLength" in the
   * field data says what was used. Takes two or three times as long. Default 0, at most 20 million;
   * 0: the lengths are taken as they are.
   */
  vtkSetClampMacro(TargetNumberOfPatches, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetNumberOfPatches, vtkIdType);
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
   * edges and points are split, and crumbs that this leaves are dropped: open pieces that fit into
   * a sphere of radius HoleSize and had such an edge or a copy, but never the largest piece; where
   * neighbours are oriented against each other, each connected component is turned to the
   * orientation that the larger part of its area has; holes and self-intersections are treated as
   * FillHoles and SelfIntersections say. A surface without such defects is taken as it is: in
   * particular a room whose normals point inward stays so. When off, a surface with a defect is an
   * error, borders excepted.
   */
  vtkSetMacro(Repair, bool);
  vtkGetMacro(Repair, bool);
  vtkBooleanMacro(Repair, bool);
  ///@}

  ///@{
  /**
   * Whether small holes are filled when Repair is on: those whose border fits into a sphere of
   * radius HoleSize, and into one half as large as the sphere around the connected component (so
   * the outline of a small plate is no hole). Patches there have the data of cells at the border.
   * Default on.
   */
  vtkSetMacro(FillHoles, bool);
  vtkGetMacro(FillHoles, bool);
  vtkBooleanMacro(FillHoles, bool);
  ///@}

  ///@{
  /**
   * The radius of the largest holes that are filled, in the input's unit; also that of the largest
   * crumbs that are dropped, and how far the surface may move where a self-intersection is
   * resolved. Default 0: the diagonal of the bounding box divided by 100.
   */
  vtkSetMacro(HoleSize, double);
  vtkGetMacro(HoleSize, double);
  ///@}

  ///@{
  /**
   * How far apart points may be, in the input's unit, that the repair takes for one; also how far a
   * corner may be from an edge that it lies on. Only points at borders are welded, where that joins
   * two edges, and never points more than a quarter of the edges there apart. Default 0: what the
   * coordinates are worth by their type, size and number of digits, and more where points are just
   * beyond it, as noise of arithmetic puts them.
   */
  vtkSetMacro(WeldTolerance, double);
  vtkGetMacro(WeldTolerance, double);
  ///@}

  enum
  {
    SELF_INTERSECTIONS_RESOLVE = 0,
    SELF_INTERSECTIONS_REFUSE = 1,
    SELF_INTERSECTIONS_KEEP = 2
  };

  ///@{
  /**
   * What happens where triangles of one connected component intersect. Components that stick in
   * each other, as furniture in a floor does, are no defect and stay as they are.
   * - Resolve (default): the triangles are moved, or taken away and the gap closed, within one
   *   component and locally. It is an error if some are left, if the component would be connected
   *   in another way, or if its surface would move by more than HoleSize. Needs Repair on;
   * otherwise as Refuse.
   * - Refuse: an error that says how many pairs of triangles intersect and where the first ones do.
   * - Keep: they stay as they are. Patches that cross elsewhere are warned of.
   */
  vtkSetClampMacro(SelfIntersections, int, SELF_INTERSECTIONS_RESOLVE, SELF_INTERSECTIONS_KEEP);
  vtkGetMacro(SelfIntersections, int);
  void SetSelfIntersectionsToResolve() { this->SetSelfIntersections(SELF_INTERSECTIONS_RESOLVE); }
  void SetSelfIntersectionsToRefuse() { this->SetSelfIntersections(SELF_INTERSECTIONS_REFUSE); }
  void SetSelfIntersectionsToKeep() { this->SetSelfIntersections(SELF_INTERSECTIONS_KEEP); }
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

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  double TargetEdgeLength = 0.0;
  int SizeField = SIZE_FIELD_UNIFORM;
  double ApproximationError = 0.0;
  double MinimumEdgeLength = 0.0;
  double Grading = 0.3;
  bool CoarsePlanarRegions = false;
  vtkIdType TargetNumberOfPatches = 0;
  double FeatureAngle = 60.0;
  int NumberOfIterations = 3;
  bool Repair = true;
  bool FillHoles = true;
  double HoleSize = 0.0;
  double WeldTolerance = 0.0;
  int SelfIntersections = SELF_INTERSECTIONS_RESOLVE;
  bool FlipNormals = false;

private:
  vtkPatchMesher(const vtkPatchMesher&) = delete;
  void operator=(const vtkPatchMesher&) = delete;

  struct Block;
  struct Job;

  LightTransport::Outcome CheckProperties() const;
  LightTransport::Outcome FindBlocks(vtkDataObject* input, Job& job);
  LightTransport::Outcome ReadBlocks(Job& job);
  LightTransport::Outcome ReadBlock(Block& block, const LightTransport::Monitor& monitor);
  /// One number per input cell, equal for cells of the same region.
  LightTransport::Outcome ReadRegions(vtkPolyData* input, std::vector<int>& regions);
  /// One length per input point if the size field is an array, else none.
  LightTransport::Outcome ReadLengths(vtkPolyData* input, std::vector<double>& lengths);
  LightTransport::Outcome MakePatches(Job& job) const;
  LightTransport::Outcome RepairBlocks(Job& job, const LightTransport::Monitor& monitor) const;
  LightTransport::Outcome Remesh(Job& job, const LightTransport::Monitor& monitor) const;
  LightTransport::Outcome ChooseTarget(const Job& job, LightTransport::PatchTarget& target) const;
  LightTransport::Outcome Write(Job& job);
  void CheckNumberOfPatches(vtkIdType number);
};

#endif
