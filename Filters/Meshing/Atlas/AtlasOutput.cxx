// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasOutput.h"

#include "Common/Heartbeat.h"
#include "Shared/ArrayNames.h"
#include "Shared/OutputMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <cmath>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  ZeroedArray::Fill(array, tuples);
  return array;
}
} // namespace

//------------------------------------------------------------------------------
class AtlasOutput::SurfaceWriter
{
public:
  SurfaceWriter(const AtlasOutput& parts, vtkPolyData* output);
  void WriteChart(int id, const AtlasQuadtree::Chart& chart, Heartbeat& heart);
  void Finish();

private:
  using Weights = std::map<vtkIdType, double>;
  /// A chart's point, and the input point that it is there for.
  using ChartPoint = std::pair<std::size_t, vtkIdType>;

  void ReservePoints(vtkIdType more);
  std::vector<vtkIdType> FindCorners(const AtlasQuadtree::Chart& chart,
    std::vector<ChartPoint>& points, Heartbeat& heart);
  vtkIdType GetOriginalCell(const AtlasQuadtree::Chart& chart, std::size_t triangle) const;
  vtkIdType GetOriginalPoint(std::size_t point, vtkIdType cell);
  void AddPoint(const AtlasQuadtree::Chart& chart, std::size_t point, vtkIdType original);
  void AddWeights(std::size_t point, double weight, Weights& weights) const;
  void AddWeights(const AtlasQuadtree::Chart& chart, std::size_t point, double weight,
    Weights& weights) const;
  void InterpolatePoint(const Weights& weights, vtkIdType id);

  const AtlasOutput& Parts;
  vtkPolyData* Output;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
  vtkNew<vtkDoubleArray> Coordinates;
  vtkNew<vtkIdTypeArray> OriginalPoints;
  vtkNew<vtkIdTypeArray> OriginalCells;
  vtkNew<vtkIntArray> Charts;
  vtkNew<vtkIdList> CellPoints;
  vtkNew<vtkIdList> Sources;
  double BytesPerPoint;
  vtkIdType RoomForPoints = 0;
};

//------------------------------------------------------------------------------
AtlasOutput::SurfaceWriter::SurfaceWriter(const AtlasOutput& parts, vtkPolyData* output)
  : Parts(parts), Output(output),
    BytesPerPoint(OutputMemory::GetBytesPerTuple(parts.Input->GetPointData()) + 5 * sizeof(double) +
      sizeof(vtkIdType))
{
  vtkIdType faces = 0;
  for (const AtlasQuadtree::Chart& chart : parts.Quadtree.GetCharts())
  {
    faces += static_cast<vtkIdType>(chart.Disc.Triangles.size());
    this->RoomForPoints += static_cast<vtkIdType>(chart.Disc.Points.size());
  }
  this->Points->SetDataTypeToDouble();
  this->Coordinates->SetName(ArrayNames::AtlasCoordinates);
  this->Coordinates->SetNumberOfComponents(2);
  this->OriginalPoints->SetName(ArrayNames::OriginalPointIds);
  this->OriginalCells->SetName(ArrayNames::OriginalCellIds);
  this->Charts->SetName(ArrayNames::ChartId);
  OutputMemory::Allocate(faces, 3 * faces, this->Cells);
  output->GetCellData()->CopyAllOn();
  OutputMemory::AllocateCopies(parts.Input->GetCellData(), faces, output->GetCellData());
  TransportMemory::Require(
    static_cast<double>(sizeof(vtkIdType) + sizeof(int)) * static_cast<double>(faces));
  this->OriginalCells->Allocate(faces);
  this->Charts->Allocate(faces);
  TransportMemory::Require(this->BytesPerPoint * static_cast<double>(this->RoomForPoints));
  output->GetPointData()->InterpolateAllocate(parts.Input->GetPointData(), this->RoomForPoints);
  this->Points->Allocate(this->RoomForPoints);
  this->Coordinates->Allocate(2 * this->RoomForPoints);
  this->OriginalPoints->Allocate(this->RoomForPoints);
}

