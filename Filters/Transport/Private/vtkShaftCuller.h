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
#ifndef vtkShaftCuller_h
#define vtkShaftCuller_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkPatchScene.h"

#include <array>
#include <vector>

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkShaftCuller
{
public:
  using Patches = std::vector<vtkIdType>;

  explicit vtkShaftCuller(const vtkPatchScene& scene);

  /// Whether any patch can come between two points of the scene: a patch with the whole scene in
  /// front of its plane cannot. In a convex room none can.
  bool HasOccluders() const { return this->NumberOfOccluders > 0; }

  ///@{ Replace `found` by what may be between two nodes: of the whole scene, or of `candidates`.
  void Find(int nodeI, int nodeJ, Patches& found) const;
  void Narrow(int nodeI, int nodeJ, const Patches& candidates, Patches& found) const;
  ///@}
  ///@{ The same for two patches.
  void FindBetween(vtkIdType i, vtkIdType j, Patches& found) const;
  void NarrowBetween(vtkIdType i, vtkIdType j, const Patches& candidates, Patches& found) const;
  ///@}

private:
  using Vector = vtkPatchScene::Vector;
  static constexpr int Directions = 9;
  struct Bounds
  {
    std::array<double, Directions> Lower;
    std::array<double, Directions> Upper;
    Bounds();
    void Add(const Vector& point);
    void Add(const Bounds& other);
  };

  bool IsOccluder(vtkIdType patch) const;
  static bool Meets(const Bounds& begin, const Bounds& end, const Bounds& other);
  void Search(const Bounds& begin, const Bounds& end, Patches& found) const;

  const vtkPatchScene& Scene;
  std::vector<Bounds> PatchBounds;
  std::vector<Bounds> NodeBounds;     ///< of all patches
  std::vector<Bounds> OccluderBounds; ///< of the occluders of each node; empty where it has none
  std::vector<bool> Occluders;
  vtkIdType NumberOfOccluders = 0;
};

#endif
