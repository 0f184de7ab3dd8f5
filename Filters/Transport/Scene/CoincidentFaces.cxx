// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/CoincidentFaces.h"

#include "Geometry/FlatRegion.h"
#include "Scene/PatchScene.h"
#include "Scene/PolygonList.h"
#include "Shared/Pulse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;
using FlatRegion::Region;

// Neighbours overlap by what rounding does to their common edge; less than this part of the smaller
// one is no overlap either.
constexpr double LeastPart = 1e-6;

//------------------------------------------------------------------------------
/// Patches in the plane of one of them.
class Plane
{
public:
  Plane(const PatchScene& scene, vtkIdType patch)
    : Scene(scene), Origin(scene.GetCentroid(patch)), U(scene.GetNormal(patch).unitOrthogonal()),
      V(scene.GetNormal(patch).cross(U))
  {
  }

  Region Project(vtkIdType patch) const
  {
    Region region;
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(patch); ++corner)
    {
      const Vector place = this->Scene.GetCorner(patch, corner) - this->Origin;
      region.emplace_back(place.dot(this->U), place.dot(this->V));
    }
    return region;
  }

private:
  const PatchScene& Scene;
  Vector Origin;
  Vector U;
  Vector V;
};

//------------------------------------------------------------------------------
double GetNoise(const PatchScene& scene, vtkIdType patch, double edgeRounding)
{
  return LeastPart * scene.GetAreas()[patch] + 4.0 * edgeRounding * scene.GetRadius(patch);
}

//------------------------------------------------------------------------------
bool AreInOnePlane(const PatchScene& scene, vtkIdType i, vtkIdType j)
{
  const auto isOn = [&](vtkIdType patch, vtkIdType other)
  {
    const PatchPlane plane = scene.GetPlane(other);
    bool on = true;
    for (int corner = 0; on && corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      on = plane.GetCertainHeight(scene.GetCorner(patch, corner)) == 0.0;
    }
    return on;
  };
  return scene.GetNormal(i).dot(scene.GetNormal(j)) > 0.0 && isOn(i, j) && isOn(j, i);
}

//------------------------------------------------------------------------------
// Whether patch i has an overlap with patch j, which is in its plane.
bool Overlap(const PatchScene& scene, vtkIdType i, vtkIdType j)
{
  const Plane plane(scene, i);
  const Region common = FlatRegion::Clip(plane.Project(i), plane.Project(j));
  const double rounding = std::max(scene.GetEdgeRounding(i), scene.GetEdgeRounding(j));
  return FlatRegion::GetArea(common) >
    std::min(GetNoise(scene, i, rounding), GetNoise(scene, j, rounding));
}

//------------------------------------------------------------------------------
// Whether nodes may have patches at one place that face the same way.
bool MayMeet(const PatchTree::Node& a, const PatchTree::Node& b, double tolerance)
{
  const bool areApart = (a.Lower.array() > b.Upper.array() + tolerance).any() ||
    (b.Lower.array() > a.Upper.array() + tolerance).any();
  const auto getHalf = [](const PatchTree::Node& node)
  { return std::acos(std::clamp(node.ConeCosine, -1.0, 1.0)); };
  constexpr double margin = 1e-3;
  return !areApart &&
    std::acos(std::clamp(a.ConeAxis.dot(b.ConeAxis), -1.0, 1.0)) <=
    getHalf(a) + getHalf(b) + margin;
}

//------------------------------------------------------------------------------
/// Calls take(i, j) for each pair of patches that may lie on each other.
template <typename Take>
class PairWalk
{
public:
  PairWalk(const PatchTree& tree, double tolerance, const Take& take)
    : Tree(tree), Tolerance(tolerance), Pair(take)
  {
  }

  void Walk(int one, int other) const
  {
    Pulse::Beat();
    const PatchTree::Node& a = this->Tree.GetNode(one);
    const PatchTree::Node& b = this->Tree.GetNode(other);
    if (one != other && !MayMeet(a, b, this->Tolerance))
    {
      return;
    }
    if (a.IsLeaf() && b.IsLeaf())
    {
      for (vtkIdType i = a.First; i < a.Last; ++i)
      {
        for (vtkIdType j = one == other ? i + 1 : b.First; j < b.Last; ++j)
        {
          this->Pair(i, j);
        }
      }
    }
    else if (one == other)
    {
      this->Walk(a.Left, a.Left);
      this->Walk(a.Left, a.Left + 1);
      this->Walk(a.Left + 1, a.Left + 1);
    }
    else if (b.IsLeaf() || (!a.IsLeaf() && a.GetSize() >= b.GetSize()))
    {
      this->Walk(a.Left, other);
      this->Walk(a.Left + 1, other);
    }
    else
    {
      this->Walk(one, b.Left);
      this->Walk(one, b.Left + 1);
    }
  }

private:
  const PatchTree& Tree;
  double Tolerance;
  const Take& Pair;
};

