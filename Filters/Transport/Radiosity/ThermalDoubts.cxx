// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/ThermalDoubts.h"

#include "Radiosity/RadiosityMaterials.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/EnclosureVerdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
// Nothing warmer than this, in kelvin, is on Earth a sign of another unit: 100 degrees Celsius are
// 373 K.
constexpr double CelsiusLike = 100.0;
// Openings and losses of more than these shares are told of.
constexpr double NoticedSky = 1e-3;
constexpr double NoticedLoss = 0.01;

//------------------------------------------------------------------------------
double FindWarmest(const RadiosityMaterials& materials)
{
  double warmest = materials.Settings.BackgroundTemperature;
  for (std::size_t patch = 0; patch < materials.Temperature.size(); ++patch)
  {
    warmest =
      materials.HasGivenFlux[patch] ? warmest : std::max(warmest, materials.Temperature[patch]);
  }
  return warmest;
}

//------------------------------------------------------------------------------
double SumEmission(const RadiosityMaterials& materials, const PatchScene& scene)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < materials.Emission.size(); ++k)
  {
    sum += scene.GetAreas()[k / materials.NumberOfBands] * std::abs(materials.Emission[k]);
  }
  return sum * scene.GetScale() * scene.GetScale();
}
} // namespace

//------------------------------------------------------------------------------
void ThermalDoubts::Add(const RadiosityMaterials& materials, const PatchScene& scene,
  const EnclosureVerdict& verdict, double netPower, std::vector<std::string>& warnings)
{
  std::ostringstream text;
  text.precision(3);
  const double warmest = FindWarmest(materials);
  if (warmest > 0.0 && warmest <= CelsiusLike)
  {
    text << "The warmest temperature is " << warmest
         << " K: if these are degrees Celsius, add 273.15.";
    warnings.push_back(text.str());
    text.str("");
  }
  if (verdict.GetSkyShare() > NoticedSky && !materials.Settings.HasBackground())
  {
    text << "The scene is open: " << 100.0 * verdict.GetSkyShare()
         << " % of what leaves its surfaces goes to a sky at 0 K. Set BackgroundTemperature, or "
            "close the scene.";
    warnings.push_back(text.str());
    text.str("");
  }
  const double emitted = SumEmission(materials, scene);
  // A body that is seen from outside is inside out, too, and gives all to the sky.
  const bool shouldBalance = verdict.GetName() == "Closed" ||
    (verdict.GetName() == "InsideOut" && verdict.GetSkyShare() < 1.0 - NoticedSky);
  if (shouldBalance && !materials.HasGivenFluxes() && std::abs(netPower) > NoticedLoss * emitted)
  {
    text << "NetPower is " << netPower << " of " << emitted
         << " W that are emitted (lengths in metres), where a closed scene has 0.";
    warnings.push_back(text.str());
  }
}
} // namespace LightTransport
