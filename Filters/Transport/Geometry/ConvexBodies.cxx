// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/ConvexBodies.h"

#include "Geometry/PatchEdges.h"
#include "Geometry/PlaneSides.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = ConvexBodies::Vector;

// Points are compared with all sides of what may be a body: not with more than this.
constexpr double MostComparisons = 3e8;
// A side that is missing has borders no further off its plane than this many roundings of a patch.
constexpr double MostRoundings = 4.0;
// Of bodies with more sides than this a sphere inside is what hides.
constexpr std::size_t MostSides = 64;
// The part of a segment that is inside, at least: what touches a body passes by.
constexpr double LeastPart = 1e-9;

//------------------------------------------------------------------------------
double GetSquaredDistance(const Vector& point, const Vector& from, const Vector& to)
{
  const Vector along = to - from;
  const double length = along.squaredNorm();
  const double place = length > 0.0 ? (point - from).dot(along) / length : 0.0;
  return (from + std::clamp(place, 0.0, 1.0) * along - point).squaredNorm();
}

//------------------------------------------------------------------------------
Vector GetMiddle(const std::vector<Vector>& points)
{
  return std::accumulate(points.begin(), points.end(), Vector(Vector::Zero())) /
    static_cast<double>(points.size());
}
} // namespace

//------------------------------------------------------------------------------
// Patches that meet at edges at which they bound something convex, and what all of these bound.
class ConvexBodies::Builder
{
public:
  Builder(const PatchScene& scene, const PatchGeometry& walls, const std::vector<vtkIdType>& wallOf)
    : Scene(scene), Walls(walls), WallOf(wallOf), Parents(scene.GetNumberOfPatches()),
      Borders(scene.GetNumberOfPatches())
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  // Calls add(body, its walls).
  template <typename Add>
  void Build(const Add& add)
  {
    this->Connect();
    std::vector<std::vector<vtkIdType>> groups(this->Parents.size());
    for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
    {
      groups[this->FindRoot(patch)].push_back(patch);
    }
    for (const std::vector<vtkIdType>& group : groups)
    {
      Body body;
      if (group.size() >= 3 && this->Bound(group, body))
      {
        add(std::move(body), this->Own);
      }
    }
  }

private:
  vtkIdType FindRoot(vtkIdType patch)
  {
    while (this->Parents[patch] != patch)
    {
      this->Parents[patch] = this->Parents[this->Parents[patch]];
      patch = this->Parents[patch];
    }
    return patch;
  }

