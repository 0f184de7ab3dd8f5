// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/DiffusionProfile.h"

#include "Shared/Fresnel.h"
#include "Shared/GaussLegendre.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Spacing of the table in t, and its end: radii up to exp(30) depths.
constexpr double TableStep = 1.0 / 32.0;
constexpr int TableIntervals = 32 * 30;

//------------------------------------------------------------------------------
double PointSource(double depth, double sigma, double radius)
{
  const double distance = std::sqrt(radius * radius + depth * depth);
  return depth * (1.0 + sigma * distance) * std::exp(-sigma * distance) /
    (distance * distance * distance);
}

//------------------------------------------------------------------------------
double PointSourceTail(double depth, double sigma, double radius)
{
  const double distance = std::sqrt(radius * radius + depth * depth);
  return depth * std::exp(-sigma * distance) / distance;
}

//------------------------------------------------------------------------------
/// Within half a depth, where the closed forms cancel, and few points are exact.
void AddMomentsNearby(double depth, double sigma, double radius, double moments[3])
{
  static const GaussLegendre rule(10);
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double r = radius * rule.Nodes[k];
    const double weighted = radius * rule.Weights[k] * r * PointSource(depth, sigma, r);
    moments[0] += weighted;
    moments[1] += weighted * r;
    moments[2] += weighted * r * r;
  }
}

//------------------------------------------------------------------------------
/// Integral from 0 to radius of r exp(-sigma d) / d dr.
double FirstMomentOfTail(double depth, double sigma, double radius)
{
  const double distance = std::sqrt(radius * radius + depth * depth);
  const double path = radius * radius / (distance + depth);
  const double exponent = sigma * path;
  const double mean = exponent > 0.0 ? -std::expm1(-exponent) / exponent : 1.0;
  return std::exp(-sigma * depth) * path * mean;
}
} // namespace

//------------------------------------------------------------------------------
DiffusionProfile::DiffusionProfile(double scattering, double absorption, double refractiveIndex)
{
  const double extinction = scattering + absorption;
  const double internal = Fresnel::GetMeanInternalReflectance(refractiveIndex);
  const double mismatch = (1.0 + internal) / (1.0 - internal);
  this->Albedo = scattering / extinction;
  this->DiffusionCoefficient = 1.0 / (3.0 * extinction);
  this->TransportCoefficient = std::sqrt(3.0 * absorption * extinction);
  this->Depths[0] = 1.0 / extinction;
  this->Depths[1] = this->Depths[0] + 4.0 * mismatch * this->DiffusionCoefficient;
  this->Total = this->GetTail(0.0);
  this->TabulateSecondMoment();
}

//------------------------------------------------------------------------------
double DiffusionProfile::Evaluate(double radius) const
{
  const double sigma = this->TransportCoefficient;
  return this->Albedo / (4.0 * vtkMath::Pi()) *
    (PointSource(this->Depths[0], sigma, radius) + PointSource(this->Depths[1], sigma, radius));
}

//------------------------------------------------------------------------------
double DiffusionProfile::GetTail(double radius) const
{
  const double sigma = this->TransportCoefficient;
  return 0.5 * this->Albedo *
    (PointSourceTail(this->Depths[0], sigma, radius) +
      PointSourceTail(this->Depths[1], sigma, radius));
}

//------------------------------------------------------------------------------
void DiffusionProfile::GetMoments(double radius, double moments[3]) const
{
  const double sigma = this->TransportCoefficient;
  std::fill_n(moments, 3, 0.0);
  for (int source = 0; source < 2; ++source)
  {
    const double depth = this->Depths[source];
    if (radius < 0.5 * depth)
    {
      AddMomentsNearby(depth, sigma, radius, moments);
      continue;
    }
    // By parts: R r dr = -dT / (2 pi) with T the tail, which leaves integrals of exp(-sigma d) / d.
    const double tail = PointSourceTail(depth, sigma, radius);
    moments[0] += std::exp(-sigma * depth) - tail;
    moments[1] += depth * this->InterpolateSecondMoment(source, radius) - radius * tail;
    moments[2] += 2.0 * depth * FirstMomentOfTail(depth, sigma, radius) - radius * radius * tail;
  }
  for (int k = 0; k < 3; ++k)
  {
    moments[k] *= this->Albedo / (4.0 * vtkMath::Pi());
  }
}

//------------------------------------------------------------------------------
void DiffusionProfile::TabulateSecondMoment()
{
  const GaussLegendre rule(4);
  for (int source = 0; source < 2; ++source)
  {
    const double scale = this->TransportCoefficient * this->Depths[source];
    std::vector<double>& table = this->Table[source];
    table.assign(TableIntervals + 1, 0.0);
    for (int i = 0; i < TableIntervals; ++i)
    {
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
      {
        sum += rule.Weights[k] * std::exp(-scale * std::cosh((i + rule.Nodes[k]) * TableStep));
      }
      table[i + 1] = table[i] + TableStep * sum;
    }
  }
}

//------------------------------------------------------------------------------
double DiffusionProfile::InterpolateSecondMoment(int source, double radius) const
{
  const std::vector<double>& table = this->Table[source];
  const double scale = this->TransportCoefficient * this->Depths[source];
  const double position = std::asinh(radius / this->Depths[source]) / TableStep;
  if (position >= TableIntervals)
  {
    return table.back();
  }
  const int i = static_cast<int>(position);
  const double x = position - i;
  const double slopes[2] = { TableStep * std::exp(-scale * std::cosh(i * TableStep)),
    TableStep * std::exp(-scale * std::cosh((i + 1) * TableStep)) };
  const double rise = table[i + 1] - table[i];
  return table[i] +
    x *
    (slopes[0] +
      x * (3.0 * rise - 2.0 * slopes[0] - slopes[1] + x * (slopes[0] + slopes[1] - 2.0 * rise)));
}
} // namespace LightTransport
