// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finds the patches that may come between two patches, or between any two patches of two nodes of
 * the scene's tree: those that reach into the shaft, the convex hull of both (Haines and Wallace
 * 1991). Conservative: where nothing is found, nothing is between.
 *
 * A shaft is tested as the family of its cross-sections: bounds along a few fixed directions, which
 * go linearly from those of the one end to those of the other.
 */
#ifndef ShaftCuller_h
#define ShaftCuller_h

#include "Scene/PatchScene.h"

#include <array>
#include <vector>

namespace LightTransport
{
class ShaftCuller
{
public:
  static constexpr int Directions = 9;

  /// Patches, with their bounds side by side.
  struct Candidates
  {
    std::vector<vtkIdType> Patches;
    std::vector<float> Lower[Directions];
    std::vector<float> Upper[Directions];
    ///@{ Which cross-sections of the shaft looked at last meet the bounds.
    std::vector<float> First;
    std::vector<float> Last;
    bool IsBetween(std::size_t index) const { return this->First[index] <= this->Last[index]; }
    ///@}

    bool IsEmpty() const { return this->Patches.empty(); }
    /// Make room for the bounds of all patches.
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

  explicit ShaftCuller(const PatchScene& scene);

  /// Whether any patch can come between two points of the scene: a patch with the whole scene in
  /// front of its plane cannot. In a convex room none can.
  bool HasOccluders() const { return this->NumberOfOccluders > 0; }

  /// Whether anything may be between two nodes; false is certain.
  bool MayBlock(int nodeI, int nodeJ) const;

  ///@{ Replace `found` by what may be between two nodes: of the whole scene, or of `candidates`.
  void Find(int nodeI, int nodeJ, Candidates& found) const;
  void Narrow(int nodeI, int nodeJ, Candidates& candidates, Candidates& found) const;
  ///@}
  ///@{ The same for two patches.
  void FindBetween(vtkIdType i, vtkIdType j, std::vector<vtkIdType>& found) const;
  void NarrowBetween(vtkIdType i, vtkIdType j, Candidates& candidates,
    std::vector<vtkIdType>& found) const;
  ///@}

private:
  using Vector = PatchScene::Vector;
  template <typename Visit>
  void Search(const Shaft& shaft, const Visit& visit) const;
  void Search(const Shaft& shaft, std::vector<vtkIdType>& found) const;

  const PatchScene& Scene;
  std::vector<Bounds> PatchBounds;
  std::vector<Bounds> NodeBounds;     ///< of all patches
  std::vector<Bounds> OccluderBounds; ///< of the occluders of each node; empty where it has none
  std::vector<bool> Occluders;
  vtkIdType NumberOfOccluders = 0;
};
} // namespace LightTransport

#endif
