// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The parallelogram that a texel is taken for: around its position, in the plane of its normal,
 * along the steps from texel to texel, as large as its area. Neighbours then nearly tile the
 * surface: they overlap, or leave gaps, by a part of a texel that falls with its size.
 */
#ifndef TexelShape_h
#define TexelShape_h

#include <Eigen/Core>

namespace LightTransport
{
class TexelShape
{
public:
  using Vector = Eigen::Vector3d;

  /// `steps` lead to the next texel in a row and in a column. A step that is not known is 0, and
  /// then, and where both have nearly one direction, the texel is a square.
  TexelShape(const Vector& position, const Vector& normal, double area, const Vector steps[2]);

  /// Counter-clockwise seen from the front.
  Vector GetCorner(int corner) const;

private:
  Vector Position;
  Vector Sides[2];
};
} // namespace LightTransport

#endif
