// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/BlackBody.h"

#include "Radiosity/PlanckFraction.h"

#include <cmath>

namespace LightTransport
{
namespace
{
// W m^-2 K^-4, 2 pi^5 k^4 / (15 h^3 c^2), exact in the SI of 2019 (rounded here).
constexpr double StefanBoltzmann = 5.670374419e-8;
} // namespace

//------------------------------------------------------------------------------
double BlackBody::GetFlux(double temperature, const std::vector<double>& bandLimits, int band)
{
  const double share = bandLimits.empty()
    ? 1.0
    : PlanckFraction::GetBand(bandLimits[band], bandLimits[band + 1], temperature);
  return share * StefanBoltzmann * std::pow(temperature, 4);
}

//------------------------------------------------------------------------------
double BlackBody::GetTemperature(double flux)
{
  return std::pow(flux / StefanBoltzmann, 0.25);
}
} // namespace LightTransport
