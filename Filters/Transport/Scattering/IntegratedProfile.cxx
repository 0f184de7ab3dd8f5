// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/IntegratedProfile.h"

#include "Shared/GaussLegendre.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
///@{ Positions in the table are steps in the logarithm of the radius over the scale: 16 of them for
/// a factor e, from exp(-23) on, and to exp(46) where no absorption ends the profile before.
constexpr double StepsPerUnit = 16.0;
constexpr double FirstLogarithm = -23.0;
constexpr int MostIntervals = 16 * 69;
constexpr int PointsOfInterval = 4;
///@}

/// Of all so far: what is given back per unit of logarithm. Where it is less the profile ends.
constexpr double Negligible = 1e-60;
/// Of the total: as far out as the tail matters, see ScatteringProfile::GetDecay.
constexpr double TailThatMatters = 1e-6;
} // namespace

//------------------------------------------------------------------------------
double IntegratedProfile::GetRadius(double position) const
{
  return this->Scale * std::exp(FirstLogarithm + position / StepsPerUnit);
}

//------------------------------------------------------------------------------
/// The power p of R_d ~ r^-p around a radius.
double IntegratedProfile::EstimatePower(double radius) const
{
  const double ratio = std::exp(1.0 / StepsPerUnit);
  return StepsPerUnit * std::log(this->Evaluate(radius) / this->Evaluate(ratio * radius));
}

//------------------------------------------------------------------------------
void IntegratedProfile::AddInterval(std::size_t interval, double sums[3]) const
{
  static const GaussLegendre rule(PointsOfInterval);
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double r = this->GetRadius(static_cast<double>(interval) + rule.Nodes[k]);
    double weighted = rule.Weights[k] / StepsPerUnit * r * r * this->Evaluate(r);
    for (int moment = 0; moment < 3; ++moment, weighted *= r)
    {
      sums[moment] += weighted;
    }
  }
}

//------------------------------------------------------------------------------
void IntegratedProfile::Integrate(double scale)
{
  this->Scale = scale;
  this->Decay = 0.0;
  this->Total = 0.0;
  for (std::vector<Knot>& knots : this->Table)
  {
    knots.clear();
  }
  if (this->Evaluate(this->GetRadius(0.0)) > 0.0)
  {
    this->IntegrateMoments();
    this->IntegrateTail();
    this->MeasureDecay();
  }
}

//------------------------------------------------------------------------------
void IntegratedProfile::IntegrateMoments()
{
  // Within the table's first radius the profile is a power.
  const double begin = this->GetRadius(0.0);
  const double power = this->EstimatePower(begin);
  double sums[3];
  for (int k = 0; k < 3; ++k)
  {
    sums[k] = std::pow(begin, k + 2) * this->Evaluate(begin) / (k + 2.0 - power);
  }
  for (int i = 0;; ++i)
  {
    const double radius = this->GetRadius(i);
    double rise = radius * radius * this->Evaluate(radius);
    const bool ends = !(rise > Negligible * sums[0]);
    for (int k = 0; k < 3; ++k, rise *= radius)
    {
      this->Table[FIRST_MOMENT + k].push_back({ std::log(sums[k]), ends ? 0.0 : rise / sums[k] });
    }
    if (ends || i == MostIntervals)
    {
      break;
    }
    this->AddInterval(i, sums);
  }
}

