// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnySurface.h"

#include "Choices.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace LightTransportFuzz
{
namespace
{
using Point = std::array<double, 3>;
using Polygon = std::vector<vtkIdType>;

struct Soup
{
  std::vector<Point> Points;
  std::vector<Polygon> Polygons;

  vtkIdType Add(const Point& point)
  {
    this->Points.push_back(point);
    return static_cast<vtkIdType>(this->Points.size()) - 1;
  }
};

//------------------------------------------------------------------------------
// Polygons whose corners are any points of a small grid: all that touches, crosses, folds or
// repeats.
void AddGridPolygons(Choices& choices, Soup& soup)
{
  const int side = choices.Index(4) + 1;
  const auto first = static_cast<vtkIdType>(soup.Points.size());
  const int count = choices.Index(20) + 1;
  for (int k = 0; k < count; ++k)
  {
    soup.Add({ 1.0 * choices.Index(side), 1.0 * choices.Index(side), 1.0 * choices.Index(side) });
  }
  for (int k = choices.Index(24); k >= 0; --k)
  {
    Polygon polygon(choices.Chance(5) ? choices.Index(8) : 3);
    std::generate(polygon.begin(), polygon.end(), [&] { return first + choices.Index(count); });
    soup.Polygons.push_back(polygon);
  }
}

//------------------------------------------------------------------------------
// A sheet of n x m squares that is bent to a tube, a torus, a sphere or a Moebius strip: of quads
// or triangles, its edges not welded.
void AddBentSheet(Choices& choices, Soup& soup, bool closed)
{
  constexpr double turn = 6.283185307179586;
  const int n = choices.Index(8) + 1, m = choices.Index(8) + 1;
  const int shape = closed ? 2 + choices.Index(2) : choices.Index(5);
  const auto place = [&](int i, int j) -> Point
  {
    const double u = turn * (i % (shape == 0 ? n + 1 : n)) / n, v = 1.0 * j / m;
    switch (shape)
    {
      case 0:
        return { 1.0 * i / n, v, 0.0 };
      case 1:
        return { std::cos(u), std::sin(u), v };
      case 2:
        return { std::cos(u) * (2.0 + std::cos(turn * v)), std::sin(u) * (2.0 + std::cos(turn * v)),
          std::sin(turn * v) };
      case 3:
        return { std::cos(u) * std::sin(turn / 2.0 * v), std::sin(u) * std::sin(turn / 2.0 * v),
          std::cos(turn / 2.0 * v) };
      default:
        return { std::cos(u) * (2.0 + (v - 0.5) * std::cos(u / 2.0)),
          std::sin(u) * (2.0 + (v - 0.5) * std::cos(u / 2.0)), (v - 0.5) * std::sin(u / 2.0) };
    }
  };
  const auto first = static_cast<vtkIdType>(soup.Points.size());
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= m; ++j)
    {
      soup.Add(place(i, j));
    }
  }
  const bool triangles = choices.Chance(2);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      // Closed ones are seen from outside.
      const vtkIdType from = first + i * (m + 1) + j, to = from + m + 1;
      const vtkIdType a = closed ? to : from, b = closed ? from : to;
      if (triangles)
      {
        soup.Polygons.push_back({ a, b, b + 1 });
        soup.Polygons.push_back({ a, b + 1, a + 1 });
      }
      else
      {
        soup.Polygons.push_back({ a, b, b + 1, a + 1 });
      }
    }
  }
}

//------------------------------------------------------------------------------
// A box, seen from outside or inside (not if `closed`), often one that touches the box before.
void AddBox(Choices& choices, Soup& soup, bool closed)
{
  const double thick = choices.Among({ 1.0, 1.0, 0.1, 1e-3, 1e-6, closed ? 1e-9 : 0.0 });
  const Point corner = { 1.0 * choices.Index(3), 1.0 * choices.Index(3), 0.0 };
  std::array<vtkIdType, 8> ids;
  for (int k = 0; k < 8; ++k)
  {
    ids[k] = soup.Add({ corner[0] + k % 2, corner[1] + k / 2 % 2, corner[2] + thick * (k / 4) });
  }
  constexpr int faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  const bool inside = !closed && choices.Chance(2);
  for (const auto& face : faces)
  {
    Polygon polygon = { ids[face[0]], ids[face[1]], ids[face[2]], ids[face[3]] };
    if (inside)
    {
      std::reverse(polygon.begin(), polygon.end());
    }
    soup.Polygons.push_back(polygon);
  }
}

