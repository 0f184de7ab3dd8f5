// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a photon's path weighs in a medium that varies, in one band. At places where it may be
 * scattered it passes by chance, in proportion to what the extinction lacks of its majorant; else
 * it weighs as much less as is absorbed there. What weighs little survives by chance (Russian
 * roulette).
 */
#ifndef VaryingPath_h
#define VaryingPath_h

#include "Photons/PhotonMedium.h"
#include "Photons/PhotonRandom.h"
#include "Photons/VaryingMedium.h"

namespace LightTransport
{
class VaryingPath
{
public:
  using Vector = Eigen::Vector3d;

  explicit VaryingPath(const VaryingMedium& medium) : Medium(medium) {}

  /// How far to the next place where the photon may be scattered; infinite where there is none.
  double ChooseStep(const Vector& position, const Vector& direction, PhotonRandom& random)
  {
    this->Next = this->Medium.FindPlace(position, direction, random.GetExponential());
    return this->Next.Distance;
  }
  void Advance(double) {}

  /// What happens at the end of a step.
  PhotonEvent Meet(PhotonRandom& random)
  {
    ++this->Events;
    double scattering, absorption;
    this->Medium.Get(this->Next, scattering, absorption);
    const double extinction = scattering + absorption;
    if (extinction < this->Next.Majorant && random.Get() * this->Next.Majorant >= extinction)
    {
      return PhotonEvent::PASSED;
    }
    ++this->Scatterings;
    this->Weight *= scattering / extinction;
    return this->Weight >= SmallPhotonWeight || this->Survives(random) ? PhotonEvent::SCATTERED
                                                                       : PhotonEvent::ENDED;
  }

  long long GetNumberOfEvents() const { return this->Events; }
  long long GetNumberOfScatterings() const { return this->Scatterings; }

  void GetWeights(double* weights) const { weights[0] = this->Weight; }

private:
  bool Survives(PhotonRandom& random)
  {
    const bool survives = random.Get() < this->Weight;
    this->Weight = 1.0;
    return survives;
  }

  const VaryingMedium& Medium;
  VaryingMedium::Place Next{ 0.0, 0.0, false, Vector::Zero() };
  double Weight = 1.0;
  long long Events = 0;
  long long Scatterings = 0;
};
} // namespace LightTransport

#endif
