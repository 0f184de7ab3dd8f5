// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The moments of profiles (ScatteringProfile::GetMoments) over their totals, all bands at a time,
 * tabulated: as means over the radius, which hardly change near the centre.
 */
#ifndef ProfileMoments_h
#define ProfileMoments_h

#include "Scattering/RadialTable.h"
#include "Scattering/ScatteringProfile.h"

#include <Eigen/Core>

namespace LightTransport
{
class ProfileMoments
{
public:
  using Bands = Eigen::Array4d;

  ProfileMoments() = default;
  ProfileMoments(const ScatteringProfiles& profiles, double maximumDistance);

  /// Mean of r R_d(r) (r / radius)^k over [0, radius].
  struct Means
  {
    RadialTable::Lane Of[3];
  };
  Means GetMeans(double radius) const
  {
    const RadialTable::Place place = this->Tables[0].Find(radius * radius);
    return { this->Tables[0].Evaluate(place), this->Tables[1].Evaluate(place),
      this->Tables[2].Evaluate(place) };
  }

private:
  RadialTable Tables[3];
};
} // namespace LightTransport

#endif
