// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/PlanckFraction.h"

#include "vtkMath.h"

#include <cmath>

namespace LightTransport
{
namespace
{
// h c / k in micrometre kelvin, exact in the SI of 2019 (rounded here).
constexpr double SecondRadiationConstant = 14387.768775039338;
// Terms below this fraction of the sum are lost in its rounding (1.1e-16).
constexpr double Rounding = 1e-17;
// Beyond this z the share is below the smallest number.
constexpr double LargeArgument = 800.0;
// Below this z nine terms of the Taylor series reach double precision.
constexpr double SmallArgument = 1.0;
// Bernoulli numbers B_2k / (2k)! for k = 1, 2, ...
constexpr double BernoulliTerms[] = { 1.0 / 12.0, -1.0 / 720.0, 1.0 / 30240.0, -1.0 / 1209600.0,
  1.0 / 47900160.0, -691.0 / 1307674368000.0, 1.0 / 74724249600.0, -3617.0 / 10670622842880000.0,
  43867.0 / 5109094217170944000.0 };

//------------------------------------------------------------------------------
double GetNormalization()
{
  return 15.0 / std::pow(vtkMath::Pi(), 4);
}

//------------------------------------------------------------------------------
// The integral of x^3 / (e^x - 1) from z to infinity, for z that is not small.
double IntegrateFrom(double z)
{
  if (z > LargeArgument)
  {
    return 0.0;
  }
  double sum = 0.0;
  double term = 1.0;
  for (double n = 1.0; term > Rounding * sum; ++n)
  {
    term = std::exp(-n * z) / n * (((z + 3.0 / n) * z + 6.0 / (n * n)) * z + 6.0 / (n * n * n));
    sum += term;
  }
  return sum;
}

//------------------------------------------------------------------------------
// The integral from 0 to a small z.
double IntegrateTo(double z)
{
  double sum = 1.0 / 3.0 - z / 8.0;
  double power = 1.0;
  double exponent = 3.0;
  for (const double coefficient : BernoulliTerms)
  {
    power *= z * z;
    exponent += 2.0;
    sum += coefficient * power / exponent;
  }
  return z * z * z * sum;
}
} // namespace

//------------------------------------------------------------------------------
double PlanckFraction::GetBelow(double product)
{
  const double z = SecondRadiationConstant / product;
  return z < SmallArgument ? 1.0 - GetNormalization() * IntegrateTo(z)
                           : GetNormalization() * IntegrateFrom(z);
}

//------------------------------------------------------------------------------
double PlanckFraction::GetAbove(double product)
{
  const double z = SecondRadiationConstant / product;
  return z < SmallArgument ? GetNormalization() * IntegrateTo(z)
                           : 1.0 - GetNormalization() * IntegrateFrom(z);
}

//------------------------------------------------------------------------------
double PlanckFraction::GetBand(double shorter, double longer, double temperature)
{
  if (temperature == 0.0)
  {
    return 0.0;
  }
  // The difference of the smaller shares loses the fewest digits.
  const double from = shorter * temperature;
  const double to = longer * temperature;
  const double below = GetBelow(from);
  return below > 0.5 ? GetAbove(from) - GetAbove(to) : GetBelow(to) - below;
}
} // namespace LightTransport