  void Connect()
  {
    const std::vector<PatchEdge> edges = FindPatchEdges(this->Scene);
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last)
    {
      Pulse::Beat(first);
      for (last = first + 1; last < edges.size() && edges[last].IsAt(edges[first]);)
      {
        ++last;
      }
      if (last == first + 2 && edges[first].IsForward != edges[first + 1].IsForward &&
        this->IsBehind(edges[first].Patch, edges[first + 1].Patch) &&
        this->IsBehind(edges[first + 1].Patch, edges[first].Patch))
      {
        this->Parents[this->FindRoot(edges[first].Patch)] = this->FindRoot(edges[first + 1].Patch);
        continue;
      }
      for (std::size_t k = first; k < last; ++k)
      {
        this->Borders[edges[k].Patch].push_back(edges[k]);
      }
    }
  }

  // Whether no corner of a patch is in front of another.
  bool IsBehind(vtkIdType patch, vtkIdType other) const
  {
    const PatchPlane plane = this->Scene.GetPlane(other);
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(patch); ++corner)
    {
      if (plane.GetCertainHeight(this->Scene.GetCorner(patch, corner)) > 0.0)
      {
        return false;
      }
    }
    return true;
  }

  // What a group of patches bounds; false where that is nothing convex.
  bool Bound(const std::vector<vtkIdType>& group, Body& body)
  {
    this->Own.clear();
    std::vector<vtkIdType> corners;
    for (const vtkIdType patch : group)
    {
      this->Own.push_back(this->WallOf[patch]);
      const vtkIdType* const first = this->Scene.GetCorners(patch);
      corners.insert(corners.end(), first, first + this->Scene.GetNumberOfCorners(patch));
    }
    const auto unite = [](std::vector<vtkIdType>& numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    };
    unite(this->Own);
    unite(corners);
    this->Points.clear();
    for (const vtkIdType corner : corners)
    {
      this->Points.push_back(this->Scene.GetPoints()[corner]);
    }
    const auto comparisons = static_cast<double>(this->Own.size() * this->Points.size());
    return comparisons <= MostComparisons && this->AddWalls(body) && this->Close(group, body) &&
      this->Measure(body);
  }

  bool AddWalls(Body& body) const
  {
    for (const vtkIdType wall : this->Own)
    {
      Pulse::Beat();
      body.Sides.push_back(this->Walls.GetPlane(wall));
      if (!this->IsSide(body.Sides.back()))
      {
        return false;
      }
    }
    return true;
  }

  // Whether no point is in front, and not all are in the plane.
  bool IsSide(const PatchPlane& plane) const
  {
    bool isThick = false;
    for (const Vector& point : this->Points)
    {
      const double height = plane.GetCertainHeight(point);
      if (height > 0.0)
      {
        return false;
      }
      isThick = isThick || height < 0.0;
    }
    return isThick;
  }

  // Borders bound a side that is missing, which nothing of the scene may be beyond.
  bool Close(const std::vector<vtkIdType>& group, Body& body) const
  {
    PatchPlane plane;
    Vector missing = Vector::Zero();
    Vector sum = Vector::Zero();
    double count = 0.0;
    for (const vtkIdType patch : group)
    {
      missing -= this->Scene.GetAreas()[patch] * this->Scene.GetNormal(patch);
      plane.Rounding =
        std::max(plane.Rounding, MostRoundings * this->Scene.GetPlane(patch).Rounding);
      for (const PatchEdge& edge : this->Borders[patch])
      {
        sum += this->Scene.GetPoints()[edge.Low] + this->Scene.GetPoints()[edge.High];
        count += 2.0;
      }
    }
    if (count == 0.0)
    {
      return true;
    }
    plane.Origin = sum / count;
    plane.Normal = missing.normalized();
    plane.Slope = plane.SlopeAlong =
      plane.Rounding / std::max(std::sqrt(missing.norm()), plane.Rounding);
    for (const vtkIdType patch : group)
    {
      for (const PatchEdge& edge : this->Borders[patch])
      {
        if (plane.GetCertainHeight(this->Scene.GetPoints()[edge.Low]) != 0.0 ||
          plane.GetCertainHeight(this->Scene.GetPoints()[edge.High]) != 0.0)
        {
          return false;
        }
      }
    }
    body.Sides.push_back(plane);
    PatchPlane back = plane;
    back.Normal = -plane.Normal;
    return this->IsSide(plane) && !IsAnyBehind(this->Scene, back);
  }

  bool Measure(Body& body) const
  {
    body.Lower = body.Upper = this->Points.front();
    body.Center = GetMiddle(this->Points);
    for (const Vector& point : this->Points)
    {
      body.Lower = body.Lower.cwiseMin(point);
      body.Upper = body.Upper.cwiseMax(point);
      body.OuterRadius = std::max(body.OuterRadius, (point - body.Center).norm());
    }
    body.InnerRadius = body.OuterRadius;
    for (const PatchPlane& side : body.Sides)
    {
      const double distance = (body.Center - side.Origin).norm();
      body.InnerRadius =
        std::min(body.InnerRadius, -side.GetHeight(body.Center) - side.GetTolerance(distance));
    }
    return body.InnerRadius > 0.0;
  }

  const PatchScene& Scene;
  const PatchGeometry& Walls;
  const std::vector<vtkIdType>& WallOf;
  std::vector<vtkIdType> Parents;
  std::vector<std::vector<PatchEdge>> Borders;
  // Of one group.
  std::vector<vtkIdType> Own;
  std::vector<Vector> Points;
};

