// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Diffuse reflectance of a flat, semi-infinite translucent medium in one band: how much of the
 * light that enters at one point leaves per unit area at distance r, R_d(r). This is all that links
 * and their integrals ask of a model; ScatteringModels lists the models. Lengths in millimetres.
 */
#ifndef ScatteringProfile_h
#define ScatteringProfile_h

#include <cmath>
#include <memory>
#include <vector>

namespace LightTransport
{
class ScatteringProfile
{
public:
  virtual ~ScatteringProfile() = default;

  /// R_d(r), per mm^2: never negative, and never larger at a larger distance, so that a value
  /// bounds all beyond it. At 0 it is finite, or infinite where IsSingular says so.
  virtual double Evaluate(double radius) const = 0;

  /// Whether R_d goes like 1/r at the centre, as light does that was scattered once; r R_d(r) stays
  /// finite, and so does what a patch gives back of its own light.
  virtual bool IsSingular() const { return false; }

  /// Integral of R_d over the plane beyond a radius.
  virtual double GetTail(double radius) const = 0;

  /// Integral of R_d over the whole plane. A model may claim more than 1, by its error.
  double GetTotal() const { return this->GetTail(0.0); }

  /// Standard error of the total, relative, of a model that is not a formula.
  virtual double GetError() const { return 0.0; }

  /**
   * moments[k] = integral from 0 to `radius` of R_d(r) r^(k + 1) dr, k = 0, 1, 2: what a polygon
   * gives back of the light that enters it needs no more. 2 pi moments[0] is the integral over a
   * disc, the total less the tail.
   */
  virtual void GetMoments(double radius, double moments[3]) const = 0;

  ///@{
  /**
   * How fast the profile changes: within the scale (above 0) hardly at all, unless as 1/r, and at a
   * distance r its logarithm by no more than about GetNearbySlope(r) + decay per mm, as far out as
   * the tail matters. Tables and the choice of integration rules go by them: too small a decay
   * makes the estimates of errors too good, too large a one only costs time.
   */
  virtual double GetSmallestScale() const = 0;
  virtual double GetDecay() const = 0;
  ///@}

  ///@{ By how much the logarithm may change near by: as a point source does, of which a singular
  /// profile has a part at its centre (where light that was scattered once falls faster than 1/r).
  static constexpr double SlopeOfSource = 3.0;
  static constexpr double SlopeOfCentre = 1.25;
  double GetNearbySlope(double radius) const
  {
    const double fromCentre = this->IsSingular() ? SlopeOfCentre : 0.0;
    return (SlopeOfSource - fromCentre) / std::hypot(radius, this->GetSmallestScale()) +
      (fromCentre > 0.0 ? fromCentre / radius : 0.0);
  }
  ///@}
};

/// One per band.
using ScatteringProfiles = std::vector<std::unique_ptr<const ScatteringProfile>>;
} // namespace LightTransport

#endif
