// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/Overshooting.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
Overshooting::Overshooting(bool on, const std::vector<double>& areas,
  const std::vector<double>& reflectance)
  : On(on), ShotsPerSweep(static_cast<vtkIdType>(areas.size())), ShotsOfSweep(this->ShotsPerSweep),
    Remainder(VTK_DOUBLE_MAX), Losses(reflectance.size() / areas.size(), 0.0),
    Ambient(this->Losses.size(), 0.0)
{
  const std::size_t bands = this->Losses.size();
  for (std::size_t k = 0; k < reflectance.size(); ++k)
  {
    this->Losses[k % bands] += reflectance[k] * areas[k / bands];
  }
  for (double& loss : this->Losses)
  {
    loss -= loss * loss;
  }
}

//------------------------------------------------------------------------------
void Overshooting::EndSweep(double remainder)
{
  this->On = remainder < this->Remainder;
  this->Remainder = remainder;
  this->ShotsOfSweep = 0;
}

//------------------------------------------------------------------------------
void Overshooting::SetUnshotPower(const std::vector<double>& power)
{
  for (std::size_t band = 0; band < this->Ambient.size(); ++band)
  {
    const double loss = this->Losses[band];
    this->Ambient[band] = loss > 0.0 ? power[band] / loss : 0.0;
  }
}
} // namespace LightTransport
