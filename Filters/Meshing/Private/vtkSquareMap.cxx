// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSquareMap.h"

#include "vtkSquareLayout.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace
{
using Disc = vtkSquareMap::Disc;
using Point = vtkSquareMap::Point;
using Triangle = vtkSquareMap::Triangle;
using Coordinates = vtkSquareMap::Coordinates;
using Edge = std::pair<std::size_t, std::size_t>;
using Corners = std::array<std::size_t, 4>;

constexpr double PI = 3.14159265358979323846;

//------------------------------------------------------------------------------
Point Subtract(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

//------------------------------------------------------------------------------
double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

//------------------------------------------------------------------------------
double GetAngle(const Point& apex, const Point& a, const Point& b)
{
  const Point u = Subtract(a, apex);
  const Point v = Subtract(b, apex);
  return std::acos(std::max(-1.0, std::min(1.0, Dot(u, v) / std::sqrt(Dot(u, u) * Dot(v, v)))));
}

//------------------------------------------------------------------------------
// The border of a disc, with the inside to the left.
struct Border
{
  std::vector<std::size_t> Points;
  /// Length of the border up to each of its points, and at last the whole.
  std::vector<double> Lengths;
  /// How much the border turns to the left at each of its points; up to pi.
  std::vector<double> Turns;

  explicit Border(const Disc& disc);

  std::size_t GetSize() const { return this->Points.size(); }
  double GetLength() const { return this->Lengths.back(); }
  std::size_t FindSharpest(double from, double to) const;
};

//------------------------------------------------------------------------------
Border::Border(const Disc& disc)
{
  std::vector<Edge> edges;
  std::vector<double> angles(disc.Points.size(), 0.0);
  for (const Triangle& triangle : disc.Triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t a = triangle[i];
      const std::size_t b = triangle[(i + 1) % 3];
      const std::size_t c = triangle[(i + 2) % 3];
      edges.emplace_back(a, b);
      angles[a] += GetAngle(disc.Points[a], disc.Points[b], disc.Points[c]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::map<std::size_t, std::size_t> next;
  for (const Edge& edge : edges)
  {
    if (!std::binary_search(edges.begin(), edges.end(), Edge(edge.second, edge.first)))
    {
      next.insert(edge);
    }
  }
  this->Lengths.push_back(0.0);
  std::size_t point = next.empty() ? 0 : next.begin()->first;
  for (std::size_t i = 0; i < next.size(); ++i)
  {
    this->Points.push_back(point);
    this->Turns.push_back(PI - angles[point]);
    const Point step = Subtract(disc.Points[next[point]], disc.Points[point]);
    this->Lengths.push_back(this->Lengths.back() + std::sqrt(Dot(step, step)));
    point = next[point];
  }
}

//------------------------------------------------------------------------------
// Halve the inner edges that join two points of one side. The middle of an edge lies on no side, so
// that no other such edges come into being.
void HalveEdgesAlongSides(Disc& disc, std::vector<unsigned char>& sides)
{
  std::map<Edge, std::size_t> owners;
  for (std::size_t i = 0; i < disc.Triangles.size(); ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const Edge edge(disc.Triangles[i][j], disc.Triangles[i][(j + 1) % 3]);
      if (sides[edge.first] & sides[edge.second])
      {
        owners[edge] = i;
      }
    }
  }
  const auto halve = [&](const Edge& edge, std::size_t middle)
  {
    const std::size_t owner = owners[edge];
    Triangle& triangle = disc.Triangles[owner];
    std::rotate(triangle.begin(), std::find(triangle.begin(), triangle.end(), edge.first),
      triangle.end());
    const auto last = owners.find(Edge(triangle[1], triangle[2]));
    if (last != owners.end())
    {
      last->second = disc.Triangles.size();
    }
    const Triangle second{ middle, triangle[1], triangle[2] };
    triangle[1] = middle;
    disc.Triangles.push_back(second);
    disc.Sources.push_back(disc.Sources[owner]);
  };
  std::vector<Edge> edges;
  for (const auto& owner : owners)
  {
    const Edge& edge = owner.first;
    if (edge.first < edge.second && owners.count(Edge(edge.second, edge.first)) > 0)
    {
      edges.push_back(edge);
    }
  }
  for (const Edge& edge : edges)
  {
    const Point& a = disc.Points[edge.first];
    const Point& b = disc.Points[edge.second];
    const std::size_t middle = disc.Points.size();
    disc.Points.push_back({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) });
    disc.HalvedEdges.push_back({ edge.first, edge.second });
    sides.push_back(0);
    halve(edge, middle);
    halve(Edge(edge.second, edge.first), middle);
  }
}

//------------------------------------------------------------------------------
std::vector<unsigned char> GetSides(const Border& border, const Corners& corners,
  std::size_t numberOfPoints)
{
  constexpr unsigned char order[4] = { vtkSquareLayout::BOTTOM, vtkSquareLayout::RIGHT,
    vtkSquareLayout::TOP, vtkSquareLayout::LEFT };
  std::vector<unsigned char> sides(numberOfPoints, 0);
  for (int side = 0; side < 4; ++side)
  {
    const std::size_t end = corners[(side + 1) % 4];
    for (std::size_t i = corners[side]; i != end; i = (i + 1) % border.GetSize())
    {
      sides[border.Points[i]] |= order[side];
    }
    sides[border.Points[end]] |= order[side];
  }
  return sides;
}

//------------------------------------------------------------------------------
bool IsBijective(const Disc& disc, const Border& border, const Corners& corners,
  const std::vector<Coordinates>& uv)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [&](std::size_t i) { return Kernel::Point_2(uv[i][0], uv[i][1]); };
  for (const Triangle& triangle : disc.Triangles)
  {
    if (CGAL::orientation(point(triangle[0]), point(triangle[1]), point(triangle[2])) !=
      CGAL::LEFT_TURN)
    {
      return false;
    }
  }
  // The coordinate that grows or falls along each side.
  constexpr int axes[4] = { 0, 1, 0, 1 };
  constexpr double signs[4] = { 1.0, 1.0, -1.0, -1.0 };
  for (int side = 0; side < 4; ++side)
  {
    for (std::size_t i = corners[side]; i != corners[(side + 1) % 4];)
    {
      const std::size_t next = (i + 1) % border.GetSize();
      const double from = uv[border.Points[i]][axes[side]];
      const double to = uv[border.Points[next]][axes[side]];
      if (!(signs[side] * from < signs[side] * to))
      {
        return false;
      }
      i = next;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The point of the border that turns most to the left between two lengths.
std::size_t Border::FindSharpest(double from, double to) const
{
  const double length = this->GetLength();
  std::size_t best = 0;
  double bestValue = -1e300;
  for (std::size_t i = 0; i < this->GetSize(); ++i)
  {
    double at = this->Lengths[i];
    at -= length * std::floor((at - from) / length);
    if (at <= to && this->Turns[i] > bestValue)
    {
      best = i;
      bestValue = this->Turns[i];
    }
  }
  if (bestValue > -1e300)
  {
    return best;
  }
  // No point within: the next one.
  double nearest = 1e300;
  for (std::size_t i = 0; i < this->GetSize(); ++i)
  {
    double at = this->Lengths[i];
    at -= length * std::floor((at - from) / length);
    if (at < nearest)
    {
      nearest = at;
      best = i;
    }
  }
  return best;
}

//------------------------------------------------------------------------------
bool AreDistinct(const Corners& corners, std::size_t size)
{
  std::size_t around = 0;
  for (int i = 0; i < 4; ++i)
  {
    const std::size_t distance = (corners[(i + 1) % 4] + size - corners[i]) % size;
    if (distance == 0)
    {
      return false;
    }
    around += distance;
  }
  return around == size;
}

//------------------------------------------------------------------------------
std::set<Corners> GetCandidates(const Border& border)
{
  std::set<Corners> candidates;
  const auto add = [&](Corners corners)
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (AreDistinct(corners, border.GetSize()))
    {
      candidates.insert(corners);
    }
  };
  constexpr int OFFSETS = 4;
  const double window = 0.25 / OFFSETS * border.GetLength();
  for (int offset = 0; offset < OFFSETS; ++offset)
  {
    Corners corners;
    for (int i = 0; i < 4; ++i)
    {
      const double from = 0.25 * i * border.GetLength() + offset * window;
      corners[i] = border.FindSharpest(from, from + window);
    }
    add(corners);
  }
  // The four sharpest points that are not close together.
  for (double apart : { 0.125, 0.06, 0.0 })
  {
    std::vector<std::size_t> order(border.GetSize());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return border.Turns[a] > border.Turns[b]; });
    std::vector<std::size_t> chosen;
    for (std::size_t i : order)
    {
      bool free = chosen.size() < 4;
      for (std::size_t j : chosen)
      {
        const double distance = std::abs(border.Lengths[i] - border.Lengths[j]);
        free =
          free && std::min(distance, border.GetLength() - distance) >= apart * border.GetLength();
      }
      if (free)
      {
        chosen.push_back(i);
      }
    }
    if (chosen.size() == 4)
    {
      std::sort(chosen.begin(), chosen.end());
      add({ chosen[0], chosen[1], chosen[2], chosen[3] });
    }
  }
  return candidates;
}
} // namespace

