// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/GrosjeanDipole.h"

#include "Shared/Fresnel.h"
#include "vtkMath.h"

#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
GrosjeanDipole::GrosjeanDipole(const ScatteringMedium& medium)
{
  const double extinction = medium.Scattering + medium.Absorption;
  const Fresnel::InternalMoments moments = Fresnel::GetInternalMoments(medium.RefractiveIndex);
  const double mismatch = (1.0 + moments.Second) / (1.0 - moments.First);
  this->Albedo = medium.Scattering / extinction;
  this->DiffusionCoefficient =
    (2.0 * medium.Absorption + medium.Scattering) / extinction / (3.0 * extinction);
  this->TransportCoefficient = std::sqrt(medium.Absorption / this->DiffusionCoefficient);
  this->BoundaryDepth = 2.0 * mismatch * this->DiffusionCoefficient;
  this->FluenceShare = 0.25 * (1.0 - moments.First);
  this->FluxShare = 0.5 * (1.0 - moments.Second);
}

//------------------------------------------------------------------------------
double GrosjeanDipole::Evaluate(double radius, double depth) const
{
  const double sigma = this->TransportCoefficient;
  const double height = depth + 2.0 * this->BoundaryDepth;
  const double real = std::sqrt(radius * radius + depth * depth);
  const double image = std::sqrt(radius * radius + height * height);
  // The difference of two almost equal distances.
  const double further = 2.0 * this->BoundaryDepth * (depth + height) / (real + image);
  const double left = std::exp(-sigma * real);
  const double loss = -std::expm1(-sigma * further);
  const double leftOfImage = left * (1.0 - loss);
  const double fluence = left * (further / real + loss) / image / this->DiffusionCoefficient;
  const double flux = depth * (1.0 + sigma * real) * left / (real * real * real) +
    height * (1.0 + sigma * image) * leftOfImage / (image * image * image);
  return this->Albedo * this->Albedo / (4.0 * vtkMath::Pi()) *
    (this->FluenceShare * fluence + this->FluxShare * flux);
}

//------------------------------------------------------------------------------
double GrosjeanDipole::GetTotal(double depth) const
{
  const double sigma = this->TransportCoefficient;
  const double way = 2.0 * this->BoundaryDepth;
  const double loss = -std::expm1(-sigma * way);
  const double mean = sigma > 0.0 ? loss / sigma : way;
  return 0.5 * this->Albedo * this->Albedo * std::exp(-sigma * depth) *
    (this->FluxShare * (2.0 - loss) + this->FluenceShare * mean / this->DiffusionCoefficient);
}
} // namespace LightTransport
