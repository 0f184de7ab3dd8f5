// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces with atlas coordinates, built by hand: charts of a known shape, each of which fills its
/// block of the unit square.
#ifndef AtlasTestTools_h
#define AtlasTestTools_h

#include "MeshTestTools.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"

#include <functional>
#include <random>
#include <vector>

namespace atlasTest
{
using meshTest::Vector;

struct Chart
{
  /// The corner and the side of its block.
  double U;
  double V;
  double Side;
  /// Cells of the grid that is cut into triangles.
  int Columns;
  int Rows;
  /// From [0,1]^2, the whole chart, into space.
  std::function<Vector(double, double)> Shape;
};

//------------------------------------------------------------------------------
/// Points inside a chart are moved at random by up to `jitter` of the grid's spacing (below 0.25:
/// no triangle turns over).
inline vtkSmartPointer<vtkPolyData> MakeAtlas(const std::vector<Chart>& charts, int resolution,
  double jitter)
{
  std::vector<Vector> points;
  std::vector<std::array<vtkIdType, 3>> triangles;
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetName("AtlasCoordinates");
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> chartIds;
  chartIds->SetName("ChartId");
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> random(-jitter, jitter);
  for (std::size_t i = 0; i < charts.size(); ++i)
  {
    const Chart& chart = charts[i];
    const vtkIdType first = static_cast<vtkIdType>(points.size());
    for (int row = 0; row <= chart.Rows; ++row)
    {
      for (int column = 0; column <= chart.Columns; ++column)
      {
        const bool inside = row > 0 && row < chart.Rows && column > 0 && column < chart.Columns;
        const double u = (column + (inside ? random(engine) : 0.0)) / chart.Columns;
        const double v = (row + (inside ? random(engine) : 0.0)) / chart.Rows;
        points.push_back(chart.Shape(u, v));
        coordinates->InsertNextTuple2(chart.U + u * chart.Side, chart.V + v * chart.Side);
      }
    }
    for (int row = 0; row < chart.Rows; ++row)
    {
      for (int column = 0; column < chart.Columns; ++column)
      {
        const vtkIdType a = first + column + row * (chart.Columns + 1);
        const vtkIdType c = a + chart.Columns + 2;
        triangles.push_back({ a, a + 1, c });
        triangles.push_back({ a, c, c - 1 });
        chartIds->InsertNextValue(static_cast<int>(i));
        chartIds->InsertNextValue(static_cast<int>(i));
      }
    }
  }
  vtkSmartPointer<vtkPolyData> surface = meshTest::MakeSurface(points, triangles);
  surface->GetPointData()->SetTCoords(coordinates);
  surface->GetCellData()->AddArray(chartIds);
  vtkNew<vtkIntArray> made;
  made->SetName("AtlasResolution");
  made->InsertNextValue(resolution);
  surface->GetFieldData()->AddArray(made);
  return surface;
}

//------------------------------------------------------------------------------
/// A rectangle in the plane z = 0.
inline std::function<Vector(double, double)> Flat(double width, double height)
{
  return [=](double u, double v) { return Vector{ width * u, height * v, 0.0 }; };
}

//------------------------------------------------------------------------------
/// A quarter of a cylinder of radius 2 and height 3, from an angle of `quarter` right angles on.
inline std::function<Vector(double, double)> Cylinder(int quarter)
{
  return [=](double u, double v)
  {
    const double angle = 0.5 * vtkMath::Pi() * (quarter + u);
    return Vector{ 2.0 * std::cos(angle), 2.0 * std::sin(angle), 3.0 * v };
  };
}

//------------------------------------------------------------------------------
inline Vector Hill(double u, double v)
{
  return { 4.0 * u, 4.0 * v, std::sin(3.0 * u) * std::cos(2.0 * v) };
}

//------------------------------------------------------------------------------
/// One flat square of 2 x 2.
inline vtkSmartPointer<vtkPolyData> MakeSquare(int cells, double jitter)
{
  return MakeAtlas({ { 0, 0, 1, cells, cells, Flat(2, 2) } }, 32, jitter);
}

//------------------------------------------------------------------------------
/// A closed ring of four charts: the quarters of a cylinder.
inline vtkSmartPointer<vtkPolyData> MakeCylinder(int cells)
{
  return MakeAtlas(
    { { 0, 0, 0.5, cells, cells, Cylinder(0) }, { 0.5, 0, 0.5, cells, cells, Cylinder(1) },
      { 0.5, 0.5, 0.5, cells, cells, Cylinder(2) }, { 0, 0.5, 0.5, cells, cells, Cylinder(3) } },
    32, 0.2);
}

//------------------------------------------------------------------------------
/// Seven charts of three sizes: a hill, needles along each axis that are far thinner than a texel,
/// and four small ones of two triangles each.
inline vtkSmartPointer<vtkPolyData> MakeMixture()
{
  return MakeAtlas({ { 0, 0, 0.5, 23, 17, Hill }, { 0.5, 0, 0.5, 1, 3000, Flat(1, 7) },
                     { 0, 0.5, 0.5, 3000, 2, Hill }, { 0.5, 0.5, 0.25, 1, 1, Flat(5, 1) },
                     { 0.75, 0.5, 0.25, 1, 1, Flat(1, 1) }, { 0.5, 0.75, 0.25, 1, 1, Flat(1, 2) },
                     { 0.75, 0.75, 0.25, 40, 40, Hill } },
    64, 0.2);
}

//------------------------------------------------------------------------------
inline std::vector<double> GetCellAreas(vtkPolyData* surface)
{
  std::vector<double> areas(surface->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    areas[cell] = vtkMath::Norm(meshTest::GetAreaVector(surface, cell).data());
  }
  return areas;
}
} // namespace atlasTest

#endif