//------------------------------------------------------------------------------
void ConvexBodies::Find(const PatchScene& scene, const PatchGeometry& walls,
  const std::vector<vtkIdType>& wallOf)
{
  this->Bodies.clear();
  this->BodyOf.assign(walls.GetNumberOfPatches(), -1);
  this->Outside.assign(scene.GetNumberOfPatches(), true);
  Builder(scene, walls, wallOf)
    .Build(
      [this](Body&& body, const std::vector<vtkIdType>& own)
      {
        for (const vtkIdType wall : own)
        {
          this->BodyOf[wall] = this->GetNumberOfBodies();
        }
        this->Bodies.push_back(std::move(body));
      });
  for (int body = 0; body < this->GetNumberOfBodies(); ++body)
  {
    this->MarkInside(scene, wallOf, body);
  }
}

//------------------------------------------------------------------------------
// Patches that are not beside a body, near which they are.
void ConvexBodies::MarkInside(const PatchScene& scene, const std::vector<vtkIdType>& wallOf,
  int body)
{
  const Body& own = this->Bodies[body];
  const double spare = own.Sides.front().Rounding;
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    Pulse::Beat();
    const PatchTree::Node& node = scene.GetTree().GetNode(open.back());
    open.pop_back();
    if ((node.Lower - own.Upper).maxCoeff() > spare || (own.Lower - node.Upper).maxCoeff() > spare)
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left);
      open.push_back(node.Left + 1);
      continue;
    }
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      if (this->BodyOf[wallOf[patch]] != body && !this->IsBeside(scene, patch, body))
      {
        this->Outside[patch] = false;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Whether a patch is over one of the sides, and does not lie on it and face it.
bool ConvexBodies::IsBeside(const PatchScene& scene, vtkIdType patch, int body) const
{
  return std::any_of(this->Bodies[body].Sides.begin(), this->Bodies[body].Sides.end(),
    [&](const PatchPlane& side)
    {
      bool isOn = true;
      for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
      {
        const double height = side.GetCertainHeight(scene.GetCorner(patch, corner));
        if (height < 0.0)
        {
          return false;
        }
        isOn = isOn && height == 0.0;
      }
      return !isOn || side.Normal.dot(scene.GetNormal(patch)) > 0.0;
    });
}

//------------------------------------------------------------------------------
// The part of a segment that is inside is an interval. Where those from two points to a third one
// have one of some length, so has any from between the two: what holds for the corners holds for
// all.
bool ConvexBodies::IsBetween(int body, const std::vector<Vector>& from,
  const std::vector<Vector>& to) const
{
  const Body& own = this->Bodies[body];
  const auto comesWithin = [&](const Vector& a, const Vector& b, double radius)
  { return GetSquaredDistance(own.Center, a, b) < radius * radius; };
  if (!comesWithin(GetMiddle(from), GetMiddle(to), own.OuterRadius))
  {
    return false;
  }
  const auto all = [&](const auto& isTrue)
  {
    return std::all_of(from.begin(), from.end(),
      [&](const Vector& a)
      { return std::all_of(to.begin(), to.end(), [&](const Vector& b) { return isTrue(a, b); }); });
  };
  if (own.Sides.size() > MostSides)
  {
    return all([&](const Vector& a, const Vector& b)
      { return comesWithin(a, b, (1.0 - LeastPart) * own.InnerRadius); });
  }
  std::array<double, MostPoints * MostPoints> begins{}, ends;
  ends.fill(1.0);
  std::array<double, MostPoints> heights;
  for (const PatchPlane& side : own.Sides)
  {
    for (std::size_t k = 0; k < to.size(); ++k)
    {
      heights[k] = side.GetCertainHeight(to[k]);
    }
    for (std::size_t j = 0; j < from.size(); ++j)
    {
      const double begin = side.GetCertainHeight(from[j]);
      for (std::size_t k = 0; k < to.size(); ++k)
      {
        const double end = heights[k];
        if (begin > 0.0 && end > 0.0)
        {
          return false;
        }
        double& first = begins[j * MostPoints + k];
        double& last = ends[j * MostPoints + k];
        first = begin > 0.0 ? std::max(first, begin / (begin - end)) : first;
        last = end > 0.0 ? std::min(last, begin / (begin - end)) : last;
        if (last - first < LeastPart)
        {
          return false;
        }
      }
    }
  }
  return true;
}
} // namespace LightTransport