//------------------------------------------------------------------------------
bool vtkSquareMap::Map(Disc& disc, std::string& problem)
{
  const Border border(disc);
  if (border.GetSize() < 4)
  {
    problem = "The border of a chart has fewer than four points.";
    return false;
  }
  struct Trial
  {
    double Stretch;
    Corners SquareCorners;
    Disc Halved;
    std::vector<Coordinates> UV;
  };
  for (auto kind : { vtkSquareLayout::SpringKind::Conformal, vtkSquareLayout::SpringKind::Uniform })
  {
    double best = std::numeric_limits<double>::infinity();
    Corners bestCorners{};
    for (const Corners& corners : GetCandidates(border))
    {
      Disc halved = disc;
      std::vector<unsigned char> sides = GetSides(border, corners, disc.Points.size());
      HalveEdgesAlongSides(halved, sides);
      vtkSquareLayout layout(halved, sides);
      if (layout.Balance(kind) && layout.GetL2Stretch() < best)
      {
        best = layout.GetL2Stretch();
        bestCorners = corners;
      }
    }
    if (!(best < std::numeric_limits<double>::infinity()))
    {
      continue;
    }
    Disc halved = disc;
    std::vector<unsigned char> sides = GetSides(border, bestCorners, disc.Points.size());
    HalveEdgesAlongSides(halved, sides);
    vtkSquareLayout layout(halved, sides);
    layout.Balance(kind);
    layout.Reweight(10);
    layout.Minimize(20);
    if (IsBijective(halved, border, bestCorners, layout.GetCoordinates()))
    {
      this->UV = layout.GetCoordinates();
      this->L2Stretch = layout.GetL2Stretch();
      this->LInfinityStretch = layout.GetLInfinityStretch();
      disc = std::move(halved);
      return true;
    }
  }
  problem =
    "Rounding leaves a triangle of a chart without area in the square, whatever weights are "
    "tried: its triangles are too thin.";
  return false;
}
