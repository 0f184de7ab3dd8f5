// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/OccluderWalls.h"

#include "Geometry/PatchEdges.h"
#include "Scene/PatchScene.h"
#include "Scene/SceneFaces.h"
#include "Shared/Pulse.h"

#include <Eigen/Geometry>

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
// What the areas of a convex polygon and of the patches that fill it may differ by, relative.
constexpr double AreaRounding = 1e-9;
// How many times the rounding of one patch the corners of many may be off a plane or an edge.
constexpr double MostRoundings = 4.0;
// Of the order in which a hull takes the points of a grid.
constexpr double Slant = 0.37;
// Clipped walls have corners more.
constexpr std::size_t MostCorners = 16;
// By how much a place may be beside a wall and still be taken for hidden (the scene is 1 large).
constexpr double BorderRounding = 1e-13;

//------------------------------------------------------------------------------
// Lists of what is beside each patch.
std::vector<std::vector<vtkIdType>> FindNeighbours(const PatchScene& scene)
{
  std::vector<std::vector<vtkIdType>> neighbours(scene.GetNumberOfPatches());
  const std::vector<PatchEdge> edges = FindPatchEdges(scene);
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
  {
    if (edges[k].IsAt(edges[k + 1]))
    {
      neighbours[edges[k].Patch].push_back(edges[k + 1].Patch);
      neighbours[edges[k + 1].Patch].push_back(edges[k].Patch);
    }
  }
  return neighbours;
}
} // namespace

//------------------------------------------------------------------------------
// Patches in one plane, cut in two until they fill convex polygons.
class OccluderWalls::Builder
{
public:
  Builder(const PatchScene& scene, std::vector<vtkIdType>& wallOf)
    : Scene(scene), WallOf(wallOf), Corners(scene.GetNumberOfPatches())
  {
  }

  // Corners of the walls, each by its first patch; empty for all other patches.
  std::vector<std::vector<vtkIdType>> Build()
  {
    const auto neighbours = FindNeighbours(this->Scene);
    std::fill(this->WallOf.begin(), this->WallOf.end(), -1);
    for (vtkIdType seed = 0; seed < this->Scene.GetNumberOfPatches(); ++seed)
    {
      Pulse::Beat(seed);
      if (this->WallOf[seed] < 0)
      {
        this->SetPlane(seed);
        this->Join(this->Gather(seed, neighbours));
      }
    }
    return std::move(this->Corners);
  }

private:
  using Members = std::vector<vtkIdType>;

  void SetPlane(vtkIdType seed)
  {
    this->Plane = this->Scene.GetPlane(seed);
    // Along an edge: grids are cut between their rows.
    this->AxisU = (this->Scene.GetCorner(seed, 1) - this->Scene.GetCorner(seed, 0)).normalized();
    this->AxisV = this->Plane.Normal.cross(this->AxisU);
  }

