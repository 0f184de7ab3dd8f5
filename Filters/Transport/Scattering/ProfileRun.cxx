// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ProfileRun.h"

#include "Links/LinkCache.h"
#include "Scattering/ScatteringLinks.h"
#include "Shared/FieldValues.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace LightTransport
{
namespace
{
// More light than entered, beyond the error of the links, that is not worth a warning.
constexpr double NegligibleExcess = 0.01;
// How much of a body may be thin.
constexpr double LargestThinShare = 0.1;
} // namespace

//------------------------------------------------------------------------------
bool ProfileRun::IsTabulated() const
{
  return this->Owner->GetModel() == vtkSubsurfaceScattering::MODEL_TABULATED;
}

//------------------------------------------------------------------------------
Outcome ProfileRun::Check()
{
  if (this->Owner->GetNumberOfInputConnections(1) > 0)
  {
    return Outcome::Failed("A medium that varies is connected (input port 1), and Model is a "
                           "profile of uniform media: set Model to MonteCarlo, or disconnect it.");
  }
  return this->ScatteringRun::Check();
}

//------------------------------------------------------------------------------
std::unique_ptr<LinkBuilder> ProfileRun::MakeBuilder() const
{
  ScatteringOptions options;
  options.BurleyFit = this->Owner->GetBurleyFit();
  if (this->IsTabulated())
  {
    options.NumberOfPhotons = this->Owner->GetNumberOfPhotons();
    options.Seed = static_cast<std::uint64_t>(this->Owner->GetSeed());
  }
  return std::make_unique<ScatteringLinks>(this->Owner->GetModel(), options, this->Media,
    this->Owner->GetMillimetersPerUnit(), this->Owner->GetLinkTolerance());
}

//------------------------------------------------------------------------------
/// More than all of it comes back only by an error.
void ProfileRun::CheckEnergy() const
{
  const double margin = NegligibleExcess + this->Cache.Get().GetSummary("LinkErrorBound");
  for (int band = 0; band < Bands; ++band)
  {
    if (this->LeavingFlux[band] > (1.0 + margin) * this->EnteringFlux[band])
    {
      std::ostringstream text;
      text
        << "In component " << band << " " << this->LeavingFlux[band] / this->EnteringFlux[band]
        << " times the light that enters leaves again: the model claims too much where little is "
           "absorbed, or straight links do, across sharp edges and the air between parts of the "
           "body. Compare with Model MonteCarlo, which keeps energy in closed bodies.";
      this->Warn(text.str());
      return;
    }
  }
}

//------------------------------------------------------------------------------
void ProfileRun::CheckThickness() const
{
  const double* worst = std::max_element(this->ThinShares, this->ThinShares + Bands);
  if (*worst > LargestThinShare)
  {
    std::ostringstream text;
    text << "In component " << worst - this->ThinShares << " " << 100.0 * *worst
         << " % of the surface is thinner than two diffusion lengths (DiffusionThickness), where "
            "models of a medium without end claim too much. Use Model MonteCarlo.";
    this->WarnOnce({ text.str() });
  }
}

//------------------------------------------------------------------------------
void ProfileRun::WriteScattered(const SceneOutput& output)
{
  this->ScatteringRun::WriteScattered(output);
  if (this->IsTabulated())
  {
    FieldValues::Add(this->GetOutputFields(), "ProfileError",
      this->Cache.Get().ProfileErrors.data(), Bands);
  }
  this->CheckThickness();
  this->CheckEnergy();
}
} // namespace LightTransport
