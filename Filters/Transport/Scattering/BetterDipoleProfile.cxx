// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/BetterDipoleProfile.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
BetterDipoleProfile::BetterDipoleProfile(const ScatteringMedium& medium)
  : Depth(1.0 / (medium.Scattering + medium.Absorption)), Dipole(medium), Single(medium)
{
  this->Integrate(this->Depth);
}

//------------------------------------------------------------------------------
double BetterDipoleProfile::Evaluate(double radius) const
{
  return this->Dipole.Evaluate(radius, this->Depth) + this->Single.Evaluate(radius);
}
} // namespace LightTransport
