// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/MediumProperties.h"

#include "Scattering/ScatteringMaterials.h"

#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
constexpr double MostAnisotropy = 0.99;

//------------------------------------------------------------------------------
Outcome CheckAnisotropy(const std::vector<ScatteringMedium>& media)
{
  for (std::size_t band = 0; band < media.size(); ++band)
  {
    if (!(std::abs(media[band].Anisotropy) <= MostAnisotropy))
    {
      std::ostringstream text;
      text << "Component " << band << " of Anisotropy is " << media[band].Anisotropy
           << ": it must be between " << -MostAnisotropy << " and " << MostAnisotropy << ".";
      return Outcome::Failed(text.str());
    }
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
Outcome MediumProperties::MakeMedia(std::vector<ScatteringMedium>& media) const
{
  const ScatteringMaterial* preset = ScatteringMaterials::Find(this->Material);
  for (int band = 0; band < Bands; ++band)
  {
    media.push_back({ preset ? preset->Scattering[band] : this->Scattering[band],
      preset ? preset->Absorption[band] : this->Absorption[band],
      preset ? preset->RefractiveIndex : this->RefractiveIndex,
      this->Anisotropy ? this->Anisotropy[band] : 0.0 });
  }
  std::ostringstream text;
  for (int band = 0; band < Bands; ++band)
  {
    const double scattering = media[band].Scattering;
    const double absorption = media[band].Absorption;
    if (!(scattering >= 0.0) || !(absorption >= 0.0) || !std::isfinite(scattering + absorption))
    {
      text << "ScatteringCoefficient and AbsorptionCoefficient must be finite and not negative, "
              "but component "
           << band << " has " << scattering << " and " << absorption << " per mm.";
      return Outcome::Failed(text.str());
    }
    if (scattering + absorption == 0.0)
    {
      text << "ScatteringCoefficient and AbsorptionCoefficient are both 0 in component " << band
           << ": light would pass through unchanged. Set one of them above 0.";
      return Outcome::Failed(text.str());
    }
  }
  const double index = media[0].RefractiveIndex;
  if (!(index >= 1.0) || !std::isfinite(index))
  {
    text << "RefractiveIndex is " << index
         << ": it must be at least 1 (1.3 for water, 1.5 for glass and marble).";
    return Outcome::Failed(text.str());
  }
  const double unit = this->MillimetersPerUnit;
  if (!(unit > 0.0) || !std::isfinite(unit))
  {
    text << "MillimetersPerUnit is " << unit
         << ": it must be above 0 (10 for a mesh in centimetres).";
    return Outcome::Failed(text.str());
  }
  return CheckAnisotropy(media);
}
} // namespace LightTransport
