// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The scene that all transport filters work on: the patches of a data object, of all its blocks and
 * of all ranks, in flat arrays. Constant once it has been built.
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

#include "Scene/PatchGeometry.h"
#include "Scene/PatchTree.h"
#include "Scene/PolygonGathering.h"
#include "Shared/Outcome.h"
#include "Support/Ranks.h"
#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkDataObject;

namespace LightTransport
{
class PatchScene : public PatchGeometry
{
public:
  enum class Order
  {
    Spatial,
    Atlas
  };

  /// Surfaces that a scene in the order of their atlases may have: blocks of composite input.
  static constexpr std::size_t MaximumSurfaces = std::size_t(1) << (64 - 2 * PatchTree::AtlasBits);

  /**
   * Gather the patches of `input`. Fails, on every rank alike, with nothing to work on, coordinates
   * that are not finite, a patch without area, a patch that is not a planar convex polygon; in the
   * order of an atlas for a surface without "AtlasCoordinates", or more surfaces than
   * MaximumSurfaces.
   */
  Outcome Build(vtkDataObject* input, const Ranks& ranks, Order order = Order::Spatial);

  ///@{ The polygons of this rank in their order: which cells, and which patches they have become.
  const std::vector<LocalCell>& GetLocalCells() const { return this->LocalCells; }
  const std::vector<vtkIdType>& GetLocalPatches() const { return this->LocalPatches; }
  ///@}
  /// The patch that the input's polygon `polygon` has become.
  vtkIdType GetPatch(vtkIdType polygon) const { return this->Patches[polygon]; }
  /// The patches of all polygons.
  const std::vector<vtkIdType>& GetPatches() const { return this->Patches; }
  /// The input's polygon of a patch.
  vtkIdType GetPolygon(vtkIdType patch) const { return this->Polygons[patch]; }
  /// The tree that the order of the patches comes from.
  const PatchTree& GetTree() const { return this->Tree; }
  Order GetOrder() const { return this->OrderOfPatches; }

  /// Input coordinates = GetCenter() + GetScale() * scene coordinates.
  double GetScale() const { return this->Scale; }
  const Vector& GetCenter() const { return this->Center; }

  /// Depends on the geometry alone (all ranks): equal for equal scenes.
  std::uint64_t GetFingerprint() const { return this->Fingerprint; }

private:
  Outcome Normalize(const GatheredPolygons& polygons);
  void SortPatches(GatheredPolygons& polygons);
  void MergePoints(const GatheredPolygons& polygons);
  void ComputeFingerprint(const GatheredPolygons& polygons);
  Outcome ComputePatches();

  Vector Center = Vector::Zero();
  double Scale = 1.0;
  std::uint64_t Fingerprint = 0;

  Order OrderOfPatches = Order::Spatial;
  std::vector<vtkIdType> Polygons; ///< of each patch
  std::vector<vtkIdType> Patches;  ///< of each polygon
  PatchTree Tree;
  std::vector<LocalCell> LocalCells;
  std::vector<vtkIdType> LocalPatches; ///< as LocalCells
};
} // namespace LightTransport

#endif