  bool IsInPlane(vtkIdType patch) const
  {
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(patch); ++corner)
    {
      if (this->Plane.GetCertainHeight(this->Scene.GetCorner(patch, corner)) != 0.0)
      {
        return false;
      }
    }
    return true;
  }

  // All that is connected with the seed in its plane and belongs to no wall.
  Members Gather(vtkIdType seed, const std::vector<Members>& neighbours)
  {
    Members members(1, seed);
    this->WallOf[seed] = seed;
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      for (const vtkIdType next : neighbours[members[k]])
      {
        if (this->WallOf[next] < 0 && this->IsInPlane(next))
        {
          this->WallOf[next] = seed;
          members.push_back(next);
        }
      }
    }
    std::sort(members.begin(), members.end());
    return members;
  }

  // Make walls of patches in one plane.
  void Join(Members members)
  {
    const vtkIdType first = members.front();
    if (members.size() == 1)
    {
      const vtkIdType* corners = this->Scene.GetCorners(first);
      this->Corners[first].assign(corners, corners + this->Scene.GetNumberOfCorners(first));
      this->WallOf[first] = first;
      return;
    }
    std::vector<vtkIdType> hull = this->FindHull(members);
    if (hull.size() <= MostCorners && this->IsFilled(hull, members))
    {
      this->Corners[first] = std::move(hull);
      for (const vtkIdType member : members)
      {
        this->WallOf[member] = first;
      }
      return;
    }
    Members second = this->CutInTwo(members);
    this->Join(std::move(members));
    this->Join(std::move(second));
  }

  std::array<double, 2> GetPlace(const Vector& point) const
  {
    return { point.dot(this->AxisU), point.dot(this->AxisV) };
  }

  // By Andrew's chains: counter-clockwise, no corners along edges. Points come aslant to the grid:
  // rounding would put those of a column in any order.
  std::vector<vtkIdType> FindHull(const Members& members) const
  {
    std::vector<std::pair<std::array<double, 2>, vtkIdType>> points;
    for (const vtkIdType member : members)
    {
      for (int corner = 0; corner < this->Scene.GetNumberOfCorners(member); ++corner)
      {
        const vtkIdType point = this->Scene.GetCorners(member)[corner];
        const auto place = this->GetPlace(this->Scene.GetPoints()[point]);
        points.push_back({ { place[0] + Slant * place[1], place[1] - Slant * place[0] }, point });
      }
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto isTurn = [&](std::size_t a, std::size_t b, std::size_t c)
    {
      const auto &p = points[a].first, &q = points[b].first, &r = points[c].first;
      const double u[2] = { q[0] - p[0], q[1] - p[1] };
      const double v[2] = { r[0] - p[0], r[1] - p[1] };
      return u[0] * v[1] - u[1] * v[0] >
        MostRoundings * this->Plane.Rounding * std::hypot(v[0], v[1]);
    };
    std::vector<std::size_t> chain;
    const auto add = [&](std::size_t point, std::size_t least)
    {
      while (chain.size() > least && !isTurn(chain[chain.size() - 2], chain.back(), point))
      {
        chain.pop_back();
      }
      chain.push_back(point);
    };
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      add(k, 1);
    }
    const std::size_t lower = chain.size();
    for (std::size_t k = points.size() - 1; k-- > 0;)
    {
      add(k, lower);
    }
    std::vector<vtkIdType> hull;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
    {
      hull.push_back(points[chain[k]].second);
    }
    return hull;
  }

  // Lies on another one that faces the same way, in part.
  bool IsOverlapping(vtkIdType patch) const
  {
    const vtkIdType face = this->Scene.GetFaces().GetFace(patch);
    return (this->Scene.GetProblems()[face] & SceneFaces::COINCIDENT) != 0;
  }

  // Whether the patches fill their hull, and lie in its plane: far away the seed's is not that
  // certain. What is there twice, as both sides of a sheet are, would make up for a hole as large.
  bool IsFilled(const std::vector<vtkIdType>& hull, const Members& members) const
  {
    const std::vector<Vector>& points = this->Scene.GetPoints();
    Vector twice = Vector::Zero();
    for (std::size_t k = 1; k + 1 < hull.size(); ++k)
    {
      twice += (points[hull[k]] - points[hull[0]]).cross(points[hull[k + 1]] - points[hull[0]]);
    }
    const Vector normal = twice.normalized();
    double sum = 0.0;
    double largest = 0.0;
    for (const vtkIdType member : members)
    {
      if (this->Scene.GetNormal(member).dot(normal) <= 0.0 || this->IsOverlapping(member))
      {
        return false;
      }
      sum += this->Scene.GetAreas()[member];
      for (int corner = 0; corner < this->Scene.GetNumberOfCorners(member); ++corner)
      {
        const Vector offset = this->Scene.GetCorner(member, corner) - points[hull[0]];
        largest = std::max(largest, std::abs(normal.dot(offset)));
      }
    }
    return hull.size() >= 3 && std::abs(0.5 * twice.norm() - sum) <= AreaRounding * sum &&
      largest <= MostRoundings * this->Plane.Rounding;
  }

  // Keeps one part and returns the other: across the longer direction, at the widest gap between
  // centroids in the middle.
  Members CutInTwo(Members& members) const
  {
    std::array<double, 2> lower, upper;
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
    for (const vtkIdType member : members)
    {
      const auto place = this->GetPlace(this->Scene.GetCentroid(member));
      for (int axis = 0; axis < 2; ++axis)
      {
        lower[axis] = std::min(lower[axis], place[axis]);
        upper[axis] = std::max(upper[axis], place[axis]);
      }
    }
    const int axis = upper[0] - lower[0] >= upper[1] - lower[1] ? 0 : 1;
    const auto get = [&](vtkIdType member)
    { return this->GetPlace(this->Scene.GetCentroid(member))[axis]; };
    std::sort(members.begin(), members.end(),
      [&](vtkIdType a, vtkIdType b)
      {
        const double left = get(a), right = get(b);
        return left < right || (left == right && a < b);
      });
    std::size_t cut = members.size() / 2;
    for (std::size_t k = (members.size() + 3) / 4; k <= members.size() - (members.size() + 3) / 4;
         ++k)
    {
      const double widest = get(members[cut]) - get(members[cut - 1]);
      cut = get(members[k]) - get(members[k - 1]) > widest + BorderRounding ? k : cut;
    }
    Members second(members.begin() + static_cast<std::ptrdiff_t>(cut), members.end());
    members.resize(cut);
    std::sort(members.begin(), members.end());
    std::sort(second.begin(), second.end());
    return second;
  }

  const PatchScene& Scene;
  std::vector<vtkIdType>& WallOf;
  std::vector<std::vector<vtkIdType>> Corners;
  PatchPlane Plane;
  Vector AxisU, AxisV;
};

