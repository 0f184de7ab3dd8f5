// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/PointSource.h"

#include "Shared/GaussLegendre.h"

#include <cmath>
#include <cstddef>

namespace LightTransport
{
namespace
{
///@{ Spacing of the table in t, its end (radii up to exp(30) depths), and the points of the rule
/// that fills an interval.
constexpr double TableStep = 1.0 / 32.0;
constexpr int TableIntervals = 32 * 30;
constexpr int PointsOfInterval = 4;
///@}

/// Within this many depths the closed forms of the moments cancel, and few points are exact.
constexpr double Nearby = 0.5;
constexpr int PointsNearby = 10;
} // namespace

//------------------------------------------------------------------------------
PointSource::PointSource(double depth, double transportCoefficient)
  : Depth(depth), TransportCoefficient(transportCoefficient)
{
  this->TabulateSecondMoment();
}

//------------------------------------------------------------------------------
double PointSource::Evaluate(double radius) const
{
  const double sigma = this->TransportCoefficient;
  const double distance = std::sqrt(radius * radius + this->Depth * this->Depth);
  return this->Depth * (1.0 + sigma * distance) * std::exp(-sigma * distance) /
    (distance * distance * distance);
}

//------------------------------------------------------------------------------
double PointSource::GetTail(double radius) const
{
  const double distance = std::sqrt(radius * radius + this->Depth * this->Depth);
  return this->Depth * std::exp(-this->TransportCoefficient * distance) / distance;
}

//------------------------------------------------------------------------------
void PointSource::AddMoments(double radius, double moments[3]) const
{
  if (radius < Nearby * this->Depth)
  {
    this->AddMomentsNearby(radius, moments);
    return;
  }
  // By parts: with T the tail, the value times r dr is -dT, which leaves integrals of
  // exp(-sigma d) / d.
  const double tail = this->GetTail(radius);
  moments[0] += std::exp(-this->TransportCoefficient * this->Depth) - tail;
  moments[1] += this->Depth * this->InterpolateSecondMoment(radius) - radius * tail;
  moments[2] += 2.0 * this->Depth * this->GetFirstMomentOfTail(radius) - radius * radius * tail;
}

//------------------------------------------------------------------------------
void PointSource::AddMomentsNearby(double radius, double moments[3]) const
{
  static const GaussLegendre rule(PointsNearby);
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double r = radius * rule.Nodes[k];
    const double weighted = radius * rule.Weights[k] * r * this->Evaluate(r);
    moments[0] += weighted;
    moments[1] += weighted * r;
    moments[2] += weighted * r * r;
  }
}

//------------------------------------------------------------------------------
/// Integral from 0 to radius of r exp(-sigma d) / d dr.
double PointSource::GetFirstMomentOfTail(double radius) const
{
  const double distance = std::sqrt(radius * radius + this->Depth * this->Depth);
  const double path = radius * radius / (distance + this->Depth);
  const double exponent = this->TransportCoefficient * path;
  const double mean = exponent > 0.0 ? -std::expm1(-exponent) / exponent : 1.0;
  return std::exp(-this->TransportCoefficient * this->Depth) * path * mean;
}

//------------------------------------------------------------------------------
void PointSource::TabulateSecondMoment()
{
  const GaussLegendre rule(PointsOfInterval);
  const double scale = this->TransportCoefficient * this->Depth;
  this->Table.assign(TableIntervals + 1, 0.0);
  for (int i = 0; i < TableIntervals; ++i)
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
    {
      sum += rule.Weights[k] * std::exp(-scale * std::cosh((i + rule.Nodes[k]) * TableStep));
    }
    this->Table[i + 1] = this->Table[i] + TableStep * sum;
  }
}

//------------------------------------------------------------------------------
double PointSource::InterpolateSecondMoment(double radius) const
{
  const double scale = this->TransportCoefficient * this->Depth;
  const double position = std::asinh(radius / this->Depth) / TableStep;
  if (position >= TableIntervals)
  {
    return this->Table.back();
  }
  const int i = static_cast<int>(position);
  const double x = position - i;
  const double slopes[2] = { TableStep * std::exp(-scale * std::cosh(i * TableStep)),
    TableStep * std::exp(-scale * std::cosh((i + 1) * TableStep)) };
  const double rise = this->Table[i + 1] - this->Table[i];
  return this->Table[i] +
    x *
    (slopes[0] +
      x * (3.0 * rise - 2.0 * slopes[0] - slopes[1] + x * (slopes[0] + slopes[1] - 2.0 * rise)));
}
} // namespace LightTransport
