// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectIrradiance.h"

#include "Geometry/SceneRayCaster.h"
#include "Lighting/Environment.h"
#include "Lighting/LightErrors.h"
#include "Lighting/LitParts.h"
#include "Lighting/PunctualLight.h"
#include "Run/TransportRun.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkDirectIrradiance);

namespace
{
/// Calls of the progress function, at least, and rays at most between two of them, by which a user
/// who aborts does not wait. The same on all ranks.
constexpr double LeastBatches = 50.0;
constexpr double RaysOfBatch = 4e6;
// The light as a fraction of the progress.
constexpr double LightDone = 0.97;
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
  LightEffort GetEffort() const;
  vtkIdType GetNumberOfBatches() const;
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
  if (vtkImageData* picture = this->Owner->GetEnvironment(); read && picture)
  {
    auto environment = std::make_unique<Environment>(this->GetEffort());
    read = environment->Read(picture);
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
    PunctualLight light;
    if (Outcome read = light.Read(object, this->Scene); !read)
    {
      return Outcome::Failed(name + read.GetMessage());
    }
    this->Sources.push_back(light.MakeSource(this->GetEffort(), this->Owner->LightAngularDiameter));
  }
  if (this->Sources.empty() && !this->Owner->GetEnvironment())
  {
    this->Warn("No light is on and there is no environment: the irradiance is 0. Add one with "
               "AddLight or SetEnvironment.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
LightEffort vtkDirectIrradiance::Run::GetEffort() const
{
  return { this->Owner->Tolerance, this->Owner->EnvironmentSamples, this->Owner->ShadowSamples };
}

//------------------------------------------------------------------------------
vtkIdType vtkDirectIrradiance::Run::GetNumberOfBatches() const
{
  const auto patches = static_cast<double>(this->Scene.GetAreas().size());
  // A direction of a light costs about as much as ten rays.
  const double rays = this->Owner->GetEnvironment()
    ? 2.0 * this->Owner->EnvironmentSamples * Environment::MostRefined
    : (this->Owner->LightAngularDiameter > 0.0 ? 10.0 : 1.0) * this->Owner->ShadowSamples *
      LitParts::MostRefined;
  return static_cast<vtkIdType>(
    std::max(LeastBatches, std::min(patches, std::ceil(patches * rays / RaysOfBatch))));
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
  const std::vector<vtkIdType> locals = this->Scene.GetLocalPatches();
  const auto count = static_cast<vtkIdType>(locals.size());
  auto compute = [this, &locals](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType local = first; local < last; ++local)
    {
      Pulse::Beat();
      this->ComputePatch(locals[local]);
    }
  };
  const Monitor monitor = this->Progress.GetMonitor().GetStage(0.0, LightDone);
  const vtkIdType batches = this->GetNumberOfBatches();
  for (vtkIdType batch = 0; batch < batches; ++batch)
  {
    const vtkIdType first = count * batch / batches;
    const vtkIdType last = count * (batch + 1) / batches;
    Threads::For(first, last, std::min<vtkIdType>(16, 1 + (last - first) / 16), compute);
    if (!monitor.Report(static_cast<double>(batch + 1) / static_cast<double>(batches)))
    {
      return Outcome::Aborted();
    }
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
vtkDirectIrradiance::vtkDirectIrradiance() : Lights(new LightList)
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkDirectIrradiance::~vtkDirectIrradiance() = default;

//------------------------------------------------------------------------------
void vtkDirectIrradiance::SetEnvironment(vtkImageData* environment)
{
  this->SetInputDataObject(1, environment);
}

//------------------------------------------------------------------------------
vtkImageData* vtkDirectIrradiance::GetEnvironment()
{
  return vtkImageData::SafeDownCast(this->GetInputDataObject(1, 0));
}

//------------------------------------------------------------------------------
int vtkDirectIrradiance::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// Every rank needs the whole picture for its piece of the surface.
int vtkDirectIrradiance::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (vtkInformation* picture = inputs[1]->GetInformationObject(0))
  {
    picture->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    picture->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    picture->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (picture->Has(Pipeline::WHOLE_EXTENT()))
    {
      picture->Set(Pipeline::UPDATE_EXTENT(), picture->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

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
  return time;
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
  os << indent << "Environment: " << this->GetEnvironment() << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EnvironmentSamples: " << this->EnvironmentSamples << "\n";
  os << indent << "ShadowSamples: " << this->ShadowSamples << "\n";
  os << indent << "LightAngularDiameter: " << this->LightAngularDiameter << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
