// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ChristensenBurleyProfile.h"

#include "Scattering/MatchedHalfSpace.h"
#include "vtkMath.h"
#include "vtkSubsurfaceScattering.h"

#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
ChristensenBurleyProfile::ChristensenBurleyProfile(const ScatteringMedium& medium, int fit)
{
  const double extinction = medium.Scattering + medium.Absorption;
  this->Reflectance = fit == vtkSubsurfaceScattering::BURLEY_FIT_DIFFUSE_SURFACE
    ? MatchedHalfSpace::GetDiffuseReflectance(medium)
    : MatchedHalfSpace::GetNormalReflectance(medium);
  const double a = this->Reflectance;
  switch (fit)
  {
    case vtkSubsurfaceScattering::BURLEY_FIT_SEARCHLIGHT:
      this->Length = 1.0 / extinction / (1.85 - a + 7.0 * std::pow(std::abs(a - 0.8), 3));
      break;
    case vtkSubsurfaceScattering::BURLEY_FIT_DIFFUSE_MEAN_FREE_PATH:
      this->Length = 1.0 / std::sqrt(3.0 * medium.Absorption * extinction) /
        (3.5 + 100.0 * std::pow(a - 0.33, 4));
      break;
    default:
      this->Length = 1.0 / extinction / (1.9 - a + 3.5 * (a - 0.8) * (a - 0.8));
      break;
  }
  this->Integrate(this->Length);
}

//------------------------------------------------------------------------------
double ChristensenBurleyProfile::Evaluate(double radius) const
{
  if (this->Reflectance == 0.0)
  {
    return 0.0;
  }
  const double x = radius / this->Length;
  return this->Reflectance * (std::exp(-x) + std::exp(-x / 3.0)) /
    (8.0 * vtkMath::Pi() * this->Length * radius);
}
} // namespace LightTransport
