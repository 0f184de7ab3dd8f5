// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A light at a point, in all directions or in a cone.
#ifndef PointLight_h
#define PointLight_h

#include "Lighting/LightSource.h"
#include "Lighting/PieceIntegral.h"
#include "Lighting/PunctualLight.h"
#include "Lighting/ShadowClipper.h"

#include <vector>

namespace LightTransport
{
class PointLight : public LightSource
{
public:
  PointLight(const PunctualLight& light, const LightEffort& effort) : Origin(light), Effort(effort)
  {
  }

  double Light(const LitPatch& patch, LightSum& sum) const override;

private:
  using Vector = LitPatch::Vector;
  using Piece = ShadowClipper::Piece;
  /// What a light of one unit gives a patch, and what that may be off by.
  struct Mean
  {
    PieceIntegral::Value Value;
    double Error = 0.0;
  };

  double GetStrength(const Vector& point, const LitPatch& patch, double& cosine) const;
  void CutCone(const ShadowClipper& clipper, Piece& piece) const;
  Mean Integrate(const ShadowClipper& clipper, const std::vector<Piece>& pieces) const;

  PunctualLight Origin;
  LightEffort Effort;
};
} // namespace LightTransport

#endif
