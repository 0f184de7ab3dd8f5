// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Bodies whose exact reflectance is known, so that what walks in a mesh can be tested.
#ifndef FlatBoundaries_h
#define FlatBoundaries_h

#include "Photons/PhotonBoundary.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
/// All below the plane z = 0, which is patch 0.
class HalfSpaceBoundary : public PhotonBoundary
{
public:
  bool FindCrossing(const Path& path, PhotonCrossing& crossing) const override
  {
    crossing = { -path.Origin.z() / path.Direction.z(), Vector::UnitZ(), 0, true };
    return path.IsInside && path.Direction.z() > 0.0 && crossing.Distance <= path.Reach;
  }
  PhotonBall GetBall(const Vector& position) const override
  {
    return { position, position.z() * position.z() };
  }
};

/// Between z = -thickness, patch 1, and z = 0, patch 0.
class SlabBoundary : public PhotonBoundary
{
public:
  explicit SlabBoundary(double thickness) : Thickness(thickness) {}

  bool FindCrossing(const Path& path, PhotonCrossing& crossing) const override
  {
    const bool isUp = path.Direction.z() > 0.0;
    const double height = isUp ? -path.Origin.z() : this->Thickness + path.Origin.z();
    crossing.Distance = std::max(height, 0.0) / std::abs(path.Direction.z());
    crossing.Normal = isUp ? Vector::UnitZ() : Vector(-Vector::UnitZ());
    crossing.Patch = isUp ? 0 : 1;
    crossing.IsExpected = true;
    return path.IsInside && crossing.Distance <= path.Reach;
  }
  PhotonBall GetBall(const Vector& position) const override
  {
    const double height = std::min(-position.z(), this->Thickness + position.z());
    return { position, height > 0.0 ? height * height : 0.0 };
  }

private:
  double Thickness;
};
} // namespace LightTransport

#endif