//------------------------------------------------------------------------------
OccluderWalls::OccluderWalls(const PatchScene& scene)
  : PatchGeometry(scene), WallOf(scene.GetNumberOfPatches())
{
  const std::vector<std::vector<vtkIdType>> corners = Builder(scene, this->WallOf).Build();
  std::vector<vtkIdType> numbers(corners.size());
  this->Offsets.assign(1, 0);
  this->Corners.clear();
  for (std::size_t patch = 0; patch < corners.size(); ++patch)
  {
    numbers[patch] = static_cast<vtkIdType>(this->Offsets.size()) - 1;
    if (!corners[patch].empty())
    {
      this->Corners.insert(this->Corners.end(), corners[patch].begin(), corners[patch].end());
      this->Offsets.push_back(static_cast<vtkIdType>(this->Corners.size()));
    }
  }
  this->AllocatePatches();
  std::vector<vtkIdType> sizes(corners.size(), 0);
  for (const vtkIdType first : this->WallOf)
  {
    ++sizes[first];
  }
  for (std::size_t patch = 0; patch < corners.size(); ++patch)
  {
    Pulse::Beat(patch);
    // A patch by itself stays in the plane that it has, which may be that of a larger polygon.
    if (sizes[patch] > 0)
    {
      const Vector& normal = scene.GetNormal(static_cast<vtkIdType>(patch));
      this->ComputePatch(numbers[patch], sizes[patch] == 1 ? &normal : nullptr);
    }
  }
  std::transform(this->WallOf.begin(), this->WallOf.end(), this->WallOf.begin(),
    [&](vtkIdType first) { return numbers[first]; });
  this->FindNodes(scene);
  this->FindBorders();
  this->Bodies.Find(scene, *this, this->WallOf);
}

//------------------------------------------------------------------------------
void OccluderWalls::FindNodes(const PatchScene& scene)
{
  std::vector<std::array<vtkIdType, 2>> ranges(this->GetNumberOfPatches(),
    { scene.GetNumberOfPatches(), -1 });
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    auto& range = ranges[this->WallOf[patch]];
    range = { std::min(range[0], patch), std::max(range[1], patch) };
  }
  this->Nodes.resize(ranges.size());
  const PatchTree& tree = scene.GetTree();
  for (std::size_t wall = 0; wall < ranges.size(); ++wall)
  {
    int node = 0;
    while (!tree.GetNode(node).IsLeaf())
    {
      const int left = tree.GetNode(node).Left;
      const vtkIdType cut = tree.GetNode(left).Last;
      if (ranges[wall][0] < cut && ranges[wall][1] >= cut)
      {
        break;
      }
      node = ranges[wall][1] < cut ? left : left + 1;
    }
    this->Nodes[wall] = node;
  }
}

