// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ProfileRun.h"

#include "Links/LinkCache.h"
#include "Scattering/AirShare.h"
#include "Scattering/ScatteringLinks.h"
#include "Shared/FieldValues.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <vector>

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
  if (this->Owner->GetDropLinksThroughAir() &&
    this->Owner->GetLinkMethod() > vtkSubsurfaceScattering::LINK_METHOD_DENSE)
  {
    return Outcome::Failed(
      "DropLinksThroughAir looks at pairs of patches, and LinkMethod is Uniform "
      "or Adaptive: set it to Auto or Dense, or do not drop links.");
  }
  if (this->Owner->GetNumberOfInputConnections(1) > 0)
  {
    return Outcome::Failed("A medium that varies is connected (input port 1), and Model is a "
                           "profile of uniform media: set Model to MonteCarlo, or disconnect it.");
  }
  if (this->Owner->GetCompressLinks() &&
    (this->Owner->GetLinkMethod() == vtkSubsurfaceScattering::LINK_METHOD_DENSE ||
      this->Owner->GetDropLinksThroughAir()))
  {
    return Outcome::Failed("CompressLinks is on, and links are those of all pairs (LinkMethod "
                           "Dense, or DropLinksThroughAir): only links from clusters are "
                           "compressed. Set LinkMethod to Auto, Uniform or Adaptive and drop no "
                           "links, or switch CompressLinks off.");
  }
  return this->ScatteringRun::Check();
}

//------------------------------------------------------------------------------
const char* ProfileRun::FindUseOfBody() const
{
  return this->Owner->GetDropLinksThroughAir() ? "DropLinksThroughAir"
                                               : this->ScatteringRun::FindUseOfBody();
}

//------------------------------------------------------------------------------
// In an order for clusters, where there may be any: that of links which may be kept.
Outcome ProfileRun::Gather()
{
  return this->Owner->GetLinkMethod() == vtkSubsurfaceScattering::LINK_METHOD_DENSE
    ? this->ScatteringRun::Gather()
    : this->GatherInOrder(PatchScene::Order::Surface,
        this->Cache.FindArrangement(*this->MakeBuilder(), this->AllRanks));
}

//------------------------------------------------------------------------------
// Where patches have moved too far for what was kept, all is arranged and chosen afresh.
Outcome ProfileRun::Link()
{
  Outcome linked = this->ScatteringRun::Link();
  if (linked && !this->Cache.Get().GetExchange())
  {
    linked = this->Gather();
    linked = linked ? this->ReadIrradiance() : linked;
    linked = linked ? this->ScatteringRun::Link() : linked;
  }
  return linked;
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
  const bool refines = this->Owner->GetRefineByIrradiance() &&
    this->Owner->GetLinkMethod() != vtkSubsurfaceScattering::LINK_METHOD_DENSE &&
    !this->Owner->GetDropLinksThroughAir();
  return std::make_unique<ScatteringLinks>(this->Owner->GetModel(), options, this->Media,
    this->Owner->GetMillimetersPerUnit(),
    ScatteringLinkChoice{ this->Owner->GetLinkMethod(), this->Owner->GetNumberOfLinks(),
      this->Owner->GetLinkTolerance(), this->Owner->GetDropLinksThroughAir(),
      this->Owner->GetCompressLinks(), this->Owner->GetCompressionTolerance(),
      this->Owner->GetReuseLinks() && !refines, static_cast<LinkDevice>(this->Owner->GetDevice()),
      refines ? this->Irradiance : std::vector<double>() });
}

//------------------------------------------------------------------------------
/// More than all of it comes back only by an error; of light below 0 nobody can tell.
void ProfileRun::CheckEnergy(const AirShare& air) const
{
  const Links& links = this->Cache.Get();
  const double margin = 1.0 + NegligibleExcess + links.GetSummary("LinkErrorBound") +
    links.GetSummary("LinkError") + links.GetSummary("CompressionError");
  if (*std::min_element(this->Irradiance.begin(), this->Irradiance.end()) < 0.0)
  {
    return;
  }
  std::vector<double> gains;
  std::transform(this->LeavingFlux.begin(), this->LeavingFlux.end(), this->EnteringFlux.begin(),
    std::back_inserter(gains),
    [](double leaving, double entering) { return entering > 0.0 ? leaving / entering : 0.0; });
  const auto worst = std::max_element(gains.begin(), gains.end()) - gains.begin();
  if (gains[worst] > margin)
  {
    const double total = links.ProfileTotals[worst % Bands];
    std::ostringstream text;
    text << "In component " << worst << " " << gains[worst]
         << " times the light that enters leaves again, which cannot be: a flat surface gives back "
         << total << " by this model";
    if (!links.AreThroughAirDropped && air.Shares[worst] > 0.0)
    {
      text << ", " << 100.0 * air.Shares[worst]
           << " % goes through the air between parts of the body (DropLinksThroughAir leaves that "
              "out)";
    }
    if (gains[worst] > total)
    {
      text << ", and straight links claim too much across hollows, sharp edges and thin walls";
    }
    text << ". Compare with Model MonteCarlo, which keeps energy in closed bodies.";
    this->Warn(text.str());
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
  const Links& links = this->Cache.Get();
  FieldValues::Add(this->GetOutputFields(), "ProfileTotal", links.ProfileTotals.data(), Bands);
  if (this->IsTabulated())
  {
    FieldValues::Add(this->GetOutputFields(), "ProfileError", links.ProfileErrors.data(), Bands);
  }
  const AirShare air(links, this->GetEntering(), this->Scattered);
  if (!this->Scene.IsOfTexels())
  {
    FieldValues::Add(this->GetOutputFields(), "LinksThroughAir", air.Shares.data(),
      this->GetNumberOfComponents());
    FieldValues::Add(this->GetOutputFields(), "LinksThroughAirError", air.Errors.data(),
      this->GetNumberOfComponents());
  }
  this->CheckThickness();
  this->CheckEnergy(air);
}
} // namespace LightTransport
