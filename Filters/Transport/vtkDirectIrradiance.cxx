// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectIrradiance.h"

#include "Geometry/PatchSampler.h"
#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Fresnel.h"
#include "Shared/Threads.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTimerLog.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkDirectIrradiance);

namespace
{
using Vector = PatchScene::Vector;

constexpr int Bands = 3;
/// Points on a patch where the first ones disagree, over their number.
constexpr int Refinement = 16;
/// Longer than the scene, whose bounding box has diagonal 1.
constexpr double OutOfScene = 2.0;
/// Shadow rays end so far in front of a light: a lamp that touches a surface is not behind it.
constexpr double Clearance = 1e-6;
/// Calls of the progress function; the same on all ranks.
constexpr int NumberOfBatches = 50;

//------------------------------------------------------------------------------
/// A light, in the scene's coordinates.
struct Light
{
  bool Positional;
  Vector Position;
  /// Unit vector from the light to its focal point.
  Vector Axis;
  double Color[Bands];
  double Attenuation[3];
  double ConeCosine;
  double Exponent;
};

//------------------------------------------------------------------------------
/// Returns nullptr, or what is wrong with the light and the remedy.
const char* ConvertLight(vtkLight* object, const PatchScene& scene, Light& light)
{
  double position[3];
  double focus[3];
  object->GetTransformedPosition(position);
  object->GetTransformedFocalPoint(focus);
  light.Positional = object->GetPositional() != 0;
  light.Position = (Vector(position) - scene.GetCenter()) / scene.GetScale();
  light.Axis = Vector(focus) - Vector(position);
  const double* attenuation = object->GetAttenuationValues();
  std::copy_n(attenuation, 3, light.Attenuation);
  const bool cone = light.Positional && object->GetConeAngle() < 90.0;
  light.ConeCosine = cone ? std::cos(vtkMath::RadiansFromDegrees(object->GetConeAngle())) : 0.0;
  light.Exponent = object->GetExponent();
  double strength = object->GetIntensity();
  for (int band = 0; band < Bands; ++band)
  {
    light.Color[band] = object->GetIntensity() * object->GetDiffuseColor()[band];
    strength = std::min(strength, light.Color[band]);
  }
  const double smallest = *std::min_element(attenuation, attenuation + 3);
  const double sum = attenuation[0] + attenuation[1] + attenuation[2];
  if (!(strength >= 0.0) || !std::isfinite(light.Color[0] + light.Color[1] + light.Color[2]) ||
    !(smallest >= 0.0) || !(sum > 0.0) || !std::isfinite(sum))
  {
    return " has an intensity, color or attenuation that is negative or not finite, or no "
           "attenuation value above 0: correct them.";
  }
  if ((!light.Positional || cone) && !(light.Axis.norm() > 0.0))
  {
    return " has its focal point at its position and so no direction: move one of them.";
  }
  light.Axis.normalize();
  return nullptr;
}

//------------------------------------------------------------------------------
/// Radiance by longitude and latitude.
struct RadianceMap
{
  int Width = 0;
  int Height = 0;
  std::vector<double> Values;

  bool IsEmpty() const { return this->Values.empty(); }

  void Evaluate(const Vector& direction, double radiance[Bands]) const
  {
    const double longitude = std::atan2(direction.y(), direction.x()) / (2.0 * vtkMath::Pi());
    const double latitude =
      std::asin(std::min(1.0, std::max(-1.0, direction.z()))) / vtkMath::Pi() + 0.5;
    const double x = (longitude < 0.0 ? longitude + 1.0 : longitude) * this->Width - 0.5;
    const double y = std::min(std::max(latitude * this->Height - 0.5, 0.0), this->Height - 1.0);
    const int column = static_cast<int>(std::floor(x));
    const int row = std::min(static_cast<int>(y), std::max(0, this->Height - 2));
    const double right = x - column;
    const double up = y - row;
    const int columns[2] = { (column + this->Width) % this->Width,
      (column + 1 + this->Width) % this->Width };
    const int rows[2] = { row, std::min(row + 1, this->Height - 1) };
    for (int band = 0; band < Bands; ++band)
    {
      const auto at = [&](int i, int j)
      { return this->Values[(rows[j] * this->Width + columns[i]) * Bands + band]; };
      radiance[band] = (1.0 - up) * ((1.0 - right) * at(0, 0) + right * at(1, 0)) +
        up * ((1.0 - right) * at(0, 1) + right * at(1, 1));
    }
  }
};

//------------------------------------------------------------------------------
/// Evenly spread points of a patch.
struct PatchPoints
{
  PolygonExchange::Polygon Polygon;
  PatchSampler Sampler;

