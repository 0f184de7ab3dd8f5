// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finds the walls (OccluderWalls) that may come between two patches, or between any two patches of
 * two nodes of the scene's tree: those that reach into the shaft, the convex hull of both (Haines
 * and Wallace 1991), in front of both, with the two on different sides of their plane.
 * Conservative: where nothing is found, nothing is between.
 *
 * A shaft is tested as the family of its cross-sections: bounds along a few fixed directions, which
 * go linearly from those of the one end to those of the other. Sides are those of boxes as long as
 * nodes are large, then of patches: once for each wall and patch of two nodes, not for each pair
 * (SideFinder). Of the walls of a convex body those are enough that face the first of two patches,
 * where that is outside. From there on what is found is in order: first what is likely to hide
 * much.
 */
#ifndef ShaftCuller_h
#define ShaftCuller_h

#include "Geometry/OccluderWalls.h"
#include "Geometry/SideMasks.h"
#include "Scene/PatchScene.h"

#include <array>
#include <vector>

namespace LightTransport
{
class ShaftCuller
{
public:
  static constexpr int Directions = 9;

  /// What may be between two patches.
  struct Occluder
  {
    vtkIdType Wall;
    bool IsCut; ///< by the plane of one of the two, which it reaches at least
  };

  /// Walls, with their bounds side by side.
  struct Candidates
  {
    std::vector<vtkIdType> Walls;
    std::array<std::vector<float>, Directions> Lower;
    std::array<std::vector<float>, Directions> Upper;
    ///@{ Which cross-sections of the shaft looked at last meet the bounds.
    std::vector<float> First;
    std::vector<float> Last;
    ///@}
    ///@{ Sides of the patches of two nodes with few of them, from FirstI and FirstJ on; while nodes
    /// are larger there are none.
    bool HasSides = false;
    std::vector<SideMasks> SidesI; ///< without those of the back of what only the front hides
    std::vector<SideMasks> SidesJ;
    vtkIdType FirstI = 0;
    vtkIdType FirstJ = 0;
    ///@}
    std::vector<std::size_t> Kept; ///< which these were of those they were chosen from

    bool IsEmpty() const { return this->Walls.empty(); }
    /// Make room for the bounds of all walls.
    void Resize();
  };

  struct Bounds
  {
    std::array<float, Directions> Lower;
    std::array<float, Directions> Upper;
    Bounds();
    void Add(const PatchScene::Vector& point);
    void Add(const Bounds& other);
  };

  /// The hull of two bounds. Each side is met by a bound at t = (bound - Begin) * Inverse.
  struct Shaft
  {
    struct Side
    {
      float Begin, Inverse;
      bool IsLast; ///< cross-sections up to t meet what has the bound; otherwise those from t on
    };
    std::array<Side, 2 * Directions> Sides; ///< lower and upper side of each direction
    Shaft(const Bounds& begin, const Bounds& end);
    bool Meets(const Bounds& other) const;
  };

  /// Sides of the nodes that were asked about last: most are asked about again beside another one.
  class SideCache
  {
  public:
    template <typename FindSides>
    const SideMasks& Get(int end, int node, vtkIdType first, vtkIdType wall, vtkIdType walls,
      const FindSides& find)
    {
      auto& entries = this->Entries[end][first / SideFinder::MaximumPatches % Nodes];
      entries.resize(walls);
      Entry& entry = entries[wall];
      if (entry.Node != node)
      {
        entry = { node, find(wall) };
      }
      return entry.Sides;
    }

  private:
    static constexpr vtkIdType Nodes = 4;
    struct Entry
    {
      int Node = -1;
      SideMasks Sides;
    };
    std::array<std::vector<Entry>, Nodes> Entries[2]; ///< of the first nodes, and of the second
  };

  explicit ShaftCuller(const PatchScene& scene);

  const OccluderWalls& GetWalls() const { return this->Walls; }

  /// Whether anything can come between two points of the scene: a wall with the whole scene in
  /// front of its plane cannot. In a convex room none can.
  bool HasOccluders() const { return this->NumberOfOccluders > 0; }

  /// Whether anything may be between two nodes; false is certain.
  bool MayBlock(int nodeI, int nodeJ) const;

  ///@{ Replace `found` by what may be between two nodes: of the whole scene, or of `candidates`
  /// that were found for nodes above them.
  void Find(int nodeI, int nodeJ, Candidates& found) const;
  void Narrow(int nodeI, int nodeJ, Candidates& candidates, Candidates& found) const;
  ///@}
  /// Of what was found for two nodes with few patches, keep what parts any two of them. To be
  /// called before Narrow and NarrowBetween take the list further: it takes longer than a look for
  /// what hides all.
  void KeepParting(int nodeI, int nodeJ, SideCache& sides, Candidates& found) const;
  ///@{ The same for two patches; candidates are those of two leaves.
  void FindBetween(vtkIdType i, vtkIdType j, std::vector<Occluder>& found) const;
  void NarrowBetween(vtkIdType i, vtkIdType j, Candidates& candidates,
    std::vector<Occluder>& found) const;
  ///@}

  /// A wall that certainly hides all of one node from all of the other; -1 where none is known.
  /// `guess`: the wall to try first, or -1.
  vtkIdType FindHiding(int nodeI, int nodeJ, const Candidates& candidates, vtkIdType guess) const;

private:
  using Vector = PatchScene::Vector;
  void SetLeaf(int node);
  void SetNode(int node);
  template <typename Visit>
  void Search(const Shaft& shaft, const Visit& visit) const;
  bool MayPart(vtkIdType wall, int nodeI, int nodeJ) const;
  SideMasks LeaveOutBacks(vtkIdType wall, unsigned int outside, SideMasks sides) const;
  unsigned int GetOutside(vtkIdType first, vtkIdType last) const;
  template <typename Item, typename GetWall>
  void Order(const Vector& from, const Vector& to, std::vector<Item>& items,
    const GetWall& getWall) const;
  void SetBounds(Candidates& found) const;
  static void Keep(const Candidates& candidates, Candidates& found);
  std::vector<Vector> GetBox(int node) const;
  bool IsOf(vtkIdType wall, vtkIdType i, vtkIdType j) const
  {
    return wall == this->Walls.GetWall(i) || wall == this->Walls.GetWall(j);
  }

  const PatchScene& Scene;
  const OccluderWalls Walls;
  std::vector<Bounds> PatchBounds;
  std::vector<Bounds> WallBounds;
  std::vector<Bounds> NodeBounds;     ///< of all patches
  std::vector<bool> NodesOutside;     ///< all patches are outside all bodies
  std::vector<int> NodeBodies;        ///< that all patches bound, -1 where there is none
  std::vector<Bounds> OccluderBounds; ///< of the occluders of each node; empty where it has none
  ///@{ The occluders that belong to node k and to none of its children: from OccluderBegins[k] to
  /// OccluderBegins[k + 1].
  std::vector<vtkIdType> Occluders;
  std::vector<vtkIdType> OccluderBegins;
  ///@}
  vtkIdType NumberOfOccluders = 0;
};
} // namespace LightTransport

#endif
