// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered exactly once in a flat, semi-infinite medium and leaves: exact for light
 * that enters along the normal and isotropic (reduced) scattering, with Fresnel's equations at the
 * way out. What is scattered at a depth z is sigma_s' exp(-sigma_t' z), and of that
 *
 *   exp(-sigma_t' d) cos(t) T(t) / (4 pi d^2),   d^2 = r^2 + z^2,   cos(t) = z / d
 *
 * leaves per area at a distance r. Over the angle t instead of the depth, with u = sin(t), this is
 *
 *   R(r) = alpha' sigma_t' / (4 pi r) integral from 0 to 1/n of T exp(-sigma_t' r cot(t / 2)) du,
 *
 * a sum of exponentials over r by a fixed rule: it falls everywhere and goes like 1/r at 0. R.
 * Habel, P. H. Christensen, W. Jarosz, "Photon Beam Diffusion", EGSR 2013, section 5.
 *
 * Light that enters from all directions would be scattered once and leave 7 % (index 1.5) to 33 %
 * (index 1) more; that profile is not round for each direction, and models of diffusion assume
 * normal entry, too.
 */
#ifndef SingleScattering_h
#define SingleScattering_h

#include "Scattering/ScatteringMedium.h"

#include <vector>

namespace LightTransport
{
class SingleScattering
{
public:
  explicit SingleScattering(const ScatteringMedium& medium);

  /// Per mm^2, as ScatteringProfile::Evaluate.
  double Evaluate(double radius) const;

  /// Over the whole plane.
  double GetTotal() const;

private:
  /// Weight exp(-Decay r) / r
  struct Term
  {
    double Weight;
    double Decay;
  };
  std::vector<Term> Terms;
};
} // namespace LightTransport

#endif
