// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSingleScattering.h"

#include "Geometry/PatchSampler.h"
#include "Lighting/LightErrors.h"
#include "Lighting/LightingRun.h"
#include "Lighting/Panorama.h"
#include "Lighting/SampleMean.h"
#include "Marching/RayMarcher.h"
#include "Photons/ClosedSurface.h"
#include "Photons/PhotonScattering.h"
#include "Scattering/MediumProperties.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/Pulse.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkSingleScattering);

namespace
{
// The rays as a fraction of the progress.
constexpr double RaysDone = 0.97;
// A sample costs about as much as this many rays to an environment.
constexpr double RaysOfSample = 10.0;
// Errors over the spread of blocks of samples: 0.7 to 1.05. In seven dimensions samples are hardly
// more even together than in blocks.
constexpr double Evenness = 1.0;

//------------------------------------------------------------------------------
// Of random numbers, for a sample of a patch. (Samples of both ways have keys of their own.)
std::uint64_t GetStream(std::uint64_t key, int sample)
{
  return (key << 20) + static_cast<std::uint64_t>(sample);
}
} // namespace

//------------------------------------------------------------------------------
class vtkSingleScattering::Run : public LightingRun
{
public:
  Run(vtkSingleScattering* owner, const RunPorts& ports)
    : LightingRun(owner, ports), Owner(owner), StartTime(vtkTimerLog::GetUniversalTime())
  {
  }

protected:
  NumberProperties::List ListNumbers() const override;
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

private:
  /// Flux that leaves a patch.
  struct Arrival
  {
    vtkIdType Patch;
    std::array<double, LightBands> Flux;
  };

  void ComputePatch(vtkIdType patch);
  void FollowReflections(vtkIdType patch, const Polygon& shape);
  void AddReflections(vtkIdType patch);

  vtkSingleScattering* Owner;
  double StartTime;
  std::vector<ScatteringMedium> Media; ///< of each band
  Panorama Environment;
  RayMarcher::Lights Lights;
  std::unique_ptr<RayMarcher> Marcher;
  ///@{ patches x bands
  std::vector<double> Scattered;
  std::vector<double> Error; ///< its square, until all is added
  /// Of what was reflected before it was scattered.
  std::vector<double> Reflected;
  std::vector<double> ReflectedVariance;
  ///@}
  /// From light that enters each patch and is reflected first, until it is added.
  std::vector<std::vector<Arrival>> Reflections;
};

//------------------------------------------------------------------------------
NumberProperties::List vtkSingleScattering::Run::ListNumbers() const
{
  NumberProperties::List numbers = this->LightingRun::ListNumbers();
  numbers.emplace_back("MinimumContribution", this->Owner->MinimumContribution);
  return numbers;
}

//------------------------------------------------------------------------------
Outcome vtkSingleScattering::Run::Check()
{
  const MediumProperties properties{ this->Owner->Material, this->Owner->ScatteringCoefficient,
    this->Owner->AbsorptionCoefficient, this->Owner->RefractiveIndex, this->Owner->Anisotropy,
    this->Owner->MillimetersPerUnit };
  return properties.MakeMedia(this->Media);
}

