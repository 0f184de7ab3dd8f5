// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/PointDistances.h"

#include "Common/LengthAcross.h"
#include "Shared/DisjointSets.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
PointDistances::PointDistances(const AtlasSurface& surface, const std::vector<int>& faces,
  const std::vector<std::array<int, 3>>& neighbors, const std::vector<std::array<double, 3>>& costs,
  const Watch& watch)
  : Surface(surface), Faces(faces), Watcher(watch)
{
  this->FindSides(neighbors, costs);
  const std::size_t size = this->FirstCorner.size() - 1;
  this->Distances.assign(size, std::numeric_limits<double>::infinity());
  std::vector<int> next(this->FirstCorner.begin(), this->FirstCorner.end() - 1);
  this->CornersOfSides.resize(this->Sides.size());
  for (std::size_t corner = 0; corner < this->Sides.size(); ++corner)
  {
    this->CornersOfSides[next[this->Sides[corner]]++] = static_cast<Corner>(corner);
  }
}

//------------------------------------------------------------------------------
// Corners that meet at edges without a cost are on one side of their point.
void PointDistances::FindSides(const std::vector<std::array<int, 3>>& neighbors,
  const std::vector<std::array<double, 3>>& costs)
{
  DisjointSets sets(3 * this->Faces.size());
  const auto forEachMeeting = [&](const auto& visit)
  {
    for (int face = 0; face < static_cast<int>(neighbors.size()); ++face)
    {
      for (int edge = 0; edge < 3; ++edge)
      {
        const int neighbor = neighbors[face][edge];
        if (neighbor > face)
        {
          const std::array<int, 3>& back = neighbors[neighbor];
          const int other =
            static_cast<int>(std::find(back.begin(), back.end(), face) - back.begin());
          visit(3 * face + edge, 3 * neighbor + (other + 1) % 3, costs[face][edge]);
          visit(3 * face + (edge + 1) % 3, 3 * neighbor + other, costs[face][edge]);
        }
      }
    }
  };
  forEachMeeting(
    [&](Corner a, Corner b, double cost)
    {
      if (!(cost > 0.0))
      {
        sets.Join(a, b);
      }
    });
  std::vector<int> numbers(3 * this->Faces.size(), -1);
  for (std::size_t corner = 0; corner < numbers.size(); ++corner)
  {
    int& number = numbers[sets.Find(corner)];
    if (number < 0)
    {
      number = static_cast<int>(this->FirstCorner.size());
      this->FirstCorner.push_back(0);
    }
    ++this->FirstCorner[number];
    this->Sides.push_back(number);
  }
  this->FirstCorner.insert(this->FirstCorner.begin(), 0);
  std::partial_sum(this->FirstCorner.begin(), this->FirstCorner.end(), this->FirstCorner.begin());
  forEachMeeting(
    [&](Corner a, Corner b, double cost)
    {
      if (this->Sides[a] != this->Sides[b])
      {
        this->Bridges.push_back({ this->Sides[a], this->Sides[b], cost });
        this->Bridges.push_back({ this->Sides[b], this->Sides[a], cost });
      }
    });
  std::stable_sort(this->Bridges.begin(), this->Bridges.end(),
    [](const Bridge& a, const Bridge& b) { return a.From < b.From; });
}

//------------------------------------------------------------------------------
void PointDistances::Reach(int face, double distance)
{
  for (int corner = 0; corner < 3; ++corner)
  {
    const std::size_t point = this->Surface.Triangles[this->Faces[face]][corner];
    const double way =
      (this->Surface.GetPoint(point) - this->Surface.Centers[this->Faces[face]]).norm();
    this->Shorten(this->Sides[3 * face + corner], distance + way);
  }
  while (!this->Queue.empty())
  {
    this->Watcher.Check();
    const Entry entry = this->Queue.top();
    this->Queue.pop();
    if (!(entry.first > this->Distances[entry.second]))
    {
      this->Leave(entry.second);
    }
  }
}

//------------------------------------------------------------------------------
void PointDistances::Shorten(int side, double distance)
{
  // Corners of obtuse faces shorten each other by turns; smaller changes end it.
  const double significant = 1.0 - 1e-4;
  if (distance < significant * this->Distances[side])
  {
    this->Distances[side] = distance;
    this->Queue.emplace(distance, side);
  }
}

//------------------------------------------------------------------------------
void PointDistances::Leave(int side)
{
  for (int i = this->FirstCorner[side]; i < this->FirstCorner[side + 1]; ++i)
  {
    this->CrossFace(this->CornersOfSides[i]);
  }
  for (auto bridge = std::lower_bound(this->Bridges.begin(), this->Bridges.end(), side,
         [](const Bridge&a, int from) { return a.From < from; });
       bridge != this->Bridges.end() && bridge->From == side; ++bridge)
  {
    this->Shorten(bridge->To, this->Distances[side] + bridge->Cost);
  }
}

//------------------------------------------------------------------------------
// From a corner to the two others, with what is known of the third.
void PointDistances::CrossFace(Corner from)
{
  const int face = from / 3;
  const int corner = from % 3;
  const TriangleSoup::Triangle& triangle = this->Surface.Triangles[this->Faces[face]];
  const double distance = this->Distances[this->Sides[from]];
  for (const int step : { 1, 2 })
  {
    const int to = (corner + step) % 3;
    const int third = (corner + 3 - step) % 3;
    const double other = this->Distances[this->Sides[3 * face + third]];
    const bool known = other <= distance;
    this->Shorten(this->Sides[3 * face + to],
      GetLengthAcross(this->Surface.GetPoint(triangle[corner]),
        this->Surface.GetPoint(triangle[known ? third : corner]),
        this->Surface.GetPoint(triangle[to]), distance, known ? other : distance, 1.0));
  }
}

//------------------------------------------------------------------------------
double PointDistances::GetDistance(int face) const
{
  double sum = 0.0;
  for (int corner = 0; corner < 3; ++corner)
  {
    sum += this->Distances[this->Sides[3 * face + corner]];
  }
  return sum / 3.0;
}
} // namespace LightTransport
