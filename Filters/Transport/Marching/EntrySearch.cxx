// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Marching/EntrySearch.h"

#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Light nearer to the plane of a patch than this cosine brings nothing.
constexpr double LeastCosine = 1e-9;
constexpr int MostSteps = 60;

//------------------------------------------------------------------------------
double GetAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}
} // namespace

//------------------------------------------------------------------------------
// False where no patch of a node can bring light to the point.
bool EntrySearch::CanReach(const PatchTree::Node& node, const Vector& point, const Origin& light,
  double reach) const
{
  const Vector center = 0.5 * (node.Lower + node.Upper);
  const double radius = 0.5 * (node.Upper - node.Lower).norm();
  const Vector path = point - center;
  const double distance = path.norm();
  if (distance - radius > reach)
  {
    return false;
  }
  const Vector incident = light.IsPoint ? Vector(center - light.Place) : Vector(-light.Place);
  const double away = light.IsPoint ? incident.norm() : 0.0;
  if (distance <= radius || (light.IsPoint && away <= radius) || node.ConeCosine <= 0.0)
  {
    return true;
  }
  const double width = light.IsPoint ? std::asin(radius / away) : 0.0;
  const double spread = std::acos(std::min(node.ConeCosine, 1.0));
  const double incidence = GetAngle(-incident, node.ConeAxis);
  if (incidence - spread - width >= 0.5 * vtkMath::Pi())
  {
    return false;
  }
  if (incidence + spread + width >= 0.5 * vtkMath::Pi())
  {
    return true;
  }
  const Vector direction = this->Interface.RefractInwards(incident.normalized(), node.ConeAxis);
  const double allowed = spread + width / this->Index + std::asin(radius / distance);
  return GetAngle(direction, path) <= allowed;
}

//------------------------------------------------------------------------------
void EntrySearch::Find(const Vector& point, const Origin& light, double reach,
  std::vector<Entry>& entries) const
{
  // The tree halves its nodes: it is not deeper than that.
  std::array<int, 128> open;
  int count = 0;
  open[count++] = 0;
  while (count > 0)
  {
    const PatchTree::Node& node = this->Scene.GetTree().GetNode(open[--count]);
    if (!this->CanReach(node, point, light, reach))
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open[count++] = node.Left;
      open[count++] = node.Left + 1;
      continue;
    }
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      Entry entry;
      if (this->FindOnPatch(patch, point, light, entry) && entry.Distance <= reach)
      {
        entries.push_back(entry);
      }
    }
  }
}

//------------------------------------------------------------------------------
bool EntrySearch::FindOnPatch(vtkIdType patch, const Vector& point, const Origin& light,
  Entry& entry) const
{
  const Vector& normal = this->Scene.GetNormal(patch);
  const Vector& centroid = this->Scene.GetCentroid(patch);
  const double depth = normal.dot(centroid - point);
  const double height =
    light.IsPoint ? normal.dot(light.Place - centroid) : normal.dot(light.Place);
  if (!(depth > 0.0) || !(height > LeastCosine))
  {
    return false;
  }
  entry.Patch = patch;
  if (light.IsPoint)
  {
    return this->EnterFromPoint(normal, depth, height, point, light.Place, entry) &&
      this->Contains(patch, entry.Point);
  }
  this->EnterFromAfar(normal, depth, point, light.Place, entry);
  return this->Contains(patch, entry.Point);
}

//------------------------------------------------------------------------------
void EntrySearch::EnterFromAfar(const Vector& normal, double depth, const Vector& point,
  const Vector& towards, Entry& entry) const
{
  entry.Towards = towards;
  entry.Direction = this->Interface.RefractInwards(-towards, normal);
  const double cosine = towards.dot(normal);
  const double inside = -entry.Direction.dot(normal);
  entry.Distance = depth / inside;
  entry.Point = point - entry.Distance * entry.Direction;
  entry.Spread = (1.0 - this->Interface.GetExternalReflectance(cosine)) * cosine / inside;
}

//------------------------------------------------------------------------------
// How far from the foot of the light, along the surface, the ray crosses it: `width` is how far
// apart light and point are along the surface. Newton's method between bounds.
double EntrySearch::FindCrossing(double height, double depth, double width) const
{
  double low = 0.0;
  double high = width;
  double place = width * height / (height + depth);
  for (int step = 0; step < MostSteps && high - low > 1e-15 * width; ++step)
  {
    const double rest = width - place;
    const double outside = std::hypot(place, height);
    const double inside = std::hypot(rest, depth);
    const double excess = place / outside - this->Index * rest / inside;
    (excess > 0.0 ? high : low) = place;
    const double slope = height * height / (outside * outside * outside) +
      this->Index * depth * depth / (inside * inside * inside);
    double next = place - excess / slope;
    next = next > low && next < high ? next : 0.5 * (low + high);
    const bool isFound = std::abs(next - place) <= 1e-14 * width;
    place = next;
    if (isFound)
    {
      break;
    }
  }
  return place;
}

//------------------------------------------------------------------------------
// A thin beam spreads in the plane of incidence and across it.
bool EntrySearch::EnterFromPoint(const Vector& normal, double depth, double height,
  const Vector& point, const Vector& light, Entry& entry) const
{
  const Vector along = point - light + (height + depth) * normal;
  const double width = along.norm();
  const double place = this->FindCrossing(height, depth, width);
  entry.Point = light - height * normal;
  if (width > 0.0)
  {
    entry.Point += place / width * along;
  }
  const Vector outside = light - entry.Point;
  const double away = outside.norm();
  entry.Towards = outside / away;
  const Vector inside = point - entry.Point;
  entry.Distance = inside.norm();
  entry.Direction = inside / entry.Distance;
  const double cosine = height / away;
  if (cosine <= LeastCosine)
  {
    return false;
  }
  const double inner = depth / entry.Distance;
  const double across = height / cosine + depth / (this->Index * inner);
  const double within =
    height / (cosine * cosine) + depth * cosine / (this->Index * inner * inner * inner);
  entry.Spread = (1.0 - this->Interface.GetExternalReflectance(cosine)) * away * away /
    (across * within * inner);
  return true;
}

//------------------------------------------------------------------------------
bool EntrySearch::Contains(vtkIdType patch, const Vector& point) const
{
  if ((point - this->Scene.GetCentroid(patch)).squaredNorm() >
    std::pow(this->Scene.GetRadius(patch), 2) * (1.0 + 1e-9))
  {
    return false;
  }
  const int corners = this->Scene.GetNumberOfCorners(patch);
  const Vector& normal = this->Scene.GetNormal(patch);
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector& from = this->Scene.GetCorner(patch, corner);
    const Vector& to = this->Scene.GetCorner(patch, (corner + 1) % corners);
    if (normal.dot((to - from).cross(point - from)) < 0.0)
    {
      return false;
    }
  }
  return true;
}
} // namespace LightTransport
