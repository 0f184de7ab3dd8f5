// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Two exponentials over r, fitted to Monte Carlo: P. H. Christensen, B. Burley, "Approximate
 * Reflectance Profiles for Efficient Subsurface Scattering", Pixar technical memo 15-04, 2015:
 *
 *   R_d(r) = A (exp(-r / d) + exp(-r / 3d)) / (8 pi d r),   d = l / s(A)
 *
 * A is the exact reflectance (MatchedHalfSpace), of normal light for a searchlight and of diffuse
 * light for a diffusely lit surface; the fit over the diffuse mean free path is one of a
 * searchlight. All fits are for a medium with the index of its surroundings: the refractive index
 * has no influence.
 */
#ifndef ChristensenBurleyProfile_h
#define ChristensenBurleyProfile_h

#include "Scattering/IntegratedProfile.h"
#include "Scattering/ScatteringMedium.h"

namespace LightTransport
{
class ChristensenBurleyProfile : public IntegratedProfile
{
public:
  /// `fit` is one of vtkSubsurfaceScattering::BurleyFitType.
  ChristensenBurleyProfile(const ScatteringMedium& medium, int fit);

  double Evaluate(double radius) const override;
  bool IsSingular() const override { return true; }

private:
  double Reflectance;
  double Length;
};
} // namespace LightTransport

#endif