//------------------------------------------------------------------------------
void OccluderWalls::FindBorders()
{
  for (vtkIdType wall = 0; wall < this->GetNumberOfPatches(); ++wall)
  {
    const int count = this->GetNumberOfCorners(wall);
    for (int corner = 0; corner < count; ++corner)
    {
      const Vector& begin = this->GetCorner(wall, corner);
      const Vector edge = this->GetCorner(wall, (corner + 1) % count) - begin;
      this->Inwards.push_back(this->GetNormal(wall).cross(edge).normalized());
      this->Heights.push_back(this->Inwards.back().dot(begin));
    }
  }
}

//------------------------------------------------------------------------------
bool OccluderWalls::IsInside(vtkIdType wall, const Vector& place) const
{
  for (vtkIdType k = this->Offsets[wall]; k < this->Offsets[wall + 1]; ++k)
  {
    if (this->Inwards[k].dot(place) < this->Heights[k] - BorderRounding)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void OccluderWalls::End::Set(std::vector<Vector> points, bool isOutside)
{
  this->Points = std::move(points);
  this->IsOutside = isOutside;
  this->Middle = std::accumulate(this->Points.begin(), this->Points.end(), Vector(Vector::Zero())) /
    static_cast<double>(this->Points.size());
  this->SquaredReach = (this->Points[0] - this->Points[this->Points.size() / 2]).squaredNorm();
}

//------------------------------------------------------------------------------
// Whether a segment comes near a wall on its way through the plane.
bool OccluderWalls::MayHide(vtkIdType wall, const Vector& from, const Vector& to) const
{
  const Vector& normal = this->GetNormal(wall);
  const Vector& middle = this->GetCentroid(wall);
  const double begin = normal.dot(from - middle);
  const double end = normal.dot(to - middle);
  if (begin * end >= 0.0)
  {
    return false;
  }
  const double reach = (1.0 + 1e-6) * this->GetRadius(wall) + BorderRounding;
  return (from + begin / (begin - end) * (to - from) - middle).squaredNorm() <= reach * reach;
}

//------------------------------------------------------------------------------
// All segments cross the wall's plane within the hull of the places where those between the given
// points do.
bool OccluderWalls::HidesAll(vtkIdType wall, const End& from, const End& to, bool strictly) const
{
  // Most walls are smaller than either end, or beside the segment between the middles.
  const double reach = std::min(from.SquaredReach, to.SquaredReach);
  if (16.0 * this->GetRadius(wall) * this->GetRadius(wall) < reach)
  {
    return false;
  }
  if (!this->MayHide(wall, from.Middle, to.Middle))
  {
    return false;
  }
  const PatchPlane plane = this->GetPlane(wall);
  const auto getHeight = [&](const Vector& point)
  {
    const double height = plane.GetHeight(point);
    const double tolerance = plane.GetTolerance((point - plane.Origin).norm());
    return std::abs(height) > tolerance ? height : 0.0;
  };
  const double heights[2] = { getHeight(from.Middle), getHeight(to.Middle) };
  const auto crosses = [&](const Vector& a, double heightA, const Vector& b, double heightB)
  {
    const double height = heightA - heightB;
    return height == 0.0 || this->IsInside(wall, a + heightA / height * (b - a));
  };
  if (heights[0] * heights[1] >= 0.0 || !crosses(from.Middle, heights[0], to.Middle, heights[1]))
  {
    return false;
  }
  const double side = heights[0] > 0.0 ? 1.0 : -1.0;
  const auto isOnSide = [&](const End& end, double sign)
  {
    return std::all_of(end.Points.begin(), end.Points.end(),
      [&](const Vector& point)
      {
        const double height = sign * getHeight(point);
        return strictly ? height > 0.0 : height >= 0.0;
      });
  };
  if (!isOnSide(from, side) || !isOnSide(to, -side))
  {
    return false;
  }
  return std::all_of(from.Points.begin(), from.Points.end(),
    [&](const Vector& a)
    {
      return std::all_of(to.Points.begin(), to.Points.end(),
        [&](const Vector& b) { return crosses(a, getHeight(a), b, getHeight(b)); });
    });
}
} // namespace LightTransport
