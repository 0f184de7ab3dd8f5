// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/PlaneSides.h"

#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
bool IsAnyBehind(const PatchScene& scene, const PatchPlane& plane)
{
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const PatchTree::Node& node = scene.GetTree().GetNode(open.back());
    open.pop_back();
    const PatchScene::Vector lowest =
      (plane.Normal.array() > 0.0).select(node.Lower.array(), node.Upper.array()).matrix();
    const double nearest =
      (node.Lower - plane.Origin).cwiseMax(plane.Origin - node.Upper).cwiseMax(0.0).norm();
    if (plane.GetHeight(lowest) >= -plane.GetLeastTolerance(nearest))
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left);
      open.push_back(node.Left + 1);
      continue;
    }
    for (vtkIdType other = node.First; other < node.Last; ++other)
    {
      for (int corner = 0; corner < scene.GetNumberOfCorners(other); ++corner)
      {
        if (plane.GetCertainHeight(scene.GetCorner(other, corner)) < 0.0)
        {
          return true;
        }
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::vector<bool> FindHollows(const PatchScene& scene)
{
  std::vector<bool> hollows(scene.GetNumberOfPatches());
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    PatchPlane plane = scene.GetPlane(patch);
    plane.Normal = -plane.Normal;
    hollows[patch] = IsAnyBehind(scene, plane);
  }
  return hollows;
}
} // namespace LightTransport