//------------------------------------------------------------------------------
void Damage(Choices& choices, Soup& soup)
{
  for (int k = choices.Chance(2) ? choices.Index(6) : 0; k > 0 && !soup.Polygons.empty(); --k)
  {
    Polygon& polygon = soup.Polygons[choices.Index(static_cast<int>(soup.Polygons.size()))];
    switch (choices.Index(5))
    {
      case 0:
        std::reverse(polygon.begin(), polygon.end());
        break;
      case 1:
        soup.Polygons.push_back(Polygon(polygon));
        break;
      case 2:
        polygon.clear();
        break;
      case 3: // two corners in one place
        polygon.resize(polygon.size() + 1, polygon.empty() ? 0 : polygon.back());
        break;
      default: // a corner elsewhere
        if (!polygon.empty())
        {
          soup.Points[polygon[0]][choices.Index(3)] += choices.Between(-1.0, 1.0);
        }
        break;
    }
  }
}

//------------------------------------------------------------------------------
void Transform(Choices& choices, Soup& soup)
{
  const double size =
    choices.Chance(4) ? std::abs(choices.Extreme()) : choices.Among({ 1.0, 1.0, 1.0, 1e-3, 1e3 });
  const double offset = choices.Among({ 0.0, 0.0, 0.0, 6e5, 6e6, 1e12 });
  const double rounding = choices.Among({ 0.0, 0.0, 0.0, 1e-15, 1e-7, 1e-3 });
  for (Point& point : soup.Points)
  {
    for (double& coordinate : point)
    {
      const double noise = rounding > 0.0 ? choices.Between(-rounding, rounding) : 0.0;
      coordinate = (coordinate + noise) * size + offset;
    }
  }
  if (choices.Chance(16) && !soup.Points.empty())
  {
    soup.Points[choices.Index(static_cast<int>(soup.Points.size()))][choices.Index(3)] =
      choices.Extreme();
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSurface(Choices& choices, const Soup& soup, bool strips)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(choices.Chance(2) ? VTK_FLOAT : VTK_DOUBLE);
  for (const Point& point : soup.Points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> polygons;
  for (const Polygon& polygon : soup.Polygons)
  {
    polygons->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  surface->SetPoints(points);
  // A strip has a triangle for each corner after the second.
  if (strips)
  {
    surface->SetStrips(polygons);
  }
  else
  {
    surface->SetPolys(polygons);
  }
  if (choices.Chance(8) && !soup.Points.empty())
  {
    vtkNew<vtkCellArray> vertices;
    vertices->InsertNextCell({ 0 });
    surface->SetVerts(vertices);
  }
  return surface;
}

//------------------------------------------------------------------------------
// What an array of that name usually holds.
double ChooseValue(Choices& choices, const std::string& name, bool extreme)
{
  if (extreme && choices.Chance(4))
  {
    return choices.Extreme();
  }
  if (name.find("Temperature") != std::string::npos)
  {
    return choices.Between(0.0, 500.0);
  }
  if (name == "Region" || name.find("Group") == 0 || name.find("Condition") != std::string::npos ||
    name == "ChartId")
  {
    return choices.Index(3);
  }
  return name == "vtkGhostType" ? choices.Among({ 0, 0, 0, 1, 32, 255 }) : choices.Share();
}

} // namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAbstractArray> MakeArray(Choices& choices, const std::string& name,
  vtkIdType tuples)
{
  const bool ghosts = name == "vtkGhostType";
  const bool calm = choices.IsCalm();
  const int type = ghosts ? VTK_UNSIGNED_CHAR
    : calm                ? choices.Among({ VTK_DOUBLE, VTK_FLOAT })
           : choices.Among({ VTK_DOUBLE, VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT, VTK_INT, VTK_ID_TYPE,
               VTK_UNSIGNED_CHAR, VTK_BIT, VTK_STRING });
  const auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(ghosts ? 1
      : calm                          ? choices.Among({ 1, 3 })
                                      : choices.Among({ 1, 1, 1, 1, 2, 3, 3, 4, 9 }));
  if (choices.Strange(12))
  {
    tuples = std::max<vtkIdType>(0, tuples + choices.Among({ -1, 1, -7, 100 }));
  }
  array->SetNumberOfTuples(tuples);
  const bool extreme = choices.Strange(6);
  for (vtkIdType k = 0; k < array->GetNumberOfValues(); ++k)
  {
    const double value = ChooseValue(choices, name, extreme);
    // Numbers beyond what integers hold would be undefined behaviour here.
    const bool integers = type != VTK_DOUBLE && type != VTK_FLOAT;
    array->SetVariantValue(k, integers && !(std::abs(value) < 250.0) ? 250.0 : value);
  }
  return array;
}

namespace
{
//------------------------------------------------------------------------------
void AddArrays(Choices& choices, vtkPolyData* surface)
{
  constexpr const char* ofCells[] = { "Emission", "Reflectance", "Emission", "Reflectance",
    "Temperature", "Emissivity", "DirectIrradiance", "BoundaryCondition", "PrescribedNetFlux",
    "EmissionBack", "ReflectanceBack", "Group", "Region", "Irradiance", "TransmittedIrradiance",
    "vtkGhostType", "ChartId", "OriginalCellIds", "Other" };
  constexpr const char* ofPoints[] = { "EdgeLength", "AtlasCoordinates", "vtkGhostType", "Normals",
    "Other" };
  for (int k = choices.Index(7); k > 0; --k)
  {
    const std::string name = ofCells[choices.Index(static_cast<int>(std::size(ofCells)))];
    surface->GetCellData()->AddArray(MakeArray(choices, name, surface->GetNumberOfCells()));
  }
  for (int k = choices.Index(3); k > 0; --k)
  {
    const std::string name = ofPoints[choices.Index(static_cast<int>(std::size(ofPoints)))];
    surface->GetPointData()->AddArray(MakeArray(choices, name, surface->GetNumberOfPoints()));
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeAnySurface(Choices& choices, const Needs& needs)
{
  if (choices.Strange(20))
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  const bool closed = needs.IsClosed && choices.IsCalm();
  Soup soup;
  for (int parts = choices.Index(3); parts >= 0; --parts)
  {
    switch (choices.Index(4))
    {
      case 0:
        closed ? AddBox(choices, soup, closed) : AddGridPolygons(choices, soup);
        break;
      case 1:
        AddBentSheet(choices, soup, closed);
        break;
      default:
        AddBox(choices, soup, closed);
        break;
    }
  }
  if (!choices.IsCalm())
  {
    Damage(choices, soup);
    Transform(choices, soup);
  }
  vtkSmartPointer<vtkPolyData> surface = MakeSurface(choices, soup, choices.Strange(10));
  if (!choices.IsCalm())
  {
    AddArrays(choices, surface);
    return surface;
  }
  for (const char* name : needs.Arrays)
  {
    surface->GetCellData()->AddArray(MakeArray(choices, name, surface->GetNumberOfCells()));
  }
  return surface;
}
} // namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> MakeAnyInput(Choices& choices, bool composite, const Needs& needs)
{
  if (!composite || !choices.Chance(4))
  {
    return MakeAnySurface(choices, needs);
  }
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const int count = choices.Index(4);
  for (int block = 0; block < count; ++block)
  {
    blocks->SetBlock(block, choices.Strange(6) ? nullptr : MakeAnySurface(choices, needs));
  }
  return blocks;
}
} // namespace LightTransportFuzz
