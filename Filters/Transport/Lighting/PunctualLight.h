// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A vtkLight in a scene's coordinates, and the source that it becomes: a PointLight where it is
/// positional, else a DistantLight.
#ifndef PunctualLight_h
#define PunctualLight_h

#include "Lighting/LightSource.h"
#include "Shared/Outcome.h"

#include <memory>

class vtkLight;

namespace LightTransport
{
struct PunctualLight
{
  using Vector = LitPatch::Vector;

  /// By which part of what it would get if it faced the light a patch's errors are measured, where
  /// it gets less.
  static constexpr double Facing = 0.25;

  bool IsPositional = false;
  Vector Position = Vector::Zero();
  Vector Axis = Vector::Zero(); ///< unit vector from the light to its focal point
  double Color[LightBands] = {};
  double Attenuation[3] = {};
  double ConeCosine = 0.0; ///< 0 where there is no cone
  double Exponent = 0.0;   ///< counts within a cone

  /// Take over a light that is on. A failure's message begins after the light's name.
  Outcome Read(vtkLight* object, const PatchScene& scene);

  /// Irradiance of a positional light at a point that faces it, over the color; within its cone.
  /// `unit` is a length of 1 in the input's unit.
  double GetStrength(const Vector& point, double unit) const;
  bool IsInCone(const Vector& point) const
  {
    const Vector path = point - this->Position;
    return path.dot(this->Axis) >= this->ConeCosine * path.norm() || this->ConeCosine == 0.0;
  }

  ///@{ A direction of a directional light that is a disc: the one that is `radius` (a tangent) away
  /// from the axis; for two numbers evenly spread in (0, 1) and the radius in radians, as dense as
  /// the disc is bright to a surface that faces it.
  Vector Lean(double radius, double angle) const;
  Vector GetDirection(double radius, double u, double v) const;
  ///@}

  /// `angularDiameter`, in degrees, is that of directional lights.
  std::unique_ptr<LightSource> MakeSource(const LightEffort& effort, double angularDiameter) const;
};
} // namespace LightTransport

#endif
