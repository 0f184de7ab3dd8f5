// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonWalk.h"

#include "Photons/HenyeyGreenstein.h"

#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
bool PhotonWalk::MeetsSurface(State& photon, const Vector& target, double step,
  Counts& counts) const
{
  if (photon.Ball.Contains(target))
  {
    return false;
  }
  photon.Ball = this->Boundary.GetBall(photon.Position);
  if (photon.Ball.Contains(photon.Position) && photon.Ball.Contains(target))
  {
    return false;
  }
  photon.Ball.SquaredRadius = 0.0;
  ++counts.Rays;
  return this->Boundary.FindCrossing({ photon.Position, photon.Direction, step, true, photon.From },
    photon.Crossing);
}

//------------------------------------------------------------------------------
PhotonWalk::Fate PhotonWalk::WalkOutside(State& photon, PhotonRandom& random, Counts& counts) const
{
  for (;;)
  {
    ++counts.Rays;
    if (!this->Boundary.FindCrossing(
          { photon.Position, photon.Direction, PhotonBoundary::Unlimited, false, photon.From },
          photon.Crossing))
    {
      return Fate::ESCAPED;
    }
    const PhotonCrossing& crossing = photon.Crossing;
    if (!crossing.IsExpected)
    {
      return Fate::LOST;
    }
    photon.HasJustEntered = crossing.Distance < SamePlace;
    photon.Position += crossing.Distance * photon.Direction;
    photon.From = crossing.Patch;
    const double cosine = -photon.Direction.dot(crossing.Normal);
    if (random.Get() >= this->Interface.GetExternalReflectance(cosine))
    {
      photon.Direction = this->Interface.RefractInwards(photon.Direction, crossing.Normal);
      return Fate::CROSSED;
    }
    photon.Direction = PhotonInterface::Reflect(photon.Direction, crossing.Normal);
  }
}

//------------------------------------------------------------------------------
Eigen::Vector3d PhotonWalk::Scatter(const Vector& direction, PhotonRandom& random) const
{
  const double g = this->Anisotropy;
  if (g == 0.0)
  {
    return random.GetDirection();
  }
  const double cosine = HenyeyGreenstein::GetCosine(g, random.Get());
  double x, y;
  const double square = random.GetInCircle(x, y);
  const double sine = std::sqrt(std::max(0.0, (1.0 - cosine * cosine) / square));
  const Vector tangent = direction.unitOrthogonal();
  return (sine * (x * tangent + y * direction.cross(tangent)) + cosine * direction).normalized();
}

//------------------------------------------------------------------------------
Eigen::Vector3d PhotonWalk::Enter(const Vector& outward, PhotonRandom& random) const
{
  const Vector tangent = outward.unitOrthogonal();
  for (;;)
  {
    double x, y;
    const double cosine = std::sqrt(1.0 - random.GetInCircle(x, y));
    if (random.Get() >= this->Interface.GetExternalReflectance(cosine))
    {
      const Vector direction = x * tangent + y * outward.cross(tangent) - cosine * outward;
      return this->Interface.RefractInwards(direction, outward);
    }
  }
}
} // namespace LightTransport
