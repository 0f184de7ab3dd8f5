// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What one patch receives from the clusters of a body. Near by, where pieces of clusters are not
 * what they are at their centres, the profile is integrated patch by patch and summed up to the
 * clusters above them; where it is smooth, clusters are known by their pieces.
 */
#ifndef ScatteringReceiver_h
#define ScatteringReceiver_h

#include "Scattering/RefinementOnDevice.h"
#include "Scattering/ScatteringClusters.h"
#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class ScatteringReceiver
{
public:
  using Bands = ScatteringClusters::Bands;

  /// A cluster or a patch.
  struct Part
  {
    int Slot = 0;
    Bands Value = Bands::Zero();   ///< integral of the profile over it
    Bands Squares = Bands::Zero(); ///< of its square
    bool IsExact = false;          ///< patch by patch
    bool IsFactor = false;         ///< the value is that of a link
    bool IsLeftOut = false;        ///< certainly too little
    bool IsDivided = false;        ///< whatever it is, which nothing here tells
    bool IsKept = false;           ///< as it was chosen before
    int NumberBelow = 0;           ///< parts that follow it and lie below it
  };

  /// `clusters` must outlive this. What is certainly below `leaveOut`, per mm^2, is.
  ScatteringReceiver(const ScatteringClusters& clusters, double leaveOut)
    : Clusters(&clusters), LeaveOut(leaveOut)
  {
  }

  /// Look at all clusters from a patch.
  void Look(vtkIdType patch);
  /// Look at the clusters from which it received before it moved, and at all that were left out:
  /// [begin, end) in the order of their patches.
  void Look(vtkIdType patch, const int* begin, const int* end);
  /// Likewise where a device has looked.
  void Adopt(vtkIdType patch, const RefinementOnDevice::Walk& walk);
  vtkIdType GetPatch() const { return this->Patch; }

  /// What a link from a part misses at most of light that differs by 1 from its mean there, root
  /// mean square.
  Bands GetDeviation(const Part& part) const;
  /// Whether the part holds the receiver.
  bool IsOwn(const Part& part) const;
  Part GetPart(int slot) const;

  /// Hands to take(part) the patches and what is left out below the root, and the clusters for
  /// which divide(part) is false.
  template <typename Divide, typename Take>
  void Visit(const Divide& divide, const Take& take) const
  {
    this->VisitPart(this->Parts[0], divide, take);
  }
  /// The same below a part.
  template <typename Divide, typename Take>
  void VisitPart(const Part& part, const Divide& divide, const Take& take) const;

private:
  void Add(int slot);
  void AddLinked(int slot);
  void AddKept(int slot, const int* begin, const int* end);
  void AddFound(int slot, RefinementOnDevice::Walk& walk);
  void AddPart(RefinementOnDevice::Walk& walk);
  void AddPatch(int slot);
  template <typename AddChild>
  void AddNode(int slot, const AddChild& addChild);
  void SetSmooth(const ScatteringClusters::Estimate& estimate, Part& part) const;
  Part MakeSmooth(int slot) const;
  bool IsNegligible(int slot) const;
  const ScatteringClusters* Clusters;
  double LeaveOut;
  vtkIdType Patch = -1;
  std::vector<Part> Parts; ///< each before those below it
};

//------------------------------------------------------------------------------
template <typename Divide, typename Take>
void ScatteringReceiver::VisitPart(const Part& part, const Divide& divide, const Take& take) const
{
  const LinkSlots& slots = this->Clusters->GetSlots();
  if (slots.IsPatch(part.Slot) || part.IsLeftOut || !(part.IsDivided || divide(part)))
  {
    take(part);
    return;
  }
  if (part.NumberBelow > 0)
  {
    const Part* below = &part + 1;
    const Part* end = below + part.NumberBelow;
    for (; below < end; below += 1 + below->NumberBelow)
    {
      this->VisitPart(*below, divide, take);
    }
    return;
  }
  const LinkSlots::Node children = slots.GetChildren(part.Slot);
  for (int child = children.First; child < children.Last; ++child)
  {
    this->VisitPart(this->MakeSmooth(child), divide, take);
  }
}
} // namespace LightTransport

#endif
