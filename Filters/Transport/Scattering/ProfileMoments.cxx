// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ProfileMoments.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Of the smallest scale of a profile or the longest distance: closer than this all is one.
constexpr double CoreSize = 1e-9;
/// Of the core: the table's values at 0.
constexpr double CentreOfCore = 0.1;
} // namespace

//------------------------------------------------------------------------------
ProfileMoments::ProfileMoments(const ScatteringProfiles& profiles, double maximumDistance)
{
  double core = CoreSize * maximumDistance;
  for (const auto& profile : profiles)
  {
    core = std::min(core, CoreSize * profile->GetSmallestScale());
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Tables[k] = RadialTable(core * core, maximumDistance,
      [&](int band, double squared)
      {
        const ScatteringProfile& profile = *profiles[band];
        const double total = profile.GetTotal();
        const double radius = std::max(std::sqrt(squared), CentreOfCore * core);
        double moments[3];
        profile.GetMoments(radius, moments);
        return total > 0.0 ? moments[k] / (total * std::pow(radius, k + 1)) : 0.0;
      });
  }
}
} // namespace LightTransport
