// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ClusterSampler.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;
}

//------------------------------------------------------------------------------
ClusterSampler::ClusterSampler(const PatchScene& scene, const LinkSlots& slots)
  : Scene(scene), Slots(slots), AreaBefore(scene.GetNumberOfPatches() + 1, 0.0)
{
  std::partial_sum(scene.GetAreas().begin(), scene.GetAreas().end(), this->AreaBefore.begin() + 1);
}

//------------------------------------------------------------------------------
ClusterSampler::Samples ClusterSampler::Take(int slot, Randomness& random) const
{
  const std::vector<double>& before = this->AreaBefore;
  const bool isPatch = this->Slots.IsPatch(slot);
  const PatchTree::Node& node = this->Scene.GetTree().GetNode(this->Slots.GetNode(slot));
  const vtkIdType first = isPatch ? this->Slots.GetPatch(slot) : node.First;
  const vtkIdType last = isPatch ? first + 1 : node.Last;
  const double area = before[last] - before[first];
  Samples samples;
  for (int k = 0; k < Points; ++k)
  {
    const double target = before[first] + area * (k + random.Get()) / Points;
    const auto next = std::upper_bound(before.begin() + first + 1, before.begin() + last, target);
    const vtkIdType patch = std::min<vtkIdType>(next - before.begin(), last) - 1;
    const double within = (target - before[patch]) / (before[patch + 1] - before[patch]);
    samples[k] = { patch,
      this->GetPoint(patch, std::min(std::max(within, 0.0), 1.0), random.Get()) };
  }
  return samples;
}

//------------------------------------------------------------------------------
// A point of a patch from two numbers, evenly.
Vector ClusterSampler::GetPoint(vtkIdType patch, double u, double v) const
{
  const int last = this->Scene.GetNumberOfCorners(patch) - 2;
  const Vector& origin = this->Scene.GetCorner(patch, 0);
  int corner = 1;
  if (last > 1)
  {
    double left = u * this->Scene.GetAreas()[patch];
    for (;; ++corner)
    {
      const Vector a = this->Scene.GetCorner(patch, corner) - origin;
      const Vector b = this->Scene.GetCorner(patch, corner + 1) - origin;
      const double area = 0.5 * a.cross(b).norm();
      if (left < area || corner == last)
      {
        u = std::min(left / area, 1.0);
        break;
      }
      left -= area;
    }
  }
  const double root = std::sqrt(u);
  return origin + root * (1.0 - v) * (this->Scene.GetCorner(patch, corner) - origin) +
    root * v * (this->Scene.GetCorner(patch, corner + 1) - origin);
}
} // namespace LightTransport
