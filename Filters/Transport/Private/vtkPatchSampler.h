// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Deterministic, well spread sample points: an additive recurrence in up to four dimensions (Roberts 2018, the generalised golden
 * ratio), shifted by a hash so that different pairs or patches do not repeat each other's errors. The same key and index give the
 * same point, on any thread.
 */
#ifndef vtkPatchSampler_h
#define vtkPatchSampler_h

#include "vtkPatchScene.h"

#include <cmath>
#include <cstdint>

class vtkPatchSampler
{
public:
  explicit vtkPatchSampler(std::uint64_t key)
  {
    for (double& shift : this->Shifts)
    {
      key += 0x9E3779B97F4A7C15ull;
      std::uint64_t bits = key;
      bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
      bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
      bits ^= bits >> 31;
      shift = static_cast<double>(bits >> 11) * 0x1.0p-53;
    }
  }

  /// Coordinate `dimension` (0 to 3) of point `index`, in [0, 1).
  double Get(int index, int dimension) const
  {
    // Powers of 1/x, where x solves x^5 = x + 1.
    constexpr double steps[4] = { 0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
      0.5385972572236101 };
    const double value = this->Shifts[dimension] + (index + 1) * steps[dimension];
    return value - std::floor(value);
  }

  /// A uniformly distributed point of a patch, from dimensions `first` and `first` + 1 of point `index`.
  vtkPatchScene::Vector GetPoint(
    const vtkPatchScene& scene, vtkIdType patch, int index, int first) const
  {
    double u = this->Get(index, first);
    double v = this->Get(index, first + 1);
    const vtkPatchScene::Vector& origin = scene.GetCorner(patch, 0);
    int corner = 1;
    if (scene.GetNumberOfCorners(patch) > 3)
    {
      corner = ChooseTriangle(scene, patch, u);
    }
    if (u + v > 1.0)
    {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    return origin + u * (scene.GetCorner(patch, corner) - origin) +
      v * (scene.GetCorner(patch, corner + 1) - origin);
  }

private:
  // A triangle of the fan by its share of the area; u is stretched so that it is uniform within it.
  static int ChooseTriangle(const vtkPatchScene& scene, vtkIdType patch, double& u)
  {
    const vtkPatchScene::Vector& origin = scene.GetCorner(patch, 0);
    const vtkPatchScene::Vector& normal = scene.GetNormal(patch);
    const int last = scene.GetNumberOfCorners(patch) - 2;
    double left = u * scene.GetAreas()[patch];
    for (int corner = 1;; ++corner)
    {
      const vtkPatchScene::Vector a = scene.GetCorner(patch, corner) - origin;
      const vtkPatchScene::Vector b = scene.GetCorner(patch, corner + 1) - origin;
      const double area = 0.5 *
        (normal.x() * (a.y() * b.z() - a.z() * b.y()) +
          normal.y() * (a.z() * b.x() - a.x() * b.z()) +
          normal.z() * (a.x() * b.y() - a.y() * b.x()));
      if (left < area || corner == last)
      {
        u = area > 0.0 ? std::fmin(left / area, 1.0) : 0.0;
        return corner;
      }
      left -= area;
    }
  }

  double Shifts[4];
};

#endif
