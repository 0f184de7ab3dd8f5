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
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkTimerLog.h"

#include <algorithm>
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
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

private:
  void ComputePatch(vtkIdType patch);

  vtkSingleScattering* Owner;
  double StartTime;
  std::vector<ScatteringMedium> Media; ///< of each band
  Panorama Environment;
  RayMarcher::Lights Lights;
  std::unique_ptr<RayMarcher> Marcher;
  ///@{ patches x bands
  std::vector<double> Scattered;
  std::vector<double> Error;
  ///@}
};

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
    this->Media[0].RefractiveIndex, this->Lights);
  return this->AllRanks.Agree(this->Marcher->Build());
}

//------------------------------------------------------------------------------
// Each rank looks at its own patches.
Outcome vtkSingleScattering::Run::Compute()
{
  const std::size_t patches = this->Scene.GetAreas().size();
  this->Scattered.assign(patches * LightBands, 0.0);
  this->Error.assign(patches * LightBands, 0.0);
  if (Outcome done = this->ForLocalPatches(RaysOfSample * this->Owner->NumberOfSamples, RaysDone,
        [this](vtkIdType patch) { this->ComputePatch(patch); });
      !done)
  {
    return done;
  }
  this->AllRanks.Sum(this->Scattered);
  this->AllRanks.Sum(this->Error);
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
      const RayMarcher::Sample sample{ outside.GetPoint(shape, k, 0), patch,
        outside.GetDirection(shape.Normal, k, 2), inside.Get(k, 0),
        { inside.Get(k, 1), inside.Get(k, 2) }, k % LightBands };
      double radiance[LightBands] = {};
      this->Marcher->March(sample, radiance);
      sum.Add(radiance, vtkMath::Pi(), 0.0);
    });
  const LightSum light = mean.GetMean(false, Evenness);
  std::copy_n(light.Incident, LightBands, &this->Scattered[patch * LightBands]);
  std::transform(light.Variance, light.Variance + LightBands, &this->Error[patch * LightBands],
    [](double variance) { return std::sqrt(variance); });
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
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
}
