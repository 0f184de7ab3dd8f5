// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/ClosedSurface.h"

#include "Scene/PatchScene.h"
#include "Shared/DisjointSets.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

// Points nearer to each other, or to an edge, are one place, in a scene whose diagonal is 1: as for
// the photons that walk inside.
constexpr double Tolerance = 1e-6;

//------------------------------------------------------------------------------
// How much more often edges are passed from their lower point to the higher one than back.
class EdgeBalance
{
public:
  using Edges = std::map<std::pair<vtkIdType, vtkIdType>, int>;

  void Add(vtkIdType from, vtkIdType to, int times)
  {
    if (from == to || times == 0)
    {
      return;
    }
    const auto edge = this->Open.emplace(std::minmax(from, to), 0).first;
    edge->second += from < to ? times : -times;
    if (edge->second == 0)
    {
      this->Open.erase(edge);
    }
  }
  const Edges& GetOpen() const { return this->Open; }

private:
  Edges Open;
};

//------------------------------------------------------------------------------
// The points of some edges, found by place.
class EdgePoints
{
public:
  EdgePoints(const PatchScene& scene, const EdgeBalance::Edges& edges);

  const Vector& Get(vtkIdType point) const { return this->Scene.GetPoints()[point]; }

  // The first point in a place.
  vtkIdType GetFirst(vtkIdType point) const
  {
    vtkNew<vtkIdList> near;
    this->Locator->FindPointsWithinRadius(Tolerance, this->Get(point).data(), near);
    vtkIdType first = point;
    for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
    {
      first = std::min(first, this->Ids[near->GetId(k)]);
    }
    return first;
  }

  // Those on an edge between its ends, in their order.
  std::vector<vtkIdType> GetBetween(vtkIdType from, vtkIdType to) const;

private:
  const PatchScene& Scene;
  std::vector<vtkIdType> Ids;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkStaticPointLocator> Locator;
};

