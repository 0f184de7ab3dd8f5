// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasOutput.h"

#include "Common/Heartbeat.h"
#include "Shared/ArrayNames.h"

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
  array->SetNumberOfTuples(tuples);
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

  vtkIdType GetOriginalPoint(std::size_t point, vtkIdType cell);
  vtkIdType AddPoint(const AtlasQuadtree::Chart& chart, std::size_t point, vtkIdType original);
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
};

//------------------------------------------------------------------------------
AtlasOutput::SurfaceWriter::SurfaceWriter(const AtlasOutput& parts, vtkPolyData* output)
  : Parts(parts), Output(output)
{
  this->Points->SetDataTypeToDouble();
  this->Coordinates->SetName(ArrayNames::AtlasCoordinates);
  this->Coordinates->SetNumberOfComponents(2);
  this->OriginalPoints->SetName(ArrayNames::OriginalPointIds);
  this->OriginalCells->SetName(ArrayNames::OriginalCellIds);
  this->Charts->SetName(ArrayNames::ChartId);
  const auto faces = static_cast<vtkIdType>(parts.Surface.Triangles.size());
  this->Cells->AllocateEstimate(faces, 3);
  output->GetCellData()->CopyAllOn();
  output->GetCellData()->CopyAllocate(parts.Input->GetCellData(), faces);
  output->GetPointData()->InterpolateAllocate(parts.Input->GetPointData(), faces / 2);
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
vtkIdType AtlasOutput::SurfaceWriter::AddPoint(const AtlasQuadtree::Chart& chart, std::size_t point,
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
  return id;
}

//------------------------------------------------------------------------------
void AtlasOutput::SurfaceWriter::WriteChart(int id, const AtlasQuadtree::Chart& chart,
  Heartbeat& heart)
{
  // Input points that coincide may differ in their data, so each is there by itself.
  std::map<std::pair<std::size_t, vtkIdType>, vtkIdType> known;
  for (std::size_t i = 0; i < chart.Disc.Triangles.size(); ++i)
  {
    heart.Beat();
    const std::size_t source = this->Parts.Surface.Sources[chart.Disc.Sources[i]];
    const vtkIdType cell = this->Parts.Soup.CellIds[source];
    vtkIdType corners[3];
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::size_t point = chart.Disc.Triangles[i][corner];
      const vtkIdType original =
        point < chart.Points.size() ? this->GetOriginalPoint(chart.Points[point], cell) : -1;
      const auto place = known.emplace(std::make_pair(point, original), -1).first;
      if (place->second < 0)
      {
        place->second = this->AddPoint(chart, point, original);
      }
      corners[corner] = place->second;
    }
    const vtkIdType newCell = this->Cells->InsertNextCell(3, corners);
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