  PatchPoints(const PatchScene& scene, vtkIdType patch) : Sampler(static_cast<std::uint64_t>(patch))
  {
    PolygonExchange::MakePolygon(scene, patch, this->Polygon);
  }

  Vector Get(int k) const { return this->Sampler.GetPoint(this->Polygon, k, 0); }
};

//------------------------------------------------------------------------------
/// What one light or the environment gives a patch.
struct Sum
{
  double Incident[Bands] = {};
  double Transmitted[Bands] = {};

  void Add(const double* values, double weight, double transmittance)
  {
    for (int band = 0; band < Bands; ++band)
    {
      this->Incident[band] += weight * values[band];
      this->Transmitted[band] += weight * transmittance * values[band];
    }
  }
};
} // namespace

//------------------------------------------------------------------------------
struct vtkDirectIrradiance::Internals
{
  std::vector<vtkSmartPointer<vtkLight>> LightObjects;

  PatchScene Scene;
  SceneRayCaster Caster;
  std::vector<Light> Lights;
  RadianceMap Surroundings;

  bool Shadows = true;
  int ShadowSamples = 16;
  int EnvironmentSamples = 256;
  double RefractiveIndex = 1.0;

  std::vector<double> Incident;
  std::vector<double> Transmitted;
  std::vector<double> Rays;

  bool IsBlocked(const Vector& point, const Vector& target, vtkIdType patch) const
  {
    return this->Shadows && this->Caster.IsOccluded(point, target, patch, -1);
  }

  /// Irradiance at normal incidence over Color, cosine and shadow included; 0 in the shadow or
  /// behind.
  double LightPoint(const Light& light, const Vector& point, vtkIdType patch, double& cosine) const;
  bool LightPatch(const Light& light, const PatchPoints& points, vtkIdType patch, bool refined,
    Sum& sum) const;
  void AddLight(const Light& light, const PatchPoints& points, vtkIdType patch, Sum& sum);
  void AddEnvironment(const PatchPoints& points, vtkIdType patch, Sum& sum);
  void ComputePatch(vtkIdType patch);
};

//------------------------------------------------------------------------------
double vtkDirectIrradiance::Internals::LightPoint(const Light& light, const Vector& point,
  vtkIdType patch, double& cosine) const
{
  Vector towards = -light.Axis;
  double strength = 1.0;
  double reach = OutOfScene;
  if (light.Positional)
  {
    const Vector path = light.Position - point;
    const double distance = path.norm();
    towards = path / distance;
    reach = std::min(reach, std::max(0.0, distance - Clearance));
    const double length = distance * this->Scene.GetScale();
    strength = 1.0 /
      (light.Attenuation[0] + length * (light.Attenuation[1] + length * light.Attenuation[2]));
    if (light.ConeCosine > 0.0)
    {
      const double axial = -towards.dot(light.Axis);
      strength *= axial >= light.ConeCosine ? std::pow(axial, light.Exponent) : 0.0;
    }
  }
  cosine = towards.dot(this->Scene.GetNormal(patch));
  if (!(cosine > 0.0) || strength == 0.0)
  {
    return 0.0;
  }
  return this->IsBlocked(point, point + reach * towards, patch) ? 0.0 : strength * cosine;
}

