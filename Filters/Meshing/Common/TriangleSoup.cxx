// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/TriangleSoup.h"

#include "Common/SoupEdges.h"
#include "Shared/InputArrays.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace LightTransport
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

//------------------------------------------------------------------------------
Kernel::Point_3 ToKernel(const TriangleSoup::Point& point)
{
  return Kernel::Point_3(point[0], point[1], point[2]);
}

//------------------------------------------------------------------------------
// What points have in common that become one: coordinates, and ids where equal points stay apart.
using Key = std::pair<TriangleSoup::Point, vtkIdType>;
struct KeyHash
{
  std::size_t operator()(const Key& key) const
  {
    std::size_t hash = std::hash<vtkIdType>()(key.second);
    for (const double value : key.first)
    {
      // std::hash knows that -0 equals 0.
      hash = hash * 0x9E3779B97F4A7C15ULL + std::hash<double>()(value);
    }
    return hash;
  }
};

//------------------------------------------------------------------------------
// Cuts the faces of a vtkPolyData into triangles and gives points that are one an index.
class SoupReader
{
public:
  SoupReader(vtkPolyData* input, TriangleSoup& soup, bool mergePoints)
    : Input(input), Soup(soup), MergesPoints(mergePoints)
  {
    this->Ghosts = vtkUnsignedCharArray::SafeDownCast(
      input->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  }

  void ReadPolygons(vtkIdType firstCell)
  {
    this->ForEachCell(this->Input->GetPolys(), firstCell,
      [this](vtkIdType cell, vtkIdType size, const vtkIdType* ids)
      {
        if (size == 3)
        {
          this->Add(cell, ids[0], ids[1], ids[2]);
        }
        else if (size > 3)
        {
          this->AddPolygon(cell, size, ids);
        }
      });
  }

  void ReadStrips(vtkIdType firstCell)
  {
    this->ForEachCell(this->Input->GetStrips(), firstCell,
      [this](vtkIdType cell, vtkIdType size, const vtkIdType* ids)
      {
        for (vtkIdType i = 0; i + 2 < size; ++i)
        {
          const vtkIdType odd = i % 2;
          this->Add(cell, ids[i + odd], ids[i + 1 - odd], ids[i + 2]);
        }
      });
  }

private:
  template <typename Function>
  void ForEachCell(vtkCellArray* cells, vtkIdType cell, const Function& function)
  {
    const int ignored = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      if (!this->Ghosts || !(this->Ghosts->GetValue(cell) & ignored))
      {
        vtkIdType size = 0;
        const vtkIdType* ids = nullptr;
        iterator->GetCurrentCell(size, ids);
        function(cell, size, ids);
      }
      ++cell;
    }
  }

  void AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* ids)
  {
    this->Polygon->Initialize(static_cast<int>(size), ids, this->Input->GetPoints());
    // Ids within the polygon: the points of a polygon need not differ.
    std::iota(this->Polygon->PointIds->begin(), this->Polygon->PointIds->end(), 0);
    // All versions of VTK have this call of vtkCell, not all have that of vtkPolygon.
    vtkCell& polygon = *this->Polygon;
    const bool done = polygon.Triangulate(0, this->TriangleIds, this->TrianglePoints) != 0 &&
      this->TriangleIds->GetNumberOfIds() == 3 * (size - 2);
    for (vtkIdType i = 0; i < size - 2; ++i)
    {
      // A polygon that cannot be cut has no area or crosses itself: its fan shows what is wrong.
      const vtkIdType a = done ? this->TriangleIds->GetId(3 * i) : 0;
      const vtkIdType b = done ? this->TriangleIds->GetId(3 * i + 1) : i + 1;
      const vtkIdType c = done ? this->TriangleIds->GetId(3 * i + 2) : i + 2;
      this->Add(cell, ids[a], ids[b], ids[c]);
    }
  }

  void Add(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
  {
    this->Soup.Triangles.push_back({ this->Merge(a), this->Merge(b), this->Merge(c) });
    this->Soup.CellIds.push_back(cell);
  }

  std::size_t Merge(vtkIdType id)
  {
    TriangleSoup::Point point;
    this->Input->GetPoint(id, point.data());
    const Key key{ point, this->MergesPoints ? 0 : id };
    const auto inserted = this->IndexOfPoint.emplace(key, this->Soup.Points.size());
    if (inserted.second)
    {
      this->Soup.Points.push_back(point);
      this->Soup.PointIds.push_back(id);
      this->Soup.SplitPoints.push_back(false);
    }
    return inserted.first->second;
  }

  vtkPolyData* Input;
  TriangleSoup& Soup;
  vtkUnsignedCharArray* Ghosts;
  bool MergesPoints;
  std::unordered_map<Key, std::size_t, KeyHash> IndexOfPoint;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> TriangleIds;
  vtkNew<vtkPoints> TrianglePoints;
};

