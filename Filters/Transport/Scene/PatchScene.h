// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The scene that all transport filters work on: the patches of a data object, of all its blocks and
 * of all ranks, in flat arrays.
 *
 * Points are merged where their coordinates are equal, then centred and scaled so that the bounding
 * box has diagonal 1: nothing downstream needs an absolute length, and a micrometre and a thousand
 * kilometres give the same numbers. Lengths in the input's unit are scene lengths times GetScale().
 *
 * All ranks hold the whole scene, in the same order: that of a tree (PatchTree), so that patches
 * that are near each other in space are near each other in every array and in the exchange matrix.
 * The tree is the spatial one, or for links between clusters that of the surfaces' atlases, one
 * after another: points of an atlas are the point array "AtlasCoordinates". Where users meet
 * numbers of patches (messages, arguments) they are those of the input's polygons: all blocks and
 * ranks in order, ghosts left out.
 */
#ifndef PatchScene_h
#define PatchScene_h

#include "Scene/PatchTree.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkMultiProcessController;
class vtkPolyData;

namespace LightTransport
{
class PatchScene
{
public:
  using Vector = Eigen::Vector3d;

  /// Corners that a patch may have (PolygonExchange clips them in arrays of fixed size).
  static constexpr int MaximumCorners = 30;

  enum class Order
  {
    Spatial,
    Atlas
  };

  /// Surfaces that a scene in the order of their atlases may have: blocks of composite input.
  static constexpr std::size_t MaximumSurfaces = std::size_t(1) << (64 - 2 * PatchTree::AtlasBits);

  /**
   * Gather the patches of `input`. Returns false, on every rank alike, with `error` naming the
   * problem and the remedy: nothing to work on, coordinates that are not finite, a patch without
   * area, a patch that is not a planar convex polygon; in the order of an atlas a surface without
   * "AtlasCoordinates", or more surfaces than MaximumSurfaces.
   */
  bool Build(vtkDataObject* input, vtkMultiProcessController* controller, std::string& error,
    Order order = Order::Spatial);

  /// Whether all surfaces have "AtlasCoordinates" that Build takes. Collective.
  static bool HasAtlas(vtkDataObject* input, vtkMultiProcessController* controller);

  vtkIdType GetNumberOfPatches() const { return static_cast<vtkIdType>(this->Areas.size()); }
  /// The patches of this rank, in the order of its polygons.
  const std::vector<vtkIdType>& GetLocalPatches() const { return this->LocalPatches; }
  /// The patch that the input's polygon `polygon` has become.
  vtkIdType GetPatch(vtkIdType polygon) const { return this->Patches[polygon]; }
  /// The input's polygon of a patch.
  vtkIdType GetPolygon(vtkIdType patch) const { return this->Polygons[patch]; }
  /// The tree that the order of the patches comes from.
  const PatchTree& GetTree() const { return this->Tree; }
  Order GetOrder() const { return this->OrderOfPatches; }

  ///@{ Scene geometry: centred and scaled.
  const std::vector<Vector>& GetPoints() const { return this->Points; }
  int GetNumberOfCorners(vtkIdType patch) const
  {
    return static_cast<int>(this->Offsets[patch + 1] - this->Offsets[patch]);
  }
  /// Indices into GetPoints(), counter-clockwise seen from the front.
  const vtkIdType* GetCorners(vtkIdType patch) const
  {
    return &this->Corners[this->Offsets[patch]];
  }
  const Vector& GetCorner(vtkIdType patch, int corner) const
  {
    return this->Points[this->Corners[this->Offsets[patch] + corner]];
  }
  /// Whether two patches have a corner in common.
  bool AreTouching(vtkIdType i, vtkIdType j) const;
  const std::vector<double>& GetAreas() const { return this->Areas; }
  const Vector& GetNormal(vtkIdType patch) const { return this->Normals[patch]; }
  const Vector& GetCentroid(vtkIdType patch) const { return this->Centroids[patch]; }
  /// Radius around the centroid of a sphere that holds the patch.
  double GetRadius(vtkIdType patch) const { return this->Radii[patch]; }
  ///@}

  /// Input coordinates = GetCenter() + GetScale() * scene coordinates.
  double GetScale() const { return this->Scale; }
  const Vector& GetCenter() const { return this->Center; }

  /// Depends on the geometry alone (all ranks): equal for equal scenes.
  std::uint64_t GetFingerprint() const { return this->Fingerprint; }

  /**
   * A cell array of the input as doubles, for all patches of all ranks: values[patch * components +
   * component]. `input` is the data object that the scene was built from; `required` decides
   * whether an array that is missing everywhere is an error or leaves `values` empty. Errors (all
   * ranks alike): the array is missing in some block, is not numeric, is a point array, has
   * different component counts, or holds a value that is not finite.
   */
  bool GatherCellArray(vtkDataObject* input, const std::string& name, bool required,
    std::vector<double>& values, int& components, std::string& error) const;

