// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The plane of a patch, and how well its coordinates tell what is in front of it: points nearer to
 * it than the tolerance are on it. Whatever decides between front and back asks here, so that two
 * surfaces in one place (the sides of a sheet, a wall that two rooms share), whose coordinates
 * rounding has parted, are one place to all of them.
 *
 * The tolerance has a part that holds at the patch and one that grows with the distance from it:
 * the normal of a small patch is known less well than that of a large one, and that of a sliver
 * less well around its long axis than across it.
 */
#ifndef PatchPlane_h
#define PatchPlane_h

#include <Eigen/Core>

#include <cmath>

namespace LightTransport
{
struct PatchPlane
{
  using Vector = Eigen::Vector3d;

  Vector Origin = Vector::Zero(); ///< centroid of the patch
  Vector Normal = Vector::UnitZ();
  double Rounding = 0.0;           ///< of heights at the patch
  double Slope = 0.0;              ///< what is added for each unit of distance, at most
  double SlopeAlong = 0.0;         ///< of it, along the patch where that is long
  Vector Across = Vector::UnitX(); ///< in the plane, the direction in which it is narrow

  double GetHeight(const Vector& point) const { return (point - this->Origin).dot(this->Normal); }

  ///@{ Bounds of the tolerance at a distance from Origin.
  double GetTolerance(double distance) const { return this->Rounding + this->Slope * distance; }
  double GetLeastTolerance(double distance) const
  {
    return this->Rounding + this->SlopeAlong * distance;
  }
  ///@}

  /// The height, or 0 where the coordinates cannot tell it from that.
  double GetCertainHeight(const Vector& point) const
  {
    const Vector offset = point - this->Origin;
    const double height = offset.dot(this->Normal);
    const double left = std::abs(height) - this->Rounding -
      (this->Slope - this->SlopeAlong) * std::abs(offset.dot(this->Across));
    const bool isOn =
      left <= 0.0 || left * left <= this->SlopeAlong * this->SlopeAlong * offset.squaredNorm();
    return isOn ? 0.0 : height;
  }
};
} // namespace LightTransport

#endif