//------------------------------------------------------------------------------
// Where input points coincide there are more points than the charts have. VTK's arrays double then,
// and the old one is there until it is copied.
void AtlasOutput::SurfaceWriter::ReservePoints(vtkIdType more)
{
  const vtkIdType count = this->Points->GetNumberOfPoints() + more;
  if (count > this->RoomForPoints)
  {
    constexpr double oldAndNew = 3.0;
    TransportMemory::Require(oldAndNew * this->BytesPerPoint * static_cast<double>(count));
  }
}

//------------------------------------------------------------------------------
vtkIdType AtlasOutput::SurfaceWriter::GetOriginalCell(const AtlasQuadtree::Chart& chart,
  std::size_t triangle) const
{
  return this->Parts.Soup.CellIds[this->Parts.Surface.Sources[chart.Disc.Sources[triangle]]];
}

//------------------------------------------------------------------------------
// The point of an input cell that a point of the surface is: of those that were merged, its own.
vtkIdType AtlasOutput::SurfaceWriter::GetOriginalPoint(std::size_t point, vtkIdType cell)
{
  const TriangleSoup& soup = this->Parts.Soup;
  if (point >= soup.Points.size())
  {
    return -1;
  }
  this->Parts.Input->GetCellPoints(cell, this->CellPoints);
  for (const vtkIdType id : *this->CellPoints)
  {
    TriangleSoup::Point position;
    this->Parts.Input->GetPoint(id, position.data());
    if (position == soup.Points[point])
    {
      return id;
    }
  }
  return soup.PointIds[point];
}

