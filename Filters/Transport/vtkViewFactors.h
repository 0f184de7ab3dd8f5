// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkViewFactors
 * @brief view factors (form factors) between all patches of a surface, with occlusion
 *
 * F_ij is the fraction of what leaves patch i diffusely that reaches patch j. Surfaces are
 * one-sided: the front is where the counter-clockwise normal points; back faces block and absorb,
 * unless TwoSided is on.
 * The exchange G_ij = A_i F_ij is computed once per pair, so A_i F_ij = A_j F_ji holds exactly.
 *
 * How a pair is computed: both patches are clipped to the half-space in front of the other; near
 * pairs use the contour integral (Sparrow 1963; the inner integral in closed form, the outer one by
 * adaptive Gauss quadrature), pairs further apart products of Gauss rules, each where its error
 * bound allows it. What may stand between two patches is found by shaft culling (Haines and Wallace
 * 1991): where nothing does, that is certain. Otherwise the visible part is integrated over one
 * patch, from each of whose points the shadows of the occluders on the other are drawn as
 * intervals of many lines (PairVisibility), until the row keeps its Tolerance.
 *
 * Input cell array (SetInputArrayToProcess 0 ["Group"], optional): integers that divide the patches
 * into groups. Without it the blocks of composite input are the groups.
 *
 * Output port 0: the input with the cell arrays
 *   - "ViewFactorSum" (1 component): sum_j F_ij as computed, before any closure. 1 in a closed
 * scene.
 *   - "ViewFactorError" (1): estimate of sum_j |error of F_ij|, or where that is larger of the
 * error of the next two, or of what is missing to 1 in the sum of all three.
 *   - "SkyFraction" (1): the part of what leaves the patch that leaves the scene.
 *   - "BackFaceFraction" (1): the part that meets back faces. Both are integrated on their own, by
 * eight sets of scrambled Sobol' rays (Embree) that tell their own error, and combined with
 * 1 - ViewFactorSum by the variances of both, until they keep the Tolerance too, or 100 / Tolerance
 * rays of a patch (32,768 at most) are used up. A row that misses no more than its error, and where
 * 128 rays find no opening, has none. Under a closure they are what is applied.
 *   - "SceneProblems" (1, int): flags, 0 where all is well: 1 more than half of what leaves it
 * meets back faces, or of the rays that meet it more than half its back; 2 sees most of a leak; 4
 * on a polygon of a lower number that faces the same way (left out where all of it is); 8 without
 * area or with a border that crosses itself (left out, all else is 0); 16 Tolerance not reached; 32
 * not plane (cut into triangles). and field data:
 *   - EnclosureVerdict (string): "Closed"; "Leaking" where up to 1 % of what leaves the surfaces
 * gets out; "Open"; "InsideOut" where more than 5 % meets back faces, or where no polygon sees any
 * other but their backs enclose a space. IsClosed (0 or 1). LeakArea (input unit squared): the area
 * of a hole in a closed scene through which as much would leave; that of the hole, where the scene
 * is convex.
 *   - PairsExamined = PairsBackFacing (also those in one plane) + PairsFacing; PairsNotSending were
 * not examined (vtkRadiosity only).
 *   - of the facing ones PairsUnobstructed (nothing is between them), PairsHidden and
 * PairsPartlyVisible (all others). PairsLookedAt of them are neither free nor hidden by a single
 * plane wall: what is seen past what is between is found from points. Where Tolerance allows it a
 * few rays judge blocks of pairs as hidden, or as free: those count as hidden, or nowhere.
 *   - RowGap: how much what the rays found and what row sums miss differ at most, beyond what their
 * errors explain. 0 where all agrees.
 *   - RaysCast, ViewFactorSeconds, MatrixBytes (tiles of 256 x 256 pairs that are all zero are not
 * stored), DenseMatrixBytes.
 *   - ClosureChange (largest sum of the absolute changes of a row of F), ClosureGap (largest
 * |1 - sum| left in a row, sky and back faces included).
 *
 * Output port 1: vtkTable, view factors between groups: columns "Group", "Area" (input unit
 * squared), one per receiving group, "Sky" and "BackFace".
 *
 * Errors: see vtkTransportAlgorithm; in addition the memory for the tiles that may be needed, at
 * most n (n + 1) / 2 values of 4 bytes, must be there; "Group" must have integers. Warnings tell of
 * back faces, leaks and a tolerance that was not reached: how much, where, and the remedy.
 */
#ifndef vtkViewFactors_h
#define vtkViewFactors_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkDoubleArray;
class vtkTable;

