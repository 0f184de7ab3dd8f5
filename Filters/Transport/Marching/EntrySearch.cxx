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
/// Of squared radii: what is so near to a circle is looked at.
constexpr double CircleMargin = 1e-6;

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
  const double widest = incidence + spread + width;
  if (widest >= 0.5 * vtkMath::Pi())
  {
    return true;
  }
  const Vector direction = this->Interface.RefractInwards(incident.normalized(), node.ConeAxis);
  const double allowed =
    this->GetTurn(widest) * spread + width / this->Index + std::asin(radius / distance);
  return GetAngle(direction, path) <= allowed;
}

//------------------------------------------------------------------------------
// How far a refracted ray turns at most with the normal, at angles of incidence up to a right one:
// by 1 - d theta_t / d theta_i in the plane of incidence, and less across it.
double EntrySearch::GetTurn(double incidence) const
{
  const double cosine = std::cos(incidence);
  return 1.0 - cosine / std::sqrt(this->Index * this->Index - 1.0 + cosine * cosine);
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
// Of the sines along the way that crosses there, by Snell's law. It grows with the place.
double EntrySearch::Refraction::GetExcess(double place) const
{
  const double rest = this->Width - place;
  return place / std::hypot(place, this->Height) -
    this->Index * rest / std::hypot(rest, this->Depth);
}

//------------------------------------------------------------------------------
bool EntrySearch::Refraction::CrossesBetween(double low, double high) const
{
  return low <= high && (low <= 0.0 || this->GetExcess(low) <= 0.0) &&
    (high >= this->Width || this->GetExcess(high) >= 0.0);
}

//------------------------------------------------------------------------------
// Newton's method between bounds.
double EntrySearch::Refraction::FindCrossing() const
{
  double low = 0.0;
  double high = this->Width;
  double place = this->Width * this->Height / (this->Height + this->Depth);
  for (int step = 0; step < MostSteps && high - low > 1e-15 * this->Width; ++step)
  {
    const double rest = this->Width - place;
    const double outside = std::hypot(place, this->Height);
    const double inside = std::hypot(rest, this->Depth);
    const double excess = place / outside - this->Index * rest / inside;
    (excess > 0.0 ? high : low) = place;
    const double slope = this->Height * this->Height / (outside * outside * outside) +
      this->Index * this->Depth * this->Depth / (inside * inside * inside);
    double next = place - excess / slope;
    next = next > low && next < high ? next : 0.5 * (low + high);
    const bool isFound = std::abs(next - place) <= 1e-14 * this->Width;
    place = next;
    if (isFound)
    {
      break;
    }
  }
  return place;
}

//------------------------------------------------------------------------------
// False where the crossing is outside of the circle around the patch. `foot` of the light, in the
// plane of the patch, and from there on along the surface.
bool EntrySearch::MayCross(vtkIdType patch, const Vector& foot, const Vector& along,
  const Refraction& refraction) const
{
  const Vector center = this->Scene.GetCentroid(patch) - foot;
  const double radius2 = std::pow(this->Scene.GetRadius(patch), 2) * (1.0 + CircleMargin);
  const double middle = refraction.Width > 0.0 ? center.dot(along) / refraction.Width : 0.0;
  const double half2 = radius2 - (center.squaredNorm() - middle * middle);
  const double half = std::sqrt(std::max(half2, 0.0));
  return half2 >= 0.0 && refraction.CrossesBetween(middle - half, middle + half);
}

//------------------------------------------------------------------------------
// A thin beam spreads in the plane of incidence and across it.
bool EntrySearch::EnterFromPoint(const Vector& normal, double depth, double height,
  const Vector& point, const Vector& light, Entry& entry) const
{
  const Vector along = point - light + (height + depth) * normal;
  const double width = along.norm();
  const Refraction refraction{ this->Index, height, depth, width };
  entry.Point = light - height * normal;
  if (!this->MayCross(entry.Patch, entry.Point, along, refraction))
  {
    return false;
  }
  if (width > 0.0)
  {
    entry.Point += refraction.FindCrossing() / width * along;
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
