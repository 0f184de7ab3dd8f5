// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/PatchSizing.h"

#include "vtkMath.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace LightTransport
{
namespace
{
using Point = SourceSurface::Point;

//------------------------------------------------------------------------------
Eigen::Vector3d ToVector(const Point& point)
{
  return Eigen::Vector3d(point[0], point[1], point[2]);
}

//------------------------------------------------------------------------------
// Curvature around a point within a part: the sum over edges, and the area it belongs to.
struct CurvatureSum
{
  Eigen::Matrix3d Tensor = Eigen::Matrix3d::Zero();
  double Area = 0.0;
};

//------------------------------------------------------------------------------
// The largest length at C that lengths at A and B, and on the line between them, allow.
double LimitLength(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
  double lengthAtA, double lengthAtB, double grading)
{
  const double side = (b - a).norm();
  double t = lengthAtA <= lengthAtB ? 0.0 : 1.0;
  const double slope = side > 0.0 ? (lengthAtB - lengthAtA) / side : grading;
  if (std::abs(slope) < grading)
  {
    // Minimum over x of lengthAtA + slope x + grading sqrt((foot - x)^2 + height^2).
    const double foot = (c - a).dot(b - a) / side;
    const double height = (c - a).cross(b - a).norm() / side;
    const double x = foot - height * slope / std::sqrt(grading * grading - slope * slope);
    t = std::min(std::max(x / side, 0.0), 1.0);
  }
  return lengthAtA + t * (lengthAtB - lengthAtA) + grading * (c - (a + t * (b - a))).norm();
}

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
      if (neighbour != SourceSurface::NONE && regions[neighbour] == SourceSurface::NONE &&
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
  for (const Point& point : surface.Points)
  {
    box.extend(ToVector(point));
  }
  return box.diagonal().norm();
}

//------------------------------------------------------------------------------
// How many equilateral triangles fill a triangle.
double CountTriangles(const SourceSurface& surface, std::size_t triangle,
  const std::vector<double>& lengths)
{
  double perArea = 0.0;
  for (const std::size_t corner : surface.Triangles[triangle])
  {
    perArea += 4.0 / std::sqrt(3.0) / (lengths[corner] * lengths[corner]) / 3.0;
  }
  return perArea * surface.GetArea(triangle);
}
} // namespace

//------------------------------------------------------------------------------
std::vector<double> PatchSizing::GetCurvatures(const SourceSurface& surface)
{
  std::map<std::pair<std::size_t, std::size_t>, CurvatureSum> sums;
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    const Eigen::Vector3d normal = ToVector(surface.GetNormal(i)).normalized();
    for (int j = 0; j < 3; ++j)
    {
      const std::size_t from = surface.Triangles[i][j];
      const std::size_t to = surface.Triangles[i][(j + 1) % 3];
      // A third of the area around a point is its own.
      sums[{ from, surface.Parts[i] }].Area += surface.GetArea(i) / 3.0;
      const std::size_t neighbour = surface.Neighbours[i][j];
      if (neighbour == SourceSurface::NONE || neighbour < i)
      {
        continue;
      }
      const Eigen::Vector3d other = ToVector(surface.GetNormal(neighbour)).normalized();
      const Eigen::Vector3d edge = ToVector(surface.Points[to]) - ToVector(surface.Points[from]);
      const double length = edge.norm();
      const Eigen::Vector3d along = edge / length;
      const double angle = std::atan2(normal.cross(other).dot(along), normal.dot(other));
      // Half of the edge belongs to each of its ends.
      const Eigen::Matrix3d tensor = 0.5 * angle * length * along * along.transpose();
      sums[{ from, surface.Parts[i] }].Tensor += tensor;
      sums[{ to, surface.Parts[i] }].Tensor += tensor;
    }
  }
  std::vector<double> curvatures(surface.Points.size(), 0.0);
  for (const auto& sum : sums)
  {
    const Eigen::Matrix3d tensor = sum.second.Tensor / sum.second.Area;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor, Eigen::EigenvaluesOnly);
    const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
    curvatures[sum.first.first] = std::max(curvatures[sum.first.first], largest);
  }
  return curvatures;
}

//------------------------------------------------------------------------------
double PatchSizing::GetLengthForCurvature(double curvature, double error, double shortest,
  double longest)
{
  // Written so that curvature 0 gives the longest length and a negative root the shortest.
  const double length2 = 6.0 * error / curvature - 3.0 * error * error;
  return std::sqrt(std::min(std::max(length2, shortest * shortest), longest * longest));
}

//------------------------------------------------------------------------------
std::vector<std::size_t> PatchSizing::FindPlanarRegions(const SourceSurface& surface,
  const std::vector<double>& lengths)
{
  const double tolerance = 1e-6 * GetSize(surface);
  const double fewestTriangles = 8.0;
  std::vector<std::size_t> regions(surface.Triangles.size(), SourceSurface::NONE);
  std::vector<bool> tried(surface.Triangles.size(), false);
  for (std::size_t first = 0; first < regions.size(); ++first)
  {
    if (tried[first] || regions[first] != SourceSurface::NONE)
    {
      continue;
    }
    const std::vector<std::size_t> region = GrowPlane(surface, first, tolerance, regions);
    double count = 0.0;
    for (const std::size_t triangle : region)
    {
      count += CountTriangles(surface, triangle, lengths);
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
std::vector<double> PatchSizing::GetWidths(const SourceSurface& surface,
  const std::vector<std::size_t>& regions)
{
  const auto isBorder = [&](std::size_t triangle, int side)
  {
    const std::size_t neighbour = surface.Neighbours[triangle][side];
    return neighbour == SourceSurface::NONE || regions[neighbour] != regions[triangle];
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

//------------------------------------------------------------------------------
void PatchSizing::Grade(const SourceSurface& surface, double grading, std::vector<double>& lengths)
{
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
          LimitLength(ToVector(surface.Points[from]), ToVector(surface.Points[last]),
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
double PatchSizing::EstimateNumberOfTriangles(const SourceSurface& surface,
  const std::vector<double>& lengths)
{
  double number = 0.0;
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    number += CountTriangles(surface, i, lengths);
    for (int j = 0; j < 3; ++j)
    {
      if (surface.Neighbours[i][j] == SourceSurface::NONE)
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
double PatchSizing::GetMeanLength(const SourceSurface& surface, const std::vector<double>& lengths)
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
