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

  /// `angularDiameter`, in degrees, is that of directional lights.
  std::unique_ptr<LightSource> MakeSource(const LightEffort& effort, double angularDiameter) const;
};
} // namespace LightTransport

#endif
