// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/NearPairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace LightTransport
{
namespace
{
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t,
  CGAL::Box_intersection_d::ID_EXPLICIT>;
using Boxes = std::vector<Box>;
using Visitor = std::function<void(std::size_t, std::size_t)>;
using TriangleCrossings::Points;

// A point of so many triangles is a hub.
constexpr std::size_t FewestOfHub = 64;

//------------------------------------------------------------------------------
void VisitWithin(Boxes& boxes, const Visitor& visit)
{
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
    [&](const Box& a, const Box& b) { visit(a.info(), b.info()); });
}

//------------------------------------------------------------------------------
void VisitBetween(Boxes first, Boxes second, const Visitor& visit)
{
  CGAL::box_intersection_d(first.begin(), first.end(), second.begin(), second.end(),
    [&](const Box& a, const Box& b) { visit(a.info(), b.info()); });
}

//------------------------------------------------------------------------------
// The pairs of different groups from `first` up to `last`.
Boxes VisitBetweenGroups(const std::vector<Boxes>& groups, std::size_t first, std::size_t last,
  const Visitor& visit)
{
  if (last - first == 1)
  {
    return groups[first];
  }
  const std::size_t middle = first + (last - first) / 2;
  Boxes all = VisitBetweenGroups(groups, first, middle, visit);
  const Boxes others = VisitBetweenGroups(groups, middle, last, visit);
  VisitBetween(all, others, visit);
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

//------------------------------------------------------------------------------
// The directions from a hub to the points of one of its triangles.
CGAL::Bbox_3 GetDirections(const Points& points, const TriangleSoup::Triangle& triangle,
  std::size_t hub)
{
  CGAL::Bbox_3 box;
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (const std::size_t corner : triangle)
  {
    if (corner == hub)
    {
      continue;
    }
    double direction[3];
    for (int i = 0; i < 3; ++i)
    {
      direction[i] = points[corner][i] - points[hub][i];
    }
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    if (!std::isnormal(length))
    {
      return { -2.0, -2.0, -2.0, 2.0, 2.0, 2.0 };
    }
    for (int i = 0; i < 3; ++i)
    {
      direction[i] /= length;
      sum[i] += direction[i];
    }
    box += CGAL::Bbox_3(direction[0], direction[1], direction[2], direction[0], direction[1],
      direction[2]);
  }
  // The arc between two directions is at most so far from the line between them, and rounding is
  // much less than the last number.
  const double bulge = 1.0 - 0.5 * std::hypot(sum[0], sum[1], sum[2]);
  return TriangleCrossings::Widen(box, std::max(bulge, 0.0) + 1e-12);
}

//------------------------------------------------------------------------------
// The corner of a triangle that most triangles have, the first of equal ones.
std::size_t FindHub(const TriangleSoup::Triangle& triangle, const std::vector<std::size_t>& uses)
{
  return *std::max_element(triangle.begin(), triangle.end(),
    [&](std::size_t a, std::size_t b) { return uses[a] < uses[b]; });
}
} // namespace

//------------------------------------------------------------------------------
void NearPairs::ForEach(const Points& points, const TriangleCrossings::Triangles& triangles,
  const std::vector<std::size_t>& used, const Visitor& visit)
{
  std::vector<std::size_t> uses(points.size(), 0);
  for (const std::size_t i : used)
  {
    for (const std::size_t corner : triangles[i])
    {
      ++uses[corner];
    }
  }
  // The first group is of triangles without a hub.
  std::vector<Boxes> groups(1);
  std::vector<Boxes> directions(1);
  std::map<std::size_t, std::size_t> groupOfHub;
  for (const std::size_t i : used)
  {
    const std::size_t hub = FindHub(triangles[i], uses);
    const Box box(TriangleCrossings::GetBox(points, triangles[i]), i);
    if (uses[hub] < FewestOfHub)
    {
      groups[0].push_back(box);
      continue;
    }
    const std::size_t group = groupOfHub.emplace(hub, groups.size()).first->second;
    if (group == groups.size())
    {
      groups.emplace_back();
      directions.emplace_back();
    }
    groups[group].push_back(box);
    directions[group].emplace_back(GetDirections(points, triangles[i], hub), i);
  }
  VisitBetweenGroups(groups, 0, groups.size(), visit);
  VisitWithin(groups[0], visit);
  for (Boxes& boxes : directions)
  {
    VisitWithin(boxes, visit);
  }
}
} // namespace LightTransport
