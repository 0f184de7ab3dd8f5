// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SmoothPoints.h"

#include "Scene/PatchScene.h"
#include "Shared/DisjointSets.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
/// The corners that use each point: those of point p are [Starts[p], Starts[p + 1]) of Corners.
struct PointUses
{
  explicit PointUses(const PatchGeometry& patches)
    : Starts(patches.GetPoints().size() + 1, 0), Corners(patches.GetCorners().size()),
      Patches(patches.GetCorners().size())
  {
    for (const vtkIdType point : patches.GetCorners())
    {
      ++this->Starts[point + 1];
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    std::vector<vtkIdType> next(this->Starts.begin(), this->Starts.end() - 1);
    for (vtkIdType patch = 0; patch < patches.GetNumberOfPatches(); ++patch)
    {
      for (vtkIdType corner = patches.GetOffsets()[patch]; corner < patches.GetOffsets()[patch + 1];
           ++corner)
      {
        const vtkIdType use = next[patches.GetCorners()[corner]]++;
        this->Corners[use] = corner;
        this->Patches[use] = patch;
      }
    }
  }

  std::vector<vtkIdType> Starts;
  std::vector<vtkIdType> Corners;
  std::vector<vtkIdType> Patches; ///< as Corners
};
} // namespace

//------------------------------------------------------------------------------
SmoothPoints::SmoothPoints(const PatchScene& scene, double featureAngle,
  const std::vector<double>& materials, int materialComponents)
  : Scene(scene), Groups(scene.GetCorners().size(), 0)
{
  const double cosine = std::cos(vtkMath::RadiansFromDegrees(featureAngle));
  const auto areJoined = [&](vtkIdType a, vtkIdType b)
  {
    return scene.GetNormal(a).dot(scene.GetNormal(b)) >= cosine &&
      std::equal(materials.begin() + a * materialComponents,
        materials.begin() + (a + 1) * materialComponents,
        materials.begin() + b * materialComponents);
  };
  const PointUses uses(scene);
  for (std::size_t point = 0; point < scene.GetPoints().size(); ++point)
  {
    const vtkIdType first = uses.Starts[point];
    const vtkIdType count = uses.Starts[point + 1] - first;
    DisjointSets sets(count);
    for (vtkIdType a = 0; a < count; ++a)
    {
      for (vtkIdType b = 0; b < a; ++b)
      {
        if (areJoined(uses.Patches[first + a], uses.Patches[first + b]))
        {
          sets.Join(a, b);
        }
      }
    }
    std::vector<vtkIdType> groups(count, -1);
    for (vtkIdType a = 0; a < count; ++a)
    {
      vtkIdType& group = groups[sets.Find(a)];
      group = group < 0 ? this->NumberOfGroups++ : group;
      this->Groups[uses.Corners[first + a]] = group;
    }
  }
}

//------------------------------------------------------------------------------
std::vector<double> SmoothPoints::GetMeans(const std::vector<double>& values, int components) const
{
  std::vector<double> means(this->NumberOfGroups * components, 0.0);
  std::vector<double> weights(this->NumberOfGroups, 0.0);
  const std::vector<vtkIdType>& offsets = this->Scene.GetOffsets();
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    const double area = this->Scene.GetAreas()[patch];
    for (vtkIdType corner = offsets[patch]; corner < offsets[patch + 1]; ++corner)
    {
      const vtkIdType group = this->Groups[corner];
      weights[group] += area;
      for (int component = 0; component < components; ++component)
      {
        means[group * components + component] += area * values[patch * components + component];
      }
    }
  }
  for (std::size_t k = 0; k < means.size(); ++k)
  {
    means[k] /= weights[k / components];
  }
  return means;
}
} // namespace LightTransport
