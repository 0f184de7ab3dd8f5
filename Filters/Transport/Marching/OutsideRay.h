// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A ray in the air between the parts of a body, or between bodies: followed from patch to patch,
/// with the light or against it, reflected or refracted inwards as likely as both are.
#ifndef OutsideRay_h
#define OutsideRay_h

#include "Photons/PhotonBoundary.h"
#include "Photons/PhotonInterface.h"
#include "Photons/PhotonRandom.h"

namespace LightTransport
{
struct OutsideRay
{
  using Vector = Eigen::Vector3d;

  Vector Position;
  Vector Direction;
  vtkIdType Patch; ///< where it is, or -1
  int Reflections = 0;

  /// Follow it to where it enters a body; the direction is that inside then. False where it goes
  /// away.
  bool Enter(const PhotonBoundary& boundary, const PhotonInterface& interface,
    PhotonRandom& random);

private:
  /// More reflections in a row are not followed.
  static constexpr int MostReflections = 64;
};
} // namespace LightTransport

#endif
