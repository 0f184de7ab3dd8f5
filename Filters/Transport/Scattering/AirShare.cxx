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
  std::vector<double> totals(bands, 0.0);
  std::vector<double> variances(bands, 0.0);
  std::vector<double> brightest(bands, 0.0);
  this->Shares.assign(bands, 0.0);
  for (std::size_t k = 0; k < entering.size(); ++k)
  {
    const std::size_t band = k % bands;
    const double throughAir = entering[k] * links.ThroughAir.Carried[k];
    this->Shares[band] += throughAir;
    totals[band] += areas[k / bands] * leaving[k];
    totals[band] += links.AreThroughAirDropped ? throughAir : 0.0;
    variances[band] += 2.0 * entering[k] * entering[k] * links.ThroughAir.Variances[k];
    brightest[band] = std::max(brightest[band], std::abs(entering[k]));
  }
  for (std::size_t band = 0; band < bands; ++band)
  {
    const double error =
      std::max(std::sqrt(variances[band]), links.ThroughAir.Samples[band] * brightest[band]);
    const bool isDark = totals[band] == 0.0;
    this->Shares[band] = isDark ? 0.0 : std::min(this->Shares[band] / totals[band], 1.0);
    this->Errors.push_back(isDark ? 0.0 : error / std::abs(totals[band]));
  }
}
} // namespace LightTransport
