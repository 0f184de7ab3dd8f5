// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A vtkLight, directional, positional or a spot, in a scene's coordinates.
#ifndef PunctualLight_h
#define PunctualLight_h

#include "Lighting/LightSource.h"
#include "Shared/Outcome.h"

class vtkLight;

namespace LightTransport
{
class PunctualLight : public LightSource
{
public:
  using Vector = LitPatch::Vector;

  /// Points on a patch that look at the light; where not all of them see it alike 16 times as many
  /// are taken.
  explicit PunctualLight(int shadowSamples) : ShadowSamples(shadowSamples) {}

  /// Take over a light that is on. A failure's message begins after the light's name.
  Outcome Read(vtkLight* object, const PatchScene& scene);

  double Light(const LitPatch& patch, LightSum& sum) const override;

private:
  /// Irradiance at normal incidence over Color, cosine and shadow included; 0 in the shadow or
  /// behind.
  double LookFrom(const Vector& point, const LitPatch& patch, double& cosine) const;
  /// Returns false where the points disagree.
  bool LookFromPoints(const LitPatch& patch, bool refined, LightSum& sum) const;

  int ShadowSamples;
  bool Positional = false;
  Vector Position = Vector::Zero();
  /// Unit vector from the light to its focal point.
  Vector Axis = Vector::Zero();
  double Color[LightBands] = {};
  double Attenuation[3] = {};
  double ConeCosine = 0.0;
  double Exponent = 0.0;
};
} // namespace LightTransport

#endif
