// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/ChartDisc.h"

#include "Shared/DisjointSets.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
ChartDisc::ChartDisc(const AtlasSurface& surface, const std::vector<int>& faces,
  const std::vector<int>& owners, std::vector<int>& local, const Watch& watch)
  : Surface(surface), Faces(faces), Neighbors(surface.GetNeighborsWithin(faces, owners, local))
{
  watch.Check();
  this->UncutNeighbors = this->Neighbors;
  this->NumberPoints();
}

//------------------------------------------------------------------------------
// The edge of the neighbour across an edge: two triangles of a manifold that is no bag of two faces
// share one edge, and where they share more its ends tell.
int ChartDisc::GetOppositeEdge(int face, int edge) const
{
  const TriangleSoup::Triangle& a = this->Surface.Triangles[this->Faces[face]];
  const TriangleSoup::Triangle& b =
    this->Surface.Triangles[this->Faces[this->UncutNeighbors[face][edge]]];
  int opposite = 0;
  while (b[opposite] != a[(edge + 1) % 3] || b[(opposite + 1) % 3] != a[edge])
  {
    ++opposite;
  }
  return opposite;
}

//------------------------------------------------------------------------------
// Corners that meet across edges that are not cut are one point.
void ChartDisc::NumberPoints()
{
  const std::size_t size = this->Faces.size();
  DisjointSets corners(3 * size);
  DisjointSets components(size);
  int sides = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->Neighbors[i][edge];
      if (neighbor >= 0)
      {
        ++sides;
        const int opposite = this->GetOppositeEdge(static_cast<int>(i), edge);
        corners.Join(3 * i + edge, 3 * std::size_t(neighbor) + (opposite + 1) % 3);
        corners.Join(3 * i + (edge + 1) % 3, 3 * std::size_t(neighbor) + opposite);
        components.Join(i, neighbor);
      }
    }
  }
  const std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> numbers(3 * size, none);
  this->Points.clear();
  this->Corners.resize(size);
  this->NumberOfComponents = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    this->NumberOfComponents += components.Find(i) == i;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      std::size_t& number = numbers[corners.Find(3 * i + corner)];
      if (number == none)
      {
        number = this->Points.size();
        this->Points.push_back(this->Surface.Triangles[this->Faces[i]][corner]);
      }
      this->Corners[i][corner] = number;
    }
  }
  const int faces = static_cast<int>(size);
  this->NumberOfBorderEdges = 3 * faces - sides;
  this->EulerCharacteristic =
    static_cast<int>(this->Points.size()) - (3 * faces - sides / 2) + faces;
}

//------------------------------------------------------------------------------
void ChartDisc::Slit()
{
  this->CutAllButTree();
  this->JoinDanglingCuts();
  this->NumberPoints();
}

//------------------------------------------------------------------------------
std::vector<bool> ChartDisc::FindBorderPoints(
  const std::vector<std::array<int, 3>>& neighbors) const
{
  std::vector<bool> onBorder(this->Points.size(), false);
  for (std::size_t face = 0; face < this->Faces.size(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      if (neighbors[face][edge] < 0)
      {
        onBorder[this->Corners[face][edge]] = true;
        onBorder[this->Corners[face][(edge + 1) % 3]] = true;
      }
    }
  }
  return onBorder;
}

//------------------------------------------------------------------------------
void ChartDisc::SlitOneEdge()
{
  const std::vector<bool> onBorder = this->FindBorderPoints(this->Neighbors);
  for (std::size_t face = 0; face < this->Faces.size(); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      if (onBorder[this->Corners[face][edge]] && !onBorder[this->Corners[face][(edge + 1) % 3]])
      {
        const int opposite = this->GetOppositeEdge(static_cast<int>(face), edge);
        this->Neighbors[this->Neighbors[face][edge]][opposite] = -1;
        this->Neighbors[face][edge] = -1;
        this->NumberPoints();
        return;
      }
    }
  }
}

