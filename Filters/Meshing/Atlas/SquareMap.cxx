// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/SquareMap.h"

#include "Atlas/SquareLayout.h"
#include "vtkMath.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

namespace LightTransport
{
namespace
{
using Disc = SquareMap::Disc;
using Point = SquareMap::Point;
using Triangle = SquareMap::Triangle;
using Coordinates = SquareMap::Coordinates;
using Edge = std::pair<std::size_t, std::size_t>;
using Corners = std::array<std::size_t, 4>;

// How many corners are tried, and how many of these after a first look.
constexpr int Beginnings = 8;
constexpr std::size_t Finalists = 3;

// Newton's method ends by itself, mostly after ten iterations; long branches take up to this many.
constexpr int LastIterations = 200;

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
  std::vector<std::size_t> FindSharpestApart(std::size_t number, double apart) const;
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
    this->Turns.push_back(vtkMath::Pi() - angles[point]);
    const Point step = Subtract(disc.Points[next[point]], disc.Points[point]);
    this->Lengths.push_back(this->Lengths.back() + std::sqrt(Dot(step, step)));
    point = next[point];
  }
}

//------------------------------------------------------------------------------
// Halve the inner edges that join two points of one side. The middle of an edge lies on no side, so
// that no other such edges come into being.
const Disc& HalveEdgesAlongSides(Disc& disc, std::vector<unsigned char>& sides)
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
  return disc;
}

//------------------------------------------------------------------------------
std::vector<unsigned char> GetSides(const Border& border, const Corners& corners,
  std::size_t numberOfPoints)
{
  constexpr unsigned char order[4] = { SquareLayout::Bottom, SquareLayout::Right, SquareLayout::Top,
    SquareLayout::Left };
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
// The point that turns most to the left among those between two lengths, or the first one after.
std::size_t Border::FindSharpest(double from, double to) const
{
  const double length = this->GetLength();
  std::size_t sharpest = 0;
  double sharpestAt = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->GetSize(); ++i)
  {
    const double at = this->Lengths[i] - length * std::floor((this->Lengths[i] - from) / length);
    if (at < to && sharpestAt < to ? this->Turns[i] > this->Turns[sharpest] : at < sharpestAt)
    {
      sharpest = i;
      sharpestAt = at;
    }
  }
  return sharpest;
}

//------------------------------------------------------------------------------
// Up to `number` points that turn most to the left and are at least so far apart, in order.
std::vector<std::size_t> Border::FindSharpestApart(std::size_t number, double apart) const
{
  std::vector<std::size_t> order(this->GetSize());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return this->Turns[a] > this->Turns[b]; });
  std::vector<std::size_t> chosen;
  for (auto i = order.begin(); i != order.end() && chosen.size() < number; ++i)
  {
    const bool isFree = std::none_of(chosen.begin(), chosen.end(),
      [&](std::size_t j)
      {
        const double distance = std::abs(this->Lengths[*i] - this->Lengths[j]);
        return std::min(distance, this->GetLength() - distance) < apart;
      });
    if (isFree)
    {
      chosen.push_back(*i);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

//------------------------------------------------------------------------------
bool AreInOrder(const Corners& corners)
{
  return corners[0] < corners[1] && corners[1] < corners[2] && corners[2] < corners[3];
}

//------------------------------------------------------------------------------
// Places for the corners: quarters of the border from several beginnings, each moved to the
// sharpest point nearby, and the sharpest points of all that are not too close together.
std::set<Corners> GetCandidates(const Border& border)
{
  std::set<Corners> candidates;
  const auto add = [&](Corners corners)
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (AreInOrder(corners))
    {
      candidates.insert(corners);
    }
  };
  const double quarter = 0.25 * border.GetLength();
  for (int beginning = 0; beginning < Beginnings; ++beginning)
  {
    const double window = quarter / Beginnings;
    Corners corners;
    for (int i = 0; i < 4; ++i)
    {
      const double from = i * quarter + beginning * window;
      corners[i] = border.FindSharpest(from, from + window);
    }
    add(corners);
  }
  for (double apart : { 0.5 * quarter, 0.25 * quarter, 0.0 })
  {
    const std::vector<std::size_t> corners = border.FindSharpestApart(4, apart);
    if (corners.size() == 4)
    {
      add({ corners[0], corners[1], corners[2], corners[3] });
    }
  }
  return candidates;
}

// A disc with its corners chosen, on its way to the square.
struct Trial
{
  Trial(const Disc& disc, const Border& border, const Corners& corners, const Watch& watch)
    : SquareCorners(corners), Halved(disc), Sides(GetSides(border, corners, disc.Points.size())),
      Layout(HalveEdgesAlongSides(this->Halved, this->Sides), this->Sides, watch)
  {
  }

  Corners SquareCorners;
  Disc Halved;
  std::vector<unsigned char> Sides;
  SquareLayout Layout;
  double Stretch = std::numeric_limits<double>::infinity();
};
using Trials = std::vector<std::unique_ptr<Trial>>;

//------------------------------------------------------------------------------
// The trials that a step has succeeded for, the least stretch first, and at most `number`.
template <typename Step>
void KeepBest(Trials& trials, std::size_t number, Step&& step)
{
  for (auto& trial : trials)
  {
    if (!step(trial->Layout))
    {
      trial.reset();
      continue;
    }
    trial->Stretch = trial->Layout.GetL2Stretch();
  }
  trials.erase(std::remove(trials.begin(), trials.end(), nullptr), trials.end());
  std::sort(trials.begin(), trials.end(),
    [](const auto& a, const auto& b) { return a->Stretch < b->Stretch; });
  trials.resize(std::min(number, trials.size()));
}
} // namespace

//------------------------------------------------------------------------------
bool SquareMap::Map(Disc& disc, std::string& problem, const Watch& watch)
{
  const Border border(disc);
  if (border.GetSize() < 4)
  {
    problem = "the border of a disc has fewer than four points";
    return false;
  }
  const std::set<Corners> candidates = GetCandidates(border);
  for (auto springs : { SquareLayout::SpringKind::Conformal, SquareLayout::SpringKind::Uniform })
  {
    // Which corners are best shows late, but one step of reweighting tells most of them apart.
    Trials trials;
    for (const Corners& corners : candidates)
    {
      trials.push_back(std::make_unique<Trial>(disc, border, corners, watch));
    }
    KeepBest(trials, Finalists,
      [&](SquareLayout& layout)
      {
        const bool isOneToOne = layout.Balance(springs) && layout.IsOneToOne();
        layout.Reweight(1);
        return isOneToOne;
      });
    KeepBest(trials, Finalists,
      [](SquareLayout& layout)
      {
        layout.Reweight(10);
        layout.Minimize(3);
        return true;
      });
    for (auto& trial : trials)
    {
      trial->Layout.Minimize(LastIterations);
      if (IsBijective(trial->Halved, border, trial->SquareCorners, trial->Layout.GetCoordinates()))
      {
        this->UV = trial->Layout.GetCoordinates();
        this->L2Stretch = trial->Layout.GetL2Stretch();
        this->LInfinityStretch = trial->Layout.GetLInfinityStretch();
        disc = std::move(trial->Halved);
        return true;
      }
    }
  }
  problem = "rounding leaves a triangle of a disc without area in the square: the disc has "
            "triangles that are too thin, or branches that are too long";
  return false;
}
} // namespace LightTransport
