// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/AirShare.h"

#include "Links/Links.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
// A link of a sample is in the sums of both its patches. Where both get the same light the variance
// of what it carries is exact, else at most twice what it should be.
AirShare::AirShare(const Links& links, const std::vector<double>& entering,
  const std::vector<double>& leaving)
{
  const std::vector<double>& areas = links.GetExchange()->GetAreas();
  const std::size_t bands = links.ThroughAir.Samples.size();
  const std::size_t components = entering.size() / areas.size();
  std::vector<double> totals(components, 0.0);
  std::vector<double> variances(components, 0.0);
  std::vector<double> brightest(components, 0.0);
  this->Shares.assign(components, 0.0);
  for (std::size_t k = 0; k < entering.size(); ++k)
  {
    const std::size_t patch = k / components;
    const std::size_t component = k % components;
    const std::size_t link = patch * bands + component % bands;
    const double throughAir = entering[k] * links.ThroughAir.Carried[link];
    this->Shares[component] += throughAir;
    totals[component] += areas[patch] * leaving[k];
    totals[component] += links.AreThroughAirDropped ? throughAir : 0.0;
    variances[component] += 2.0 * entering[k] * entering[k] * links.ThroughAir.Variances[link];
    brightest[component] = std::max(brightest[component], std::abs(entering[k]));
  }
  for (std::size_t component = 0; component < components; ++component)
  {
    const double error = std::max(std::sqrt(variances[component]),
      links.ThroughAir.Samples[component % bands] * brightest[component]);
    const bool isDark = totals[component] == 0.0;
    double& share = this->Shares[component];
    share = isDark ? 0.0 : std::min(share / totals[component], 1.0);
    this->Errors.push_back(isDark ? 0.0 : error / std::abs(totals[component]));
  }
}
} // namespace LightTransport
