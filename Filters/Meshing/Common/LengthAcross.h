// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How a value that grows with distance goes on through a triangle, as in fast marching.
#ifndef LengthAcross_h
#define LengthAcross_h

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
/// The largest value at C that those at A and B, and on the line between them, allow when it grows
/// by at most `growth` per unit of distance.
inline double GetLengthAcross(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c, double lengthAtA, double lengthAtB, double growth)
{
  const double side = (b - a).norm();
  double t = lengthAtA <= lengthAtB ? 0.0 : 1.0;
  const double slope = side > 0.0 ? (lengthAtB - lengthAtA) / side : growth;
  if (std::abs(slope) < growth)
  {
    // Minimum over x of lengthAtA + slope x + growth sqrt((foot - x)^2 + height^2).
    const double foot = (c - a).dot(b - a) / side;
    const double height = (c - a).cross(b - a).norm() / side;
    const double x = foot - height * slope / std::sqrt(growth * growth - slope * slope);
    t = std::min(std::max(x / side, 0.0), 1.0);
  }
  return lengthAtA + t * (lengthAtB - lengthAtA) + growth * (c - (a + t * (b - a))).norm();
}
} // namespace LightTransport

#endif
