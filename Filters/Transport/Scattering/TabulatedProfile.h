// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The exact profile of a flat, semi-infinite medium for diffuse light, with Fresnel's equations at
 * its surface and Henyey and Greenstein's phase function, but for errors of chance: photons that
 * have walked in it once (HalfSpaceTable).
 *
 * Where less is absorbed than in any walk what the walk lacks is known better in all than as the
 * sum of what diffusion says of where it leaves: of all that enters a share does not leave that
 * grows like 4 n^2 / (1 - F) sqrt(absorbed / 3), and like what is absorbed beyond that. What
 * diffusion says is scaled to that total, which is 1 without absorption.
 */
#ifndef TabulatedProfile_h
#define TabulatedProfile_h

#include "Scattering/HalfSpaceTable.h"
#include "Scattering/IntegratedProfile.h"
#include "Scattering/ScatteringMedium.h"

#include <cstdint>
#include <memory>

namespace LightTransport
{
class TabulatedProfile : public IntegratedProfile
{
public:
  /// `photons`: 0 for as many as is reasonable. Collective.
  TabulatedProfile(const ScatteringMedium& medium, long long photons, std::uint64_t seed,
    const Ranks& ranks = Ranks());

  double Evaluate(double radius) const override;
  bool IsSingular() const override { return true; }
  double GetError() const override { return this->Table ? this->Table->GetError() : 0.0; }

private:
  void AddLacking(double share, double index, double scale);

  double Extinction;                           ///< the reduced one
  double PhotonDecay = 0.0;                    ///< over its inverse
  std::shared_ptr<const HalfSpaceTable> Table; ///< nullptr where nothing is scattered
  ///@{ Of a walk that absorbs more, and how much of what it lacks for that is added.
  double WalkDecay = 0.0;
  double Gain = 1.0;
  ///@}
};
} // namespace LightTransport

#endif
