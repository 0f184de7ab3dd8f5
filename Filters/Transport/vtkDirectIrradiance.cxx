// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectIrradiance.h"

#include "Geometry/SceneRayCaster.h"
#include "Lighting/Environment.h"
#include "Lighting/PunctualLight.h"
#include "Run/TransportRun.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/Threads.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkDirectIrradiance);

namespace
{
/// Calls of the progress function; the same on all ranks.
constexpr int NumberOfBatches = 50;
} // namespace

//------------------------------------------------------------------------------
struct vtkDirectIrradiance::LightList
{
  std::vector<vtkSmartPointer<vtkLight>> Objects;
};

//------------------------------------------------------------------------------
class vtkDirectIrradiance::Run : public TransportRun
{
public:
  Run(vtkDirectIrradiance* owner, const RunPorts& ports)
    : TransportRun(ports), Owner(owner), StartTime(vtkTimerLog::GetUniversalTime())
  {
    this->NumberOfSides = owner->TwoSided ? 2 : 1;
  }

protected:
  Outcome Check() override;
  Outcome Read() override;
  Outcome Compute() override;
  void Write() override;

private:
  Outcome ReadLights();
  void ComputePatch(vtkIdType patch);

  vtkDirectIrradiance* Owner;
  double StartTime;
  std::vector<std::unique_ptr<LightSource>> Sources;
  SceneRayCaster Caster;
  ///@{ patches x bands
  std::vector<double> Incident;
  std::vector<double> Transmitted;
  ///@}
  std::vector<double> Rays; ///< of each patch
};

//------------------------------------------------------------------------------
Outcome vtkDirectIrradiance::Run::Check()
{
  const double index = this->Owner->RefractiveIndex;
  if (!(index >= 1.0) || !std::isfinite(index))
  {
    std::ostringstream text;
    text << "RefractiveIndex is " << index << ": it must be at least 1 (1 for an opaque surface).";
    return Outcome::Failed(text.str());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkDirectIrradiance::Run::Read()
{
  Outcome read = this->ReadLights();
  if (read && this->Owner->Environment)
  {
    auto environment =
      std::make_unique<LightTransport::Environment>(this->Owner->EnvironmentSamples);
    read = environment->Read(this->Owner->Environment);
    this->Sources.push_back(std::move(environment));
  }
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkDirectIrradiance::Run::ReadLights()
{
  for (int index = 0; index < this->Owner->GetNumberOfLights(); ++index)
  {
    vtkLight* object = this->Owner->GetLight(index);
    if (!object->GetSwitch())
    {
      continue;
    }
    const std::string name = "Light " + std::to_string(index);
    if (!object->LightTypeIsSceneLight())
    {
      return Outcome::Failed(name +
        " is a headlight or camera light, which follows a camera, and a filter has none: call "
        "SetLightTypeToSceneLight().");
    }
    auto light = std::make_unique<PunctualLight>(this->Owner->ShadowSamples);
    if (Outcome read = light->Read(object, this->Scene); !read)
    {
      return Outcome::Failed(name + read.GetMessage());
    }
    this->Sources.push_back(std::move(light));
  }
  if (this->Sources.empty() && !this->Owner->Environment)
  {
    this->Warn("No light is on and there is no environment: the irradiance is 0. Add one with "
               "AddLight or SetEnvironment.");
  }
  return Outcome::Done();
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
  this->Rays.assign(patches, 0.0);
  const std::vector<vtkIdType> locals = this->Scene.GetLocalPatches();
  const auto count = static_cast<vtkIdType>(locals.size());
  auto compute = [this, &locals](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType local = first; local < last; ++local)
    {
      this->ComputePatch(locals[local]);
    }
  };
  const Monitor monitor = this->Progress.GetMonitor();
  for (int batch = 0; batch < NumberOfBatches; ++batch)
  {
    Threads::For(count * batch / NumberOfBatches, count * (batch + 1) / NumberOfBatches, 16,
      compute);
    if (!monitor.Report(static_cast<double>(batch + 1) / NumberOfBatches))
    {
      return Outcome::Aborted();
    }
  }
  for (std::vector<double>* values : { &this->Incident, &this->Transmitted, &this->Rays })
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
  std::copy_n(sum.Incident, LightBands, &this->Incident[patch * LightBands]);
  std::copy_n(sum.Transmitted, LightBands, &this->Transmitted[patch * LightBands]);
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
  FieldValues::Add(fields, "DirectIrradianceSeconds",
    vtkTimerLog::GetUniversalTime() - this->StartTime);
}

//------------------------------------------------------------------------------
vtkDirectIrradiance::vtkDirectIrradiance() : Lights(new LightList) {}

//------------------------------------------------------------------------------
vtkDirectIrradiance::~vtkDirectIrradiance()
{
  this->SetEnvironment(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkDirectIrradiance, Environment, vtkImageData);

//------------------------------------------------------------------------------
void vtkDirectIrradiance::AddLight(vtkLight* light)
{
  auto& lights = this->Lights->Objects;
  if (light && std::find(lights.begin(), lights.end(), light) == lights.end())
  {
    lights.emplace_back(light);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::RemoveLight(vtkLight* light)
{
  auto& lights = this->Lights->Objects;
  const auto found = std::find(lights.begin(), lights.end(), light);
  if (found != lights.end())
  {
    lights.erase(found);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::RemoveAllLights()
{
  if (!this->Lights->Objects.empty())
  {
    this->Lights->Objects.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkDirectIrradiance::GetNumberOfLights()
{
  return static_cast<int>(this->Lights->Objects.size());
}

//------------------------------------------------------------------------------
vtkLight* vtkDirectIrradiance::GetLight(int index)
{
  return index >= 0 && index < this->GetNumberOfLights() ? this->Lights->Objects[index].Get()
                                                         : nullptr;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDirectIrradiance::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkLight* light : this->Lights->Objects)
  {
    time = std::max(time, light->GetMTime());
    if (vtkMatrix4x4* matrix = light->GetTransformMatrix())
    {
      time = std::max(time, matrix->GetMTime());
    }
  }
  return this->Environment ? std::max(time, this->Environment->GetMTime()) : time;
}

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkDirectIrradiance::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  os << indent << "Environment: " << this->Environment << "\n";
  os << indent << "EnvironmentSamples: " << this->EnvironmentSamples << "\n";
  os << indent << "ShadowSamples: " << this->ShadowSamples << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
