// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Repairs that need to know neighbours: crumbs, holes and self-intersections of an oriented
 * manifold.
 *
 * A component is what is connected by edges. All methods throw what CGAL throws (std::exception),
 * those that get a monitor Heartbeat::Stopped when aborted: nothing is of use then.
 */
#ifndef ManifoldRepair_h
#define ManifoldRepair_h

#include "Common/TriangleSoup.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <array>
#include <memory>

namespace LightTransport
{
class ManifoldRepair
{
public:
  ManifoldRepair();
  ~ManifoldRepair();
  ManifoldRepair(const ManifoldRepair&) = delete;
  void operator=(const ManifoldRepair&) = delete;

  /// Take a copy of the soup. Fails when it is not a manifold.
  Outcome Build(const TriangleSoup& soup);

  /**
   * Drop components that are open, not the largest one, have an edge at which the soup was split or
   * lost a duplicate (TriangleSoup::SplitPoints), and fit into a sphere of radius `size`.
   * Returns the number of their triangles.
   */
  vtkIdType DropCrumbs(double size);

  /**
   * Fill the holes whose border fits into a sphere of radius `size` and into one half as large as
   * the component's. Returns their number.
   */
  vtkIdType FillHoles(double size, const Monitor& monitor);

  struct Intersections
  {
    /// Pairs of triangles of one component that have more in common than corners and sides, and of
    /// two components.
    vtkIdType NumberWithin = 0;
    vtkIdType NumberBetween = 0;
    /// The first pair within a component: where it is, and the cells it comes from.
    TriangleSoup::Point Place{ 0.0, 0.0, 0.0 };
    std::array<vtkIdType, 2> CellIds{ -1, -1 };
  };
  Intersections FindSelfIntersections(const Monitor& monitor);

  /**
   * Take away the surface around the self-intersections that were found and close the gap. A
   * component is left as it was if this fails, changes how it is connected, or moves its surface by
   * more than `distance`. `left` becomes what is left.
   */
  Outcome ResolveSelfIntersections(double distance, const Monitor& monitor, Intersections& left);

  /// The repaired surface. A new triangle or point has the ids of an old one next to it.
  void Write(TriangleSoup& soup) const;

private:
  Intersections DescribeIntersections() const;

  struct Internals;
  std::unique_ptr<Internals> Surface;
};
} // namespace LightTransport

#endif