//------------------------------------------------------------------------------
Outcome CheckInput(vtkPolyData* input)
{
  if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    return Outcome::Failed(input->GetNumberOfCells() == 0
        ? "The input has no cells: give a surface made of polygons."
        : "The input has no polygons, only vertices or lines: give a surface made of polygons.");
  }
  if (Outcome checked = InputArrays::CheckLengths(input); !checked)
  {
    return checked;
  }
  double point[3];
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      return Outcome::Failed("The coordinates of point " + std::to_string(i) +
        " are not finite: remove the points whose coordinates are NaN or infinite.");
    }
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
Outcome TriangleSoup::Read(vtkPolyData* input, bool mergePoints)
{
  if (Outcome checked = CheckInput(input); !checked)
  {
    return checked;
  }
  SoupReader reader(input, *this, mergePoints);
  const vtkIdType firstPolygon = input->GetNumberOfVerts() + input->GetNumberOfLines();
  reader.ReadPolygons(firstPolygon);
  reader.ReadStrips(firstPolygon + input->GetNumberOfPolys());
  return Outcome::Done();
}

//------------------------------------------------------------------------------
std::string TriangleSoup::DescribeDefects() const
{
  const auto degenerate = std::count_if(this->Triangles.begin(), this->Triangles.end(),
    [this](const Triangle& triangle) { return this->IsDegenerate(triangle); });
  const std::vector<bool> first = this->FindFirstOfDuplicates();
  const auto duplicates = std::count(first.begin(), first.end(), false);
  vtkIdType nonManifold = 0;
  vtkIdType opposed = 0;
  SoupEdges::ForEach(this->Triangles,
    [&](const SoupEdges::Edge&, int forward, int backward)
    {
      nonManifold += forward + backward > 2;
      opposed += forward + backward == 2 && forward != backward;
    });

  std::ostringstream text;
  const auto describe = [&text](auto number, const char* what)
  {
    if (number > 0)
    {
      text << (text.tellp() > 0 ? ", " : "") << number << ' ' << what;
    }
  };
  describe(degenerate, "degenerate triangles");
  describe(duplicates, "duplicate triangles");
  describe(nonManifold, "edges with more than two triangles");
  describe(opposed, "edges between triangles of opposite orientation");
  if (text.tellp() <= 0 && !PMP::is_polygon_soup_a_polygon_mesh(this->Triangles))
  {
    text << "points at which parts of the surface only touch";
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::vector<bool> TriangleSoup::FindFirstOfDuplicates() const
{
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  sorted.reserve(this->Triangles.size());
  for (const Triangle& triangle : this->Triangles)
  {
    sorted.emplace_back(triangle, sorted.size());
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> first(this->Triangles.size(), true);
  for (std::size_t i = 1; i < sorted.size(); ++i)
  {
    first[sorted[i].second] = sorted[i].first != sorted[i - 1].first;
  }
  return first;
}

//------------------------------------------------------------------------------
double TriangleSoup::GetDiagonal() const
{
  Point low{ 0.0, 0.0, 0.0 };
  Point high{ 0.0, 0.0, 0.0 };
  bool first = true;
  for (const Triangle& triangle : this->Triangles)
  {
    for (const std::size_t corner : triangle)
    {
      const Point& point = this->Points[corner];
      for (int i = 0; i < 3; ++i)
      {
        low[i] = first ? point[i] : std::min(low[i], point[i]);
        high[i] = first ? point[i] : std::max(high[i], point[i]);
      }
      first = false;
    }
  }
  return std::sqrt(vtkMath::Distance2BetweenPoints(low.data(), high.data()));
}

//------------------------------------------------------------------------------
TriangleSoup::Point TriangleSoup::GetNormal(const Triangle& triangle) const
{
  Point u;
  Point v;
  Point normal;
  vtkMath::Subtract(this->Points[triangle[1]].data(), this->Points[triangle[0]].data(), u.data());
  vtkMath::Subtract(this->Points[triangle[2]].data(), this->Points[triangle[0]].data(), v.data());
  vtkMath::Cross(u.data(), v.data(), normal.data());
  return normal;
}

//------------------------------------------------------------------------------
bool TriangleSoup::HasRepeatedPoint(const Triangle& t)
{
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

//------------------------------------------------------------------------------
bool TriangleSoup::IsDegenerate(const Triangle& triangle) const
{
  return HasRepeatedPoint(triangle) ||
    CGAL::collinear(ToKernel(this->Points[triangle[0]]), ToKernel(this->Points[triangle[1]]),
      ToKernel(this->Points[triangle[2]]));
}

} // namespace LightTransport
