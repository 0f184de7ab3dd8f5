// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SmoothPoints.h"

#include "Scene/PatchScene.h"
#include "Shared/DisjointSets.h"
#include "Shared/Pulse.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
PatchScene::Vector GetNormal(const PatchScene& scene, vtkIdType face)
{
  PatchScene::Vector normal = PatchScene::Vector::Zero();
  for (const vtkIdType patch : scene.GetFaces().GetPatches(face))
  {
    normal += scene.GetFaces().GetShare(patch) * scene.GetNormal(patch);
  }
  return normal.stableNormalized();
}

//------------------------------------------------------------------------------
/// The corners of faces at each place and side: those of key k are [Starts[k], Starts[k + 1]).
struct PlaceUses
{
  explicit PlaceUses(const PatchScene& scene)
    : Starts(scene.GetNumberOfPlaces() * scene.GetFaces().GetNumberOfSides() + 1, 0)
  {
    const auto visit = [&scene](auto&& take)
    {
      const SceneFaces& faces = scene.GetFaces();
      vtkIdType corner = 0;
      for (vtkIdType face = 0; face < faces.GetNumberOfFaces(); ++face)
      {
        Pulse::Beat(face);
        const vtkIdType side = faces.GetSide(face);
        for (const vtkIdType place : scene.GetPlaces(faces.GetPolygon(face)))
        {
          if (faces.GetPatch(face) >= 0)
          {
            take(place + side * scene.GetNumberOfPlaces(), corner, face);
          }
          ++corner;
        }
      }
    };
    visit([this](vtkIdType key, vtkIdType, vtkIdType) { ++this->Starts[key + 1]; });
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Corners.resize(this->Starts.back());
    this->Faces.resize(this->Starts.back());
    std::vector<vtkIdType> next(this->Starts.begin(), this->Starts.end() - 1);
    visit(
      [&](vtkIdType key, vtkIdType corner, vtkIdType face)
      {
        this->Corners[next[key]] = corner;
        this->Faces[next[key]++] = face;
      });
  }

  std::vector<vtkIdType> Starts;
  std::vector<vtkIdType> Corners; ///< among those of all faces
  std::vector<vtkIdType> Faces;   ///< as Corners
};
} // namespace

//------------------------------------------------------------------------------
SmoothPoints::SmoothPoints(const PatchScene& scene, double featureAngle,
  const std::vector<double>& materials, int materialComponents)
  : Scene(scene), Groups(scene.GetPlaceOffsets().back() * scene.GetFaces().GetNumberOfSides(), -1)
{
  const double cosine = std::cos(vtkMath::RadiansFromDegrees(featureAngle));
  std::vector<PatchScene::Vector> normals;
  for (vtkIdType face = 0; face < scene.GetFaces().GetNumberOfFaces(); ++face)
  {
    Pulse::Beat(face);
    normals.push_back(GetNormal(scene, face));
  }
  const auto areJoined = [&](vtkIdType a, vtkIdType b)
  {
    const vtkIdType patchA = scene.GetPatch(a);
    const vtkIdType patchB = scene.GetPatch(b);
    return normals[a].dot(normals[b]) >= cosine &&
      std::equal(materials.begin() + patchA * materialComponents,
        materials.begin() + (patchA + 1) * materialComponents,
        materials.begin() + patchB * materialComponents);
  };
  const PlaceUses uses(scene);
  for (std::size_t key = 0; key + 1 < uses.Starts.size(); ++key)
  {
    Pulse::Beat(key);
    const vtkIdType first = uses.Starts[key];
    const vtkIdType count = uses.Starts[key + 1] - first;
    DisjointSets sets(count);
    for (vtkIdType a = 0; a < count; ++a)
    {
      for (vtkIdType b = 0; b < a; ++b)
      {
        if (areJoined(uses.Faces[first + a], uses.Faces[first + b]))
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
vtkIdType SmoothPoints::GetGroup(vtkIdType polygon, int side, vtkIdType corner) const
{
  const std::vector<vtkIdType>& offsets = this->Scene.GetPlaceOffsets();
  return this->Groups[side * offsets.back() + offsets[polygon] + corner];
}

//------------------------------------------------------------------------------
void SmoothPoints::GetMembers(std::vector<vtkIdType>& starts, std::vector<vtkIdType>& patches,
  std::vector<double>& parts) const
{
  const SceneFaces& faces = this->Scene.GetFaces();
  const auto visit = [&](auto&& take)
  {
    std::size_t corner = 0;
    for (vtkIdType face = 0; face < faces.GetNumberOfFaces(); ++face)
    {
      Pulse::Beat(face);
      const SceneFaces::Range places = this->Scene.GetPlaces(faces.GetPolygon(face));
      for (auto place = places.begin(); place != places.end(); ++place, ++corner)
      {
        for (const vtkIdType patch : faces.GetPatches(face))
        {
          take(this->Groups[corner], patch, faces.GetShare(patch) * faces.GetArea(face));
        }
      }
    }
  };
  std::vector<double> areas(this->NumberOfGroups, 0.0);
  starts.assign(this->NumberOfGroups + 1, 0);
  visit(
    [&](vtkIdType group, vtkIdType, double area)
    {
      ++starts[group + 1];
      areas[group] += area;
    });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  patches.resize(starts.back());
  parts.resize(starts.back());
  std::vector<vtkIdType> next(starts.begin(), starts.end() - 1);
  visit(
    [&](vtkIdType group, vtkIdType patch, double area)
    {
      patches[next[group]] = patch;
      parts[next[group]++] = area / areas[group];
    });
}

//------------------------------------------------------------------------------
// Face by face in the order of the patches.
std::vector<double> SmoothPoints::GetMeans(const std::vector<double>& values, int components) const
{
  std::vector<double> means(this->NumberOfGroups * components, 0.0);
  std::vector<double> weights(this->NumberOfGroups, 0.0);
  const SceneFaces& faces = this->Scene.GetFaces();
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    const vtkIdType face = faces.GetFace(patch);
    if (faces.GetPatch(face) != patch)
    {
      continue;
    }
    const double area = faces.GetArea(face);
    const vtkIdType polygon = faces.GetPolygon(face);
    const std::vector<vtkIdType>& offsets = this->Scene.GetPlaceOffsets();
    for (vtkIdType corner = 0; corner < offsets[polygon + 1] - offsets[polygon]; ++corner)
    {
      const vtkIdType group = this->GetGroup(polygon, faces.GetSide(face), corner);
      weights[group] += area;
      for (int component = 0; component < components; ++component)
      {
        means[group * components + component] += area * values[face * components + component];
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
