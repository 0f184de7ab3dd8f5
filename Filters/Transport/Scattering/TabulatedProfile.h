// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The exact profile of a flat, semi-infinite medium for diffuse light, with Fresnel's equations at
 * its surface and Henyey and Greenstein's phase function, but for errors of chance: photons that
 * have walked in it once (HalfSpaceTable).
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
  /// `photons`: 0 for as many as is reasonable.
  TabulatedProfile(const ScatteringMedium& medium, long long photons, std::uint64_t seed);

  double Evaluate(double radius) const override;
  bool IsSingular() const override { return true; }
  double GetError() const override { return this->Table ? this->Table->GetError() : 0.0; }

private:
  double Extinction;                           ///< the reduced one
  double PhotonDecay = 0.0;                    ///< over its inverse
  std::shared_ptr<const HalfSpaceTable> Table; ///< nullptr where nothing is scattered
};
} // namespace LightTransport

#endif
