// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/SceneLook.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
// Patches that all others are looked at from, and how many pairs of each a ray goes through.
constexpr vtkIdType Lookouts = 128;
constexpr vtkIdType RaysEach = 32;

//------------------------------------------------------------------------------
bool AreFacing(const PatchScene& scene, vtkIdType a, vtkIdType b)
{
  const PatchScene::Vector between = scene.GetCentroid(b) - scene.GetCentroid(a);
  return between.dot(scene.GetNormal(a)) > 0.0 && between.dot(scene.GetNormal(b)) < 0.0;
}
} // namespace

//------------------------------------------------------------------------------
Outcome SceneLook::Take(const PatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  SceneRayCaster caster;
  Outcome built = caster.Build(scene);
  const vtkIdType lookouts = std::min(patches, Lookouts);
  const vtkIdType step = std::max<vtkIdType>(patches / RaysEach, 1);
  double facing = 0.0, looked = 0.0, hidden = 0.0;
  for (vtkIdType k = 0; built && k < lookouts; ++k)
  {
    const vtkIdType from = k * patches / lookouts;
    for (vtkIdType to = 0; to < patches; ++to)
    {
      if (!AreFacing(scene, from, to))
      {
        continue;
      }
      facing += 1.0;
      if ((to + k) % step == 0)
      {
        looked += 1.0;
        hidden +=
          caster.IsOccluded(scene.GetCentroid(from), scene.GetCentroid(to), from, to) ? 1.0 : 0.0;
      }
    }
  }
  this->Patches = static_cast<double>(patches);
  this->Pairs = 0.5 * this->Patches * this->Patches;
  this->FacingPairs = lookouts > 0 ? 0.5 * facing * this->Patches / lookouts : 0.0;
  this->HiddenShare = looked > 0.0 ? hidden / looked : 0.0;
  return built;
}
} // namespace LightTransport
