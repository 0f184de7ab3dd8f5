// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The scene that all transport filters work on: the patches of a data object, of all its blocks and
 * of all ranks, in flat arrays. Constant once it has been built. Polygons of any shape are cut into
 * patches, which are plane and convex (PolygonCutting); whose they are GetFaces() knows.
 *
 * Points are merged where their coordinates are equal, then centred and scaled so that the bounding
 * box has diagonal 1: nothing downstream needs an absolute length, and a micrometre and a thousand
 * kilometres give the same numbers. Lengths in the input's unit are scene lengths times GetScale().
 *
 * All ranks hold the whole scene, in the same order: that of a tree (PatchTree), so that patches
 * that are near each other in space are near each other in every array and in the exchange matrix.
 * The tree is the spatial one, or for links between clusters that of a surface, or that of the
 * surfaces' atlases, one after another: points of an atlas are the point array "AtlasCoordinates".
 * Where users meet numbers of patches (messages, arguments) they are those of the input's polygons:
 * all blocks and ranks in order, ghosts left out.
 */
#ifndef PatchScene_h
#define PatchScene_h

#include "Scene/PatchGeometry.h"
#include "Scene/PatchTree.h"
#include "Scene/PolygonGathering.h"
#include "Scene/SceneFaces.h"
#include "Shared/Outcome.h"
#include "Support/Ranks.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;

namespace LightTransport
{
struct ScenePieces;

/// How the patches of a surface are arranged, to arrange those of the same polygons elsewhere
/// alike.
struct PatchArrangement
{
  std::uint64_t Topology = 0;    ///< of all that does not depend on where points are
  std::vector<vtkIdType> Pieces; ///< of each patch, among those that polygons are cut into
  std::vector<vtkIdType> Cuts;   ///< PatchTree::GetCuts
};

class PatchScene : public PatchGeometry
{
public:
  enum class Order
  {
    Spatial,
    Surface,
    Atlas
  };

  /// Surfaces that a scene in the order of their atlases may have: blocks of composite input.
  static constexpr std::size_t MaximumSurfaces = std::size_t(1) << (64 - 2 * PatchTree::AtlasBits);

  /**
   * Gather the patches of `input`. Fails, on every rank alike, with nothing to work on (no polygon
   * that has an area), coordinates that are not finite; in the order of an atlas for a surface
   * without "AtlasCoordinates", or more surfaces than MaximumSurfaces. `numberOfSides` is 2 where
   * the backs of polygons are faces, too; `takesTexels` lets the input be texel images
   * (TexelGathering), whose polygons are looked at as they are: neighbours may overlap. In the
   * order of a surface, patches of the polygons that `kept` had, with the same point ids (or texels
   * at the same places of their image), cut alike, are arranged as they were, wherever they are.
   */
  Outcome Build(vtkDataObject* input, const Ranks& ranks, Order order = Order::Spatial,
    int numberOfSides = 1, bool takesTexels = false,
    std::shared_ptr<const PatchArrangement> kept = nullptr);

  const SceneFaces& GetFaces() const { return this->Faces; }
  /// Whether polygons are those of texels.
  bool IsOfTexels() const { return this->OfTexels; }
  /// Of each face, flags of SceneFaces::Problem.
  const std::vector<int>& GetProblems() const { return this->Problems; }
  /// What users should know of the polygons, a line each; the same on all ranks.
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

  ///@{ The polygons of this rank in their order: which cells, the number of the first of them, and
  /// all patches of them.
  const std::vector<LocalCell>& GetLocalCells() const { return this->LocalCells; }
  /// Texels of this rank that are polygons of another one.
  const std::vector<CopiedCell>& GetCopiedCells() const { return this->CopiedCells; }
  vtkIdType GetFirstLocalPolygon() const { return this->FirstLocal; }
  std::vector<vtkIdType> GetLocalPatches() const;
  ///@}
  /// The places of a polygon's corners: those at one place have the same number.
  SceneFaces::Range GetPlaces(vtkIdType polygon) const
  {
    return { this->Places.data() + this->PlaceOffsets[polygon],
      this->Places.data() + this->PlaceOffsets[polygon + 1] };
  }
  /// The first corner of each polygon among the corners of all, and after them their number.
  const std::vector<vtkIdType>& GetPlaceOffsets() const { return this->PlaceOffsets; }
  vtkIdType GetNumberOfPlaces() const { return this->NumberOfPlaces; }

  /// A patch of a face, for what all of them have alike; -1 where it has none.
  vtkIdType GetPatch(vtkIdType face) const { return this->Faces.GetPatch(face); }
  /// The input's polygon of a patch.
  vtkIdType GetPolygon(vtkIdType patch) const
  {
    return this->Faces.GetPolygon(this->Faces.GetFace(patch));
  }
  /// The tree that the order of the patches comes from.
  const PatchTree& GetTree() const { return this->Tree; }
  Order GetOrder() const { return this->OrderOfPatches; }
  /// In the order of a surface; else nullptr.
  const std::shared_ptr<const PatchArrangement>& GetArrangement() const
  {
    return this->Arrangement;
  }

  /// Input coordinates = GetCenter() + GetScale() * scene coordinates.
  double GetScale() const { return this->Scale; }
  const Vector& GetCenter() const { return this->Center; }

  /// Depends on the geometry alone (all ranks): equal for equal scenes.
  std::uint64_t GetFingerprint() const { return this->Fingerprint; }

private:
  Outcome Normalize(const GatheredPolygons& polygons);
  std::vector<Vector> MakeCorners(const GatheredPolygons& polygons);
  void Prune(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
    ScenePieces& pieces);
  void WarnOfSpacing();
  void Arrange(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
    const ScenePieces& pieces);
  std::vector<vtkIdType> ArrangePieces(const GatheredPolygons& polygons,
    const std::vector<Vector>& corners, const ScenePieces& pieces);
  std::vector<vtkIdType> SortPieces(const GatheredPolygons& polygons,
    const std::vector<Vector>& corners, const ScenePieces& pieces);
  void MergePoints(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
    const ScenePieces& pieces, const std::vector<vtkIdType>& order);
  void ComputeFingerprint(const GatheredPolygons& polygons, const ScenePieces& pieces,
    const std::vector<vtkIdType>& order);

  Vector Center = Vector::Zero();
  double Scale = 1.0;
  std::uint64_t Fingerprint = 0;

  Order OrderOfPatches = Order::Spatial;
  PatchTree Tree;
  std::shared_ptr<const PatchArrangement> Kept;
  std::shared_ptr<const PatchArrangement> Arrangement;
  SceneFaces Faces;
  std::vector<int> Problems;
  std::vector<std::string> Warnings;
  bool OfTexels = false;
  std::vector<LocalCell> LocalCells;
  std::vector<CopiedCell> CopiedCells;
  vtkIdType FirstLocal = 0;
  std::vector<vtkIdType> PlaceOffsets; ///< of each polygon, in Places
  std::vector<vtkIdType> Places;
  vtkIdType NumberOfPlaces = 0;
};
} // namespace LightTransport

#endif
