// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/EdgeLengths.h"

#include "Common/Heartbeat.h"
#include "Common/LengthAcross.h"
#include "Mesher/PointVectors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
double EdgeLengths::GetLengthForCurvature(double curvature, double error, double shortest,
  double longest)
{
  // Written so that curvature 0 gives the longest length and a negative root the shortest.
  const double length2 = curvature > 0.0 ? 6.0 * error / curvature - 3.0 * error * error
                                         : std::numeric_limits<double>::max();
  return std::min(std::max(std::sqrt(std::max(0.0, length2)), shortest), longest);
}

//------------------------------------------------------------------------------
void EdgeLengths::Grade(const SourceSurface& surface, double grading, std::vector<double>& lengths,
  const Monitor& monitor)
{
  Heartbeat heart(monitor);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    queue.emplace(lengths[i], i);
  }
  // Corners of obtuse triangles shorten each other by turns; smaller changes end it.
  const double significant = 1.0 - 1e-4;
  while (!queue.empty())
  {
    const Entry entry = queue.top();
    queue.pop();
    const std::size_t from = entry.second;
    if (entry.first > lengths[from])
    {
      continue;
    }
    for (const std::size_t triangle : surface.GetTrianglesAround(from))
    {
      heart.Beat();
      const SourceSurface::Triangle& corners = surface.Triangles[triangle];
      for (int i = 0; i < 3; ++i)
      {
        const std::size_t to = corners[i];
        const std::size_t a = corners[(i + 1) % 3];
        const std::size_t b = corners[(i + 2) % 3];
        if (to == from)
        {
          continue;
        }
        // From the other corner of the side only when its own length is settled.
        const std::size_t other = a == from ? b : a;
        const std::size_t last = lengths[other] <= lengths[from] ? other : from;
        const double limit =
          GetLengthAcross(ToVector(surface.Points[from]), ToVector(surface.Points[last]),
            ToVector(surface.Points[to]), lengths[from], lengths[last], grading);
        if (limit < significant * lengths[to])
        {
          lengths[to] = limit;
          queue.emplace(limit, to);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// How many equilateral triangles fill a triangle.
double EdgeLengths::CountTriangles(const SourceSurface& surface, std::size_t triangle,
  const std::vector<double>& lengths)
{
  double perArea = 0.0;
  for (const std::size_t corner : surface.Triangles[triangle])
  {
    perArea += 4.0 / std::sqrt(3.0) / (lengths[corner] * lengths[corner]) / 3.0;
  }
  return perArea * surface.GetArea(triangle);
}

//------------------------------------------------------------------------------
double EdgeLengths::EstimateNumberOfTriangles(const SourceSurface& surface,
  const std::vector<double>& lengths)
{
  double number = 0.0;
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    number += CountTriangles(surface, i, lengths);
    for (int j = 0; j < 3; ++j)
    {
      if (surface.Neighbours[i][j] == SourceSurface::None)
      {
        // Each side of an edge to keep has about half a triangle more per length.
        const std::size_t from = surface.Triangles[i][j];
        const std::size_t to = surface.Triangles[i][(j + 1) % 3];
        const double side = (ToVector(surface.Points[to]) - ToVector(surface.Points[from])).norm();
        number += side / (lengths[from] + lengths[to]);
      }
    }
  }
  return number;
}

//------------------------------------------------------------------------------
double EdgeLengths::GetMeanLength(const SourceSurface& surface, const std::vector<double>& lengths)
{
  double area = 0.0;
  double number = 0.0;
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    area += surface.GetArea(i);
    number += CountTriangles(surface, i, lengths);
  }
  return std::sqrt(4.0 / std::sqrt(3.0) * area / number);
}
} // namespace LightTransport
