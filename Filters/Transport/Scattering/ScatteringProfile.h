// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Diffuse reflectance of a flat, semi-infinite translucent medium in one band: how much of the
 * light that enters at one point leaves per unit area at distance r, R_d(r). This is all that links
 * and their integrals ask of a model; ScatteringModels lists the models. Lengths in millimetres.
 */
#ifndef ScatteringProfile_h
#define ScatteringProfile_h

#include <memory>
#include <vector>

namespace LightTransport
{
class ScatteringProfile
{
public:
  virtual ~ScatteringProfile() = default;

  /// R_d(r), per mm^2: finite at 0 too, never negative, and never larger at a larger distance, so
  /// that a value bounds all beyond it.
  virtual double Evaluate(double radius) const = 0;

  /// Integral of R_d over the plane beyond a radius.
  virtual double GetTail(double radius) const = 0;

  /// Integral of R_d over the whole plane.
  double GetTotal() const { return this->GetTail(0.0); }

  /**
   * moments[k] = integral from 0 to `radius` of R_d(r) r^(k + 1) dr, k = 0, 1, 2: what a polygon
   * gives back of the light that enters it needs no more. 2 pi moments[0] is the integral over a
   * disc, the total less the tail.
   */
  virtual void GetMoments(double radius, double moments[3]) const = 0;

  ///@{
  /**
   * How fast the profile changes: within the scale (above 0) hardly at all, and at a distance r its
   * logarithm by no more than about 3 / sqrt(r^2 + scale^2) + decay per mm, as far out as the tail
   * matters. Tables and the choice of integration rules go by them: too small a decay makes the
   * estimates of errors too good, too large a one only costs time.
   */
  virtual double GetSmallestScale() const = 0;
  virtual double GetDecay() const = 0;
  ///@}
};

/// One per band.
using ScatteringProfiles = std::vector<std::unique_ptr<const ScatteringProfile>>;
} // namespace LightTransport

#endif
