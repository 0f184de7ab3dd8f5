// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/MonteCarloRun.h"

#include "Links/LinkCache.h"
#include "Photons/ClosedSurface.h"
#include "Photons/PhotonLinks.h"
#include "Scene/SceneOutput.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTable.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <sstream>

namespace LightTransport
{
namespace
{
// Light that photons lose on their way: of less nobody need know, and with more nothing is known. A
// few of them may be chance.
constexpr double LostShareToTell = 1e-4;
constexpr double LostShareToFail = 0.02;
constexpr double LostPhotonsToTell = 3.0;
// Free paths from end to end of the scene that are finer than coordinates are worth.
constexpr double MostFreePaths = 1e6;

//------------------------------------------------------------------------------
double GetLargest(const std::vector<double>& values)
{
  return *std::max_element(values.begin(), values.end());
}
} // namespace

//------------------------------------------------------------------------------
bool MonteCarloRun::FollowsPhotons() const
{
  return this->Owner->GetLinkMethod() == vtkSubsurfaceScattering::LINK_METHOD_AUTO;
}

//------------------------------------------------------------------------------
PhotonScattering::Settings MonteCarloRun::GetSettings() const
{
  return { this->Owner->GetTargetError(), this->Owner->GetNumberOfPhotons(),
    static_cast<std::uint64_t>(this->Owner->GetSeed()) };
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::Check()
{
  if (const int method = this->Owner->GetLinkMethod();
      method == vtkSubsurfaceScattering::LINK_METHOD_UNIFORM ||
      method == vtkSubsurfaceScattering::LINK_METHOD_ADAPTIVE)
  {
    return Outcome::Failed("LinkMethod is Uniform or Adaptive, links between clusters, which Model "
                           "MonteCarlo has not: set it to Auto, or to Dense for links that are "
                           "kept.");
  }
  if (this->FollowsPhotons() && this->Owner->GetDevice() == vtkSubsurfaceScattering::DEVICE_OPENGL)
  {
    return Outcome::Failed("Device is OpenGL, which applies links: photons are followed on the "
                           "CPU. Set Device to Auto, or LinkMethod to Dense.");
  }
  return this->ScatteringRun::Check();
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::Read()
{
  Outcome read = this->ScatteringRun::Read();
  if (read && this->FollowsPhotons() && this->GetNumberOfLights() > 1)
  {
    return Outcome::Failed("The irradiance is that of " +
      std::to_string(this->GetNumberOfLights()) +
      " lights, and photons are followed from one: set LinkMethod to Dense, for links of photons "
      "that any light goes through.");
  }
  return read ? this->ReadMedium() : read;
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::ReadMedium()
{
  if (this->Owner->GetNumberOfInputConnections(1) == 0)
  {
    return Outcome::Done();
  }
  vtkDataObject* medium = this->Owner->GetInputDataObject(1, 0);
  auto* image = vtkImageData::SafeDownCast(medium);
  if (!image)
  {
    return Outcome::Failed(std::string("The medium (input port 1) is a ") +
      (medium ? medium->GetClassName() : "connection without data") +
      ": it must be one vtkImageData. Extract the block that has it.");
  }
  const double scale = this->Scene.GetScale();
  this->Image = std::make_unique<MediumImage>();
  Outcome read = this->Image->Read(image,
    { this->Scene.GetCenter(), scale, scale * this->Owner->GetMillimetersPerUnit() });
  if (!read)
  {
    return read;
  }
  const std::vector<std::uint64_t> all =
    this->AllRanks.Gather(std::vector<std::uint64_t>{ this->Image->GetFingerprint() });
  return std::equal(all.begin() + 1, all.end(), all.begin())
    ? Outcome::Done()
    : Outcome::Failed("The medium is not the same on all ranks: each of them needs all of it. Give "
                      "it by a source or a reader that makes any part of it, as that of .vti "
                      "files does.");
}

//------------------------------------------------------------------------------
std::unique_ptr<LinkBuilder> MonteCarloRun::MakeBuilder() const
{
  return std::make_unique<PhotonLinks>(this->Media, this->Owner->GetMillimetersPerUnit(),
    this->GetSettings(), this->Image.get());
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::Link()
{
  this->CheckSize();
  if (this->FollowsPhotons())
  {
    return ClosedSurface::Check(this->Scene);
  }
  Outcome linked = this->ScatteringRun::Link();
  return linked ? this->CheckLost(this->Cache.Get().GetSummary("LostShare"),
                    this->Cache.Get().GetSummary("PhotonsTraced"))
                : linked;
}

//------------------------------------------------------------------------------
void MonteCarloRun::CheckSize() const
{
  double largest = 0.0;
  for (const PhotonMedium& medium : this->GetMedia())
  {
    largest = std::max(largest, medium.GetExtinction());
  }
  if (largest > MostFreePaths)
  {
    std::ostringstream text;
    text << "The surface is " << largest << " free paths from end to end. More than "
         << MostFreePaths
         << " are finer than its coordinates are worth: some percent of the light may be missing "
            "or too much. Check MillimetersPerUnit, or use Model Tabulated.";
    this->WarnOnce({ text.str() });
  }
}

//------------------------------------------------------------------------------
std::vector<PhotonMedium> MonteCarloRun::GetMedia() const
{
  return PhotonScattering::GetMedia(this->Media,
    this->Scene.GetScale() * this->Owner->GetMillimetersPerUnit());
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::Scatter()
{
  return this->FollowsPhotons() ? this->FollowPhotons() : this->ApplyWithErrors();
}

//------------------------------------------------------------------------------
Outcome MonteCarloRun::FollowPhotons()
{
  const std::vector<double> entering = this->GetEntering();
  if (std::any_of(entering.begin(), entering.end(), [](double light) { return light < 0.0; }))
  {
    return Outcome::Failed("The irradiance is negative on some polygons, which photons cannot be: "
                           "set LinkMethod to Dense for differences of light.");
  }
  const PhotonScattering scattering(this->Scene, this->GetMedia(), this->Media[0].RefractiveIndex,
    this->Image.get());
  Outcome done = scattering.Run(entering, this->GetSettings(), this->AllRanks,
    this->Progress.GetMonitor().GetStage(0.0, LinksDone), this->Photons);
  this->DeviceUsed = "CPU";
  this->DeviceExplanation = "photons are followed on the CPU";
  return done ? this->CheckLost(GetLargest(this->Photons.LostShares),
                  static_cast<double>(this->Photons.Photons))
              : done;
}

//------------------------------------------------------------------------------
// Links are counts of photons, whose variance is a product of the same links: the squares go
// through them beside the light.
Outcome MonteCarloRun::ApplyWithErrors()
{
  const std::vector<double> light = this->GetEntering();
  const auto components = static_cast<std::size_t>(this->GetNumberOfComponents());
  std::vector<double> both;
  both.reserve(2 * light.size());
  for (std::size_t first = 0; first < light.size(); first += components)
  {
    both.insert(both.end(), &light[first], &light[first] + components);
    std::transform(&light[first], &light[first] + components, std::back_inserter(both),
      [](double e) { return e * e; });
  }
  Outcome applied = this->ApplyLinks(both, 2 * this->GetNumberOfLights());
  if (applied)
  {
    std::vector<double> squares;
    for (std::size_t first = 0; first < both.size(); first += 2 * components)
    {
      const double* values = &both[first];
      this->Scattered.insert(this->Scattered.end(), values, values + components);
      squares.insert(squares.end(), values + components, values + 2 * components);
    }
    this->Errors =
      PhotonLinks::GetErrors(this->Cache.Get(), light, this->Scattered, squares, this->AllRanks);
  }
  return applied;
}

//------------------------------------------------------------------------------
// Of the light that photons have lost.
Outcome MonteCarloRun::CheckLost(double share, double photons) const
{
  std::ostringstream text;
  text
    << 100.0 * share
    << " % of the light is lost on its way: the surface crosses itself, or photons are scattered "
       "more than "
    << PhotonWalk::MostScatterings
    << " times. Unite its parts (vtkPatchMesher with Repair), or check MillimetersPerUnit.";
  if (share > LostShareToFail)
  {
    return Outcome::Failed(text.str());
  }
  if (share > LostShareToTell && share * photons > LostPhotonsToTell)
  {
    this->WarnOnce({ text.str() });
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void MonteCarloRun::SumLeaving()
{
  this->ScatteringRun::SumLeaving();
  for (std::size_t k = 0; k < this->Photons.Scattered.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetFaces().GetArea(k / Bands);
    this->LeavingFlux[k % Bands] += area * this->Photons.Scattered[k];
  }
}

//------------------------------------------------------------------------------
void MonteCarloRun::WriteScattered(const SceneOutput& output)
{
  if (this->FollowsPhotons())
  {
    this->WritePhotons(output);
    return;
  }
  this->ScatteringRun::WriteScattered(output);
  output.AddArray(ArrayNames::ScatteredIrradianceError, this->Errors,
    this->GetNumberOfComponents());
}

//------------------------------------------------------------------------------
void MonteCarloRun::WritePhotons(const SceneOutput& output) const
{
  const PhotonScattering::Result& photons = this->Photons;
  output.AddFaceArray(ArrayNames::ScatteredIrradiance, photons.Scattered, Bands);
  output.AddFaceArray(ArrayNames::ScatteredIrradianceError, photons.Errors, Bands);
  const double count = std::max<double>(photons.Photons, 1.0);
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, "LeavingShare", photons.LeavingShares.data(), Bands);
  FieldValues::Add(fields, "LeavingShareError", photons.LeavingShareErrors.data(), Bands);
  FieldValues::Add(fields, "UnscatteredShare", photons.UnscatteredShares.data(), Bands);
  FieldValues::Add(fields, "LostShare", photons.LostShares.data(), Bands);
  FieldValues::Add(fields, "RelativeError", photons.RelativeErrors.data(), Bands);
  FieldValues::Add(fields, "PhotonsTraced", static_cast<double>(photons.Photons));
  FieldValues::Add(fields, "ScatteringsPerPhoton", photons.Counts.Scatterings / count);
  FieldValues::Add(fields, "EntriesPerPhoton", photons.Counts.Entries / count);
  FieldValues::Add(fields, "WalkSeconds", this->ApplySeconds);

  this->Table->Initialize();
  vtkFieldData* row = this->Table->GetRowData();
  FieldValues::Add(row, "Photons", static_cast<double>(photons.Photons));
  FieldValues::Add(row, "WalkSeconds", this->ApplySeconds);
  FieldValues::Add(row, "Error", GetLargest(photons.RelativeErrors));
}
} // namespace LightTransport