//------------------------------------------------------------------------------
Outcome vtkSingleScattering::Run::Read()
{
  Outcome read = this->ReadLights(this->Lights.Punctual);
  if (vtkImageData* picture = this->Owner->GetEnvironment(); read && picture)
  {
    read = this->Environment.Read(picture);
    this->Lights.Environment = &this->Environment;
  }
  this->Lights.Radius = 0.5 * vtkMath::RadiansFromDegrees(this->Owner->LightAngularDiameter);
  this->Lights.HasShadows = this->Owner->Shadows;
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkSingleScattering::Run::Link()
{
  if (Outcome closed = ClosedSurface::Check(this->Scene); !closed)
  {
    return closed;
  }
  this->Marcher = std::make_unique<RayMarcher>(this->Scene,
    PhotonScattering::GetMedia(this->Media,
      this->Scene.GetScale() * this->Owner->MillimetersPerUnit),
    this->Media[0].RefractiveIndex, this->Lights, this->Owner->MinimumContribution);
  return this->AllRanks.Agree(this->Marcher->Build());
}

//------------------------------------------------------------------------------
// Each rank looks at its own patches.
Outcome vtkSingleScattering::Run::Compute()
{
  const std::size_t patches = this->Scene.GetAreas().size();
  this->Scattered.assign(patches * LightBands, 0.0);
  this->Error.assign(patches * LightBands, 0.0);
  this->Reflected.assign(patches * LightBands, 0.0);
  this->ReflectedVariance.assign(patches * LightBands, 0.0);
  this->Reflections.resize(patches);
  if (Outcome done = this->ForLocalPatches(
        RaysOfSample * this->Owner->NumberOfSamples, RaysDone,
        [this](vtkIdType patch) { this->ComputePatch(patch); },
        [this](vtkIdType patch) { this->AddReflections(patch); });
      !done)
  {
    return done;
  }
  for (std::size_t k = 0; k < this->Scattered.size(); ++k)
  {
    this->Scattered[k] += this->Reflected[k];
    this->Error[k] += this->ReflectedVariance[k];
  }
  this->AllRanks.Sum(this->Scattered);
  this->AllRanks.Sum(this->Error);
  for (double& error : this->Error)
  {
    error = std::sqrt(error);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Points and directions outside are even in projected solid angle: exitance is pi times the mean
// radiance. What is chosen inside has numbers of its own.
void vtkSingleScattering::Run::ComputePatch(vtkIdType patch)
{
  Polygon shape;
  shape.Set(this->Scene, patch);
  const auto key = static_cast<std::uint64_t>(patch);
  const PatchSampler outside(key);
  const ShuffledSampler inside(key);
  SampleMean mean(this->Owner->NumberOfSamples);
  mean.Fill(
    [&](int k, LightSum& sum)
    {
      Pulse::Beat();
      const RayMarcher::Sample sample{ outside.GetPoint(shape, k, 0), patch,
        outside.GetDirection(shape.Normal, k, 2), inside.Get(k, 0),
        { inside.Get(k, 1), inside.Get(k, 2) }, k % LightBands, GetStream(key, k) };
      double radiance[LightBands] = {};
      this->Marcher->March(sample, radiance);
      sum.Add(radiance, vtkMath::Pi(), 0.0);
    });
  const LightSum light = mean.GetMean(false, Evenness);
  for (int band = 0; band < LightBands; ++band)
  {
    this->Scattered[patch * LightBands + band] = light.Incident[band];
    this->Error[patch * LightBands + band] = light.Variance[band];
  }
  if (this->Marcher->HasReflections())
  {
    this->FollowReflections(patch, shape);
  }
}

//------------------------------------------------------------------------------
// Kept until it can be added: sums do not depend on threads.
void vtkSingleScattering::Run::FollowReflections(vtkIdType patch, const Polygon& shape)
{
  const int samples = this->Owner->NumberOfSamples;
  const auto key = static_cast<std::uint64_t>(patch + this->Scene.GetNumberOfPatches());
  const PatchSampler surface(key);
  const ShuffledSampler inside(key);
  std::vector<Arrival>& arrivals = this->Reflections[patch];
  const auto receive = [&arrivals](vtkIdType to, const double* flux) {
    arrivals.push_back({ to, { flux[0], flux[1], flux[2] } });
  };
  for (int k = 0; k < samples; ++k)
  {
    Pulse::Beat();
    const RayMarcher::Entrance entrance{ surface.GetPoint(shape, k, 0), patch,
      this->Scene.GetAreas()[patch] / samples, inside.Get(k, 3), inside.Get(k, 0),
      { inside.Get(k, 1), inside.Get(k, 2) }, { surface.Get(k, 2), surface.Get(k, 3) },
      k % LightBands, GetStream(key, k) };
    this->Marcher->Shine(entrance, receive);
  }
}

//------------------------------------------------------------------------------
void vtkSingleScattering::Run::AddReflections(vtkIdType patch)
{
  for (const Arrival& arrival : this->Reflections[patch])
  {
    const double area = this->Scene.GetAreas()[arrival.Patch];
    for (int band = 0; band < LightBands; ++band)
    {
      const double exitance = arrival.Flux[band] / area;
      this->Reflected[arrival.Patch * LightBands + band] += exitance;
      this->ReflectedVariance[arrival.Patch * LightBands + band] += exitance * exitance;
    }
  }
  std::vector<Arrival>().swap(this->Reflections[patch]);
}

//------------------------------------------------------------------------------
void vtkSingleScattering::Run::Write()
{
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle);
  const SceneOutput output(this->Scene, &points, this->Input, this->Output);
  output.AddArray(ArrayNames::SingleScatteredIrradiance, this->Scattered, LightBands);
  output.AddArray(ArrayNames::SingleScatteredIrradianceError, this->Error, LightBands);
  double flux[LightBands] = {};
  for (std::size_t k = 0; k < this->Scattered.size(); ++k)
  {
    flux[k % LightBands] +=
      this->GetAreaUnit() * this->Scene.GetAreas()[k / LightBands] * this->Scattered[k];
  }
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, "SingleScatteredFlux", flux, LightBands);
  const LightErrors errors(this->Scene, this->Scattered, this->Error,
    std::vector<double>(this->Scene.GetAreas().size(), 1.0));
  FieldValues::Add(fields, ArrayNames::SingleScatteredIrradianceError, errors.GetTotal());
  FieldValues::Add(fields, "SingleScatteringSeconds",
    vtkTimerLog::GetUniversalTime() - this->StartTime);
}

//------------------------------------------------------------------------------
vtkSingleScattering::vtkSingleScattering() = default;

//------------------------------------------------------------------------------
vtkSingleScattering::~vtkSingleScattering() = default;

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkSingleScattering::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
void vtkSingleScattering::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto print = [&os, &indent](const char* name, const double* values)
  { os << indent << name << ": " << values[0] << ", " << values[1] << ", " << values[2] << "\n"; };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material: " << this->Material << "\n";
  print("ScatteringCoefficient", this->ScatteringCoefficient);
  print("AbsorptionCoefficient", this->AbsorptionCoefficient);
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
  os << indent << "MillimetersPerUnit: " << this->MillimetersPerUnit << "\n";
  print("Anisotropy", this->Anisotropy);
  os << indent << "MinimumContribution: " << this->MinimumContribution << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
}
