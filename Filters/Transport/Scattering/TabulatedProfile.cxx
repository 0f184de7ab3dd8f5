// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/TabulatedProfile.h"

#include "Shared/Fresnel.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
TabulatedProfile::TabulatedProfile(const ScatteringMedium& medium, long long photons,
  std::uint64_t seed, const Ranks& ranks)
  : Extinction(medium.Scattering + medium.Absorption)
{
  if (medium.Scattering > 0.0)
  {
    HalfSpaceTable::Settings settings{ medium.Scattering / this->Extinction, medium.RefractiveIndex,
      medium.Anisotropy };
    settings.NumberOfPhotons = photons;
    settings.Seed = seed;
    this->Table = HalfSpaceTable::Get(settings, ranks);
    this->PhotonDecay =
      HalfSpaceTable::GetDecay(medium.Absorption / this->Extinction, medium.Anisotropy);
  }
  // The mean free path as it is: photons are scattered once within it.
  const double scale = 1.0 / (medium.Scattering / (1.0 - medium.Anisotropy) + medium.Absorption);
  const double share = medium.Absorption / (this->Extinction * HalfSpaceTable::LeastAbsorption);
  if (this->Table && share < 1.0)
  {
    this->WalkDecay = HalfSpaceTable::GetDecay(HalfSpaceTable::LeastAbsorption, medium.Anisotropy);
    this->AddLacking(share, medium.RefractiveIndex, scale);
  }
  this->Integrate(scale);
}

//------------------------------------------------------------------------------
/// Of a medium that absorbs `share` of what the walk does.
void TabulatedProfile::AddLacking(double share, double index, double scale)
{
  // What does not leave of all that enters, for the root of what is absorbed.
  const double slope =
    4.0 / std::sqrt(3.0) * index * index / (1.0 - Fresnel::GetMeanExternalReflectance(index));
  const double loss = slope * std::sqrt(HalfSpaceTable::LeastAbsorption);
  this->Gain = 0.0;
  this->Integrate(scale);
  const double walked = this->GetTotal();
  this->Gain = 1.0;
  this->Integrate(scale);
  const double lacking = this->GetTotal() - walked;
  const double total = 1.0 - loss * std::sqrt(share) + (walked - 1.0 + loss) * share;
  // Where the medium is hardly another than that of the walk the difference is lost in rounding.
  constexpr double least = 1e-5;
  constexpr double most = 2.0;
  if (lacking > least)
  {
    this->Gain = std::clamp((total - walked) / lacking, 0.0, most);
  }
}

//------------------------------------------------------------------------------
double TabulatedProfile::Evaluate(double radius) const
{
  return this->Table ? this->Extinction * this->Extinction *
      this->Table->Evaluate(this->Extinction * radius, this->PhotonDecay, this->WalkDecay,
        this->Gain)
                     : 0.0;
}
} // namespace LightTransport
