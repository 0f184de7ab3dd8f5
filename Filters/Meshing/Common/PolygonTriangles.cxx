// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/PolygonTriangles.h"

#include "vtkMath.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace LightTransport
{
namespace
{
using PolygonTriangles::Point;
using PolygonTriangles::Triangle;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// How often the border goes round a face, and along its edges with it on the left, less those with
// it on the right.
struct Turns
{
  bool IsKnown = false;
  int Around = 0;
  std::array<int, 3> Along{ 0, 0, 0 };
};

using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
using Faces = CGAL::Constrained_triangulation_face_base_2<Kernel,
  CGAL::Triangulation_face_base_with_info_2<Turns, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Faces>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;
using Flat = std::vector<std::array<double, 2>>;

// Borders that cross by less than this part of an edge touch.
constexpr double CrossingTolerance = 1e-6;
// Every corner is held against every edge then.
constexpr std::size_t MostCornersToSnap = 5000;
// Triangles that face the other way by no more than this part of the polygon are rounding.
constexpr double AreaTolerance = 1e-12;

//------------------------------------------------------------------------------
// Twice the area times the normal, by Newell's rule.
Point GetNormal(const std::vector<Point>& corners)
{
  Point normal{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    Point u;
    Point v;
    Point cross;
    vtkMath::Subtract(corners[i].data(), corners[0].data(), u.data());
    vtkMath::Subtract(corners[i + 1].data(), corners[0].data(), v.data());
    vtkMath::Cross(u.data(), v.data(), cross.data());
    vtkMath::Add(normal.data(), cross.data(), normal.data());
  }
  return normal;
}

//------------------------------------------------------------------------------
// Along the axis that is nearest to the normal: coordinates keep all their digits.
Flat Project(const std::vector<Point>& corners, const Point& normal)
{
  int axis = 0;
  for (int i = 1; i < 3; ++i)
  {
    axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
  }
  const int x = (axis + (normal[axis] > 0.0 ? 1 : 2)) % 3;
  const int y = (axis + (normal[axis] > 0.0 ? 2 : 1)) % 3;
  Flat places;
  for (const Point& corner : corners)
  {
    // Adding zero turns -0 into 0.
    places.push_back({ corner[x] + 0.0, corner[y] + 0.0 });
  }
  return places;
}

//------------------------------------------------------------------------------
// The border as corners, of those in one place the first.
std::vector<std::size_t> GetBorder(const Flat& places)
{
  std::map<std::array<double, 2>, std::size_t> first;
  std::vector<std::size_t> border;
  for (const auto& place : places)
  {
    border.push_back(first.emplace(place, border.size()).first->second);
  }
  return border;
}

//------------------------------------------------------------------------------
// The same where rounding has parted what touches: corners near each other are one, and the border
// goes over those that are near it.
std::vector<std::size_t> GetSnappedBorder(const Flat& places)
{
  const std::size_t size = places.size();
  std::vector<std::size_t> kept;
  std::vector<std::size_t> corners(size);
  const auto getLength = [&places](std::size_t a, std::size_t b)
  { return std::hypot(places[a][0] - places[b][0], places[a][1] - places[b][1]); };
  for (std::size_t i = 0; i < size; ++i)
  {
    const double reach = CrossingTolerance *
      std::max(getLength(i, (i + 1) % size), getLength(i, (i + size - 1) % size));
    const auto found = std::find_if(kept.begin(), kept.end(),
      [&](std::size_t other) { return getLength(i, other) <= reach; });
    corners[i] = found == kept.end() ? i : *found;
    if (found == kept.end())
    {
      kept.push_back(i);
    }
  }
  std::vector<std::size_t> border;
  for (std::size_t i = 0; i < size; ++i)
  {
    const std::size_t a = corners[i];
    const std::size_t b = corners[(i + 1) % size];
    border.push_back(a);
    const double length = getLength(a, b);
    std::vector<std::pair<double, std::size_t>> between;
    for (const std::size_t corner : kept)
    {
      const double x = places[corner][0] - places[a][0];
      const double y = places[corner][1] - places[a][1];
      const double u = (places[b][0] - places[a][0]) / length;
      const double v = (places[b][1] - places[a][1]) / length;
      const double along = x * u + y * v;
      if (corner != a && corner != b && along > 0.0 && along < length &&
        std::abs(x * v - y * u) <= CrossingTolerance * length)
      {
        between.emplace_back(along, corner);
      }
    }
    std::sort(between.begin(), between.end());
    for (const auto& corner : between)
    {
      border.push_back(corner.second);
    }
  }
  return border;
}

//------------------------------------------------------------------------------
// Count how often the border goes along the edges from one corner to the next.
void CountTurns(Triangulation& triangulation, Vertex from, Vertex to)
{
  while (from != to)
  {
    Vertex next;
    Face right;
    int index;
    if (!triangulation.includes_edge(from, to, next, right, index))
    {
      return;
    }
    const Face left = right->neighbor(index);
    --right->info().Along[index];
    ++left->info().Along[triangulation.mirror_index(right, index)];
    from = next;
  }
}

//------------------------------------------------------------------------------
// From the outside inward. False where the border goes round anything in other ways than once.
bool SpreadTurns(Triangulation& triangulation)
{
  std::vector<Face> faces{ triangulation.infinite_face() };
  faces[0]->info().IsKnown = true;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const Face next = faces[i]->neighbor(j);
      const int around = faces[i]->info().Around - faces[i]->info().Along[j];
      if (around != 0 && around != 1)
      {
        return false;
      }
      if (!next->info().IsKnown)
      {
        next->info().IsKnown = true;
        next->info().Around = around;
        faces.push_back(next);
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool Triangulate(const Flat& places, const std::vector<std::size_t>& border,
  std::vector<Triangle>& triangles)
{
  Triangulation triangulation;
  std::vector<Vertex> vertices(places.size());
  for (const std::size_t corner : border)
  {
    if (vertices[corner] == Vertex())
    {
      vertices[corner] =
        triangulation.insert(Kernel::Point_2(places[corner][0], places[corner][1]));
      vertices[corner]->info() = corner;
    }
  }
  // A border that crosses itself without leaving a line has no inside.
  for (int pass = 0; pass < 2 && triangulation.dimension() == 2; ++pass)
  {
    for (std::size_t i = 0; i < border.size(); ++i)
    {
      const Vertex from = vertices[border[i]];
      const Vertex to = vertices[border[(i + 1) % border.size()]];
      if (from == to)
      {
        continue;
      }
      if (pass == 0)
      {
        try
        {
          triangulation.insert_constraint(from, to);
        }
        catch (const Triangulation::Intersection_of_constraints_exception&)
        {
          return false;
        }
      }
      else
      {
        CountTurns(triangulation, from, to);
      }
    }
  }
  if (triangulation.dimension() < 2 || !SpreadTurns(triangulation))
  {
    return false;
  }
  for (const Face face : triangulation.finite_face_handles())
  {
    if (face->info().Around == 1)
    {
      triangles.push_back(
        { face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info() });
    }
  }
  return true;
}
} // namespace

//------------------------------------------------------------------------------
bool PolygonTriangles::Cut(const std::vector<Point>& corners, std::vector<Triangle>& triangles)
{
  triangles.clear();
  const Point normal = GetNormal(corners);
  double extent2 = 0.0;
  for (const Point& corner : corners)
  {
    extent2 = std::max(extent2, vtkMath::Distance2BetweenPoints(corner.data(), corners[0].data()));
  }
  const auto isFlat = [extent2](const Point& vector)
  { return !(vtkMath::Norm(vector.data()) > AreaTolerance * extent2); };
  if (isFlat(normal))
  {
    bool isLine = true;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
      triangles.push_back({ 0, i, i + 1 });
      isLine = isLine && isFlat(GetNormal({ corners[0], corners[i], corners[i + 1] }));
    }
    // Areas on both sides that cancel out are those of a border that crosses itself.
    return isLine;
  }
  const Flat places = Project(corners, normal);
  if (Triangulate(places, GetBorder(places), triangles))
  {
    return true;
  }
  triangles.clear();
  return corners.size() <= MostCornersToSnap &&
    Triangulate(places, GetSnappedBorder(places), triangles);
}

//------------------------------------------------------------------------------
bool PolygonTriangles::AreRight(const std::vector<Point>& corners,
  const std::vector<Triangle>& triangles)
{
  const Point normal = GetNormal(corners);
  const double least = -AreaTolerance * vtkMath::Dot(normal.data(), normal.data());
  return std::all_of(triangles.begin(), triangles.end(),
    [&](const Triangle& triangle)
    {
      const Point part =
        GetNormal({ corners[triangle[0]], corners[triangle[1]], corners[triangle[2]] });
      return vtkMath::Dot(part.data(), normal.data()) >= least;
    });
}
} // namespace LightTransport
