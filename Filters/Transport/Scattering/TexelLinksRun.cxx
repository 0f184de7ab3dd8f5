// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/TexelLinksRun.h"

#include "Scene/SceneOutput.h"
#include "Shared/ArrayNames.h"
#include "vtkSubsurfaceScattering.h"

#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome TexelLinksRun::Check()
{
  if (this->Owner->GetModel() == vtkSubsurfaceScattering::MODEL_MONTE_CARLO)
  {
    return Outcome::Failed("Model is MonteCarlo, whose photons walk in the body itself, and texels "
                           "enclose none: choose a profile, such as Model Tabulated.");
  }
  if (this->Owner->GetRefineByIrradiance())
  {
    return Outcome::Failed("RefineByIrradiance is on, and links are asked for that hold in any "
                           "light: switch it off.");
  }
  return this->ProfileRun::Check();
}

//------------------------------------------------------------------------------
void TexelLinksRun::Write()
{
  std::vector<double> rows(this->Scene.GetAreas().size());
  std::iota(rows.begin(), rows.end(), 1.0);
  SceneOutput(this->Scene, nullptr, this->Input, this->Output)
    .AddArray(ArrayNames::LinkRow, rows, 1);
}
} // namespace LightTransport
