// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/DipoleProfile.h"

#include "Shared/Fresnel.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
DipoleProfile::DipoleProfile(const ScatteringMedium& medium)
{
  const double extinction = medium.Scattering + medium.Absorption;
  const double internal = Fresnel::GetMeanInternalReflectance(medium.RefractiveIndex);
  const double mismatch = (1.0 + internal) / (1.0 - internal);
  this->Albedo = medium.Scattering / extinction;
  this->DiffusionCoefficient = 1.0 / (3.0 * extinction);
  this->TransportCoefficient = std::sqrt(3.0 * medium.Absorption * extinction);
  const double realDepth = 1.0 / extinction;
  const double virtualDepth = realDepth + 4.0 * mismatch * this->DiffusionCoefficient;
  this->Sources.emplace_back(realDepth, this->TransportCoefficient);
  this->Sources.emplace_back(virtualDepth, this->TransportCoefficient);
}

//------------------------------------------------------------------------------
double DipoleProfile::Evaluate(double radius) const
{
  return this->Albedo / (4.0 * vtkMath::Pi()) *
    (this->Sources[0].Evaluate(radius) + this->Sources[1].Evaluate(radius));
}

//------------------------------------------------------------------------------
double DipoleProfile::GetTail(double radius) const
{
  return 0.5 * this->Albedo * (this->Sources[0].GetTail(radius) + this->Sources[1].GetTail(radius));
}

//------------------------------------------------------------------------------
void DipoleProfile::GetMoments(double radius, double moments[3]) const
{
  std::fill_n(moments, 3, 0.0);
  for (const PointSource& source : this->Sources)
  {
    source.AddMoments(radius, moments);
  }
  for (int k = 0; k < 3; ++k)
  {
    moments[k] *= this->Albedo / (4.0 * vtkMath::Pi());
  }
}
} // namespace LightTransport