//------------------------------------------------------------------------------
/// Returns false where the points disagree.
bool vtkDirectIrradiance::Internals::LightPatch(const Light& light, const PatchPoints& points,
  vtkIdType patch, bool refined, Sum& sum) const
{
  const int count = this->ShadowSamples * (refined ? Refinement : 1);
  double smallest = VTK_DOUBLE_MAX;
  double largest = 0.0;
  for (int k = 0; k < count; ++k)
  {
    double cosine = 0.0;
    const double strength = this->LightPoint(light, points.Get(k), patch, cosine);
    smallest = std::min(smallest, strength);
    largest = std::max(largest, strength);
    sum.Add(light.Color, strength / count,
      Fresnel::GetTransmittance(cosine, this->RefractiveIndex));
  }
  // A narrow shadow or light along an edge misses all points, but hardly all corners.
  const int corners = refined ? 0 : this->Scene.GetNumberOfCorners(patch);
  for (int k = 0; k < corners; ++k)
  {
    const Vector point =
      0.98 * this->Scene.GetCorner(patch, k) + 0.02 * this->Scene.GetCentroid(patch);
    double cosine = 0.0;
    const double strength = this->LightPoint(light, point, patch, cosine);
    smallest = std::min(smallest, strength);
    largest = std::max(largest, strength);
  }
  return smallest >= 0.75 * largest;
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Internals::AddLight(const Light& light, const PatchPoints& points,
  vtkIdType patch, Sum& sum)
{
  if (!light.Positional && light.Axis.dot(this->Scene.GetNormal(patch)) >= 0.0)
  {
    return;
  }
  const double count = this->ShadowSamples;
  this->Rays[patch] += count + this->Scene.GetNumberOfCorners(patch);
  Sum part;
  if (!this->LightPatch(light, points, patch, false, part))
  {
    part = Sum();
    this->Rays[patch] += count * Refinement;
    this->LightPatch(light, points, patch, true, part);
  }
  for (int band = 0; band < Bands; ++band)
  {
    sum.Incident[band] += part.Incident[band];
    sum.Transmitted[band] += part.Transmitted[band];
  }
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Internals::AddEnvironment(const PatchPoints& points, vtkIdType patch,
  Sum& sum)
{
  const Vector& normal = this->Scene.GetNormal(patch);
  const double weight = vtkMath::Pi() / this->EnvironmentSamples;
  for (int k = 0; k < this->EnvironmentSamples; ++k)
  {
    const Vector direction = points.Sampler.GetDirection(normal, k, 2);
    const double cosine = direction.dot(normal);
    const Vector point = points.Get(k);
    if (!this->IsBlocked(point, point + OutOfScene * direction, patch))
    {
      double radiance[Bands];
      this->Surroundings.Evaluate(direction, radiance);
      sum.Add(radiance, weight, Fresnel::GetTransmittance(cosine, this->RefractiveIndex));
    }
  }
  this->Rays[patch] += this->EnvironmentSamples;
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::Internals::ComputePatch(vtkIdType patch)
{
  const PatchPoints points(this->Scene, patch);
  Sum sum;
  for (const Light& light : this->Lights)
  {
    this->AddLight(light, points, patch, sum);
  }
  if (!this->Surroundings.IsEmpty())
  {
    this->AddEnvironment(points, patch, sum);
  }
  std::copy_n(sum.Incident, Bands, &this->Incident[patch * Bands]);
  std::copy_n(sum.Transmitted, Bands, &this->Transmitted[patch * Bands]);
}

//------------------------------------------------------------------------------
vtkDirectIrradiance::vtkDirectIrradiance() : Self(new Internals) {}

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
  auto& lights = this->Self->LightObjects;
  if (light && std::find(lights.begin(), lights.end(), light) == lights.end())
  {
    lights.emplace_back(light);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::RemoveLight(vtkLight* light)
{
  auto& lights = this->Self->LightObjects;
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
  if (!this->Self->LightObjects.empty())
  {
    this->Self->LightObjects.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkDirectIrradiance::GetNumberOfLights()
{
  return static_cast<int>(this->Self->LightObjects.size());
}

//------------------------------------------------------------------------------
vtkLight* vtkDirectIrradiance::GetLight(int index)
{
  return index >= 0 && index < this->GetNumberOfLights() ? this->Self->LightObjects[index].Get()
                                                         : nullptr;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDirectIrradiance::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkLight* light : this->Self->LightObjects)
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
int vtkDirectIrradiance::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  const double start = vtkTimerLog::GetUniversalTime();
  if (!(this->RefractiveIndex >= 1.0) || !std::isfinite(this->RefractiveIndex))
  {
    vtkErrorMacro("RefractiveIndex is " << this->RefractiveIndex
                                        << ": it must be at least 1 (1 for an opaque surface).");
    return 0;
  }
  std::string error;
  if (!this->Self->Scene.Build(input, this->Controller, error))
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  if (!this->ReadLights() || !this->ReadEnvironment() || !this->ComputeIrradiance())
  {
    return 0;
  }
  this->WriteResults(input, output, vtkTimerLog::GetUniversalTime() - start);
  this->UpdateProgress(1.0);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkDirectIrradiance::ReadLights()
{
  Internals& self = *this->Self;
  self.Lights.clear();
  for (int index = 0; index < this->GetNumberOfLights(); ++index)
  {
    vtkLight* object = this->GetLight(index);
    if (!object->GetSwitch())
    {
      continue;
    }
    if (!object->LightTypeIsSceneLight())
    {
      vtkErrorMacro("Light " << index
                             << " is a headlight or camera light, which follows a camera, and a "
                                "filter has none: call SetLightTypeToSceneLight().");
      return false;
    }
    Light light;
    const char* problem = ConvertLight(object, self.Scene, light);
    if (problem)
    {
      vtkErrorMacro("Light " << index << problem);
      return false;
    }
    self.Lights.push_back(light);
  }
  if (self.Lights.empty() && !this->Environment)
  {
    vtkWarningMacro("No light is on and there is no environment: the irradiance is 0. Add one with "
                    "AddLight or SetEnvironment.");
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkDirectIrradiance::ReadEnvironment()
{
  RadianceMap& environment = this->Self->Surroundings;
  environment = RadianceMap();
  if (!this->Environment)
  {
    return true;
  }
  const int* size = this->Environment->GetDimensions();
  vtkDataArray* scalars = this->Environment->GetPointData()->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 || (components != 1 && components != Bands))
  {
    vtkErrorMacro("The environment must be a two-dimensional image with point scalars of 1 or 3 "
                  "components, but its size is "
      << size[0] << " x " << size[1] << " x " << size[2] << " with " << components
      << " components.");
    return false;
  }
  environment.Width = size[0];
  environment.Height = size[1];
  environment.Values.reserve(static_cast<std::size_t>(size[0]) * size[1] * Bands);
  for (vtkIdType pixel = 0; pixel < scalars->GetNumberOfTuples(); ++pixel)
  {
    for (int band = 0; band < Bands; ++band)
    {
      const double value = scalars->GetComponent(pixel, components == 1 ? 0 : band);
      if (!std::isfinite(value))
      {
        vtkErrorMacro("The environment has a value that is not finite at pixel "
          << pixel << ": replace such values.");
        return false;
      }
      environment.Values.push_back(value);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkDirectIrradiance::ComputeIrradiance()
{
  Internals& self = *this->Self;
  std::string error;
  const bool built = !this->Shadows || self.Caster.Build(self.Scene, error);
  if (!PatchScene::Agree(this->Controller, built, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  self.Shadows = this->Shadows;
  self.ShadowSamples = this->ShadowSamples;
  self.EnvironmentSamples = this->EnvironmentSamples;
  self.RefractiveIndex = this->RefractiveIndex;
  const std::size_t patches = self.Scene.GetAreas().size();
  self.Incident.assign(patches * Bands, 0.0);
  self.Transmitted.assign(patches * Bands, 0.0);
  self.Rays.assign(patches, 0.0);

  const std::vector<vtkIdType>& locals = self.Scene.GetLocalPatches();
  const auto count = static_cast<vtkIdType>(locals.size());
  auto compute = [&self, &locals](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType local = first; local < last; ++local)
    {
      self.ComputePatch(locals[local]);
    }
  };
  for (int batch = 0; batch < NumberOfBatches; ++batch)
  {
    Threads::For(count * batch / NumberOfBatches, count * (batch + 1) / NumberOfBatches, 16,
      compute);
    if (!this->ReportProgress(static_cast<double>(batch + 1) / NumberOfBatches))
    {
      return false;
    }
  }
  if (this->GetNumberOfRanks() > 1)
  {
    for (std::vector<double>* values : { &self.Incident, &self.Transmitted, &self.Rays })
    {
      const std::vector<double> mine = *values;
      this->Controller->AllReduce(mine.data(), values->data(), static_cast<vtkIdType>(mine.size()),
        vtkCommunicator::SUM_OP);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkDirectIrradiance::WriteResults(vtkDataObject* input, vtkDataObject* output, double seconds)
{
  Internals& self = *this->Self;
  self.Scene.BuildSmoothPoints(this->FeatureAngle, {}, 0);
  self.Scene.CopyStructure(input, output);
  self.Scene.AddArray(output, "DirectIrradiance", self.Incident, Bands);
  vtkFieldData* fields = output->GetFieldData();
  if (this->RefractiveIndex > 1.0)
  {
    self.Scene.AddArray(output, "TransmittedIrradiance", self.Transmitted, Bands);
    AddSummary(fields, "RefractiveIndex", this->RefractiveIndex);
  }
  double rays = 0.0;
  double flux[Bands] = {};
  const double unit = self.Scene.GetScale() * self.Scene.GetScale();
  for (std::size_t patch = 0; patch < self.Rays.size(); ++patch)
  {
    rays += self.Rays[patch];
    for (int band = 0; band < Bands; ++band)
    {
      flux[band] += unit * self.Scene.GetAreas()[patch] * self.Incident[patch * Bands + band];
    }
  }
  AddSummary(fields, "DirectFlux", flux);
  AddSummary(fields, "DirectIrradianceRays", this->Shadows ? rays : 0.0);
  AddSummary(fields, "DirectIrradianceSeconds", seconds);
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
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
