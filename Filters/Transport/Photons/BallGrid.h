// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far the surface is from the centres of the cells of a grid: asked for where photons come,
 * kept for those that come later. Any thread may find it; all find the same.
 */
#ifndef BallGrid_h
#define BallGrid_h

#include "Photons/PhotonBoundary.h"

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace LightTransport
{
class BallGrid
{
public:
  using Vector = Eigen::Vector3d;

  /// Around these points.
  void Build(const std::vector<Vector>& points);

  /// Around the centre of the position's cell; `findRadius(center)` tells how far the surface is.
  template <typename FindRadius>
  PhotonBall Get(const Vector& position, const FindRadius& findRadius) const;

private:
  static constexpr float Unknown = -2.0f;
  // Size of a body across, relative to its length, below which it counts as this.
  static constexpr double Thinnest = 0.01;

  Vector Low = Vector::Zero();
  double CellSize = 1.0;
  int Counts[3] = { 0, 0, 0 };
  mutable std::vector<std::atomic<float>> Radii;
};

//------------------------------------------------------------------------------
inline void BallGrid::Build(const std::vector<Vector>& points)
{
  // As many as a processor keeps near at hand.
  constexpr double mostCells = 1 << 15;
  this->Low = Vector::Constant(PhotonBoundary::Unlimited);
  Vector high = -this->Low;
  for (const Vector& point : points)
  {
    this->Low = this->Low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  // Of a needle or a sheet all along the long sides.
  const Vector size = (high - this->Low).cwiseMax(Thinnest * (high - this->Low).maxCoeff());
  this->CellSize = std::cbrt(size.prod() / mostCells);
  std::size_t cells = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Counts[axis] = static_cast<int>((high[axis] - this->Low[axis]) / this->CellSize) + 1;
    cells *= this->Counts[axis];
  }
  this->Radii = std::vector<std::atomic<float>>(cells);
  std::fill(this->Radii.begin(), this->Radii.end(), Unknown);
}

//------------------------------------------------------------------------------
template <typename FindRadius>
PhotonBall BallGrid::Get(const Vector& position, const FindRadius& findRadius) const
{
  std::size_t cell = 0;
  Vector center;
  for (int axis = 2; axis >= 0; --axis)
  {
    const int index =
      std::min(std::max(static_cast<int>((position[axis] - this->Low[axis]) / this->CellSize), 0),
        this->Counts[axis] - 1);
    center[axis] = this->Low[axis] + (index + 0.5) * this->CellSize;
    cell = cell * this->Counts[axis] + index;
  }
  float radius = this->Radii[cell].load(std::memory_order_relaxed);
  if (radius == Unknown)
  {
    radius = std::max(0.0f, static_cast<float>(findRadius(center)));
    this->Radii[cell].store(radius, std::memory_order_relaxed);
  }
  return { center, double(radius) * radius };
}
} // namespace LightTransport

#endif
