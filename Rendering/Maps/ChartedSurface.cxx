// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/ChartedSurface.h"

#include "Shared/ArrayNames.h"
#include "Shared/BitHash.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace LightTransport
{
namespace
{
/// What rounding may move the border of a chart by, as a part of its size.
constexpr double Rounding = 1e-4;
/// The smallest chart is one texel of the largest map.
constexpr int MostLevels = 15;
} // namespace

/// The square block of a chart.
struct ChartedSurface::Chart
{
  double Low[2] = { 1.0, 1.0 };
  double High[2] = { 0.0, 0.0 };
  double Size = 1.0;

  void Add(const double place[2]);
  /// False where what has been added does not fill a node of the quadtree.
  bool Round();
};

/// What is read of a surface.
struct ChartedSurface::Source
{
  vtkPolyData* Surface;
  vtkDataArray* Places;
  vtkDataArray* Charts; ///< nullptr for a single one
  vtkIdType FirstCell;

  int GetChart(vtkIdType triangle) const
  {
    return this->Charts
      ? static_cast<int>(this->Charts->GetComponent(this->FirstCell + triangle, 0))
      : 0;
  }

  template <typename Visit>
  void VisitTriangles(const Visit& visit) const
  {
    vtkCellArray* polygons = this->Surface->GetPolys();
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    for (vtkIdType triangle = 0; triangle < polygons->GetNumberOfCells(); ++triangle)
    {
      polygons->GetCellAtId(triangle, count, corners);
      visit(triangle, count, corners);
    }
  }
};

//------------------------------------------------------------------------------
void ChartedSurface::Chart::Add(const double place[2])
{
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Low[axis] = std::min(this->Low[axis], place[axis]);
    this->High[axis] = std::max(this->High[axis], place[axis]);
  }
}

//------------------------------------------------------------------------------
bool ChartedSurface::Chart::Round()
{
  const double extent = std::max(this->High[0] - this->Low[0], this->High[1] - this->Low[1]);
  const double level = extent > 0.0 ? std::round(-std::log2(extent)) : MostLevels + 1.0;
  this->Size = std::exp2(-level);
  const double allowed = Rounding * this->Size;
  bool good = level <= MostLevels;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double low = this->Size * std::round(this->Low[axis] / this->Size);
    good = good && std::abs(this->Low[axis] - low) <= allowed &&
      std::abs(this->High[axis] - low - this->Size) <= allowed;
    this->Low[axis] = low;
  }
  return good;
}

//------------------------------------------------------------------------------
std::uint64_t ChartedSurface::GetStamp(vtkPolyData* surface)
{
  BitHash hash;
  hash.AddObjects({ surface->GetPoints(), surface->GetPolys(),
    surface->GetPointData()->GetArray(ArrayNames::AtlasCoordinates),
    surface->GetCellData()->GetArray(ArrayNames::ChartId) });
  return hash.Get();
}