//------------------------------------------------------------------------------
// All faces, those with most edges between them and the border first.
std::vector<int> ChartDisc::FindFacesFromInside() const
{
  std::vector<int> order;
  std::vector<bool> known(this->Faces.size(), false);
  const auto visit = [&](int face)
  {
    if (!known[face])
    {
      known[face] = true;
      order.push_back(face);
    }
  };
  for (int face = 0; face < static_cast<int>(this->Faces.size()); ++face)
  {
    const std::array<int, 3>& neighbors = this->UncutNeighbors[face];
    if (*std::min_element(neighbors.begin(), neighbors.end()) < 0)
    {
      visit(face);
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (const int neighbor : this->UncutNeighbors[order[i]])
    {
      if (neighbor >= 0)
      {
        visit(neighbor);
      }
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

//------------------------------------------------------------------------------
// A tree from the innermost face outwards: its branches meet, and leave cuts, beyond holes and
// handles.
void ChartDisc::CutAllButTree()
{
  this->Neighbors.assign(this->Faces.size(), { -1, -1, -1 });
  std::vector<bool> known(this->Faces.size(), false);
  std::vector<int> order(1, this->FindFacesFromInside().front());
  known[order.front()] = true;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const int face = order[i];
    for (int edge = 0; edge < 3; ++edge)
    {
      const int neighbor = this->UncutNeighbors[face][edge];
      if (neighbor >= 0 && !known[neighbor])
      {
        known[neighbor] = true;
        order.push_back(neighbor);
        this->Neighbors[face][edge] = neighbor;
        this->Neighbors[neighbor][this->GetOppositeEdge(face, edge)] = face;
      }
    }
  }
}

//------------------------------------------------------------------------------
void ChartDisc::JoinDanglingCuts()
{
  struct Side
  {
    int Face;
    int Edge;
  };
  const std::vector<bool> onBorder = this->FindBorderPoints(this->UncutNeighbors);
  std::vector<std::vector<Side>> cuts(this->Points.size());
  for (int face = 0; face < static_cast<int>(this->Faces.size()); ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::size_t ends[2] = { this->Corners[face][edge],
        this->Corners[face][(edge + 1) % 3] };
      const int neighbor = this->UncutNeighbors[face][edge];
      for (const std::size_t end : ends)
      {
        if (neighbor > face && this->Neighbors[face][edge] < 0)
        {
          cuts[end].push_back({ face, edge });
        }
      }
    }
  }
  const auto isCut = [this](const Side& side) { return this->Neighbors[side.Face][side.Edge] < 0; };
  std::vector<std::size_t> queue(this->Points.size());
  std::iota(queue.begin(), queue.end(), 0);
  while (!queue.empty())
  {
    const std::size_t point = queue.back();
    queue.pop_back();
    if (onBorder[point] || std::count_if(cuts[point].begin(), cuts[point].end(), isCut) != 1)
    {
      continue;
    }
    const Side side = *std::find_if(cuts[point].begin(), cuts[point].end(), isCut);
    const int neighbor = this->UncutNeighbors[side.Face][side.Edge];
    this->Neighbors[side.Face][side.Edge] = neighbor;
    this->Neighbors[neighbor][this->GetOppositeEdge(side.Face, side.Edge)] = side.Face;
    queue.push_back(this->Corners[side.Face][side.Edge]);
    queue.push_back(this->Corners[side.Face][(side.Edge + 1) % 3]);
  }
}

//------------------------------------------------------------------------------
SquareMap::Disc ChartDisc::GetDisc() const
{
  SquareMap::Disc disc;
  for (const std::size_t point : this->Points)
  {
    disc.Points.push_back(this->Surface.Points[point]);
  }
  disc.Triangles = this->Corners;
  disc.Sources.resize(this->Faces.size());
  std::iota(disc.Sources.begin(), disc.Sources.end(), 0);
  return disc;
}
} // namespace LightTransport
