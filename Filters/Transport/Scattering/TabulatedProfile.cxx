// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/TabulatedProfile.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
TabulatedProfile::TabulatedProfile(const ScatteringMedium& medium, long long photons,
  std::uint64_t seed)
  : Extinction(medium.Scattering + medium.Absorption)
{
  if (medium.Scattering > 0.0)
  {
    HalfSpaceTable::Settings settings{ medium.Scattering / this->Extinction, medium.RefractiveIndex,
      medium.Anisotropy };
    settings.NumberOfPhotons = photons;
    settings.Seed = seed;
    this->Table = HalfSpaceTable::Get(settings);
    this->PhotonDecay =
      HalfSpaceTable::GetDecay(medium.Absorption / this->Extinction, medium.Anisotropy);
  }
  // The mean free path as it is: photons are scattered once within it.
  this->Integrate(1.0 / (medium.Scattering / (1.0 - medium.Anisotropy) + medium.Absorption));
}

//------------------------------------------------------------------------------
double TabulatedProfile::Evaluate(double radius) const
{
  return this->Table ? this->Extinction * this->Extinction *
      this->Table->Evaluate(this->Extinction * radius, this->PhotonDecay)
                     : 0.0;
}
} // namespace LightTransport
