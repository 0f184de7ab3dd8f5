// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/TriangleSoup.h"

#include "Common/CoordinateRounding.h"
#include "Common/PolygonTriangles.h"
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
#include <limits>
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
struct PointHash
{
  std::size_t operator()(const TriangleSoup::Point& point) const
  {
    std::size_t hash = 0;
    for (const double value : point)
    {
      // std::hash knows that -0 equals 0.
      hash = hash * 0x9E3779B97F4A7C15ULL + std::hash<double>()(value);
    }
    return hash;
  }
};
using IndexOfPoint = std::unordered_map<TriangleSoup::Point, std::size_t, PointHash>;

//------------------------------------------------------------------------------
// Cuts the faces of a vtkPolyData into triangles and gives points that are one an index.
class SoupReader
{
public:
  SoupReader(vtkPolyData* input, TriangleSoup& soup, bool mergePoints, const Monitor& monitor)
    : Input(input), Soup(soup), MergesPoints(mergePoints), Watcher(monitor)
  {
    this->Indices.assign(input->GetNumberOfPoints(), None);
    this->Ghosts = vtkUnsignedCharArray::SafeDownCast(
      input->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
    if (this->Ghosts && this->Ghosts->GetNumberOfTuples() < input->GetNumberOfCells())
    {
      this->Ghosts = nullptr;
    }
  }

  bool ReadPolygons(vtkIdType firstCell)
  {
    return this->ForEachCell(this->Input->GetPolys(), firstCell,
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

  bool ReadStrips(vtkIdType firstCell)
  {
    return this->ForEachCell(this->Input->GetStrips(), firstCell,
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
  // False when it was aborted.
  template <typename Function>
  bool ForEachCell(vtkCellArray* cells, vtkIdType cell, const Function& function)
  {
    const int ignored = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    const vtkIdType cellsPerReport = 10000;
    const double total = static_cast<double>(this->Input->GetNumberOfCells());
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
      if (++cell % cellsPerReport == 0 && !this->Watcher.Report(static_cast<double>(cell) / total))
      {
        return false;
      }
    }
    return true;
  }

  void AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* ids)
  {
    this->Corners.resize(size);
    for (vtkIdType i = 0; i < size; ++i)
    {
      this->Input->GetPoint(ids[i], this->Corners[i].data());
    }
    // Cutting ears off is for simple shapes; where that goes wrong nobody is told.
    const vtkIdType manyCorners = 1000;
    const bool done = size <= manyCorners && this->CutEars(size, ids) &&
      PolygonTriangles::AreRight(this->Corners, this->Pieces);
    if (!done && !PolygonTriangles::Cut(this->Corners, this->Pieces))
    {
      this->Soup.CrossingCells.push_back(cell);
      return;
    }
    for (const TriangleSoup::Triangle& piece : this->Pieces)
    {
      this->Add(cell, ids[piece[0]], ids[piece[1]], ids[piece[2]]);
    }
  }

  bool CutEars(vtkIdType size, const vtkIdType* ids)
  {
    this->Pieces.clear();
    this->Polygon->Initialize(static_cast<int>(size), ids, this->Input->GetPoints());
    // Ids within the polygon: the points of a polygon need not differ.
    std::iota(this->Polygon->PointIds->begin(), this->Polygon->PointIds->end(), 0);
    // All versions of VTK have this call of vtkCell, not all have that of vtkPolygon.
    vtkCell& polygon = *this->Polygon;
    if (polygon.Triangulate(0, this->TriangleIds, this->TrianglePoints) == 0 ||
      this->TriangleIds->GetNumberOfIds() != 3 * (size - 2))
    {
      return false;
    }
    for (vtkIdType i = 0; i < this->TriangleIds->GetNumberOfIds(); i += 3)
    {
      this->Pieces.push_back({ static_cast<std::size_t>(this->TriangleIds->GetId(i)),
        static_cast<std::size_t>(this->TriangleIds->GetId(i + 1)),
        static_cast<std::size_t>(this->TriangleIds->GetId(i + 2)) });
    }
    return true;
  }

  void Add(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
  {
    this->Soup.Triangles.push_back({ this->Merge(a), this->Merge(b), this->Merge(c) });
    this->Soup.CellIds.push_back(cell);
  }

  std::size_t Merge(vtkIdType id)
  {
    std::size_t& index = this->Indices[id];
    if (index == None)
    {
      TriangleSoup::Point point;
      this->Input->GetPoint(id, point.data());
      index = this->MergesPoints
        ? this->Merged.emplace(point, this->Soup.Points.size()).first->second
        : this->Soup.Points.size();
      if (index == this->Soup.Points.size())
      {
        this->Soup.Points.push_back(point);
        this->Soup.PointIds.push_back(id);
        this->Soup.SplitPoints.push_back(false);
      }
    }
    return index;
  }

  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  vtkPolyData* Input;
  TriangleSoup& Soup;
  vtkUnsignedCharArray* Ghosts;
  bool MergesPoints;
  const Monitor& Watcher;
  /// Of the input's points, in the soup.
  std::vector<std::size_t> Indices;
  IndexOfPoint Merged;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> TriangleIds;
  vtkNew<vtkPoints> TrianglePoints;
  std::vector<TriangleSoup::Point> Corners;
  std::vector<TriangleSoup::Triangle> Pieces;
};

// Exact arithmetic on larger numbers ends the process inside GMP, and areas of smaller surfaces
// are 0.
constexpr double LargestSize = 1e40;

//------------------------------------------------------------------------------
Outcome FailForSize(const char* what, double size)
{
  std::ostringstream text;
  text << what << size << ": scale the surface to a size between 1e-40 and 1e40.";
  return Outcome::Failed(text.str());
}

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
  const vtkIdType points = input->GetNumberOfPoints();
  for (vtkIdType i = 0; i < points; ++i)
  {
    double point[3];
    input->GetPoint(i, point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      return Outcome::Failed("The coordinates of point " + std::to_string(i) +
        " are not finite: remove the points whose coordinates are NaN or infinite.");
    }
    const double size = std::max({ std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) });
    if (size > LargestSize)
    {
      return FailForSize("The surface has coordinates as large as ", size);
    }
  }
  for (vtkCellArray* cells : { input->GetPolys(), input->GetStrips() })
  {
    auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      iterator->GetCurrentCell(size, ids);
      if (std::any_of(ids, ids + size, [points](vtkIdType id) { return id < 0 || id >= points; }))
      {
        return Outcome::Failed("The input has polygons with points that do not exist: it is "
                               "broken, make it anew.");
      }
    }
  }
  return Outcome::Done();
}

} // namespace

