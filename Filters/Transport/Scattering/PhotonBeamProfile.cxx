// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/PhotonBeamProfile.h"

#include <cmath>

namespace LightTransport
{
namespace
{
///@{ Sources are evenly spread over the logarithm of depth, in mean free paths: the sum converges
/// exponentially with their number, at any distance from the beam.
constexpr double FirstLogarithm = -19.0;
constexpr double LastLogarithm = 3.8;
constexpr int NumberOfSources = 57;
///@}
} // namespace

//------------------------------------------------------------------------------
PhotonBeamProfile::PhotonBeamProfile(const ScatteringMedium& medium)
  : Extinction(medium.Scattering + medium.Absorption), Dipole(medium), Single(medium)
{
  const double step = (LastLogarithm - FirstLogarithm) / NumberOfSources;
  for (int k = 0; k < NumberOfSources; ++k)
  {
    const double depth = std::exp(FirstLogarithm + step * (k + 0.5));
    this->Sources.push_back({ depth / this->Extinction, step * depth * std::exp(-depth) });
  }
  this->Integrate(1.0 / this->Extinction);
}

//------------------------------------------------------------------------------
double PhotonBeamProfile::Evaluate(double radius) const
{
  double sum = 0.0;
  for (const Source& source : this->Sources)
  {
    const double distance = std::sqrt(radius * radius + source.Depth * source.Depth);
    const double correction = -std::expm1(-2.0 * this->Extinction * (distance + source.Depth));
    sum += source.Weight * correction * this->Dipole.Evaluate(radius, source.Depth);
  }
  return sum + this->Single.Evaluate(radius);
}
} // namespace LightTransport