//------------------------------------------------------------------------------
Outcome ChartedSurface::FindArrays(Source& source)
{
  vtkPolyData* surface = source.Surface;
  source.Places = surface->GetPointData()->GetArray(ArrayNames::AtlasCoordinates);
  source.Charts = surface->GetCellData()->GetArray(ArrayNames::ChartId);
  source.FirstCell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  if (surface->GetNumberOfPolys() == 0)
  {
    return Outcome::Failed("The surface has no triangles: give one that vtkSurfaceAtlas made.");
  }
  if (!source.Places || source.Places->GetNumberOfComponents() != 2 ||
    source.Places->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    return Outcome::Failed("The surface has no point array \"AtlasCoordinates\" of 2 components: "
                           "use vtkSurfaceAtlas.");
  }
  if (source.Charts &&
    (source.Charts->GetNumberOfComponents() != 1 ||
      source.Charts->GetNumberOfTuples() != surface->GetNumberOfCells()))
  {
    return Outcome::Failed("The cell array \"ChartId\" must have 1 component and a value for each "
                           "cell: use vtkSurfaceAtlas.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome ChartedSurface::FindBlocks(const Source& source, std::vector<Chart>& charts,
  std::vector<int>& chartOfPoint)
{
  std::map<int, int> numbers;
  chartOfPoint.assign(static_cast<std::size_t>(source.Surface->GetNumberOfPoints()), -1);
  std::string problem;
  source.VisitTriangles(
    [&](vtkIdType triangle, vtkIdType count, const vtkIdType* corners)
    {
      const int chart =
        numbers.emplace(source.GetChart(triangle), static_cast<int>(numbers.size())).first->second;
      charts.resize(numbers.size());
      for (vtkIdType corner = 0; corner < count; ++corner)
      {
        int& known = chartOfPoint[static_cast<std::size_t>(corners[corner])];
        if (known >= 0 && known != chart)
        {
          problem = "Point " + std::to_string(corners[corner]) + " belongs to two charts";
        }
        known = chart;
        double place[2];
        source.Places->GetTuple(corners[corner], place);
        charts[static_cast<std::size_t>(chart)].Add(place);
      }
      if (count != 3)
      {
        problem = "Cell " + std::to_string(source.FirstCell + triangle) + " is no triangle";
      }
    });
  if (!source.Charts)
  {
    charts[0] = Chart{ { 0.0, 0.0 }, { 1.0, 1.0 }, 1.0 };
  }
  for (const auto& number : numbers)
  {
    if (!charts[static_cast<std::size_t>(number.second)].Round())
    {
      problem = "Chart " + std::to_string(number.first) + " does not fill a square of the atlas";
    }
  }
  return problem.empty() ? Outcome::Done() : Outcome::Failed(problem + ": use vtkSurfaceAtlas.");
}

//------------------------------------------------------------------------------
Outcome ChartedSurface::AddCorners(const Source& source)
{
  this->Corners.reserve(
    static_cast<std::size_t>(3 * FloatsPerCorner * source.Surface->GetNumberOfPolys()));
  bool good = true;
  source.VisitTriangles(
    [&](vtkIdType triangle, vtkIdType, const vtkIdType* corners)
    {
      double points[3][3];
      double places[3][2];
      for (int corner = 0; corner < 3; ++corner)
      {
        source.Surface->GetPoint(corners[corner], points[corner]);
        source.Places->GetTuple(corners[corner], places[corner]);
        vtkMath::Subtract(points[corner], this->Center.data(), points[corner]);
      }
      double sides[2][3];
      double normal[3];
      vtkMath::Subtract(points[1], points[0], sides[0]);
      vtkMath::Subtract(points[2], points[0], sides[1]);
      vtkMath::Cross(sides[0], sides[1], normal);
      const double area = vtkMath::Normalize(normal);
      const double onAtlas = (places[1][0] - places[0][0]) * (places[2][1] - places[0][1]) -
        (places[1][1] - places[0][1]) * (places[2][0] - places[0][0]);
      good = good && std::isfinite(area) && std::isfinite(onAtlas);
      this->Area += 0.5 * area;
      // Flattened triangles have no texel.
      const double share = onAtlas > 0.0 ? area / onAtlas : 0.0;
      for (int corner = 0; corner < 3; ++corner)
      {
        for (const double value :
          { points[corner][0], points[corner][1], points[corner][2], normal[0], normal[1],
            normal[2], places[corner][0], places[corner][1], share,
            static_cast<double>(source.GetChart(triangle)), static_cast<double>(corners[corner]) })
        {
          this->Corners.push_back(static_cast<float>(value));
        }
      }
    });
  if (!good || !(this->Area > 0.0))
  {
    return Outcome::Failed("The surface has points or \"AtlasCoordinates\" that are not finite, or "
                           "no area: correct them.");
  }
  for (std::size_t share = 8; share < this->Corners.size(); share += FloatsPerCorner)
  {
    this->Corners[share] = static_cast<float>(this->Corners[share] / this->Area);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void ChartedSurface::AddPoints(const Source& source, const std::vector<Chart>& charts,
  const std::vector<int>& chartOfPoint)
{
  this->Points.assign(8 * chartOfPoint.size(), 0.0f);
  for (std::size_t point = 0; point < chartOfPoint.size(); ++point)
  {
    if (chartOfPoint[point] >= 0)
    {
      const Chart& chart = charts[static_cast<std::size_t>(chartOfPoint[point])];
      float* texels = &this->Points[8 * point];
      for (int axis = 0; axis < 2; ++axis)
      {
        texels[axis] =
          static_cast<float>(source.Places->GetComponent(static_cast<vtkIdType>(point), axis));
        texels[4 + axis] = static_cast<float>(chart.Low[axis]);
      }
      texels[6] = static_cast<float>(chart.Size);
    }
  }
}

//------------------------------------------------------------------------------
std::uint64_t ChartedSurface::GetHash() const
{
  BitHash hash;
  for (const float number : this->Corners)
  {
    hash.AddNumber(number);
  }
  for (const double number : this->Center)
  {
    hash.AddNumber(number);
  }
  return hash.Get();
}

//------------------------------------------------------------------------------
Outcome ChartedSurface::Read(vtkPolyData* surface)
{
  *this = ChartedSurface();
  Source source{ surface, nullptr, nullptr, 0 };
  if (Outcome found = FindArrays(source); !found)
  {
    return found;
  }
  std::vector<Chart> charts;
  std::vector<int> chartOfPoint;
  if (Outcome found = FindBlocks(source, charts, chartOfPoint); !found)
  {
    return found;
  }
  for (const Chart& chart : charts)
  {
    this->SmallestMap =
      std::max(this->SmallestMap, static_cast<int>(std::lround(1.0 / chart.Size)));
  }
  surface->ComputeBounds();
  surface->GetCenter(this->Center.data());
  this->AddPoints(source, charts, chartOfPoint);
  return this->AddCorners(source);
}
} // namespace LightTransport