//------------------------------------------------------------------------------
Outcome TriangleSoup::Read(vtkPolyData* input, bool mergePoints, const Monitor& monitor)
{
  if (Outcome checked = CheckInput(input); !checked)
  {
    return checked;
  }
  SoupReader reader(input, *this, mergePoints, monitor);
  const vtkIdType firstPolygon = input->GetNumberOfVerts() + input->GetNumberOfLines();
  if (!reader.ReadPolygons(firstPolygon) ||
    !reader.ReadStrips(firstPolygon + input->GetNumberOfPolys()))
  {
    return Outcome::Aborted();
  }
  const double diagonal = this->GetDiagonal();
  if (diagonal > 0.0 && diagonal < 1.0 / LargestSize)
  {
    return FailForSize("The surface's bounding box has a diagonal of ", diagonal);
  }
  vtkPoints* points = input->GetPoints();
  this->Rounding =
    CoordinateRounding::Find(this->Points, points && points->GetDataType() == VTK_FLOAT);
  return monitor.Check(1.0);
}

//------------------------------------------------------------------------------
std::vector<std::size_t> TriangleSoup::FindPlaces() const
{
  IndexOfPoint first;
  first.reserve(this->Points.size());
  std::vector<std::size_t> places;
  places.reserve(this->Points.size());
  for (const Point& point : this->Points)
  {
    places.push_back(first.emplace(point, places.size()).first->second);
  }
  return places;
}

//------------------------------------------------------------------------------
std::string TriangleSoup::DescribeDefects() const
{
  const auto degenerate = std::count_if(this->Triangles.begin(), this->Triangles.end(),
    [this](const Triangle& triangle) { return this->IsDegenerate(triangle); });
  std::vector<std::size_t> points(this->Points.size());
  std::iota(points.begin(), points.end(), 0);
  const std::vector<bool> first = this->FindFirstOfDuplicates(points);
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
  describe(this->CrossingCells.size(), "polygons whose border crosses itself");
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
std::vector<bool> TriangleSoup::FindFirstOfDuplicates(const std::vector<std::size_t>& places) const
{
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  sorted.reserve(this->Triangles.size());
  for (const Triangle& triangle : this->Triangles)
  {
    sorted.emplace_back(Triangle{ places[triangle[0]], places[triangle[1]], places[triangle[2]] },
      sorted.size());
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
