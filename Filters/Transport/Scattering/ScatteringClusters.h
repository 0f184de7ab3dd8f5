// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What patches receive from clusters of patches by profiles of distance: the nodes of a scene's
 * tree, each as a few pieces of it, in millimetres. Slots are those of a vtkExchangeHierarchy.
 */
#ifndef ScatteringClusters_h
#define ScatteringClusters_h

#include "Links/LinkSlots.h"
#include "Scattering/ScatteringIntegrals.h"
#include "Scattering/ScatteringPatches.h"
#include "vtkDeviceLinkRefiner.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
class PatchScene;

class ScatteringClusters
{
public:
  using Bands = ScatteringIntegrals::Bands;

  /// What a link from a cluster to a patch would come to; over the profiles' totals, per mm^2.
  struct Estimate
  {
    Bands Value = Bands::Zero();   ///< mean of the profile over the cluster
    Bands Squares = Bands::Zero(); ///< of its square
    Bands Error = Bands::Zero();   ///< of the value
    /// Whether all this is true: each piece is narrow beside the profile there.
    bool IsSmooth = true;
  };

  /// What factors may be wrong by, relative to themselves, per area of both patches, and of
  /// neighbours.
  struct Tolerances
  {
    double Relative;
    double PerArea;
    double PerNeighbour;
  };

  /// All must outlive this. `tolerances` are those of factors.
  ScatteringClusters(const PatchScene& scene, const ScatteringPatches& patches,
    const ScatteringIntegrals& integrals, const Tolerances& tolerances);

  const LinkSlots& GetSlots() const { return this->Slots; }
  double GetArea(int slot) const { return this->Places[slot].Area; }
  const Eigen::Vector3d& GetCenter(int slot) const { return this->Places[slot].Center; }
  double GetMoment(int slot) const { return this->Places[slot].Moment; }
  bool HoldsPatch(int slot, vtkIdType patch) const;
  ///@{ Patches [first, last) of a slot.
  vtkIdType GetFirstPatch(int slot) const { return this->Places[slot].First; }
  vtkIdType GetLastPatch(int slot) const { return this->Places[slot].Last; }
  ///@}

  /// A patch of a slot, by a number from 0 to 1: as likely as its area is large.
  vtkIdType Pick(int slot, double number) const;

  /// An upper bound of the profile between a patch and a slot.
  double GetBound(vtkIdType receiver, int slot) const;

  /// For a node. Where it need be known `onlyIfSmooth`, what is not is no more than said so.
  Estimate Look(vtkIdType receiver, int node, bool onlyIfSmooth) const;
  /// Whether the value of an estimate is as good as that of a link has to be.
  bool IsFactor(const Estimate& estimate) const
  {
    return estimate.IsSmooth &&
      (estimate.Error <= this->Factors.Relative * estimate.Value + this->Factors.PerArea).all();
  }

  /// The integral of the profile over a slot, averaged over the receiver.
  Bands Integrate(vtkIdType receiver, int slot) const;
  Bands IntegratePatch(vtkIdType receiver, vtkIdType patch) const;

  /// All that Look knows, for a device.
  void Describe(vtkDeviceLinkRefiner::Body& body) const;

private:
  /// Of a slot.
  struct Place
  {
    Eigen::Vector3d Center = Eigen::Vector3d::Zero();
    double Area = 0.0;
    double Moment = 0.0; ///< mean squared distance from the centre
    double Radius = 0.0; ///< of a sphere around the centre that holds it
    vtkIdType First = 0; ///< patches [First, Last)
    vtkIdType Last = 0;
  };

  void FillPlaces();
  void GatherPieces();
  bool IsNarrow(double size2, const Bands& value, const Bands& change) const;
  void AddIntegral(vtkIdType receiver, int slot, Bands& sum) const;
  const Place& GetReceiver(vtkIdType patch) const
  {
    return this->Places[this->Slots.GetNumberOfNodes() + patch];
  }

  const ScatteringPatches& Patches;
  const ScatteringIntegrals& Integrals;
  const Tolerances Factors;
  const LinkSlots Slots;
  std::vector<Place> Places;
  ///@{ The pieces of node k: slots PieceOffsets[k] to PieceOffsets[k + 1] of Pieces.
  std::vector<int> PieceOffsets;
  std::vector<int> Pieces;
  ///@}
};
} // namespace LightTransport

#endif
