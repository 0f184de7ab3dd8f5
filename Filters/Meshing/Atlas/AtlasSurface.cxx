// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
// An edge is halved when it is longer than this part of the square root of the area of the
// surface, or of its component; but never into more pieces than the last number says.
constexpr double EdgesAcrossSurface = 24.0;
constexpr double EdgesAcrossComponent = 4.0;
constexpr double MaximumPiecesOfEdge = 64.0;

//------------------------------------------------------------------------------
std::uint64_t MakeKey(std::size_t a, std::size_t b)
{
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) |
    static_cast<std::uint64_t>(std::max(a, b));
}
} // namespace

//------------------------------------------------------------------------------
AtlasSurface::AtlasSurface(const TriangleSoup& soup)
  : Points(soup.Points), Triangles(soup.Triangles), Sources(soup.Triangles.size())
{
  std::iota(this->Sources.begin(), this->Sources.end(), 0);
  this->FindNeighbors();
  this->FindGeometry();
  std::vector<double> longest = this->FindLongestEdges();
  while (this->HalveLongEdges(longest))
  {
  }
  if (!this->HalvedEdges.empty())
  {
    this->FindNeighbors();
    this->FindGeometry();
  }
}

//------------------------------------------------------------------------------
double AtlasSurface::GetEdgeLength(int face, int edge) const
{
  const TriangleSoup::Triangle& triangle = this->Triangles[face];
  return (this->GetPoint(triangle[edge]) - this->GetPoint(triangle[(edge + 1) % 3])).norm();
}

//------------------------------------------------------------------------------
AtlasSurface::Vector AtlasSurface::GetEdgeMiddle(int face, int edge) const
{
  const TriangleSoup::Triangle& triangle = this->Triangles[face];
  return 0.5 * (this->GetPoint(triangle[edge]) + this->GetPoint(triangle[(edge + 1) % 3]));
}

//------------------------------------------------------------------------------
std::vector<std::array<int, 3>> AtlasSurface::GetNeighborsWithin(const std::vector<int>& faces,
  const std::vector<int>& owners, std::vector<int>& local) const
{
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    local[faces[i]] = static_cast<int>(i);
  }
  std::vector<std::array<int, 3>> neighbors(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[faces[i]][edge];
      const bool inside = neighbor >= 0 && owners[neighbor] == owners[faces[i]];
      neighbors[i][edge] = inside ? local[neighbor] : -1;
    }
  }
  return neighbors;
}

//------------------------------------------------------------------------------
void AtlasSurface::FindNeighbors()
{
  struct Side
  {
    std::uint64_t Key;
    int Face;
    int Edge;
  };
  std::vector<Side> sides;
  sides.reserve(3 * this->Triangles.size());
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    const TriangleSoup::Triangle& triangle = this->Triangles[face];
    for (int edge = 0; edge < 3; ++edge)
    {
      sides.push_back({ MakeKey(triangle[edge], triangle[(edge + 1) % 3]), face, edge });
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.Key < b.Key; });
  this->Neighbors.assign(this->Triangles.size(), { -1, -1, -1 });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
  {
    if (sides[i].Key == sides[i + 1].Key)
    {
      this->Neighbors[sides[i].Face][sides[i].Edge] = sides[i + 1].Face;
      this->Neighbors[sides[i + 1].Face][sides[i + 1].Edge] = sides[i].Face;
    }
  }
}

//------------------------------------------------------------------------------
void AtlasSurface::FindGeometry()
{
  const std::size_t size = this->Triangles.size();
  this->Areas.resize(size);
  this->Normals.resize(size);
  this->Centers.resize(size);
  this->Area = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Vector a = this->GetPoint(this->Triangles[i][0]);
    const Vector b = this->GetPoint(this->Triangles[i][1]);
    const Vector c = this->GetPoint(this->Triangles[i][2]);
    const Vector normal = (b - a).cross(c - a);
    this->Areas[i] = 0.5 * normal.norm();
    this->Normals[i] = normal.normalized();
    this->Centers[i] = (a + b + c) / 3.0;
    this->Area += this->Areas[i];
  }
}

//------------------------------------------------------------------------------
// How long the edges of each face may be.
std::vector<double> AtlasSurface::FindLongestEdges() const
{
  std::vector<double> lengths(this->Triangles.size(), -1.0);
  std::vector<int> component;
  for (int first = 0; first < this->GetNumberOfFaces(); ++first)
  {
    if (lengths[first] >= 0.0)
    {
      continue;
    }
    component.assign(1, first);
    lengths[first] = 0.0;
    double area = 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < component.size(); ++i)
    {
      area += this->Areas[component[i]];
      for (int edge = 0; edge < 3; ++edge)
      {
        longest = std::max(longest, this->GetEdgeLength(component[i], edge));
        const int neighbor = this->Neighbors[component[i]][edge];
        if (neighbor >= 0 && lengths[neighbor] < 0.0)
        {
          lengths[neighbor] = 0.0;
          component.push_back(neighbor);
        }
      }
    }
    const double length = std::max(longest / MaximumPiecesOfEdge,
      std::min(std::sqrt(this->Area) / EdgesAcrossSurface, std::sqrt(area) / EdgesAcrossComponent));
    for (const int face : component)
    {
      lengths[face] = length;
    }
  }
  return lengths;
}

//------------------------------------------------------------------------------
int AtlasSurface::FindLongestHalvedEdge(std::size_t face, const Middles& middles) const
{
  int found = -1;
  double length = 0.0;
  for (int edge = 0; edge < 3; ++edge)
  {
    const TriangleSoup::Triangle& t = this->Triangles[face];
    const double candidate = this->GetEdgeLength(static_cast<int>(face), edge);
    if (candidate > length && middles.count(MakeKey(t[edge], t[(edge + 1) % 3])) != 0)
    {
      found = edge;
      length = candidate;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
// Halve all edges that are too long, once. Returns whether there were any.
bool AtlasSurface::HalveLongEdges(std::vector<double>& longest)
{
  Middles middles;
  for (int face = 0; face < this->GetNumberOfFaces(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::size_t a = this->Triangles[face][edge];
      const std::size_t b = this->Triangles[face][(edge + 1) % 3];
      if (this->GetEdgeLength(face, edge) > longest[face] &&
        middles.emplace(MakeKey(a, b), this->Points.size()).second)
      {
        const Vector middle = this->GetEdgeMiddle(face, edge);
        this->Points.push_back({ middle[0], middle[1], middle[2] });
        this->HalvedEdges.push_back({ a, b });
      }
    }
  }
  // Cut a triangle at its longest halved side; its parts keep the sides that are still to be cut.
  for (std::size_t face = 0; face < this->Triangles.size() && !middles.empty(); ++face)
  {
    for (int edge = this->FindLongestHalvedEdge(face, middles); edge >= 0;
         edge = this->FindLongestHalvedEdge(face, middles))
    {
      const TriangleSoup::Triangle t = this->Triangles[face];
      const std::size_t middle = middles.at(MakeKey(t[edge], t[(edge + 1) % 3]));
      this->Triangles[face][(edge + 1) % 3] = middle;
      this->Triangles.push_back({ middle, t[(edge + 1) % 3], t[(edge + 2) % 3] });
      this->Sources.push_back(this->Sources[face]);
      longest.push_back(longest[face]);
    }
  }
  return !middles.empty();
}
} // namespace LightTransport
