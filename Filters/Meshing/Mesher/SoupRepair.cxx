// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SoupRepair.h"

#include "Common/SoupEdges.h"
#include "Shared/DisjointSets.h"

#include "vtkMath.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace LightTransport
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Edge = SoupEdges::Edge;
using Triangle = TriangleSoup::Triangle;

//------------------------------------------------------------------------------
// Writes down what orient_polygon_soup does.
struct OrientationRecord : public PMP::Default_orientation_visitor
{
  std::vector<bool>* Reversed = nullptr;
  std::vector<vtkIdType>* PointIds = nullptr;
  std::vector<bool>* SplitPoints = nullptr;

  void polygon_orientation_reversed(std::size_t triangle)
  {
    (*this->Reversed)[triangle] = !(*this->Reversed)[triangle];
  }
  void duplicated_vertex(std::size_t point, std::size_t)
  {
    const vtkIdType id = (*this->PointIds)[point];
    this->PointIds->push_back(id);
    this->SplitPoints->push_back((*this->SplitPoints)[point]);
  }
};
} // namespace

//------------------------------------------------------------------------------
SoupRepair::SoupRepair(TriangleSoup& soup, RepairCounts& counts) : Soup(soup), Counts(counts) {}

//------------------------------------------------------------------------------
void SoupRepair::DropDegenerateTriangles()
{
  this->Counts.NumberOfDroppedTriangles +=
    std::count_if(this->Soup.Triangles.begin(), this->Soup.Triangles.end(),
      [this](const Triangle& triangle) { return this->Soup.IsDegenerate(triangle); });
  // Needles can hang on needles, so one pass may make new ones; the points on a line are soon used
  // up, and what is left after many passes is dropped as it is.
  const int manyPasses = 100;
  for (int pass = 0; pass < manyPasses && this->SplitNeighboursOfDegenerateTriangles(); ++pass)
  {
  }
  std::vector<bool> kept(this->Soup.Triangles.size());
  std::transform(this->Soup.Triangles.begin(), this->Soup.Triangles.end(), kept.begin(),
    [this](const Triangle& triangle) { return !this->Soup.IsDegenerate(triangle); });
  this->Keep(kept);
}

//------------------------------------------------------------------------------
// A triangle whose points lie on one line cannot simply go: its neighbour across the longest side
// would lose its own, and a closed surface would be open. So that neighbour is split at the third
// point, which then lies between the others anyway. Drops the degenerate triangles that were seen;
// returns whether others came up.
bool SoupRepair::SplitNeighboursOfDegenerateTriangles()
{
  std::map<Edge, std::size_t> splits;
  std::vector<bool> kept(this->Soup.Triangles.size(), true);
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    const Triangle& t = this->Soup.Triangles[i];
    if (!this->Soup.IsDegenerate(t))
    {
      continue;
    }
    if (TriangleSoup::HasRepeatedPoint(t))
    {
      kept[i] = false;
      continue;
    }
    std::array<double, 3> lengths;
    for (int j = 0; j < 3; ++j)
    {
      lengths[j] = vtkMath::Distance2BetweenPoints(this->Soup.Points[t[j]].data(),
        this->Soup.Points[t[(j + 1) % 3]].data());
    }
    const auto j = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
    kept[i] = !splits.emplace(SoupEdges::Make(t[j], t[(j + 1) % 3]), t[(j + 2) % 3]).second;
  }
  if (splits.empty())
  {
    return false;
  }

  bool again = false;
  const std::size_t size = this->Soup.Triangles.size();
  for (std::size_t i = 0; i < size; ++i)
  {
    if (!kept[i])
    {
      continue;
    }
    for (int j = 0; j < 3; ++j)
    {
      const Triangle t = this->Soup.Triangles[i];
      const auto split = splits.find(SoupEdges::Make(t[j], t[(j + 1) % 3]));
      if (split != splits.end() && split->second != t[(j + 2) % 3])
      {
        this->Soup.Triangles[i][(j + 1) % 3] = split->second;
        this->Soup.Triangles.push_back({ split->second, t[(j + 1) % 3], t[(j + 2) % 3] });
        this->Soup.CellIds.push_back(this->Soup.CellIds[i]);
        kept.push_back(true);
        break;
      }
    }
    again = again || this->Soup.IsDegenerate(this->Soup.Triangles[i]);
  }
  this->Keep(kept);
  return again ||
    std::any_of(this->Soup.Triangles.begin(), this->Soup.Triangles.end(),
      [this](const Triangle& triangle) { return this->Soup.IsDegenerate(triangle); });
}