//------------------------------------------------------------------------------
// Of a patch what is left beside others.
double GetUncovered(const PatchScene& scene, vtkIdType patch, const std::vector<vtkIdType>& others,
  double noise)
{
  const Plane plane(scene, patch);
  std::vector<Region> left{ plane.Project(patch) };
  const double least = LeastPart * noise;
  for (const vtkIdType other : others)
  {
    const Region cover = plane.Project(other);
    std::vector<Region> beside;
    for (Region region : left)
    {
      for (std::size_t k = 0; k < cover.size() && !region.empty(); ++k)
      {
        const FlatRegion::Point& a = cover[k];
        const FlatRegion::Point& b = cover[(k + 1) % cover.size()];
        Region outside = FlatRegion::Clip(region, b, a);
        if (FlatRegion::GetArea(outside) > least)
        {
          beside.push_back(std::move(outside));
        }
        region = FlatRegion::Clip(region, a, b);
      }
    }
    left.swap(beside);
  }
  double area = 0.0;
  for (const Region& region : left)
  {
    area += FlatRegion::GetArea(region);
  }
  return area;
}
} // namespace

//------------------------------------------------------------------------------
CoincidentFaces::CoincidentFaces(const PatchScene& scene) : Scene(scene)
{
  this->Decide(this->FindPairs());
}

//------------------------------------------------------------------------------
std::vector<CoincidentFaces::Pair> CoincidentFaces::FindPairs() const
{
  std::vector<Pair> pairs;
  const SceneFaces& faces = this->Scene.GetFaces();
  const auto take = [&](vtkIdType i, vtkIdType j)
  {
    const double reach = this->Scene.GetRadius(i) + this->Scene.GetRadius(j);
    const Vector apart = this->Scene.GetCentroid(i) - this->Scene.GetCentroid(j);
    if (faces.GetFace(i) != faces.GetFace(j) && apart.squaredNorm() < reach * reach &&
      AreInOnePlane(this->Scene, i, j) && Overlap(this->Scene, i, j))
    {
      pairs.push_back(faces.GetFace(i) > faces.GetFace(j) ? Pair(i, j) : Pair(j, i));
    }
  };
  double tolerance = 0.0;
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    tolerance = std::max(tolerance,
      this->Scene.GetPlane(patch).GetTolerance(2.0 * this->Scene.GetRadius(patch)));
  }
  PairWalk<decltype(take)>(this->Scene.GetTree(), tolerance, take).Walk(0, 0);
  return pairs;
}

//------------------------------------------------------------------------------
// A face is left out as a whole or not at all.
void CoincidentFaces::Decide(const std::vector<Pair>& pairs)
{
  std::map<vtkIdType, std::vector<vtkIdType>> others; // of patches
  std::map<vtkIdType, double> covered;                // areas of faces
  std::map<vtkIdType, double> noise;
  for (const Pair& pair : pairs)
  {
    others[pair.first].push_back(pair.second);
  }
  const SceneFaces& faces = this->Scene.GetFaces();
  for (const auto& [patch, below] : others)
  {
    Pulse::Beat();
    const double patchNoise = GetNoise(this->Scene, patch, this->Scene.GetEdgeRounding(patch));
    covered[faces.GetFace(patch)] +=
      this->Scene.GetAreas()[patch] - GetUncovered(this->Scene, patch, below, patchNoise);
    noise[faces.GetFace(patch)] += patchNoise;
  }
  for (const auto& [face, area] : covered)
  {
    if (area >= faces.GetArea(face) - noise[face])
    {
      this->Covered.push_back(face);
    }
    else
    {
      this->Overlapping.push_back(face);
      this->OverlappingArea += area * this->Scene.GetScale() * this->Scene.GetScale();
    }
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> CoincidentFaces::GetWarnings() const
{
  std::vector<std::string> warnings;
  this->AddWarning(this->Covered,
    " on others of lower numbers that face the same way: left out, with results of 0. Remove one "
    "of the two, or put the one that is to count first.",
    warnings);
  std::ostringstream text;
  text << " partly on others of lower numbers that face the same way: an area of "
       << this->OverlappingArea << " counts twice. Cut it out of one of the two.";
  this->AddWarning(this->Overlapping, text.str(), warnings);
  return warnings;
}

//------------------------------------------------------------------------------
void CoincidentFaces::AddWarning(const std::vector<vtkIdType>& faces, const std::string& text,
  std::vector<std::string>& warnings) const
{
  std::vector<vtkIdType> sides[2];
  for (const vtkIdType face : faces)
  {
    sides[this->Scene.GetFaces().GetSide(face)].push_back(this->Scene.GetFaces().GetPolygon(face));
  }
  for (int side = 0; side < 2; ++side)
  {
    if (!sides[side].empty())
    {
      warnings.push_back((side == 0 ? "" : "Backs of ") + PolygonList::Format(sides[side], text));
    }
  }
}
} // namespace LightTransport
