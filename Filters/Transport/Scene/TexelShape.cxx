// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TexelShape.h"

#include <Eigen/Geometry>

#include <cmath>

namespace LightTransport
{
namespace
{
// Of the angle between both steps: below it they tell no shape.
constexpr double SmallestSine = 0.05;

//------------------------------------------------------------------------------
// A direction of 0 where there is none.
TexelShape::Vector GetDirection(const TexelShape::Vector& vector)
{
  TexelShape::Vector direction = vector;
  direction.stableNormalize();
  return direction;
}
} // namespace

//------------------------------------------------------------------------------
TexelShape::TexelShape(const Vector& position, const Vector& normal, double area,
  const Vector steps[2])
  : Position(position)
{
  // Normals that cancel each other leave the plane of the steps.
  Vector front = GetDirection(normal);
  front =
    front.isZero() ? GetDirection(GetDirection(steps[0]).cross(GetDirection(steps[1]))) : front;
  front = front.isZero() ? Vector(Vector::UnitZ()) : front;
  const double root = std::sqrt(area);
  Vector directions[2];
  double lengths[2];
  for (int side = 0; side < 2; ++side)
  {
    const Vector step = steps[side] - front.dot(steps[side]) * front;
    lengths[side] = std::sqrt(step.stableNorm());
    directions[side] = GetDirection(step);
  }
  const double sine = front.dot(directions[0].cross(directions[1]));
  if (sine > SmallestSine)
  {
    const double stretch = root / std::sqrt(sine);
    this->Sides[0] = stretch * (lengths[0] / lengths[1]) * directions[0];
    this->Sides[1] = stretch * (lengths[1] / lengths[0]) * directions[1];
    return;
  }
  const bool hasRow = !directions[0].isZero();
  Vector along = hasRow ? directions[0] : directions[1];
  along = along.isZero() ? front.unitOrthogonal() : along;
  const Vector across = front.cross(along);
  this->Sides[0] = root * (hasRow ? along : Vector(-across));
  this->Sides[1] = root * (hasRow ? across : along);
}

//------------------------------------------------------------------------------
TexelShape::Vector TexelShape::GetCorner(int corner) const
{
  const double alongRow = corner == 1 || corner == 2 ? 0.5 : -0.5;
  const double alongColumn = corner >= 2 ? 0.5 : -0.5;
  return this->Position + alongRow * this->Sides[0] + alongColumn * this->Sides[1];
}
} // namespace LightTransport
