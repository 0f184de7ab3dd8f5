// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/MatchedHalfSpace.h"

#include "Shared/GaussLegendre.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace LightTransport
{
namespace
{
///@{ Trapezoidal rule over a logarithm: converges exponentially.
constexpr double FirstLogarithm = -40.0;
constexpr double LastLogarithm = 40.0;
constexpr double Step = 0.25;
///@}
constexpr int PointsOfCosine = 32;

//------------------------------------------------------------------------------
/// sqrt(1 - albedo) H(cosine)
double GetLoss(const ScatteringMedium& medium, double cosine)
{
  const double albedo = medium.Scattering / (medium.Scattering + medium.Absorption);
  const double absorbed = medium.Absorption / (medium.Scattering + medium.Absorption);
  double sum = 0.0;
  for (double x = FirstLogarithm; x < LastLogarithm; x += Step)
  {
    const double k = std::exp(x);
    // 1 - albedo atan(k) / k, without a difference of almost equal numbers.
    const double rest = k > 0.1 ? 1.0 - std::atan(k) / k
                                : k * k *
        (1.0 / 3.0 -
          k * k *
            (1.0 / 5.0 -
              k * k * (1.0 / 7.0 - k * k * (1.0 / 9.0 - k * k * (1.0 / 11.0 - k * k / 13.0)))));
    sum += Step * k * std::log(absorbed + albedo * rest) / (1.0 + cosine * cosine * k * k);
  }
  return std::sqrt(absorbed) * std::exp(-cosine / vtkMath::Pi() * sum);
}
} // namespace

//------------------------------------------------------------------------------
double MatchedHalfSpace::GetNormalReflectance(const ScatteringMedium& medium)
{
  return medium.Scattering > 0.0 ? std::clamp(1.0 - GetLoss(medium, 1.0), 0.0, 1.0) : 0.0;
}

//------------------------------------------------------------------------------
double MatchedHalfSpace::GetDiffuseReflectance(const ScatteringMedium& medium)
{
  const GaussLegendre rule(PointsOfCosine);
  double loss = 0.0;
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    loss += 2.0 * rule.Weights[k] * rule.Nodes[k] * GetLoss(medium, rule.Nodes[k]);
  }
  return medium.Scattering > 0.0 ? std::clamp(1.0 - loss, 0.0, 1.0) : 0.0;
}
} // namespace LightTransport