//------------------------------------------------------------------------------
// What a point of the surface has of the points of the input.
void AtlasOutput::SurfaceWriter::AddWeights(std::size_t point, double weight,
  Weights& weights) const
{
  const std::size_t originals = this->Parts.Soup.Points.size();
  if (point < originals)
  {
    weights[this->Parts.Soup.PointIds[point]] += weight;
    return;
  }
  for (const std::size_t end : this->Parts.Surface.HalvedEdges[point - originals])
  {
    this->AddWeights(end, 0.5 * weight, weights);
  }
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::AddWeights(const AtlasQuadtree::Chart& chart, std::size_t point,
  double weight, Weights& weights) const
{
  if (point < chart.Points.size())
  {
    this->AddWeights(chart.Points[point], weight, weights);
    return;
  }
  for (const std::size_t end : chart.Disc.HalvedEdges[point - chart.Points.size()])
  {
    this->AddWeights(chart, end, 0.5 * weight, weights);
  }
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::InterpolatePoint(const Weights& weights, vtkIdType id)
{
  this->Sources->Reset();
  std::vector<double> values;
  for (const auto& weight : weights)
  {
    this->Sources->InsertNextId(weight.first);
    values.push_back(weight.second);
  }
  this->Output->GetPointData()->InterpolatePoint(this->Parts.Input->GetPointData(), id,
    this->Sources, values.data());
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::AddPoint(const AtlasQuadtree::Chart& chart, std::size_t point,
  vtkIdType original)
{
  const vtkIdType id = this->Points->InsertNextPoint(chart.Disc.Points[point].data());
  this->Coordinates->InsertNextTypedTuple(chart.Coordinates[point].data());
  this->OriginalPoints->InsertNextValue(original);
  if (original >= 0)
  {
    this->Output->GetPointData()->CopyData(this->Parts.Input->GetPointData(), original, id);
  }
  else
  {
    Weights weights;
    this->AddWeights(chart, point, 1.0, weights);
    this->InterpolatePoint(weights, id);
  }
}

//------------------------------------------------------------------------------
// The corners of the chart's triangles in the output, and the points to be added there.
std::vector<vtkIdType> AtlasOutput::SurfaceWriter::FindCorners(const AtlasQuadtree::Chart& chart,
  std::vector<ChartPoint>& points, Heartbeat& heart)
{
  // Input points that coincide may differ in their data, so each is there by itself.
  std::map<ChartPoint, vtkIdType> known;
  std::vector<vtkIdType> corners;
  corners.reserve(3 * chart.Disc.Triangles.size());
  const vtkIdType first = this->Points->GetNumberOfPoints();
  for (std::size_t i = 0; i < chart.Disc.Triangles.size(); ++i)
  {
    heart.Beat();
    const vtkIdType cell = this->GetOriginalCell(chart, i);
    for (const std::size_t point : chart.Disc.Triangles[i])
    {
      const vtkIdType original =
        point < chart.Points.size() ? this->GetOriginalPoint(chart.Points[point], cell) : -1;
      const auto place =
        known.emplace(ChartPoint(point, original), first + static_cast<vtkIdType>(points.size()));
      if (place.second)
      {
        points.emplace_back(point, original);
      }
      corners.push_back(place.first->second);
    }
  }
  return corners;
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::WriteChart(int id, const AtlasQuadtree::Chart& chart,
  Heartbeat& heart)
{
  std::vector<ChartPoint> points;
  const std::vector<vtkIdType> corners = this->FindCorners(chart, points, heart);
  this->ReservePoints(static_cast<vtkIdType>(points.size()));
  for (const ChartPoint& point : points)
  {
    heart.Beat();
    this->AddPoint(chart, point.first, point.second);
  }
  for (std::size_t i = 0; i < chart.Disc.Triangles.size(); ++i)
  {
    heart.Beat();
    const vtkIdType cell = this->GetOriginalCell(chart, i);
    const vtkIdType newCell = this->Cells->InsertNextCell(3, corners.data() + 3 * i);
    this->Output->GetCellData()->CopyData(this->Parts.Input->GetCellData(), cell, newCell);
    this->OriginalCells->InsertNextValue(cell);
    this->Charts->InsertNextValue(id);
  }
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::Finish()
{
  this->Output->SetPoints(this->Points);
  this->Output->SetPolys(this->Cells);
  vtkPointData* points = this->Output->GetPointData();
  // Points and cells may be there several times now, so their ids are no longer global.
  points->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  this->Output->GetCellData()->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  this->Output->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  points->AddArray(this->OriginalPoints);
  points->AddArray(this->Coordinates);
  points->SetActiveTCoords(this->Coordinates->GetName());
  this->Output->GetCellData()->AddArray(this->OriginalCells);
  this->Output->GetCellData()->AddArray(this->Charts);
  this->Output->Squeeze();
}

//------------------------------------------------------------------------------
AtlasOutput::AtlasOutput(vtkPolyData* input, const TriangleSoup& soup, const AtlasSurface& surface,
  const AtlasQuadtree& quadtree)
  : Input(input), Soup(soup), Surface(surface), Quadtree(quadtree)
{
}

//------------------------------------------------------------------------------
void AtlasOutput::WriteSurface(vtkPolyData* output, const Monitor& monitor) const
{
  Heartbeat heart(monitor, 256);
  SurfaceWriter writer(*this, output);
  int id = 0;
  for (const AtlasQuadtree::Chart& chart : this->Quadtree.GetCharts())
  {
    writer.WriteChart(id++, chart, heart);
  }
  writer.Finish();
  output->GetFieldData()->PassData(this->Input->GetFieldData());
}

//------------------------------------------------------------------------------
void AtlasOutput::WriteTable(vtkTable* table) const
{
  const std::vector<AtlasQuadtree::Node>& nodes = this->Quadtree.GetNodes();
  const auto add = [&](auto* type, const char* name, const auto& get)
  {
    using Array = std::remove_pointer_t<decltype(type)>;
    auto column = MakeArray<Array>(name, 1, static_cast<vtkIdType>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      column->SetValue(static_cast<vtkIdType>(i), get(nodes[i]));
    }
    table->AddColumn(column);
  };
  using Node = AtlasQuadtree::Node;
  vtkIntArray* integers = nullptr;
  vtkDoubleArray* numbers = nullptr;
  add(integers, "Chart", [](const Node& node) { return node.Chart; });
  add(integers, "Parent", [](const Node& node) { return node.Parent; });
  add(integers, "Level", [](const Node& node) { return std::ilogb(node.Size); });
  add(integers, "X", [](const Node& node) { return node.X; });
  add(integers, "Y", [](const Node& node) { return node.Y; });
  add(integers, "Size", [](const Node& node) { return node.Size; });
  add(numbers, "SurfaceArea", [](const Node& node) { return node.Area; });
  add(numbers, "Stretch",
    [this](const Node& node)
    {
      return node.Chart < 0 ? std::numeric_limits<double>::quiet_NaN()
                            : this->Quadtree.GetCharts()[node.Chart].L2Stretch;
    });
}
} // namespace LightTransport
