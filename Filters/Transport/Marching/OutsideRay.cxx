// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Marching/OutsideRay.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
bool OutsideRay::Enter(const PhotonBoundary& boundary, const PhotonInterface& interface,
  PhotonRandom& random)
{
  PhotonCrossing crossing;
  while (this->Reflections < MostReflections &&
    boundary.FindCrossing(
      { this->Position, this->Direction, PhotonBoundary::Unlimited, false, this->Patch },
      crossing) &&
    crossing.IsExpected)
  {
    this->Position += crossing.Distance * this->Direction;
    this->Patch = crossing.Patch;
    const double reflected =
      interface.GetExternalReflectance(-this->Direction.dot(crossing.Normal));
    if (random.Get() >= reflected)
    {
      this->Direction = interface.RefractInwards(this->Direction, crossing.Normal);
      return true;
    }
    this->Direction = PhotonInterface::Reflect(this->Direction, crossing.Normal);
    ++this->Reflections;
  }
  return false;
}
} // namespace LightTransport
