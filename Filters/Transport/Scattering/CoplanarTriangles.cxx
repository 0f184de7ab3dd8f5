// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/CoplanarTriangles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
bool CoplanarTriangles::Set(const Vector a[3], const Vector b[3], double flatness)
{
  const Vector* const corners[2] = { a, b };
  Vector normals[2];
  double areas[2];
  for (int side = 0; side < 2; ++side)
  {
    const Vector* const c = corners[side];
    normals[side] = (c[1] - c[0]).cross(c[2] - c[0]);
    areas[side] = normals[side].norm();
    normals[side] /= areas[side];
    for (int k = 0; k < 3; ++k)
    {
      this->Edges[side][k] = { c[k], c[(k + 1) % 3] - c[k] };
    }
  }
  this->Sign = normals[0].dot(normals[1]) > 0.0 ? 1.0 : -1.0;
  const double most = flatness * std::sqrt(std::min(areas[0], areas[1]));
  const auto isOff = [&](int side)
  {
    return std::any_of(corners[1 - side], corners[1 - side] + 3,
      [&](const Vector& corner)
      { return std::abs(normals[side].dot(corner - corners[side][0])) > most; });
  };
  return !isOff(0) && !isOff(1);
}

//------------------------------------------------------------------------------
CoplanarTriangles::Pair CoplanarTriangles::GetPair(int number) const
{
  const Segment& first = this->Edges[0][number / 3];
  const Segment& second = this->Edges[1][number % 3];
  return { first, second, -this->Sign * first.Way.dot(second.Way) };
}
} // namespace LightTransport
