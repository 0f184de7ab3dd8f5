// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/ShotPatches.h"

#include "Scene/PatchScene.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
vtkDeviceShooter::Patches DescribePatches(const PatchScene& scene)
{
  vtkDeviceShooter::Patches patches;
  for (const PatchScene::Vector& point : scene.GetPoints())
  {
    patches.Points.insert(patches.Points.end(), point.data(), point.data() + 3);
  }
  patches.Offsets.push_back(0);
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const vtkIdType* corners = scene.GetCorners(patch);
    const PatchScene::Vector& normal = scene.GetNormal(patch);
    patches.Corners.insert(patches.Corners.end(), corners,
      corners + scene.GetNumberOfCorners(patch));
    patches.Offsets.push_back(static_cast<vtkIdType>(patches.Corners.size()));
    patches.Normals.insert(patches.Normals.end(), normal.data(), normal.data() + 3);
    patches.Roundings.push_back(scene.GetPlane(patch).Rounding);
    patches.Slopes.push_back(scene.GetPlane(patch).Slope);
  }
  patches.Areas = scene.GetAreas();
  return patches;
}
} // namespace LightTransport
