// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/SingleScattering.h"

#include "Shared/Fresnel.h"
#include "Shared/GaussLegendre.h"
#include "vtkMath.h"

#include <cmath>
#include <cstddef>

namespace LightTransport
{
namespace
{
constexpr int NumberOfTerms = 48;
} // namespace

//------------------------------------------------------------------------------
SingleScattering::SingleScattering(const ScatteringMedium& medium)
{
  // The angle outside, in which T is smooth up to grazing; more terms where they fall fast.
  const double quarter = 0.5 * vtkMath::Pi();
  const double extinction = medium.Scattering + medium.Absorption;
  const GaussLegendre rule(NumberOfTerms);
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double outside = quarter * rule.Nodes[k] * rule.Nodes[k];
    const double sine = std::sin(outside) / medium.RefractiveIndex;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const double width =
      2.0 * quarter * rule.Nodes[k] * rule.Weights[k] * std::cos(outside) / medium.RefractiveIndex;
    this->Terms.push_back({ medium.Scattering / (4.0 * vtkMath::Pi()) * width *
        Fresnel::GetTransmittance(std::cos(outside), medium.RefractiveIndex),
      extinction * (1.0 + cosine) / sine });
  }
}

//------------------------------------------------------------------------------
double SingleScattering::Evaluate(double radius) const
{
  double sum = 0.0;
  for (const Term& term : this->Terms)
  {
    sum += term.Weight * std::exp(-term.Decay * radius);
  }
  return sum > 0.0 ? sum / radius : 0.0;
}

//------------------------------------------------------------------------------
double SingleScattering::GetTotal() const
{
  double sum = 0.0;
  for (const Term& term : this->Terms)
  {
    sum += term.Weight / term.Decay;
  }
  return 2.0 * vtkMath::Pi() * sum;
}
} // namespace LightTransport
