// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/PunctualLight.h"

#include "Scene/PatchScene.h"
#include "vtkLight.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Points on a patch where the first ones disagree, over their number.
constexpr int Refinement = 16;
/// Points agree where each gets at least this part of what any other gets.
constexpr double Agreement = 0.75;
/// Shadow rays end so far in front of a light: a lamp that touches a surface is not behind it.
constexpr double Clearance = 1e-6;
/// Corners look from a place that is moved by this part towards the centroid.
constexpr double CornerInset = 0.02;
} // namespace

//------------------------------------------------------------------------------
Outcome PunctualLight::Read(vtkLight* object, const PatchScene& scene)
{
  double position[3];
  double focus[3];
  object->GetTransformedPosition(position);
  object->GetTransformedFocalPoint(focus);
  this->Positional = object->GetPositional() != 0;
  this->Position = (Vector(position) - scene.GetCenter()) / scene.GetScale();
  this->Axis = Vector(focus) - Vector(position);
  const double* attenuation = object->GetAttenuationValues();
  std::copy_n(attenuation, 3, this->Attenuation);
  const bool cone = this->Positional && object->GetConeAngle() < 90.0;
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
  if ((!this->Positional || cone) && !(this->Axis.norm() > 0.0))
  {
    return Outcome::Failed(
      " has its focal point at its position and so no direction: move one of them.");
  }
  this->Axis.normalize();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
double PunctualLight::LookFrom(const Vector& point, const LitPatch& patch, double& cosine) const
{
  Vector towards = -this->Axis;
  double strength = 1.0;
  double reach = OutOfScene;
  if (this->Positional)
  {
    const Vector path = this->Position - point;
    const double distance = path.norm();
    towards = path / distance;
    reach = std::min(reach, std::max(0.0, distance - Clearance));
    const double length = distance * patch.GetScene().GetScale();
    strength = 1.0 /
      (this->Attenuation[0] + length * (this->Attenuation[1] + length * this->Attenuation[2]));
    if (this->ConeCosine > 0.0)
    {
      const double axial = -towards.dot(this->Axis);
      strength *= axial >= this->ConeCosine ? std::pow(axial, this->Exponent) : 0.0;
    }
  }
  cosine = towards.dot(patch.GetNormal());
  if (!(cosine > 0.0) || strength == 0.0)
  {
    return 0.0;
  }
  return patch.IsBlocked(point, point + reach * towards) ? 0.0 : strength * cosine;
}

//------------------------------------------------------------------------------
bool PunctualLight::LookFromPoints(const LitPatch& patch, bool refined, LightSum& sum) const
{
  const int count = this->ShadowSamples * (refined ? Refinement : 1);
  double smallest = VTK_DOUBLE_MAX;
  double largest = 0.0;
  for (int k = 0; k < count; ++k)
  {
    double cosine = 0.0;
    const double strength = this->LookFrom(patch.GetPoint(k), patch, cosine);
    smallest = std::min(smallest, strength);
    largest = std::max(largest, strength);
    sum.Add(this->Color, strength / count, patch.GetTransmittance(cosine));
  }
  // A narrow shadow or light along an edge misses all points, but hardly all corners.
  const PatchScene& scene = patch.GetScene();
  const int corners = refined ? 0 : scene.GetNumberOfCorners(patch.GetId());
  for (int k = 0; k < corners; ++k)
  {
    const Vector point = (1.0 - CornerInset) * scene.GetCorner(patch.GetId(), k) +
      CornerInset * scene.GetCentroid(patch.GetId());
    double cosine = 0.0;
    const double strength = this->LookFrom(point, patch, cosine);
    smallest = std::min(smallest, strength);
    largest = std::max(largest, strength);
  }
  return smallest >= Agreement * largest;
}

//------------------------------------------------------------------------------
double PunctualLight::Light(const LitPatch& patch, LightSum& sum) const
{
  if (!this->Positional && this->Axis.dot(patch.GetNormal()) >= 0.0)
  {
    return 0.0;
  }
  double points = this->ShadowSamples + patch.GetScene().GetNumberOfCorners(patch.GetId());
  LightSum part;
  if (!this->LookFromPoints(patch, false, part))
  {
    part = LightSum();
    points += this->ShadowSamples * Refinement;
    this->LookFromPoints(patch, true, part);
  }
  sum.Add(part);
  return points;
}
} // namespace LightTransport
