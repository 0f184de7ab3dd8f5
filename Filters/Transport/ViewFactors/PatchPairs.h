// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The exchange of single pairs of patches: that of UnoccludedPairs, and the part of it that is
/// visible (PairVisibility), as well as an error that is asked for needs.
#ifndef PatchPairs_h
#define PatchPairs_h

#include "vtkType.h"

namespace LightTransport
{
class PairVisibility;
class PatchScene;
class ShaftCuller;
class UnoccludedPairs;

class PatchPairs
{
public:
  /// What is known of a pair.
  struct View
  {
    struct Share
    {
      float Value, Error;
    };
    float Kernel; ///< exchange over both areas, as if nothing were between
    Share First;  ///< the visible part, at a first look
    Share Fine;   ///< and to an error of Allowed, where that is above 0
    float Allowed;
  };

  /// All of one scene. They must outlive this.
  PatchPairs(const PatchScene& scene, const UnoccludedPairs& open, const ShaftCuller& culler)
    : Scene(scene), Open(open), Culler(culler)
  {
  }

  /// A first look; `isFree`: nothing can be between the two.
  View Look(vtkIdType i, vtkIdType j, bool isFree, PairVisibility& visibility) const;

  /// The visible part to an error of `allowed`, a power of 2: from `view`, which keeps it. The same
  /// as if there had been no look before.
  View::Share See(vtkIdType i, vtkIdType j, double allowed, PairVisibility& visibility,
    View& view) const;

private:
  bool MayBeHidden(vtkIdType i, vtkIdType j, double kernel, PairVisibility& visibility) const;

  const PatchScene& Scene;
  const UnoccludedPairs& Open;
  const ShaftCuller& Culler;
};
} // namespace LightTransport

#endif