//------------------------------------------------------------------------------
EdgePoints::EdgePoints(const PatchScene& scene, const EdgeBalance::Edges& edges) : Scene(scene)
{
  for (const auto& edge : edges)
  {
    this->Ids.push_back(edge.first.first);
    this->Ids.push_back(edge.first.second);
  }
  std::sort(this->Ids.begin(), this->Ids.end());
  this->Ids.erase(std::unique(this->Ids.begin(), this->Ids.end()), this->Ids.end());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const vtkIdType id : this->Ids)
  {
    points->InsertNextPoint(this->Get(id).data());
  }
  this->Data->SetPoints(points);
  this->Locator->SetDataSet(this->Data);
  this->Locator->BuildLocator();
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> EdgePoints::GetBetween(vtkIdType from, vtkIdType to) const
{
  const Vector& begin = this->Get(from);
  const Vector edge = this->Get(to) - begin;
  const double length = edge.norm();
  const Vector middle = begin + 0.5 * edge;
  vtkNew<vtkIdList> near;
  this->Locator->FindPointsWithinRadius(0.5 * length, middle.data(), near);
  std::vector<std::pair<double, vtkIdType>> found;
  for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
  {
    const vtkIdType id = this->GetFirst(this->Ids[near->GetId(k)]);
    const Vector offset = this->Get(id) - begin;
    const double along = offset.dot(edge) / length;
    if (along > Tolerance && along < length - Tolerance &&
      (offset - along / length * edge).norm() < Tolerance)
    {
      found.emplace_back(along, id);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<vtkIdType> ids;
  for (const auto& point : found)
  {
    ids.push_back(point.second);
  }
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

//------------------------------------------------------------------------------
EdgeBalance CountEdges(const PatchScene& scene)
{
  EdgeBalance balance;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const vtkIdType* corners = scene.GetCorners(patch);
    const int count = scene.GetNumberOfCorners(patch);
    for (int corner = 0; corner < count; ++corner)
    {
      balance.Add(corners[corner], corners[(corner + 1) % count], 1);
    }
  }
  return balance;
}

//------------------------------------------------------------------------------
// Cut open edges at the points that lie on them.
EdgeBalance CutEdges(const PatchScene& scene, const EdgeBalance::Edges& edges)
{
  const EdgePoints points(scene, edges);
  EdgeBalance balance;
  for (const auto& edge : edges)
  {
    vtkIdType from = points.GetFirst(edge.first.first);
    const vtkIdType to = points.GetFirst(edge.first.second);
    for (const vtkIdType between : points.GetBetween(edge.first.first, edge.first.second))
    {
      balance.Add(from, between, edge.second);
      from = between;
    }
    balance.Add(from, to, edge.second);
  }
  return balance;
}

//------------------------------------------------------------------------------
std::string DescribePlace(const PatchScene& scene, const Vector& place)
{
  const Vector input = scene.GetCenter() + scene.GetScale() * place;
  std::ostringstream text;
  text << "(" << input.x() << ", " << input.y() << ", " << input.z() << ")";
  return text.str();
}

//------------------------------------------------------------------------------
Outcome FailForHole(const PatchScene& scene, const EdgeBalance::Edges& edges)
{
  Vector place;
  double longest = -1.0;
  for (const auto& edge : edges)
  {
    const Vector& from = scene.GetPoints()[edge.first.first];
    const Vector& to = scene.GetPoints()[edge.first.second];
    if ((to - from).norm() > longest)
    {
      longest = (to - from).norm();
      place = 0.5 * (from + to);
    }
  }
  return Outcome::Failed("The surface is open: " + std::to_string(edges.size()) +
    " edges have nothing on their other side, or the same side; the longest is at " +
    DescribePlace(scene, place) +
    ". Photons need a closed body: close it (vtkFillHolesFilter, or vtkPatchMesher with Repair), "
    "or "
    "choose another Model.");
}

//------------------------------------------------------------------------------
// A connected part of the surface.
struct Part
{
  double Volume = 0.0;
  double Area = 0.0;
  Eigen::AlignedBox3d Box;
};

//------------------------------------------------------------------------------
std::map<std::size_t, Part> FindParts(const PatchScene& scene)
{
  DisjointSets sets(scene.GetPoints().size());
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const vtkIdType* corners = scene.GetCorners(patch);
    for (int corner = 1; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      sets.Join(corners[0], corners[corner]);
    }
  }
  std::map<std::size_t, Part> parts;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    Part& part = parts[sets.Find(scene.GetCorners(patch)[0])];
    part.Area += scene.GetAreas()[patch];
    part.Volume +=
      scene.GetAreas()[patch] * scene.GetNormal(patch).dot(scene.GetCentroid(patch)) / 3.0;
    for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      part.Box.extend(scene.GetCorner(patch, corner));
    }
  }
  return parts;
}

//------------------------------------------------------------------------------
// Parts must have an inside; one that is turned inwards must be a cavity of another one.
Outcome CheckSides(const PatchScene& scene)
{
  const std::map<std::size_t, Part> parts = FindParts(scene);
  for (const auto& part : parts)
  {
    const bool isCavity = std::any_of(parts.begin(), parts.end(),
      [&part](const auto& other)
      { return other.second.Volume > 0.0 && other.second.Box.contains(part.second.Box); });
    // A sheet of two sides has half its area, times its thickness.
    const double smallest = Tolerance * part.second.Area;
    if (std::abs(part.second.Volume) < smallest)
    {
      return Outcome::Failed("The surface around " +
        DescribePlace(scene, part.second.Box.center()) +
        " has no inside, or less than a millionth of the scene: photons need a body. Leave such "
        "sheets out, or give them a thickness (vtkLinearExtrusionFilter).");
    }
    if (part.second.Volume < 0.0 && !isCavity)
    {
      return Outcome::Failed("The surface around " +
        DescribePlace(scene, part.second.Box.center()) +
        " is inside out: the fronts of its polygons, from which their corners are seen "
        "counter-clockwise, must be outside. Turn it (vtkReverseSense, or vtkPatchMesher with "
        "FlipNormals).");
    }
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
Outcome ClosedSurface::Check(const PatchScene& scene)
{
  EdgeBalance open = CountEdges(scene);
  if (!open.GetOpen().empty())
  {
    open = CutEdges(scene, open.GetOpen());
  }
  return open.GetOpen().empty() ? CheckSides(scene) : FailForHole(scene, open.GetOpen());
}
} // namespace LightTransport