//------------------------------------------------------------------------------
void SoupRepair::DropDuplicateTriangles()
{
  const std::vector<bool> kept = this->Soup.FindFirstOfDuplicates();
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    for (const std::size_t corner : this->Soup.Triangles[i])
    {
      this->Soup.SplitPoints[corner] = this->Soup.SplitPoints[corner] || !kept[i];
    }
  }
  this->Counts.NumberOfDroppedTriangles += std::count(kept.begin(), kept.end(), false);
  this->Keep(kept);
}

//------------------------------------------------------------------------------
void SoupRepair::Orient()
{
  if (PMP::is_polygon_soup_a_polygon_mesh(this->Soup.Triangles))
  {
    return;
  }
  std::vector<bool> reversed(this->Soup.Triangles.size(), false);
  OrientationRecord record;
  record.Reversed = &reversed;
  record.PointIds = &this->Soup.PointIds;
  record.SplitPoints = &this->Soup.SplitPoints;
  this->MarkEdgesToSplit();
  const std::size_t size = this->Soup.Points.size();
  PMP::orient_polygon_soup(this->Soup.Points, this->Soup.Triangles,
    CGAL::parameters::visitor(record));
  this->Counts.NumberOfSplitPoints += static_cast<vtkIdType>(this->Soup.Points.size() - size);
  this->TurnComponentsToMajority(reversed);
}

//------------------------------------------------------------------------------
void SoupRepair::MarkEdgesToSplit()
{
  SoupEdges::ForEach(this->Soup.Triangles,
    [this](const Edge& edge, int forward, int backward)
    {
      if (forward + backward > 2)
      {
        this->Soup.SplitPoints[edge.first] = true;
        this->Soup.SplitPoints[edge.second] = true;
      }
    });
}

//------------------------------------------------------------------------------
// Orienting starts at an arbitrary triangle, which may be the only wrong one.
void SoupRepair::TurnComponentsToMajority(const std::vector<bool>& reversed)
{
  DisjointSets components(this->Soup.Points.size());
  for (const Triangle& triangle : this->Soup.Triangles)
  {
    components.Join(triangle[0], triangle[1]);
    components.Join(triangle[0], triangle[2]);
  }
  std::map<std::size_t, double> balance;
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    const double area = vtkMath::Norm(this->Soup.GetNormal(this->Soup.Triangles[i]).data());
    balance[components.Find(this->Soup.Triangles[i][0])] += reversed[i] ? -area : area;
  }
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    const bool turn = balance[components.Find(this->Soup.Triangles[i][0])] < 0.0;
    if (turn)
    {
      std::swap(this->Soup.Triangles[i][1], this->Soup.Triangles[i][2]);
    }
    this->Counts.NumberOfReversedTriangles += turn != reversed[i];
  }
}

//------------------------------------------------------------------------------
void SoupRepair::Keep(const std::vector<bool>& kept)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    if (kept[i])
    {
      this->Soup.Triangles[next] = this->Soup.Triangles[i];
      this->Soup.CellIds[next] = this->Soup.CellIds[i];
      ++next;
    }
  }
  this->Soup.Triangles.resize(next);
  this->Soup.CellIds.resize(next);
}
} // namespace LightTransport
