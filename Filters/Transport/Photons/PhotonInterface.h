// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The smooth surface between a body and the outside, for one ray: how much of it is reflected, and
/// where the rest goes (Snell).
#ifndef PhotonInterface_h
#define PhotonInterface_h

#include "Shared/Fresnel.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
class PhotonInterface
{
public:
  using Vector = Eigen::Vector3d;

  explicit PhotonInterface(double refractiveIndex) : Index(refractiveIndex) {}

  /// Of a ray from inside. `cosine` of its angle with the outward normal.
  double GetInternalReflectance(double cosine) const
  {
    const double square = 1.0 - this->Index * this->Index * (1.0 - cosine * cosine);
    return square > 0.0 ? Fresnel::GetReflectance(std::sqrt(square), this->Index) : 1.0;
  }
  /// Of a ray from outside. `cosine` of its angle with the inward normal.
  double GetExternalReflectance(double cosine) const
  {
    return Fresnel::GetReflectance(cosine, this->Index);
  }

  ///@{ The direction behind the surface, for one that is not totally reflected.
  Vector RefractOutwards(const Vector& direction, const Vector& outward) const
  {
    return Bend(direction, outward, this->Index);
  }
  Vector RefractInwards(const Vector& direction, const Vector& outward) const
  {
    return Bend(direction, -outward, 1.0 / this->Index);
  }
  ///@}

  static Vector Reflect(const Vector& direction, const Vector& normal)
  {
    return (direction - 2.0 * direction.dot(normal) * normal).normalized();
  }

private:
  // `ahead` is the normal on the side where the ray goes.
  static Vector Bend(const Vector& direction, const Vector& ahead, double ratio)
  {
    const double cosine = direction.dot(ahead);
    const double square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    return (ratio * direction + (std::sqrt(std::max(square, 0.0)) - ratio * cosine) * ahead)
      .normalized();
  }

  double Index;
};
} // namespace LightTransport

#endif
