// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/NearSides.h"

#include "vtkMath.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>

namespace LightTransport
{
namespace
{
using Point = TriangleSoup::Point;

// How much of the sides at a point it may be welded over.
constexpr double LargestPart = 0.25;
// Long sides are looked at in pieces, so that little lies in the box around each.
constexpr double LengthsPerPiece = 4.0;
constexpr double MostPieces = 64.0;
// Pairs of points and sides that may be looked at, in all.
constexpr std::size_t MostPairs = 50000000;

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

//------------------------------------------------------------------------------
Box MakeBox(const Point& a, const Point& b, double margin, std::size_t index)
{
  double low[3];
  double high[3];
  for (int i = 0; i < 3; ++i)
  {
    low[i] = std::min(a[i], b[i]) - margin;
    high[i] = std::max(a[i], b[i]) + margin;
  }
  return { low, high, index };
}

//------------------------------------------------------------------------------
Point Interpolate(const Point& a, const Point& b, double t)
{
  return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

//------------------------------------------------------------------------------
double GetDistance(const Point& a, const Point& b)
{
  return std::sqrt(vtkMath::Distance2BetweenPoints(a.data(), b.data()));
}

struct Stop : public std::exception
{
};
} // namespace

//------------------------------------------------------------------------------
NearSides::NearSides(const TriangleSoup& soup, const SideJoiner& joiner,
  std::vector<std::size_t>& places, double tolerance)
  : Soup(soup), Joiner(joiner), Places(places), Tolerance(tolerance)
{
  this->FindBorders();
}

//------------------------------------------------------------------------------
void NearSides::FindBorders()
{
  this->Shortest.assign(this->Soup.Points.size(), std::numeric_limits<double>::max());
  std::vector<bool> known(this->Soup.Points.size(), false);
  for (std::size_t side = 0; side < this->Joiner.GetNumberOfSides(); ++side)
  {
    const auto [from, to] = this->Joiner.GetEnds(side);
    if (this->Joiner.GetPartner(side) != SideJoiner::None || this->Places[from] == this->Places[to])
    {
      continue;
    }
    this->Sides.push_back(side);
    const double length = GetDistance(this->Soup.Points[from], this->Soup.Points[to]);
    for (const std::size_t point : { from, to })
    {
      this->Shortest[point] = std::min(this->Shortest[point], length);
      if (!known[this->Places[point]])
      {
        known[this->Places[point]] = true;
        this->Points.push_back(point);
      }
    }
  }
}

//------------------------------------------------------------------------------
Outcome NearSides::Find(const Monitor& monitor)
{
  if (this->Sides.empty())
  {
    return Outcome::Done();
  }
  std::vector<double> lengths;
  for (const std::size_t side : this->Sides)
  {
    const auto [from, to] = this->Joiner.GetEnds(side);
    lengths.push_back(GetDistance(this->Soup.Points[from], this->Soup.Points[to]));
  }
  std::vector<double> sorted = lengths;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  this->TypicalLength = *middle;
  std::vector<Box> sides;
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    const auto [from, to] = this->Joiner.GetEnds(this->Sides[i]);
    const double pieces = std::min(
      std::max(std::ceil(lengths[i] / (LengthsPerPiece * this->TypicalLength)), 1.0), MostPieces);
    for (double piece = 0.0; piece < pieces; ++piece)
    {
      sides.push_back(
        MakeBox(Interpolate(this->Soup.Points[from], this->Soup.Points[to], piece / pieces),
          Interpolate(this->Soup.Points[from], this->Soup.Points[to], (piece + 1.0) / pieces),
          this->Tolerance, this->Sides[i]));
    }
  }
  std::vector<Box> points;
  for (const std::size_t point : this->Points)
  {
    points.push_back(MakeBox(this->Soup.Points[point], this->Soup.Points[point], 0.0, point));
  }
  std::size_t pairs = 0;
  bool isAborted = false;
  const std::size_t pairsPerReport = 10000;
  const auto look = [&](const Box& point, const Box& side)
  {
    isAborted = ++pairs % pairsPerReport == 0 && !monitor.Report(0.5);
    if (isAborted || pairs > MostPairs)
    {
      throw Stop();
    }
    this->Look(point.info(), side.info());
  };
  try
  {
    CGAL::box_intersection_d(points.begin(), points.end(), sides.begin(), sides.end(), look);
  }
  catch (const Stop&)
  {
    return isAborted
      ? Outcome::Aborted()
      : Outcome::Failed("Too many border points are near each other to be welded: give a smaller "
                        "WeldTolerance, or reduce the surface first.");
  }
  return monitor.Check(1.0);
}

//------------------------------------------------------------------------------
double NearSides::FindLargestGap() const
{
  double largest = 0.0;
  for (const auto& [distance, point, other] : this->Pairs)
  {
    largest = std::max(largest, distance);
  }
  for (const auto& [side, point, along] : this->Corners)
  {
    // What misses the end of a side by less is not meant to lie on it.
    const double leastPart = 1e-5;
    if (const double part = std::min(along, 1.0 - along); part < leastPart)
    {
      const auto [from, to] = this->Joiner.GetEnds(side);
      largest =
        std::max(largest, part * GetDistance(this->Soup.Points[from], this->Soup.Points[to]));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
// How far from a side a point may be to be on it.
double NearSides::GetReach(std::size_t point, std::size_t side) const
{
  const auto [from, to] = this->Joiner.GetEnds(side);
  const double length = GetDistance(this->Soup.Points[from], this->Soup.Points[to]);
  return std::min(this->Tolerance, LargestPart * std::min(this->Shortest[point], length));
}

//------------------------------------------------------------------------------
void NearSides::Look(std::size_t point, std::size_t side)
{
  const auto ends = this->Joiner.GetEnds(side);
  const std::size_t place = this->Places[point];
  for (const std::size_t corner : this->Soup.Triangles[side / 3])
  {
    if (this->Places[corner] == place)
    {
      return;
    }
  }
  const Point& position = this->Soup.Points[point];
  const double reach = this->GetReach(point, side);
  for (const std::size_t end : ends)
  {
    const double distance = GetDistance(position, this->Soup.Points[end]);
    if (distance <= reach)
    {
      this->Pairs.emplace_back(distance, std::min(point, end), std::max(point, end));
      return;
    }
  }
  Point along;
  Point offset;
  vtkMath::Subtract(this->Soup.Points[ends[1]].data(), this->Soup.Points[ends[0]].data(),
    along.data());
  vtkMath::Subtract(position.data(), this->Soup.Points[ends[0]].data(), offset.data());
  const double t =
    vtkMath::Dot(along.data(), offset.data()) / vtkMath::Dot(along.data(), along.data());
  const Point on = Interpolate(this->Soup.Points[ends[0]], this->Soup.Points[ends[1]], t);
  if (t > 0.0 && t < 1.0 && GetDistance(position, on) <= reach)
  {
    this->Corners.emplace_back(side, point, t);
  }
}

//------------------------------------------------------------------------------
// Of each place that may be welded, sorted.
std::vector<std::vector<std::size_t>> NearSides::FindTriangles() const
{
  std::vector<bool> wanted(this->Places.size(), false);
  for (const auto& [distance, point, other] : this->Pairs)
  {
    wanted[this->Places[point]] = wanted[this->Places[other]] = true;
  }
  std::vector<std::vector<std::size_t>> triangles(this->Places.size());
  for (std::size_t triangle = 0; triangle < this->Soup.Triangles.size(); ++triangle)
  {
    for (const std::size_t corner : this->Soup.Triangles[triangle])
    {
      if (wanted[this->Places[corner]])
      {
        triangles[this->Places[corner]].push_back(triangle);
      }
    }
  }
  return triangles;
}

//------------------------------------------------------------------------------
bool NearSides::Weld()
{
  if (this->Pairs.empty())
  {
    return false;
  }
  std::sort(this->Pairs.begin(), this->Pairs.end());
  this->Pairs.erase(std::unique(this->Pairs.begin(), this->Pairs.end()), this->Pairs.end());
  std::vector<std::vector<std::size_t>> triangles = this->FindTriangles();
  std::map<std::size_t, std::size_t> welded;
  const auto find = [&welded](std::size_t place)
  {
    for (auto next = welded.find(place); next != welded.end(); next = welded.find(place))
    {
      place = next->second;
    }
    return place;
  };
  for (const auto& [distance, point, other] : this->Pairs)
  {
    const auto [to, from] = std::minmax({ find(this->Places[point]), find(this->Places[other]) });
    std::vector<std::size_t> all;
    std::merge(triangles[to].begin(), triangles[to].end(), triangles[from].begin(),
      triangles[from].end(), std::back_inserter(all));
    // Corners of one triangle stay apart.
    if (to != from && std::adjacent_find(all.begin(), all.end()) == all.end())
    {
      triangles[to] = std::move(all);
      triangles[from].clear();
      welded[from] = to;
    }
  }
  for (std::size_t& place : this->Places)
  {
    place = find(place);
  }
  return !welded.empty();
}

//------------------------------------------------------------------------------
struct NearSides::Incidence
{
  /// Of a side and a place on it, how far along.
  std::map<std::pair<std::size_t, std::size_t>, double> Corners;
  /// Of a place, a side and its point there.
  std::map<std::size_t, std::vector<std::pair<std::size_t, std::size_t>>> Sides;
};

//------------------------------------------------------------------------------
// Whether a side has both ends on another, or one of them and an end of the other on it.
bool NearSides::RunsAlong(const Incidence& incidence, std::size_t side, std::size_t other) const
{
  const auto count = [&](std::size_t on, std::size_t of)
  {
    const auto [from, to] = this->Joiner.GetEnds(on);
    int number = 0;
    for (const std::size_t end : this->Joiner.GetEnds(of))
    {
      const std::size_t place = this->Places[end];
      number += this->Places[from] == place || this->Places[to] == place ||
        incidence.Corners.count({ on, place }) != 0;
    }
    return number;
  };
  const auto [from, to] = this->Joiner.GetEnds(side);
  const auto [otherFrom, otherTo] = this->Joiner.GetEnds(other);
  const int common = (this->Places[from] == this->Places[otherFrom]) +
    (this->Places[from] == this->Places[otherTo]) + (this->Places[to] == this->Places[otherFrom]) +
    (this->Places[to] == this->Places[otherTo]);
  return side / 3 != other / 3 && count(side, other) + count(other, side) - common > 1 &&
    !this->Joiner.IsFold(side, other);
}

//------------------------------------------------------------------------------
std::map<std::size_t, std::vector<std::size_t>> NearSides::FindSplits() const
{
  Incidence incidence;
  for (const auto& [side, point, along] : this->Corners)
  {
    const auto [from, to] = this->Joiner.GetEnds(side);
    const std::size_t place = this->Places[point];
    if (this->Joiner.GetPartner(side) == SideJoiner::None && place != this->Places[from] &&
      place != this->Places[to])
    {
      incidence.Corners.emplace(std::make_pair(side, place), along);
      incidence.Sides[place];
    }
  }
  for (const std::size_t side : this->Sides)
  {
    for (const std::size_t end : this->Joiner.GetEnds(side))
    {
      if (this->Joiner.GetPartner(side) != SideJoiner::None)
      {
        break;
      }
      const auto found = incidence.Sides.find(this->Places[end]);
      if (found != incidence.Sides.end())
      {
        found->second.emplace_back(side, end);
      }
    }
  }
  std::map<std::size_t, std::vector<std::pair<double, std::size_t>>> found;
  for (const auto& [corner, along] : incidence.Corners)
  {
    for (const auto& [other, point] : incidence.Sides[corner.second])
    {
      if (this->RunsAlong(incidence, corner.first, other))
      {
        found[corner.first].emplace_back(along, point);
        break;
      }
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> splits;
  for (auto& [side, corners] : found)
  {
    std::sort(corners.begin(), corners.end());
    std::vector<std::size_t>& points = splits[side];
    std::transform(corners.begin(), corners.end(), std::back_inserter(points),
      [](const std::pair<double, std::size_t>& corner) { return corner.second; });
  }
  return splits;
}
} // namespace LightTransport
