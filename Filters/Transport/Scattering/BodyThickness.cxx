// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/BodyThickness.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Threads.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
constexpr int PatchesPerTask = 64;
} // namespace

//------------------------------------------------------------------------------
Outcome BodyThickness::Measure(const PatchScene& scene, std::vector<double>& thickness)
{
  SceneRayCaster caster;
  if (Outcome built = caster.Build(scene); !built)
  {
    return built;
  }
  thickness.assign(scene.GetAreas().size(), 1.0);
  const auto measure = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      const PatchScene::Vector& origin = scene.GetCentroid(patch);
      const PatchScene::Vector inward = -scene.GetNormal(patch);
      bool front = false;
      const vtkIdType hit = caster.FindHit(origin, inward, patch, front);
      if (hit >= 0)
      {
        const PatchScene::Vector& normal = scene.GetNormal(hit);
        const double distance = normal.dot(scene.GetCentroid(hit) - origin) / normal.dot(inward);
        thickness[patch] = std::clamp(std::isfinite(distance) ? distance : 0.0, 0.0, 1.0);
      }
    }
  };
  Threads::For(0, static_cast<vtkIdType>(thickness.size()), PatchesPerTask, measure);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
double BodyThickness::GetTransportCoefficient(const ScatteringMedium& medium)
{
  return std::sqrt(3.0 * medium.Absorption * (medium.Absorption + medium.Scattering));
}
} // namespace LightTransport
