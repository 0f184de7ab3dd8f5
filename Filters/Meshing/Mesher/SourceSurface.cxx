// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SourceSurface.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Point = SourceSurface::Point;

//------------------------------------------------------------------------------
Point Subtract(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

//------------------------------------------------------------------------------
double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

//------------------------------------------------------------------------------
Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

//------------------------------------------------------------------------------
double GetDistance2(const Point& a, const Point& b)
{
  const Point d = Subtract(a, b);
  return Dot(d, d);
}
} // namespace

//------------------------------------------------------------------------------
void SourceSurface::Link()
{
  this->FirstTriangle.assign(this->Points.size() + 1, 0);
  for (const Triangle& triangle : this->Triangles)
  {
    for (const std::size_t corner : triangle)
    {
      ++this->FirstTriangle[corner + 1];
    }
  }
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    this->FirstTriangle[i + 1] += this->FirstTriangle[i];
  }
  std::vector<std::size_t> next(this->FirstTriangle.begin(), this->FirstTriangle.end() - 1);
  this->TrianglesOfPoints.resize(3 * this->Triangles.size());
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    for (const std::size_t corner : this->Triangles[i])
    {
      this->TrianglesOfPoints[next[corner]++] = i;
    }
  }
  this->Visits.assign(this->Triangles.size(), 0);
  this->NumberOfSearches = 0;
}

//------------------------------------------------------------------------------
SourceSurface::Range SourceSurface::GetTrianglesAround(std::size_t point) const
{
  const std::size_t* all = this->TrianglesOfPoints.data();
  return { all + this->FirstTriangle[point], all + this->FirstTriangle[point + 1] };
}

//------------------------------------------------------------------------------
SourceSurface::Place SourceSurface::Find(const std::vector<std::size_t>& starts,
  const Point& position) const
{
  const std::size_t search = ++this->NumberOfSearches;
  Place best;
  double bestDistance2 = std::numeric_limits<double>::max();
  double radius2 = bestDistance2;
  this->Queue.assign(starts.begin(), starts.end());
  for (const std::size_t start : starts)
  {
    this->Visits[start] = search;
  }
  for (std::size_t i = 0; i < this->Queue.size() && bestDistance2 > 0.0; ++i)
  {
    const std::size_t triangle = this->Queue[i];
    const Triangle& corners = this->Triangles[triangle];
    const Place place = GetClosest(this->Points[corners[0]], this->Points[corners[1]],
      this->Points[corners[2]], position);
    const double distance2 = GetDistance2(place.Position, position);
    if (distance2 < bestDistance2)
    {
      best = place;
      best.Triangle = triangle;
      bestDistance2 = distance2;
      radius2 = i < starts.size() ? distance2 : radius2;
    }
    for (const std::size_t neighbour : this->Neighbours[triangle])
    {
      if (distance2 <= radius2 && neighbour != None && this->Visits[neighbour] != search)
      {
        this->Visits[neighbour] = search;
        this->Queue.push_back(neighbour);
      }
    }
  }
  return best;
}

//------------------------------------------------------------------------------
SourceSurface::Point SourceSurface::GetNormal(std::size_t triangle) const
{
  const Triangle& corners = this->Triangles[triangle];
  const Point& a = this->Points[corners[0]];
  return Cross(Subtract(this->Points[corners[1]], a), Subtract(this->Points[corners[2]], a));
}

//------------------------------------------------------------------------------
double SourceSurface::GetArea(std::size_t triangle) const
{
  const Point normal = this->GetNormal(triangle);
  return 0.5 * std::sqrt(Dot(normal, normal));
}

//------------------------------------------------------------------------------
SourceSurface::Place SourceSurface::GetClosest(const Point& a, const Point& b, const Point& c,
  const Point& position)
{
  const std::array<const Point*, 3> corners{ &a, &b, &c };
  const Point normal = Cross(Subtract(b, a), Subtract(c, a));
  const double scale = Dot(normal, normal);
  Place place;
  bool inside = scale > 0.0;
  for (int i = 0; inside && i < 3; ++i)
  {
    // The weight of a corner is the part of the area that lies opposite to it.
    const Point u = Subtract(*corners[(i + 1) % 3], position);
    const Point v = Subtract(*corners[(i + 2) % 3], position);
    place.Weights[i] = Dot(Cross(u, v), normal) / scale;
    inside = place.Weights[i] >= 0.0;
  }
  double closest2 = std::numeric_limits<double>::max();
  for (int i = 0; !inside && i < 3; ++i)
  {
    const Point side = Subtract(*corners[(i + 1) % 3], *corners[i]);
    const double length2 = Dot(side, side);
    const double along = Dot(Subtract(position, *corners[i]), side);
    const double t = length2 > 0.0 ? std::min(std::max(along / length2, 0.0), 1.0) : 0.0;
    const Point on{ (*corners[i])[0] + t * side[0], (*corners[i])[1] + t * side[1],
      (*corners[i])[2] + t * side[2] };
    const double distance2 = GetDistance2(on, position);
    if (distance2 < closest2)
    {
      closest2 = distance2;
      place.Weights = { 0.0, 0.0, 0.0 };
      place.Weights[i] = 1.0 - t;
      place.Weights[(i + 1) % 3] = t;
    }
  }
  for (int j = 0; j < 3; ++j)
  {
    place.Position[j] = place.Weights[0] * a[j] + place.Weights[1] * b[j] + place.Weights[2] * c[j];
  }
  return place;
}
} // namespace LightTransport
