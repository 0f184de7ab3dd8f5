// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ThresholdSearch.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// The first threshold, as a part of the squared error that is allowed; how fast it falls, and the
// power of it that the error is taken for.
constexpr double FirstThreshold = 1.0 / 64.0;
constexpr double FastestFall = 1.0 / 64.0;
constexpr double SlowestFall = 0.9;
constexpr double UsualPower = 0.4;
constexpr double SmallestPower = 0.33;
constexpr double LargestPower = 0.6;
// What a pass aims at, as a part of the tolerance.
constexpr double Aim = 0.98;
} // namespace

//------------------------------------------------------------------------------
ThresholdSearch::ThresholdSearch(double tolerance, double squaredScale)
  : Tolerance(tolerance), Threshold(FirstThreshold * tolerance * tolerance * squaredScale)
{
}

//------------------------------------------------------------------------------
bool ThresholdSearch::IsReached(double error)
{
  if (error <= this->Tolerance)
  {
    return true;
  }
  double power = UsualPower;
  if (this->Error > error)
  {
    power = std::log(this->Error / error) / std::log(this->LastThreshold / this->Threshold);
  }
  power = std::min(std::max(power, SmallestPower), LargestPower);
  this->Error = error;
  this->LastThreshold = this->Threshold;
  const double fall = std::pow(Aim * this->Tolerance / error, 1.0 / power);
  this->Threshold *= std::min(std::max(fall, FastestFall), SlowestFall);
  return false;
}
} // namespace LightTransport
