// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ParallelTriangles.h"

#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// Of a profile's scale: distances between planes that vary by less are one.
constexpr double Unevenness = 1e-3;
// Of a turn: directions closer than this are one.
constexpr double SameDirection = 1e-9;
// Of the scale: displacements closer than this are one.
constexpr double SameMeeting = 1e-9;
// Of the logarithmic range of displacements: what one rule takes, and its points.
constexpr double WidestPart = 1.5;
constexpr int PointsOfPart = 8;

//------------------------------------------------------------------------------
double GetAngle(const FlatRegion::Point& way)
{
  return std::atan2(way.y(), way.x());
}
} // namespace

//------------------------------------------------------------------------------
bool ParallelTriangles::Set(const Vector a[3], const Vector b[3], double scale, double smallest)
{
  const Vector normal = (a[1] - a[0]).cross(a[2] - a[0]).normalized();
  const Vector u = normal.unitOrthogonal();
  const Vector v = normal.cross(u);
  const Vector* const corners[2] = { a, b };
  double lowest = normal.dot(b[0] - a[0]);
  double highest = lowest;
  for (int side = 0; side < 2; ++side)
  {
    FlatRegion::Region& region = this->Regions[side];
    region.clear();
    for (int k = 0; k < 3; ++k)
    {
      const Vector offset = corners[side][k] - a[0];
      region.emplace_back(offset.dot(u), offset.dot(v));
      if (side == 1)
      {
        lowest = std::min(lowest, normal.dot(offset));
        highest = std::max(highest, normal.dot(offset));
      }
    }
    if (FlatRegion::GetArea(region) < 0.0)
    {
      std::reverse(region.begin(), region.end());
    }
  }
  const double distance = 0.5 * (lowest + highest);
  const double change = std::max(smallest, std::min(scale, std::abs(distance)));
  if (highest - lowest > Unevenness * change)
  {
    return false;
  }
  this->SquaredDistance = distance * distance;
  this->Scale = std::max(change, std::abs(distance));
  this->FindDirections();
  return std::abs(distance) > Unevenness * scale || this->GetCommonArea(Point(0.0, 0.0)) > 0.0;
}

//------------------------------------------------------------------------------
// Of the ways from corner to corner, and of the edges both ways.
void ParallelTriangles::FindDirections()
{
  std::vector<double> angles;
  for (const Point& from : this->Regions[0])
  {
    for (const Point& to : this->Regions[1])
    {
      angles.push_back(GetAngle(to - from));
    }
  }
  for (const FlatRegion::Region& region : this->Regions)
  {
    for (std::size_t k = 0; k < region.size(); ++k)
    {
      const Point edge = region[(k + 1) % region.size()] - region[k];
      angles.push_back(GetAngle(edge));
      angles.push_back(GetAngle(-edge));
    }
  }
  std::sort(angles.begin(), angles.end());
  this->Directions.clear();
  for (const double angle : angles)
  {
    if (this->Directions.empty() || angle - this->Directions.back() > SameDirection)
    {
      this->Directions.push_back(angle);
    }
  }
  this->Directions.push_back(this->Directions.front() + 2.0 * vtkMath::Pi());
}

//------------------------------------------------------------------------------
// Displacements at which a corner of one meets the line of an edge of the other, from 0 on.
std::vector<double> ParallelTriangles::FindMeetings(const Point& direction) const
{
  std::vector<double> meetings = { 0.0 };
  for (int side = 0; side < 2; ++side)
  {
    const FlatRegion::Region& edges = this->Regions[1 - side];
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      const Point edge = edges[(k + 1) % edges.size()] - edges[k];
      const double speed = FlatRegion::Cross(edge, side == 0 ? direction : Point(-direction));
      for (const Point& corner : this->Regions[side])
      {
        const double meeting = FlatRegion::Cross(edge, edges[k] - corner) / speed;
        if (meeting > 0.0 && std::isfinite(meeting))
        {
          meetings.push_back(meeting);
        }
      }
    }
  }
  std::sort(meetings.begin(), meetings.end());
  meetings.erase(std::unique(meetings.begin(), meetings.end(),
                   [this](double a, double b) { return b - a <= SameMeeting * this->Scale; }),
    meetings.end());
  return meetings;
}

//------------------------------------------------------------------------------
double ParallelTriangles::GetCommonArea(const Point& displacement) const
{
  FlatRegion::Region moved = this->Regions[0];
  for (Point& corner : moved)
  {
    corner += displacement;
  }
  return FlatRegion::GetArea(FlatRegion::Clip(std::move(moved), this->Regions[1]));
}

//------------------------------------------------------------------------------
ParallelTriangles::Bands ParallelTriangles::Integrate(const Profile& profile,
  const GaussLegendre& rule) const
{
  Bands sum = Bands::Zero();
  for (std::size_t part = 1; part < this->Directions.size(); ++part)
  {
    const double begin = this->Directions[part - 1];
    const double width = this->Directions[part] - begin;
    for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
    {
      const double angle = begin + width * rule.Nodes[k];
      sum += width * rule.Weights[k] *
        this->IntegrateRay(profile, Point(std::cos(angle), std::sin(angle)));
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
// Of each stretch the common area is known by three of its values.
ParallelTriangles::Bands ParallelTriangles::IntegrateRay(const Profile& profile,
  const Point& direction) const
{
  static const GaussLegendre rule(PointsOfPart);
  const std::vector<double> meetings = this->FindMeetings(direction);
  Bands sum = Bands::Zero();
  double atBegin = this->GetCommonArea(Point(0.0, 0.0));
  for (std::size_t stretch = 1; stretch < meetings.size(); ++stretch)
  {
    const double begin = meetings[stretch - 1];
    const double length = meetings[stretch] - begin;
    const double inMiddle = this->GetCommonArea((begin + 0.5 * length) * direction);
    const double atEnd = this->GetCommonArea(meetings[stretch] * direction);
    if (inMiddle > 0.0)
    {
      const double first = std::asinh(begin / this->Scale);
      const double range = std::asinh(meetings[stretch] / this->Scale) - first;
      const int parts = std::max(1, static_cast<int>(std::ceil(range / WidestPart)));
      for (int k = 0; k < parts * PointsOfPart; ++k)
      {
        const double place =
          first + range / parts * (k / PointsOfPart + rule.Nodes[k % PointsOfPart]);
        const double radius = this->Scale * std::sinh(place);
        const double x = (radius - begin) / length;
        const double area = atBegin * (1.0 - x) * (1.0 - 2.0 * x) + 4.0 * inMiddle * x * (1.0 - x) +
          atEnd * x * (2.0 * x - 1.0);
        const double weight =
          range / parts * rule.Weights[k % PointsOfPart] * this->Scale * std::cosh(place);
        sum += weight * radius * area * profile(radius * radius + this->SquaredDistance);
      }
    }
    atBegin = atEnd;
  }
  return sum;
}
} // namespace LightTransport
