// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface of the body in which photons walk: a mesh (MeshBoundary), a half space or a slab
 * (FlatBoundaries.h). Lengths in the unit of the walk.
 */
#ifndef PhotonBoundary_h
#define PhotonBoundary_h

#include "vtkType.h"

#include <Eigen/Core>

#include <limits>

namespace LightTransport
{
/// Where a path meets the surface.
struct PhotonCrossing
{
  double Distance = 0.0;
  Eigen::Vector3d Normal = Eigen::Vector3d::UnitZ(); ///< outwards
  vtkIdType Patch = -1;
  /// Met from the side on which the photon was believed to be. If not it has slipped through, by
  /// rounding at an edge or through a hole.
  bool IsExpected = true;
};

/// Where no surface is.
struct PhotonBall
{
  Eigen::Vector3d Center = Eigen::Vector3d::Zero();
  double SquaredRadius = 0.0;

  bool Contains(const Eigen::Vector3d& point) const
  {
    return (point - this->Center).squaredNorm() < this->SquaredRadius;
  }
};

class PhotonBoundary
{
public:
  using Vector = Eigen::Vector3d;
  static constexpr double Unlimited = std::numeric_limits<double>::infinity();

  virtual ~PhotonBoundary() = default;

  /// A path: `Direction` is a unit vector, `From` the patch that it starts on, -1 for none.
  struct Path
  {
    Vector Origin;
    Vector Direction;
    double Reach;
    bool IsInside;
    vtkIdType From;
  };

  /// The first place within reach where a path leaves the body, or enters it if it runs outside.
  /// Thread-safe.
  virtual bool FindCrossing(const Path& path, PhotonCrossing& crossing) const = 0;

  /// A ball around a point inside that the surface does not reach; not necessarily the largest one,
  /// and an empty one where that is not known. Thread-safe.
  virtual PhotonBall GetBall(const Vector& position) const = 0;
};
} // namespace LightTransport

#endif
