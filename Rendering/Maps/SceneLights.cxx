// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/SceneLights.h"

#include "Shared/BitHash.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Texels around what is seen, for what is looked up between them.
constexpr double Border = 2.0;
/// A wider cone is looked at in six directions.
constexpr double WidestView = 60.0;
/// Of the scene: what is nearer to a light casts no shadow, and more room than bounds take.
constexpr double Nearest = 1e-6;
constexpr double Margin = 1e-3;

//------------------------------------------------------------------------------
bool IsGood(const SceneLight& light)
{
  double sum = 0.0;
  double least = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    sum += light.Position[k] + light.Axis[k] + light.Color[k] + light.Attenuation[k];
    least = std::min({ least, light.Color[k], light.Attenuation[k] });
  }
  const bool shinesEverywhere = light.IsPositional && light.ConeCosine == 0.0;
  return (shinesEverywhere || vtkMath::Norm(light.Axis.data()) > 0.0) &&
    std::isfinite(sum + light.Exponent + light.ConeCosine) && least >= 0.0 &&
    light.Attenuation[0] + light.Attenuation[1] + light.Attenuation[2] > 0.0;
}

//------------------------------------------------------------------------------
SceneLight Copy(vtkLight* source)
{
  SceneLight light;
  light.IsPositional = source->GetPositional() != 0;
  source->GetTransformedPosition(light.Position.data());
  double focus[3];
  source->GetTransformedFocalPoint(focus);
  vtkMath::Subtract(focus, light.Position.data(), light.Axis.data());
  vtkMath::Normalize(light.Axis.data());
  for (int band = 0; band < 3; ++band)
  {
    light.Color[band] = source->GetIntensity() * source->GetDiffuseColor()[band];
  }
  source->GetAttenuationValues(light.Attenuation.data());
  if (light.IsPositional && source->GetConeAngle() < 90.0)
  {
    light.ConeCosine = std::cos(vtkMath::RadiansFromDegrees(source->GetConeAngle()));
    light.Exponent = source->GetExponent();
  }
  return light;
}

//------------------------------------------------------------------------------
/// Of the eight corners of bounds along an axis, from an origin.
std::array<double, 2> GetRange(const double bounds[6], const Vector3& origin, const Vector3& axis)
{
  std::array<double, 2> range = { VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  for (int corner = 0; corner < 8; ++corner)
  {
    double along = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      along += (bounds[2 * k + ((corner >> k) & 1)] - origin[k]) * axis[k];
    }
    range = { std::min(range[0], along), std::max(range[1], along) };
  }
  return range;
}

//------------------------------------------------------------------------------
std::array<Vector3, 3> MakeAxes(const Vector3& ahead)
{
  std::array<Vector3, 3> axes;
  axes[2] = ahead;
  vtkMath::Perpendiculars(ahead.data(), axes[0].data(), axes[1].data(), 0.0);
  return axes;
}

//------------------------------------------------------------------------------
double GetDiagonal(const double bounds[6])
{
  return std::sqrt(std::pow(bounds[1] - bounds[0], 2) + std::pow(bounds[3] - bounds[2], 2) +
    std::pow(bounds[5] - bounds[4], 2));
}

//------------------------------------------------------------------------------
LightView MakeDistantView(const SceneLight& light, const double receivers[6], const double scene[6],
  int size)
{
  LightView view;
  for (int k = 0; k < 3; ++k)
  {
    view.Origin[k] = 0.5 * (receivers[2 * k] + receivers[2 * k + 1]);
  }
  view.Axes = MakeAxes(light.Axis);
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto range = GetRange(receivers, view.Origin, view.Axes[axis]);
    view.Middle[axis] = 0.5 * (range[0] + range[1]);
    view.Half[axis] = std::max(0.5 * (range[1] - range[0]), Nearest * GetDiagonal(receivers)) *
      (1.0 + 2.0 * Border / size);
  }
  const auto depth = GetRange(scene, view.Origin, view.Axes[2]);
  const double margin = Margin * GetDiagonal(scene);
  view.Near = depth[0] - margin;
  view.Far = depth[1] + margin;
  return view;
}

//------------------------------------------------------------------------------
LightView MakePointView(const SceneLight& light, const std::array<Vector3, 3>& axes, double tangent,
  const double scene[6], int size)
{
  LightView view;
  view.Origin = light.Position;
  view.Axes = axes;
  view.IsPerspective = true;
  view.Half.fill(tangent * (1.0 + 2.0 * Border / size));
  const double diagonal = GetDiagonal(scene);
  view.Near = Nearest * diagonal;
  view.Far = std::max(GetRange(scene, view.Origin, axes[2])[1], 0.0) + Margin * diagonal;
  return view;
}

