// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Vectors for tests of link operators in single precision, and how far results are off.
#ifndef LinkOperatorTesting_h
#define LinkOperatorTesting_h

#include "LightTransportTesting.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace LightTransportTesting
{
using Vector = std::vector<double>;

/// Numbers of either sign, from -1 to 1, that this type holds exactly.
template <typename Real = double>
Vector MakeVector(std::size_t size, unsigned int seed)
{
  std::mt19937 engine(seed);
  Vector values(size);
  for (double& value : values)
  {
    value = static_cast<Real>(engine() % 20001) / Real(10000) - Real(1);
  }
  return values;
}

/// `bound`: the sums of the absolute terms of each value, of which errors may be the fraction
/// `tolerance`.
inline bool CheckWithinBound(const Vector& found, const Vector& expected, const Vector& bound,
  double tolerance, const std::string& what)
{
  double worst = 0.0;
  for (std::size_t index = 0; index < found.size(); ++index)
  {
    const double error = std::abs(found[index] - expected[index]) / (bound[index] + 1e-30);
    worst = std::isfinite(error) ? std::max(worst, error) : HUGE_VAL;
  }
  std::cout << what << ": largest relative error " << worst << "\n";
  return Check(worst <= tolerance, what + " is wrong");
}
} // namespace LightTransportTesting

#endif
