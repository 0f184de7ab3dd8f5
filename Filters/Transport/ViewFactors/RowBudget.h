// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the errors of the pairs of a row come to together. The estimate of a pair's error is one
 * that is hardly ever exceeded, several times what it is on the average: what many pairs usually
 * are off by adds up, and what one of them is off by beyond that adds as squares do. With one pair
 * its estimate is the row's.
 */
#ifndef RowBudget_h
#define RowBudget_h

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace RowBudget
{
/// The part of a pair's estimate that it is usually off by. In rooms, a city and spheres it is 0.05
/// to 0.13, on the average over the pairs of a row, at whatever tolerance.
constexpr double UsualPart = 0.2;

/// Of pairs with this sum of estimates and of their squares.
inline double GetError(double sum, double squares)
{
  return UsualPart * sum + (1.0 - UsualPart) * std::sqrt(squares);
}

/// The largest a for which further pairs with estimates of a times weights leave the row within
/// `allowed`: sum and squares are those of the estimates so far. 0 where nothing is left.
inline double GetAllowance(double allowed, double sum, double squares, double weights,
  double squaredWeights)
{
  // UsualPart (sum + a weights) + beyond sqrt(squares + a^2 squaredWeights) = allowed
  constexpr double beyond = 1.0 - UsualPart;
  const double left = allowed - UsualPart * sum;
  const double rest = left * left - beyond * beyond * squares;
  if (left <= 0.0 || rest <= 0.0)
  {
    return 0.0;
  }
  const double usual = UsualPart * weights;
  const double root = beyond * std::sqrt(squaredWeights * rest + usual * usual * squares);
  return rest / std::max(left * usual + root, 1e-300);
}
} // namespace RowBudget
} // namespace LightTransport

#endif