//------------------------------------------------------------------------------
/// Where a cone around the ball that holds bounds is narrower than `tangent`, that and its axis.
void AimAtBounds(const Vector3& from, const double bounds[6], Vector3& ahead, double& tangent)
{
  Vector3 path;
  for (int k = 0; k < 3; ++k)
  {
    path[k] = 0.5 * (bounds[2 * k] + bounds[2 * k + 1]) - from[k];
  }
  const double distance = vtkMath::Normalize(path.data());
  const double radius = 0.5 * (1.0 + Margin) * GetDiagonal(bounds);
  const double square = distance * distance - radius * radius;
  if (square > 0.0 && radius < tangent * std::sqrt(square))
  {
    ahead = path;
    tangent = radius / std::sqrt(square);
  }
}
} // namespace

//------------------------------------------------------------------------------
bool SceneLight::operator==(const SceneLight& other) const
{
  const auto getStamp = [](const SceneLight& light)
  {
    BitHash hash;
    hash.AddNumber(light.IsPositional ? 1.0 : 0.0);
    for (const Vector3& vector : { light.Position, light.Axis, light.Color, light.Attenuation })
    {
      for (const double number : vector)
      {
        hash.AddNumber(number);
      }
    }
    hash.AddNumber(light.ConeCosine);
    hash.AddNumber(light.Exponent);
    return hash.Get();
  };
  return getStamp(*this) == getStamp(other);
}

//------------------------------------------------------------------------------
bool SceneLight::IsSomewhere() const
{
  const Vector3& place = this->IsPositional ? this->Position : this->Axis;
  const double size = vtkMath::Norm(place.data());
  return std::isfinite(size) && (this->IsPositional || size > 0.0);
}

//------------------------------------------------------------------------------
std::vector<SceneLight> SceneLights::Find(vtkRenderer* renderer)
{
  std::vector<SceneLight> lights;
  vtkLightCollection* all = renderer->GetLights();
  const auto isAnyOn = [all]()
  {
    vtkCollectionSimpleIterator place;
    all->InitTraversal(place);
    vtkLight* light = all->GetNextLight(place);
    while (light && !light->GetSwitch())
    {
      light = all->GetNextLight(place);
    }
    return light != nullptr;
  };
  if (!isAnyOn() && renderer->GetAutomaticLightCreation())
  {
    renderer->CreateLight();
  }
  renderer->UpdateLightsGeometryToFollowCamera();
  vtkCollectionSimpleIterator place;
  all->InitTraversal(place);
  for (vtkLight* light = all->GetNextLight(place); light; light = all->GetNextLight(place))
  {
    if (light->GetSwitch())
    {
      lights.push_back(Copy(light));
    }
  }
  return lights;
}

//------------------------------------------------------------------------------
Outcome SceneLights::Read(vtkRenderer* renderer, std::vector<SceneLight>& lights)
{
  lights = Find(renderer);
  return std::all_of(lights.begin(), lights.end(), IsGood)
    ? Outcome::Done()
    : Outcome::Failed("A light has a position, intensity, color or attenuation that is negative or "
                      "not finite, no attenuation value above 0, or its focal point at its "
                      "position: correct it.");
}

//------------------------------------------------------------------------------
std::vector<LightView> SceneLights::MakeViews(const SceneLight& light, const double receivers[6],
  const double scene[6], int size)
{
  if (!light.IsPositional)
  {
    return { MakeDistantView(light, receivers, scene, size) };
  }
  // The narrower of two cones: that of the light, and one around all that is lit.
  const double widest = std::tan(vtkMath::RadiansFromDegrees(WidestView));
  Vector3 ahead = light.Axis;
  double tangent = light.ConeCosine > 0.0
    ? std::sqrt(1.0 / (light.ConeCosine * light.ConeCosine) - 1.0)
    : VTK_DOUBLE_MAX;
  AimAtBounds(light.Position, receivers, ahead, tangent);
  if (tangent <= widest)
  {
    return { MakePointView(light, MakeAxes(ahead), tangent, scene, size) };
  }
  std::vector<LightView> views;
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2;
    std::array<Vector3, 3> axes = {};
    axes[0][(axis + 1) % 3] = 1.0;
    axes[1][(axis + 2) % 3] = 1.0;
    axes[2][axis] = face % 2 == 0 ? 1.0 : -1.0;
    views.push_back(MakePointView(light, axes, 1.0, scene, size));
    views.back().Face = face;
  }
  return views;
}
} // namespace LightTransport
