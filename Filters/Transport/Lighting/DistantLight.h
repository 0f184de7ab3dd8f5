// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A light infinitely far away, from one direction or from a disc in the sky.
#ifndef DistantLight_h
#define DistantLight_h

#include "Lighting/LightSource.h"
#include "Lighting/LitParts.h"
#include "Lighting/PunctualLight.h"
#include "Lighting/ShadowClipper.h"

#include <vector>

namespace LightTransport
{
class DistantLight : public LightSource
{
public:
  /// `angularDiameter` is that of the disc, in degrees.
  DistantLight(const PunctualLight& light, const LightEffort& effort, double angularDiameter);

  double Light(const LitPatch& patch, LightSum& sum) const override;

private:
  using Vector = LitPatch::Vector;
  using Blockers = std::vector<vtkIdType>;

  double LightFromPoint(const LitPatch& patch, LightSum& sum) const;
  double LightFromDisc(const LitPatch& patch, LightSum& sum) const;
  LightSum GetWholeDisc(const LitPatch& patch) const;
  double SampleDisc(const ShadowClipper& clipper, const Blockers& blockers, bool isEdgeAlike,
    LightSum& light) const;
  double AddDirection(const ShadowClipper& clipper, const Blockers& blockers, int k,
    LightSum& sum) const;
  void AddParts(const ShadowClipper& clipper, const LitParts& parts, const Vector& direction,
    LightSum& sum) const;
  Vector GetDirection(const LitPatch& patch, int k) const;
  static ShadowClipper::Origin GetOrigin(const Vector& direction);
  bool IsEdgeAlike(const ShadowClipper& clipper, const Blockers& blockers, double& share) const;

  PunctualLight Origin;
  LightEffort Effort;
  double Radius; ///< in radians
};
} // namespace LightTransport

#endif