namespace LightTransport
{
class Outcome;
class ViewFactorStore;
struct ViewFactorSettings;
} // namespace LightTransport

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkViewFactors : public vtkTransportAlgorithm
{
public:
  static vtkViewFactors* New();
  vtkTypeMacro(vtkViewFactors, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// As vtkRadiosity knows them.
  enum LinkMethodType
  {
    LINK_METHOD_DENSE = 1,
    LINK_METHOD_HIERARCHICAL = 2,
    LINK_METHOD_SAMPLED = 3
  };

  ///@{
  /**
   * Bounds the sum over j of the absolute errors of F_ij of each row. Default 1e-3, range 1e-12 to
   * 0.1. Unoccluded pairs reach any of it, but for the storage in single precision (6e-8 of each
   * F_ij); what partly visible pairs have reached when their work is used up "ViewFactorError"
   * tells.
   */
  vtkSetClampMacro(Tolerance, double, 1e-12, 0.1);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Make each row sum to 1 with its sky and back faces and keep the matrix symmetric, moving each
   * entry in proportion to its error estimate (least squares: van Leersum 1989), never below 0 or
   * above its value with nothing in between; what is open in a row is one more entry, divided
   * between "SkyFraction" and "BackFaceFraction" as before. Default off; the field data arrays
   * ClosureChange and ClosureGap tell how far it went.
   */
  vtkSetMacro(EnforceClosure, bool);
  vtkGetMacro(EnforceClosure, bool);
  vtkBooleanMacro(EnforceClosure, bool);
  ///@}

  ///@{
  /**
   * What the view factors are: LINK_METHOD_DENSE (default) a matrix of all pairs of patches,
   * integrated to Tolerance; LINK_METHOD_HIERARCHICAL links between clusters (below);
   * LINK_METHOD_SAMPLED links between patches from scrambled Sobol' rays, those of both directions
   * together, as many of each patch as LinkTolerance asks for: (0.5 / LinkTolerance)^1.6, the next
   * power of two, 64 to 65,536. Of these three, rays take least time where 1 % or more of the
   * irradiance is enough; a row's memory is what it sees. Their rows are closed as those of
   * clusters are; where that cannot be, what is missing goes to the sky, and ClosureRest in the
   * field data is the largest such part. Field data are RaysPerPatch, RaysCast, NumberOfLinks,
   * ClosureChange, ClosureGap, MatrixBytes, DenseMatrixBytes and ViewFactorSeconds.
   * "ViewFactorError" is the deviation of what is open in a row. SetHierarchical(true) is the same
   * as LINK_METHOD_HIERARCHICAL, SetHierarchical(false) as LINK_METHOD_DENSE.
   */
  vtkSetClampMacro(LinkMethod, int, LINK_METHOD_DENSE, LINK_METHOD_SAMPLED);
  vtkGetMacro(LinkMethod, int);
  void SetLinkMethodToDense() { this->SetLinkMethod(LINK_METHOD_DENSE); }
  void SetLinkMethodToHierarchical() { this->SetLinkMethod(LINK_METHOD_HIERARCHICAL); }
  void SetLinkMethodToSampled() { this->SetLinkMethod(LINK_METHOD_SAMPLED); }
  ///@}

  ///@{
  /**
   * Links between clusters of patches (vtkExchangeHierarchy) instead of a matrix: their number
   * grows with that of the patches, not with its square, and Tolerance has no effect.
   * LinkTolerance (default 1e-2, range 1e-5 to 1) bounds the error of the irradiance that they
   * give: its root mean square over the surface, relative to the radiosity, for a radiosity that is
   * the same everywhere. It is an estimate from the samples that decide which links there are;
   * single patches may be off by much more.
   *
   * Rows are closed, whether EnforceClosure is on or not: the weights of the patches are scaled
   * until each row sums to 1 with its sky and back faces (Sinkhorn and Knopp 1967; the links stay
   * symmetric). Light that is reflected often would add up the errors of rows, and closing takes
   * away most of what links leave out: LinkTolerance then bounds the error of the radiosity by even
   * light and by the sky. Where little light falls on patches beside what they emit (a small lamp,
   * scattered sunlight) it is relative to what is emitted, too: see vtkRadiosity::SetLinkTolerance.
   * "ViewFactorSum" and the two fractions are what is applied; "ViewFactorError" is a root mean
   * square for all rows.
   *
   * What has been found of pairs of clusters is kept, unless it takes more than a tenth of the free
   * memory: another LinkTolerance for the same scene then looks only at pairs that have not been
   * looked at, and gives the links that it would give afresh.
   *
   * Field data are ClusterTreeUsed ("Spatial" or "Atlas"), PairsExamined, PairsBackFacing and
   * PairsUnobstructed (pairs of clusters), LinkRaysCast (for these links beside those of kept
   * pairs), NumberOfLinks, NumberOfPatchLinks (of which between two patches), LinkError (the
   * estimate), ClosureChange (largest change of a row sum), ClosureGap, RaysCast, RowGap,
   * MatrixBytes, DenseMatrixBytes and ViewFactorSeconds.
   */
  void SetHierarchical(bool isHierarchical)
  {
    this->SetLinkMethod(isHierarchical ? LINK_METHOD_HIERARCHICAL : LINK_METHOD_DENSE);
  }
  bool GetHierarchical() const { return this->LinkMethod == LINK_METHOD_HIERARCHICAL; }
  vtkBooleanMacro(Hierarchical, bool);
  vtkSetClampMacro(LinkTolerance, double, 1e-5, 1.0);
  vtkGetMacro(LinkTolerance, double);
  ///@}

  ///@{
  /**
   * What tree the clusters of hierarchical links are nodes of. CLUSTER_TREE_SPATIAL divides patches
   * by where they face, then by place. CLUSTER_TREE_ATLAS is the quadtree of an atlas
   * (vtkSurfaceAtlas: point array "AtlasCoordinates", 2 components, in [0,1]^2; the blocks of
   * composite input have one each), whose nodes are the rows of its table "Charts" and go on below
   * the charts; an error tells of a surface without it. CLUSTER_TREE_AUTO (default): Atlas where
   * all surfaces have one, else Spatial. No effect on a matrix.
   *
   * Measured, thousands of links and error of the radiosity (lamp at the top, reflectance 0.5):
   *
   * | LinkTolerance          |  0.1 Spatial | 0.1 Atlas | 0.03 Spatial | 0.03 Atlas |
   * |------------------------|-------------:|----------:|-------------:|-----------:|
   * | inside the bunny, 1000 |     65, 4.1% |   4, 4.7% |    100, 2.5% |   37, 1.8% |
   * | furnished room, 1564   |      refused |   4, 9.5% |     47, 2.7% |   32, 2.7% |
   * | empty room, 1584       |      4, 7.0% |   3, 7.3% |     27, 1.9% |   21, 2.2% |
   *
   * | LinkTolerance          | 0.01 Spatial | 0.01 Atlas |
   * |------------------------|-------------:|-----------:|
   * | inside the bunny, 1000 |    165, 0.7% |   84, 0.7% |
   * | furnished room, 1564   |    138, 1.0% |  111, 0.9% |
   * | empty room, 1584       |     99, 0.9% |   99, 0.8% |
   */
  vtkSetClampMacro(ClusterTree, int, CLUSTER_TREE_AUTO, CLUSTER_TREE_ATLAS);
  vtkGetMacro(ClusterTree, int);
  void SetClusterTreeToAuto() { this->SetClusterTree(CLUSTER_TREE_AUTO); }
  void SetClusterTreeToSpatial() { this->SetClusterTree(CLUSTER_TREE_SPATIAL); }
  void SetClusterTreeToAtlas() { this->SetClusterTree(CLUSTER_TREE_ATLAS); }
  ///@}

  ///@{
  /**
   * Whether each polygon is two faces that exchange: thin sheets are one polygon in most models.
   * Backs count as n + i in GetViewFactor, with n the number of polygons; each output array has a
   * second one for the backs, with the suffix "Back"; groups hold both sides, unless there is an
   * array "GroupBack". Default off: backs block and absorb.
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  ///@{
  /**
   * Save the view factors that the last update computed, with the fingerprint of the geometry. Load
   * takes them from a file: updates then compute nothing, whatever the properties are, and fail for
   * any other geometry, until Load(nullptr) or another file. The file keeps a matrix with its sums,
   * errors and fractions, or what the rays of sampled links have met, of which links, fractions and
   * errors are made again: all results, those of vtkRadiosity and its errors too, are the same
   * bits. A matrix takes one process. Sampled links may be saved and loaded by several, which all
   * call this; the number of them may differ. Hierarchical links cannot be saved. Both return false
   * after an error, which they report: nothing computed yet, a file that cannot be written or read,
   * is damaged or is no file of view factors.
   */
  bool Save(const char* fileName);
  bool Load(const char* fileName);
  ///@}

  /// The table of port 1.
  vtkTable* GetGroupTable();

  /// F_ij after Update, patches counted as the input's polygons (all blocks, all ranks, ghosts left
  /// out), and with TwoSided their backs after them. 0 where out of range; on several ranks what
  /// other ranks hold is left out.
  double GetViewFactor(vtkIdType i, vtkIdType j);

  /**
   * Likewise whole rows, beginning with that of patch i: as many as `rows` has tuples, of one
   * component for each patch. They are written where the array's memory is, which may be a
   * program's own (SetArray). False where the array has another number of components or more
   * tuples than there are rows; it then stays as it was.
   */
  bool GetViewFactors(vtkIdType i, vtkDoubleArray* rows);

  /// The area of each patch in the input's unit squared, counted as in GetViewFactor. 0 where
  /// nothing is exchanged. False where the array has not one value for each patch.
  bool GetPatchAreas(vtkDoubleArray* areas);

protected:
  vtkViewFactors();
  ~vtkViewFactors() override;

  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkViewFactors(const vtkViewFactors&) = delete;
  void operator=(const vtkViewFactors&) = delete;

  friend class vtkRadiosity; // which may share the view factors
  class Run;

  /// Whether updates give links between clusters: they are asked for, and nothing was loaded.
  bool LinksClusters() const;
  LightTransport::ViewFactorSettings GetSettings() const;
  bool Report(const LightTransport::Outcome& outcome);

  std::unique_ptr<LightTransport::ViewFactorStore> Store;

  double Tolerance = 1e-3;
  bool EnforceClosure = false;
  int LinkMethod = LINK_METHOD_DENSE;
  bool TwoSided = false;
  double LinkTolerance = 1e-2;
  int ClusterTree = CLUSTER_TREE_AUTO;
};

#endif
