// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/TriangleCrossings.h"

#include "Common/Heartbeat.h"
#include "Mesher/NearPairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t,
  CGAL::Box_intersection_d::ID_EXPLICIT>;

//------------------------------------------------------------------------------
template <typename Points>
Kernel::Triangle_3 ToKernel(const Points& points, const TriangleSoup::Triangle& triangle)
{
  const auto corner = [&points, &triangle](int i)
  {
    const TriangleSoup::Point& point = points[triangle[i]];
    return Kernel::Point_3(point[0], point[1], point[2]);
  };
  return { corner(0), corner(1), corner(2) };
}

//------------------------------------------------------------------------------
// The corners of two triangles, the common ones first.
struct CornerOrder
{
  int First[3] = { 0, 1, 2 };
  int Second[3] = { 0, 1, 2 };
  int NumberInCommon = 0;

  template <typename Same>
  explicit CornerOrder(const Same& same)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = this->NumberInCommon; j < 3; ++j)
      {
        if (same(this->First[i], this->Second[j]))
        {
          std::swap(this->First[this->NumberInCommon], this->First[i]);
          std::swap(this->Second[this->NumberInCommon], this->Second[j]);
          ++this->NumberInCommon;
          break;
        }
      }
    }
  }
};

//------------------------------------------------------------------------------
// Whether two triangles have more in common than their common corners and the side between them.
bool MeetBeyond(const CornerOrder& order, const Kernel::Triangle_3& t, const Kernel::Triangle_3& u)
{
  const int* first = order.First;
  const int* second = order.Second;
  switch (order.NumberInCommon)
  {
    case 0:
      return CGAL::do_intersect(t, u);
    case 1:
      return CGAL::do_intersect(t, Kernel::Segment_3(u[second[1]], u[second[2]])) ||
        CGAL::do_intersect(u, Kernel::Segment_3(t[first[1]], t[first[2]]));
    case 2:
    {
      const Kernel::Point_3& a = t[first[0]];
      const Kernel::Point_3& b = t[first[1]];
      const Kernel::Point_3& c = t[first[2]];
      const Kernel::Point_3& d = u[second[2]];
      return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
    }
    default:
      return true;
  }
}

//------------------------------------------------------------------------------
// The same, where common corners are those with equal coordinates.
bool MeetBeyond(const Kernel::Triangle_3& t, const Kernel::Triangle_3& u)
{
  return MeetBeyond(CornerOrder([&](int i, int j) { return t[i] == u[j]; }), t, u);
}
} // namespace

//------------------------------------------------------------------------------
bool TriangleCrossings::OnlyTouch(const Corners& first, const Corners& second)
{
  const TriangleSoup::Triangle all{ 0, 1, 2 };
  return !MeetBeyond(ToKernel(first, all), ToKernel(second, all));
}

//------------------------------------------------------------------------------
std::vector<TriangleCrossings::Pair> TriangleCrossings::Find(const Points& points,
  const Triangles& triangles, const Monitor& monitor, std::size_t most)
{
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (!ToKernel(points, triangles[i]).is_degenerate())
    {
      used.push_back(i);
    }
  }
  std::vector<Pair> pairs;
  Heartbeat heart(monitor);
  const auto look = [&](std::size_t a, std::size_t b)
  {
    heart.Beat();
    const std::size_t i = std::min(a, b);
    const std::size_t j = std::max(a, b);
    const Kernel::Triangle_3 t = ToKernel(points, triangles[i]);
    const Kernel::Triangle_3 u = ToKernel(points, triangles[j]);
    const auto shared = [&](int k, int l) { return triangles[i][k] == triangles[j][l]; };
    if (MeetBeyond(CornerOrder(shared), t, u))
    {
      if (pairs.size() == most)
      {
        throw std::runtime_error(
          "more than " + std::to_string(most) + " pairs of triangles meet each other");
      }
      pairs.push_back({ i, j, !MeetBeyond(t, u) });
    }
  };
  NearPairs::ForEach(points, triangles, used, look);
  std::sort(pairs.begin(), pairs.end(),
    [](const Pair& a, const Pair& b)
    { return std::tie(a.First, a.Second) < std::tie(b.First, b.Second); });
  return pairs;
}

//------------------------------------------------------------------------------
CGAL::Bbox_3 TriangleCrossings::GetBox(const Points& points, const TriangleSoup::Triangle& triangle)
{
  CGAL::Bbox_3 box;
  for (const std::size_t corner : triangle)
  {
    const TriangleSoup::Point& p = points[corner];
    box += CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  }
  return box;
}

//------------------------------------------------------------------------------
CGAL::Bbox_3 TriangleCrossings::Widen(const CGAL::Bbox_3& box, double reach)
{
  return { box.xmin() - reach, box.ymin() - reach, box.zmin() - reach, box.xmax() + reach,
    box.ymax() + reach, box.zmax() + reach };
}

//------------------------------------------------------------------------------
CGAL::Bbox_3 TriangleCrossings::Intersect(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b)
{
  return { std::max(a.xmin(), b.xmin()), std::max(a.ymin(), b.ymin()), std::max(a.zmin(), b.zmin()),
    std::min(a.xmax(), b.xmax()), std::min(a.ymax(), b.ymax()), std::min(a.zmax(), b.zmax()) };
}

//------------------------------------------------------------------------------
void TriangleCrossings::ForEachOverlap(const std::vector<CGAL::Bbox_3>& first,
  const std::vector<CGAL::Bbox_3>& second, const Monitor& monitor,
  const std::function<void(std::size_t, std::size_t)>& function)
{
  const auto number = [](const std::vector<CGAL::Bbox_3>& plain)
  {
    std::vector<Box> boxes;
    for (const CGAL::Bbox_3& box : plain)
    {
      boxes.emplace_back(box, boxes.size());
    }
    return boxes;
  };
  std::vector<Box> a = number(first);
  std::vector<Box> b = number(second);
  Heartbeat heart(monitor);
  CGAL::box_intersection_d(a.begin(), a.end(), b.begin(), b.end(),
    [&](const Box& x, const Box& y)
    {
      heart.Beat();
      function(x.info(), y.info());
    });
}
} // namespace LightTransport