//------------------------------------------------------------------------------
void IntegratedProfile::IntegrateTail()
{
  const double pi = vtkMath::Pi();
  const std::size_t last = this->Table[FIRST_MOMENT].size() - 1;
  std::vector<double> tails(last + 1, 0.0);
  if (this->Table[FIRST_MOMENT][last].Slope > 0.0)
  {
    // A power to infinity.
    const double end = this->GetRadius(static_cast<double>(last));
    tails[last] = 2.0 * pi * end * end * this->Evaluate(end) / (this->EstimatePower(end) - 2.0);
  }
  for (std::size_t i = last; i > 0; --i)
  {
    double sums[3] = {};
    this->AddInterval(i - 1, sums);
    tails[i - 1] = tails[i] + 2.0 * pi * sums[0];
  }
  this->Total = tails[0] + 2.0 * pi * std::exp(this->Table[FIRST_MOMENT][0].Value);
  const auto far = std::find_if(tails.begin(), tails.end(),
    [this](double tail) { return tail <= 0.5 * this->Total; });
  this->FirstFar = static_cast<double>(far - tails.begin());
  for (std::size_t i = 0; i <= last; ++i)
  {
    const double radius = this->GetRadius(static_cast<double>(i));
    const double fall = 2.0 * pi * radius * radius * this->Evaluate(radius);
    this->Table[TAIL].push_back({ std::log(tails[i]), -fall / tails[i] });
  }
  if (tails[last] == 0.0)
  {
    // The last interval is cut off: it holds nothing that counts.
    this->Table[TAIL].pop_back();
  }
}

//------------------------------------------------------------------------------
void IntegratedProfile::MeasureDecay()
{
  double before = this->Evaluate(this->GetRadius(0.0));
  for (std::size_t i = 1; i < this->Table[TAIL].size(); ++i)
  {
    if (std::exp(this->Table[TAIL][i].Value) < TailThatMatters * this->Total)
    {
      break;
    }
    const double first = this->GetRadius(static_cast<double>(i) - 1.0);
    const double radius = this->GetRadius(static_cast<double>(i));
    const double value = this->Evaluate(radius);
    const double slope = std::log(before / value) / (radius - first);
    this->Decay = std::max(this->Decay, slope - this->GetNearbySlope(std::sqrt(first * radius)));
    before = value;
  }
}

//------------------------------------------------------------------------------
/// Cubic by values and slopes; a power before the first and after the last knot.
double IntegratedProfile::Interpolate(int quantity, double position) const
{
  const std::vector<Knot>& knots = this->Table[quantity];
  const double last = static_cast<double>(knots.size() - 1);
  if (position <= 0.0 || position >= last)
  {
    const Knot& end = position <= 0.0 ? knots.front() : knots.back();
    const double beyond = position <= 0.0 ? position : position - last;
    return std::exp(end.Value + end.Slope * beyond / StepsPerUnit);
  }
  const std::size_t i = static_cast<std::size_t>(position);
  const double x = position - static_cast<double>(i);
  const double slopes[2] = { knots[i].Slope / StepsPerUnit, knots[i + 1].Slope / StepsPerUnit };
  const double rise = knots[i + 1].Value - knots[i].Value;
  return std::exp(knots[i].Value +
    x *
      (slopes[0] +
        x * (3.0 * rise - 2.0 * slopes[0] - slopes[1] + x * (slopes[0] + slopes[1] - 2.0 * rise))));
}

//------------------------------------------------------------------------------
double IntegratedProfile::GetTail(double radius) const
{
  if (!(radius > 0.0) || this->Total == 0.0)
  {
    return this->Total;
  }
  const double position = StepsPerUnit * (std::log(radius / this->Scale) - FirstLogarithm);
  return position < this->FirstFar
    ? this->Total - 2.0 * vtkMath::Pi() * this->Interpolate(FIRST_MOMENT, position)
    : this->Interpolate(TAIL, position);
}

//------------------------------------------------------------------------------
void IntegratedProfile::GetMoments(double radius, double moments[3]) const
{
  std::fill_n(moments, 3, 0.0);
  if (!(radius > 0.0) || this->Total == 0.0)
  {
    return;
  }
  const double position = StepsPerUnit * (std::log(radius / this->Scale) - FirstLogarithm);
  for (int k = 0; k < 3; ++k)
  {
    moments[k] = this->Interpolate(FIRST_MOMENT + k, position);
  }
  if (position >= this->FirstFar)
  {
    moments[0] = (this->Total - this->Interpolate(TAIL, position)) / (2.0 * vtkMath::Pi());
  }
}
} // namespace LightTransport
