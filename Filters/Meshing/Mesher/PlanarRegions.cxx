// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/PlanarRegions.h"

#include "Mesher/EdgeLengths.h"
#include "Mesher/PointVectors.h"

#include "vtkType.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
struct Plane
{
  Eigen::Vector3d Origin;
  Eigen::Vector3d Normal;
};

//------------------------------------------------------------------------------
// The triangles that are connected with a first one and lie in its plane.
std::vector<std::size_t> GrowPlane(const SourceSurface& surface, std::size_t first,
  double tolerance, const std::vector<std::size_t>& regions)
{
  const Plane plane{ ToVector(surface.Points[surface.Triangles[first][0]]),
    ToVector(surface.GetNormal(first)).normalized() };
  const auto fits = [&](std::size_t triangle)
  {
    // Corners in the plane are not enough: thin triangles may stand across it.
    const double cosine = 0.999;
    const Eigen::Vector3d normal = ToVector(surface.GetNormal(triangle));
    bool all = normal.dot(plane.Normal) >= cosine * normal.norm();
    for (const std::size_t corner : surface.Triangles[triangle])
    {
      const Eigen::Vector3d offset = ToVector(surface.Points[corner]) - plane.Origin;
      all = all && std::abs(offset.dot(plane.Normal)) <= tolerance;
    }
    return all;
  };
  std::vector<std::size_t> found(1, first);
  std::map<std::size_t, bool> known;
  known[first] = true;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    for (const std::size_t neighbour : surface.Neighbours[found[i]])
    {
      if (neighbour != SourceSurface::None && regions[neighbour] == SourceSurface::None &&
        known.emplace(neighbour, true).second && fits(neighbour))
      {
        found.push_back(neighbour);
      }
    }
  }
  return found;
}

//------------------------------------------------------------------------------
double GetSize(const SourceSurface& surface)
{
  Eigen::AlignedBox3d box;
  for (const SourceSurface::Point& point : surface.Points)
  {
    box.extend(ToVector(point));
  }
  return box.diagonal().norm();
}
} // namespace

//------------------------------------------------------------------------------
std::vector<std::size_t> PlanarRegions::Find(const SourceSurface& surface,
  const std::vector<double>& lengths)
{
  const double tolerance = 1e-6 * GetSize(surface);
  const double fewestTriangles = 8.0;
  std::vector<std::size_t> regions(surface.Triangles.size(), SourceSurface::None);
  std::vector<bool> tried(surface.Triangles.size(), false);
  for (std::size_t first = 0; first < regions.size(); ++first)
  {
    if (tried[first] || regions[first] != SourceSurface::None)
    {
      continue;
    }
    const std::vector<std::size_t> region = GrowPlane(surface, first, tolerance, regions);
    double count = 0.0;
    for (const std::size_t triangle : region)
    {
      count += EdgeLengths::CountTriangles(surface, triangle, lengths);
      tried[triangle] = true;
    }
    for (const std::size_t triangle : region)
    {
      regions[triangle] = count >= fewestTriangles ? first : regions[triangle];
    }
  }
  return regions;
}

//------------------------------------------------------------------------------
std::vector<double> PlanarRegions::GetWidths(const SourceSurface& surface,
  const std::vector<std::size_t>& regions)
{
  const auto isBorder = [&](std::size_t triangle, int side)
  {
    const std::size_t neighbour = surface.Neighbours[triangle][side];
    return neighbour == SourceSurface::None || regions[neighbour] != regions[triangle];
  };
  std::vector<bool> atBorder(surface.Points.size(), false);
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      if (isBorder(i, j))
      {
        atBorder[surface.Triangles[i][j]] = true;
        atBorder[surface.Triangles[i][(j + 1) % 3]] = true;
      }
    }
  }
  std::vector<double> widths(surface.Triangles.size(), VTK_DOUBLE_MAX);
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    const SourceSurface::Triangle& corners = surface.Triangles[i];
    for (int j = 0; j < 3; ++j)
    {
      if (isBorder(i, j) && atBorder[corners[(j + 2) % 3]])
      {
        const Eigen::Vector3d side =
          ToVector(surface.Points[corners[(j + 1) % 3]]) - ToVector(surface.Points[corners[j]]);
        widths[i] = std::min(widths[i], 2.0 * surface.GetArea(i) / side.norm());
      }
    }
  }
  return widths;
}
} // namespace LightTransport