  /**
   * A value per block of this rank's input, spread over the patches: one value for all patches of
   * all ranks. Blocks are what a vtkCompositeDataIterator visits (empty ones are passed over); an
   * input that is not composite is one block. Collective.
   */
  std::vector<double> GatherBlockValues(const std::vector<double>& blockValues) const;

  /**
   * Group the corners of patches into smooth points: at each merged point, patches that meet there
   * with normals closer than `featureAngle` (degrees) and equal `materials` (materialComponents
   * values per patch, may be empty) form one group.
   */
  void BuildSmoothPoints(double featureAngle, const std::vector<double>& materials,
    int materialComponents);

  /**
   * Copy the input's structure and arrays into `output`, with points duplicated where
   * BuildSmoothPoints found several groups.
   */
  void CopyStructure(vtkDataObject* input, vtkDataObject* output);

  /**
   * Write values (as in GatherCellArray; all patches) as the cell and point array `name` of the
   * local part of `output`, which CopyStructure has filled. A point value is the area-weighted mean
   * over its group, over all ranks. Cells that are no patches (ghosts, lines) get 0.
   */
  void AddArray(vtkDataObject* output, const std::string& name, const std::vector<double>& values,
    int components) const;
  void AddCellArray(vtkDataObject* output, const std::string& name,
    const std::vector<double>& values, int components) const;

  /**
   * On several ranks: true when `ok` is true on all of them; the first error text (by rank)
   * replaces `error` on every rank.
   */
  static bool Agree(vtkMultiProcessController* controller, bool ok, std::string& error);

private:
  /// A patch of this rank: which block and cell it is.
  struct LocalCell
  {
    int Block;
    vtkIdType Cell;
  };

  /// Corner coordinates (3 per corner, input units) and corner counts, patch after patch.
  struct Raw
  {
    std::vector<double> Coordinates;
    std::vector<vtkIdType> Counts;
    ///@{ In the order of an atlas: the code of each patch, and the number of its surface.
    std::vector<std::uint64_t> Codes;
    std::vector<vtkIdType> Surfaces;
    ///@}
  };
  bool CollectLocal(vtkDataObject* input, Raw& raw, std::string& error);
  /// False when a polygon names points that do not exist.
  bool CollectBlock(vtkPolyData* data, int block, Raw& raw);
  bool CollectCodes(vtkDataObject* input, Raw& raw, std::string& error) const;
  /// Returns the number of polygons on the ranks before this one.
  vtkIdType GatherRanks(Raw& raw);
  void SortPatches(Raw& raw, vtkIdType firstLocal);
  static void AddSurfaces(const std::vector<Vector>& centers, Raw& raw);
  bool Normalize(const Raw& raw, std::string& error);
  void MergePoints(const Raw& raw);
  void ComputeFingerprint(const Raw& raw);
  bool ComputePatchGeometry(std::string& error);
  const char* ComputeOnePatch(vtkIdType patch);
  const char* CheckShape(vtkIdType patch) const;
  /// Tuples of this rank's polygons in, those of all patches out.
  std::vector<double> GatherTuples(const std::vector<double>& mine, int components) const;
  bool ReadLocalArray(vtkDataObject* input, const std::string& name, std::vector<double>& values,
    int& components, std::string& error) const;
  vtkDataArray* FindArray(vtkPolyData* data, const std::string& name, std::string& error) const;
  void CopyBlock(vtkPolyData* input, int block, vtkIdType firstLocal, vtkPolyData* output);
  static void AppendPoints(vtkPolyData* input, const std::vector<vtkIdType>& sources,
    vtkPolyData* output);
  void AddPointArray(vtkDataObject* output, const std::string& name,
    const std::vector<double>& values, int components) const;

  vtkMultiProcessController* Controller = nullptr;
  std::vector<Vector> Points;
  std::vector<vtkIdType> Offsets;
  std::vector<vtkIdType> Corners;
  std::vector<double> Areas;
  std::vector<Vector> Normals;
  std::vector<Vector> Centroids;
  std::vector<double> Radii;
  Vector Center = Vector::Zero();
  double Scale = 1.0;
  std::uint64_t Fingerprint = 0;

  Order OrderOfPatches = Order::Spatial;
  std::vector<vtkIdType> Polygons; ///< of each patch
  std::vector<vtkIdType> Patches;  ///< of each polygon
  PatchTree Tree;
  std::vector<LocalCell> LocalCells;
  std::vector<vtkIdType> LocalPatches; ///< as LocalCells

  /// Smooth group of each corner (as Corners), and the number of groups.
  std::vector<vtkIdType> CornerGroups;
  vtkIdType NumberOfGroups = 0;
  /// Smooth group of each output point of each block, -1 for points of no patch.
  std::vector<std::vector<vtkIdType>> BlockPointGroups;
};
} // namespace LightTransport

#endif
