// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which triangles of a surface meet where they should not, by exact predicates.
#ifndef TriangleCrossings_h
#define TriangleCrossings_h

#include "Common/TriangleSoup.h"
#include "Shared/Monitor.h"

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace LightTransport
{
namespace TriangleCrossings
{
using Points = std::vector<TriangleSoup::Point>;
using Triangles = std::vector<TriangleSoup::Triangle>;

struct Pair
{
  std::size_t First;
  std::size_t Second;
  /// Whether they only have corners and sides in common: by their coordinates, not as the mesh
  /// says.
  bool OnlyTouches;
};

/**
 * The pairs of triangles that meet, sorted, without those that meet where the mesh says so, in the
 * points they share. Triangles without area do not count. Throws Heartbeat::Stopped when aborted,
 * std::runtime_error where there are more than `most`: they would take gigabytes, and are no
 * surface that could be repaired.
 */
std::vector<Pair> Find(const Points& points, const Triangles& triangles, const Monitor& monitor,
  std::size_t most = 10000000);

using Corners = std::array<TriangleSoup::Point, 3>;
/// Whether two triangles that meet only have corners and sides in common, by their coordinates.
bool OnlyTouch(const Corners& first, const Corners& second);

CGAL::Bbox_3 GetBox(const Points& points, const TriangleSoup::Triangle& triangle);
/// A box that reaches further by `reach` on all sides.
CGAL::Bbox_3 Widen(const CGAL::Bbox_3& box, double reach);
/// What two boxes that overlap have in common.
CGAL::Bbox_3 Intersect(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b);

/// Calls `function` with the index of each box of one list and that of each in the other that
/// overlaps it. Throws Heartbeat::Stopped when aborted.
void ForEachOverlap(const std::vector<CGAL::Bbox_3>& first, const std::vector<CGAL::Bbox_3>& second,
  const Monitor& monitor, const std::function<void(std::size_t, std::size_t)>& function);
} // namespace TriangleCrossings
} // namespace LightTransport

#endif
