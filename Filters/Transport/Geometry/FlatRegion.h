// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Convex regions of a plane, counter-clockwise: their areas, and what they have in common.
#ifndef FlatRegion_h
#define FlatRegion_h

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
namespace FlatRegion
{
using Point = Eigen::Vector2d;
using Region = std::vector<Point>;

//------------------------------------------------------------------------------
/// Above 0 on the left of the way.
inline double Cross(const Point& a, const Point& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

//------------------------------------------------------------------------------
inline double GetArea(const Region& region)
{
  double area = 0.0;
  for (std::size_t k = 2; k < region.size(); ++k)
  {
    area += 0.5 * Cross(region[k - 1] - region[0], region[k] - region[0]);
  }
  return area;
}

//------------------------------------------------------------------------------
/// The part to the left of the line from a to b.
inline Region Clip(const Region& region, const Point& a, const Point& b)
{
  Region clipped;
  for (std::size_t k = 0; k < region.size(); ++k)
  {
    const Point& from = region[k];
    const Point& to = region[(k + 1) % region.size()];
    const double start = Cross(b - a, from - a);
    const double end = Cross(b - a, to - a);
    if (start >= 0.0)
    {
      clipped.push_back(from);
    }
    if ((start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0))
    {
      clipped.push_back(from + start / (start - end) * (to - from));
    }
  }
  return clipped;
}

//------------------------------------------------------------------------------
/// What both have in common.
inline Region Clip(Region region, const Region& other)
{
  for (std::size_t k = 0; k < other.size() && !region.empty(); ++k)
  {
    region = Clip(region, other[k], other[(k + 1) % other.size()]);
  }
  return region;
}
} // namespace FlatRegion
} // namespace LightTransport

#endif
