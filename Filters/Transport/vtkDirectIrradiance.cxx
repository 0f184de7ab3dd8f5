// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectIrradiance.h"

#include "Geometry/SceneRayCaster.h"
#include "Lighting/Environment.h"
#include "Lighting/LightErrors.h"
#include "Lighting/LightingRun.h"
#include "Lighting/LitParts.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkDirectIrradiance);

namespace
{
// The light as a fraction of the progress.
constexpr double LightDone = 0.97;
} // namespace

//------------------------------------------------------------------------------
class vtkDirectIrradiance::Run : public LightingRun
{
public:
  Run(vtkDirectIrradiance* owner, const RunPorts& ports)
    : LightingRun(owner, ports), Owner(owner), StartTime(vtkTimerLog::GetUniversalTime())
  {
    this->NumberOfSides = owner->TwoSided ? 2 : 1;
  }

protected:
  NumberProperties::List ListNumbers() const override;
  Outcome Check() override;
  Outcome Read() override;
  Outcome Compute() override;
  void Write() override;

private:
  LightEffort GetEffort() const;
  double GetMostRays() const;
  void ComputePatch(vtkIdType patch);
  void WriteErrors();

  vtkDirectIrradiance* Owner;
  double StartTime;
  std::vector<std::unique_ptr<LightSource>> Sources;
  SceneRayCaster Caster;
  ///@{ patches x bands
  std::vector<double> Incident;
  std::vector<double> Transmitted;
  std::vector<double> Error;
  ///@}
  ///@{ of each patch
  std::vector<double> Rays;
  std::vector<double> Unshadowed;
  ///@}
};

//------------------------------------------------------------------------------
NumberProperties::List vtkDirectIrradiance::Run::ListNumbers() const
{
  NumberProperties::List numbers = this->LightingRun::ListNumbers();
  numbers.emplace_back("Tolerance", this->Owner->Tolerance);
  return numbers;
}

//------------------------------------------------------------------------------
Outcome vtkDirectIrradiance::Run::Check()
{
  return TransportRun::CheckRefractiveIndex(this->Owner->RefractiveIndex);
}

//------------------------------------------------------------------------------
Outcome vtkDirectIrradiance::Run::Read()
{
  std::vector<PunctualLight> lights;
  Outcome read = this->ReadLights(lights);
  for (const PunctualLight& light : lights)
  {
    this->Sources.push_back(light.MakeSource(this->GetEffort(), this->Owner->LightAngularDiameter));
  }
  if (vtkImageData* picture = this->Owner->GetEnvironment(); read && picture)
  {
    auto environment = std::make_unique<Environment>(this->GetEffort());
    read = environment->Read(picture);
    this->Sources.push_back(std::move(environment));
  }
  return read;
}

//------------------------------------------------------------------------------
LightEffort vtkDirectIrradiance::Run::GetEffort() const
{
  return { this->Owner->Tolerance, this->Owner->EnvironmentSamples, this->Owner->ShadowSamples };
}

//------------------------------------------------------------------------------
// Of a patch, about.
double vtkDirectIrradiance::Run::GetMostRays() const
{
  // A direction of a light costs about as much as ten rays.
  return this->Owner->GetEnvironment()
    ? 2.0 * this->Owner->EnvironmentSamples * Environment::MostRefined
    : (this->Owner->LightAngularDiameter > 0.0 ? 10.0 : 1.0) * this->Owner->ShadowSamples *
      LitParts::MostRefined;
}

//------------------------------------------------------------------------------
// Each rank lights its own patches.
Outcome vtkDirectIrradiance::Run::Compute()
{
  const Outcome built = this->Owner->Shadows ? this->Caster.Build(this->Scene) : Outcome::Done();
  if (Outcome agreed = this->AllRanks.Agree(built); !agreed)
  {
    return agreed;
  }
  const std::size_t patches = this->Scene.GetAreas().size();
  this->Incident.assign(patches * LightBands, 0.0);
  this->Transmitted.assign(patches * LightBands, 0.0);
  this->Error.assign(patches * LightBands, 0.0);
  this->Rays.assign(patches, 0.0);
  this->Unshadowed.assign(patches, 0.0);
  if (Outcome lit = this->ForLocalPatches(this->GetMostRays(), LightDone,
        [this](vtkIdType patch) { this->ComputePatch(patch); });
      !lit)
  {
    return lit;
  }
  for (std::vector<double>* values :
    { &this->Incident, &this->Transmitted, &this->Error, &this->Rays, &this->Unshadowed })
  {
    this->AllRanks.Sum(*values);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Run::ComputePatch(vtkIdType patch)
{
  const LitPatch lit(this->Scene, this->Owner->Shadows ? &this->Caster : nullptr,
    this->Owner->RefractiveIndex, patch);
  LightSum sum;
  for (const auto& source : this->Sources)
  {
    this->Rays[patch] += source->Light(lit, sum);
  }
  this->Unshadowed[patch] = sum.GetLargestUnshadowed();
  std::copy_n(sum.Incident, LightBands, &this->Incident[patch * LightBands]);
  std::copy_n(sum.Transmitted, LightBands, &this->Transmitted[patch * LightBands]);
  std::transform(sum.Variance, sum.Variance + LightBands, &this->Error[patch * LightBands],
    [](double variance) { return std::sqrt(variance); });
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Run::Write()
{
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle);
  const SceneOutput output(this->Scene, &points, this->Input, this->Output);
  output.AddArray(ArrayNames::DirectIrradiance, this->Incident, LightBands);
  vtkFieldData* fields = this->GetOutputFields();
  if (this->Owner->RefractiveIndex > 1.0)
  {
    output.AddArray(ArrayNames::TransmittedIrradiance, this->Transmitted, LightBands);
    FieldValues::Add(fields, ArrayNames::RefractiveIndex, this->Owner->RefractiveIndex);
  }
  double rays = 0.0;
  double flux[LightBands] = {};
  for (std::size_t patch = 0; patch < this->Rays.size(); ++patch)
  {
    rays += this->Rays[patch];
    for (int band = 0; band < LightBands; ++band)
    {
      flux[band] += this->GetAreaUnit() * this->Scene.GetAreas()[patch] *
        this->Incident[patch * LightBands + band];
    }
  }
  FieldValues::Add(fields, "DirectFlux", flux, LightBands);
  FieldValues::Add(fields, "DirectIrradianceRays", this->Owner->Shadows ? rays : 0.0);
  output.AddArray(ArrayNames::DirectIrradianceError, this->Error, LightBands);
  this->WriteErrors();
  FieldValues::Add(fields, "DirectIrradianceSeconds",
    vtkTimerLog::GetUniversalTime() - this->StartTime);
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Run::WriteErrors()
{
  const LightErrors errors(this->Scene, this->Incident, this->Error, this->Unshadowed);
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, ArrayNames::DirectIrradianceError, errors.GetTotal());
  FieldValues::Add(fields, "LargestDirectIrradianceError", errors.GetLargest());
  const std::string warning = errors.Describe(this->Owner->Tolerance,
    this->Owner->GetEnvironment() ? "EnvironmentSamples" : "ShadowSamples");
  if (!warning.empty())
  {
    this->Warn(warning);
  }
}

//------------------------------------------------------------------------------
vtkDirectIrradiance::vtkDirectIrradiance() = default;

//------------------------------------------------------------------------------
vtkDirectIrradiance::~vtkDirectIrradiance() = default;

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkDirectIrradiance::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EnvironmentSamples: " << this->EnvironmentSamples << "\n";
  os << indent << "ShadowSamples: " << this->ShadowSamples << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
