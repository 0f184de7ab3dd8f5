// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/CoordinateRounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
using Points = std::vector<std::array<double, 3>>;

// As in PolygonGathering.cxx: coordinates in single precision come from better ones, rounded once
// or twice, those in double precision from arithmetic of their own.
constexpr double SinglePrecision = 1.5 * 0x1.0p-24;
constexpr double DoublePrecision = 4.0 * 0x1.0p-53;
// Significant digits that numbers are printed with, and that could be by chance.
constexpr int FewestDigits = 6;
constexpr int MostDigits = 12;
constexpr int MostDigitsOfSingle = 6;
// Steps that are coarser than this part of the surface are those of a drawing, not of rounding.
constexpr double CoarsestStep = 1e-4;

//------------------------------------------------------------------------------
int GetExponent(double value)
{
  return static_cast<int>(std::floor(std::log10(value)));
}

//------------------------------------------------------------------------------
bool HasDigits(double value, int digits, bool isSingle)
{
  const double scale = std::pow(10.0, digits - 1 - GetExponent(std::abs(value)));
  const double steps = value * scale;
  const double rounded = std::round(steps);
  return isSingle ? static_cast<float>(rounded / scale) == static_cast<float>(value)
                  : std::abs(steps - rounded) <= 1e-15 * std::abs(steps);
}

//------------------------------------------------------------------------------
// The significant digits that all coordinates were written with; more than `most` where they were
// not.
int FindDigits(const Points& points, int most, bool isSingle)
{
  int digits = 1;
  for (const auto& point : points)
  {
    for (const double value : point)
    {
      while (value != 0.0 && digits <= most && !HasDigits(value, digits, isSingle))
      {
        ++digits;
      }
      if (digits > most)
      {
        return digits;
      }
    }
  }
  return digits;
}

//------------------------------------------------------------------------------
// Whether numbers in double precision were in single precision before, and not exact in fewer bits.
bool WereSingle(const Points& points)
{
  bool needAllBits = false;
  const double fewBits = 0x1.0p20;
  for (const auto& point : points)
  {
    for (const double value : point)
    {
      if (static_cast<double>(static_cast<float>(value)) != value)
      {
        return false;
      }
      int exponent;
      const double steps = std::frexp(value, &exponent) * fewBits;
      needAllBits = needAllBits || steps != std::floor(steps);
    }
  }
  return needAllBits;
}
} // namespace

//------------------------------------------------------------------------------
double CoordinateRounding::Find(const Points& points, bool isSingle)
{
  double largest = 0.0;
  double sum = 0.0;
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = std::numeric_limits<double>::max();
    double high = -low;
    for (const auto& point : points)
    {
      low = std::min(low, point[axis]);
      high = std::max(high, point[axis]);
    }
    const double most = points.empty() ? 0.0 : std::max(std::abs(low), std::abs(high));
    largest = std::max(largest, most);
    sum = std::hypot(sum, most);
    extent = points.empty() ? 0.0 : std::max(extent, high - low);
  }
  if (!(largest > 0.0))
  {
    return 0.0;
  }
  const bool wereSingle = SinglePrecision * sum <= CoarsestStep * extent && WereSingle(points);
  const double precision = isSingle || wereSingle ? SinglePrecision : DoublePrecision;
  const int most = isSingle ? MostDigitsOfSingle : MostDigits;
  const int digits = FindDigits(points, most, isSingle);
  const double step = std::pow(10.0, GetExponent(largest) - digits + 1);
  const bool isPrinted = digits >= FewestDigits && digits <= most && step <= CoarsestStep * extent;
  return std::max(precision * sum, isPrinted ? 0.5 * step : 0.0);
}
} // namespace LightTransport
