// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/PunctualLight.h"

#include "Lighting/DistantLight.h"
#include "Lighting/PointLight.h"
#include "Scene/PatchScene.h"
#include "vtkLight.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome PunctualLight::Read(vtkLight* object, const PatchScene& scene)
{
  double position[3];
  double focus[3];
  object->GetTransformedPosition(position);
  object->GetTransformedFocalPoint(focus);
  this->IsPositional = object->GetPositional() != 0;
  this->Position = (Vector(position) - scene.GetCenter()) / scene.GetScale();
  this->Axis = Vector(focus) - Vector(position);
  const double* attenuation = object->GetAttenuationValues();
  std::copy_n(attenuation, 3, this->Attenuation);
  const bool cone = this->IsPositional && object->GetConeAngle() < 90.0;
  this->ConeCosine = cone ? std::cos(vtkMath::RadiansFromDegrees(object->GetConeAngle())) : 0.0;
  this->Exponent = object->GetExponent();
  double strength = object->GetIntensity();
  for (int band = 0; band < LightBands; ++band)
  {
    this->Color[band] = object->GetIntensity() * object->GetDiffuseColor()[band];
    strength = std::min(strength, this->Color[band]);
  }
  const double smallest = *std::min_element(attenuation, attenuation + 3);
  const double sum = attenuation[0] + attenuation[1] + attenuation[2];
  if (!(strength >= 0.0) || !std::isfinite(this->Color[0] + this->Color[1] + this->Color[2]) ||
    !(smallest >= 0.0) || !(sum > 0.0) || !std::isfinite(sum))
  {
    return Outcome::Failed(" has an intensity, color or attenuation that is negative or not "
                           "finite, or no attenuation value above 0: correct them.");
  }
  if ((!this->IsPositional || cone) && !(this->Axis.norm() > 0.0))
  {
    return Outcome::Failed(
      " has its focal point at its position and so no direction: move one of them.");
  }
  this->Axis.normalize();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
double PunctualLight::GetStrength(const Vector& point, double unit) const
{
  const Vector path = this->Position - point;
  const double distance = path.norm();
  const double length = distance * unit;
  double strength =
    1.0 / (this->Attenuation[0] + length * (this->Attenuation[1] + length * this->Attenuation[2]));
  if (this->ConeCosine > 0.0)
  {
    const Vector towards = path / distance;
    strength *= std::pow(std::max(0.0, -towards.dot(this->Axis)), this->Exponent);
  }
  return strength;
}

//------------------------------------------------------------------------------
PunctualLight::Vector PunctualLight::Lean(double radius, double angle) const
{
  const Vector tangent = this->Axis.unitOrthogonal();
  return (
    this->Axis + radius * (std::cos(angle) * tangent + std::sin(angle) * this->Axis.cross(tangent)))
    .normalized();
}

//------------------------------------------------------------------------------
PunctualLight::Vector PunctualLight::GetDirection(double radius, double u, double v) const
{
  const double sine = std::sin(radius) * std::sqrt(u);
  return this->Lean(sine / std::sqrt(1.0 - sine * sine), 2.0 * vtkMath::Pi() * v);
}

//------------------------------------------------------------------------------
std::unique_ptr<LightSource> PunctualLight::MakeSource(const LightEffort& effort,
  double angularDiameter) const
{
  if (this->IsPositional)
  {
    return std::make_unique<PointLight>(*this, effort);
  }
  return std::make_unique<DistantLight>(*this, effort, angularDiameter);
}
} // namespace LightTransport
