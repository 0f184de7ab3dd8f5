// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Walls that are thinner than edges are long: patches cross nowhere that the surface does not.
#include "MeshTestTools.h"

#include "vtkAppendPolyData.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

namespace
{
using Triangle = std::array<vtkIdType, 3>;

//------------------------------------------------------------------------------
// A grid of rows x columns points as a function gives them, closed around in each row.
template <typename Function>
vtkSmartPointer<vtkPolyData> MakeRing(int rows, int columns, const Function& place)
{
  std::vector<meshTest::Vector> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < columns; ++j)
    {
      points.push_back(place(i, 2.0 * vtkMath::Pi() * j / columns));
      const vtkIdType a = i * columns + j;
      const vtkIdType b = i * columns + (j + 1) % columns;
      const vtkIdType c = (i + 1) % rows * columns + (j + 1) % columns;
      const vtkIdType d = (i + 1) % rows * columns + j;
      triangles.push_back({ a, b, c });
      triangles.push_back({ a, c, d });
    }
  }
  return meshTest::MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
// A bowl with a hole in its ground, a tube: closed walls of a thickness. Each row of points runs
// around the axis; the first half of the rows goes up outside, the others down inside.
vtkSmartPointer<vtkPolyData> MakeBowl(double wall)
{
  const int rows = 24;
  return MakeRing(rows, 40,
    [&](int row, double angle)
    {
      const bool outside = row < rows / 2;
      const double part = (outside ? row : rows - 1 - row) / (rows / 2 - 1.0);
      const double polar = 0.2 + part * (0.5 * vtkMath::Pi() - 0.2);
      const double radius = outside ? 1.0 : 1.0 - wall;
      return meshTest::Vector{ radius * std::sin(polar) * std::cos(angle),
        radius * std::sin(polar) * std::sin(angle), -radius * std::cos(polar) };
    });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeTube(double wall)
{
  return MakeRing(4, 24,
    [&](int row, double angle)
    {
      const double radius = row == 0 || row == 1 ? 1.0 : 1.0 - wall;
      const double height = row == 1 || row == 2 ? 3.0 : 0.0;
      return meshTest::Vector{ radius * std::cos(angle), radius * std::sin(angle), height };
    });
}

//------------------------------------------------------------------------------
// A ball in a ball: two components.
vtkSmartPointer<vtkPolyData> MakeShells(double wall)
{
  vtkNew<vtkAppendPolyData> append;
  for (const double radius : { 1.0, 1.0 - wall })
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    sphere->SetRadius(radius);
    sphere->SetThetaResolution(40);
    sphere->SetPhiResolution(30);
    append->AddInputConnection(sphere->GetOutputPort());
  }
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->Update();
  return append->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Place(vtkPolyData* surface, double scale, double offset, bool single)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(offset, 10.0 * offset, 0.0);
  transform->Scale(scale, scale, scale);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(
    single ? vtkAlgorithm::SINGLE_PRECISION : vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
// Whether the segment from p to q passes well through the inside of a triangle.
bool Pierces(const meshTest::Vector& p, const meshTest::Vector& q,
  const std::array<meshTest::Vector, 3>& t)
{
  const auto subtract = [](const meshTest::Vector& a, const meshTest::Vector& b) {
    return meshTest::Vector{ a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  const meshTest::Vector u = subtract(t[1], t[0]);
  const meshTest::Vector v = subtract(t[2], t[0]);
  const meshTest::Vector along = subtract(q, p);
  const meshTest::Vector start = subtract(p, t[0]);
  meshTest::Vector h;
  meshTest::Vector k;
  vtkMath::Cross(along.data(), v.data(), h.data());
  vtkMath::Cross(start.data(), u.data(), k.data());
  const double scale = vtkMath::Dot(u.data(), h.data());
  const double size =
    vtkMath::Norm(u.data()) * vtkMath::Norm(v.data()) * vtkMath::Norm(along.data());
  if (std::abs(scale) <= 1e-9 * size)
  {
    return false;
  }
  const double a = vtkMath::Dot(start.data(), h.data()) / scale;
  const double b = vtkMath::Dot(along.data(), k.data()) / scale;
  const double c = vtkMath::Dot(v.data(), k.data()) / scale;
  const double rim = 1e-6;
  return a > rim && b > rim && a + b < 1.0 - rim && c > rim && c < 1.0 - rim;
}

//------------------------------------------------------------------------------
// Pairs of triangles without a common point that cross: all are tried.
int CountCrossings(vtkPolyData* mesh)
{
  std::vector<std::array<meshTest::Vector, 3>> corners;
  std::vector<Triangle> ids;
  std::vector<std::array<double, 6>> bounds;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* points;
    mesh->GetCellPoints(i, size, points);
    ids.push_back({ points[0], points[1], points[2] });
    corners.push_back({ meshTest::GetPoint(mesh, points[0]), meshTest::GetPoint(mesh, points[1]),
      meshTest::GetPoint(mesh, points[2]) });
    bounds.emplace_back();
    mesh->GetCellBounds(i, bounds.back().data());
  }
  int count = 0;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    for (std::size_t j = i + 1; j < ids.size(); ++j)
    {
      bool apart = false;
      for (int k = 0; k < 3; ++k)
      {
        apart = apart || bounds[i][2 * k] > bounds[j][2 * k + 1] ||
          bounds[j][2 * k] > bounds[i][2 * k + 1] ||
          std::find(ids[j].begin(), ids[j].end(), ids[i][k]) != ids[j].end();
      }
      bool crosses = false;
      for (int k = 0; k < 3 && !apart; ++k)
      {
        crosses = crosses || Pierces(corners[i][k], corners[i][(k + 1) % 3], corners[j]) ||
          Pierces(corners[j][k], corners[j][(k + 1) % 3], corners[i]);
      }
      count += crosses;
    }
  }
  return count;
}

//------------------------------------------------------------------------------
void TestWall(const std::string& name, vtkPolyData* surface, double length, bool closed,
  meshTest::Checker& check)
{
  struct
  {
    double Scale;
    double Offset;
    bool Single;
  } const places[] = { { 1.0, 0.0, false }, { 1e-6, 0.0, false }, { 1e6, 0.0, true },
    { 1.0, 6e5, false } };
  check.Equal(CountCrossings(surface), 0, 0, name + ": crossings of the input");
  for (const auto& place : places)
  {
    check.SetSubject(
      name + ", scale " + std::to_string(place.Scale) + ", offset " + std::to_string(place.Offset));
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputData(Place(surface, place.Scale, place.Offset, place.Single));
    mesher->SetTargetEdgeLength(place.Scale * length);
    mesher->Update();
    vtkPolyData* patches = mesher->GetOutput();
    check.True(patches->GetNumberOfCells() > 0, "patches");
    check.Equal(CountCrossings(patches), 0, 0, "crossings of the patches");
    check.Equal(meshTest::GetSummary(patches, "NumberOfSelfIntersections"), 0, 0, "told");
    check.Equal(meshTest::GetSummary(patches, "NumberOfIntersectionsBetweenComponents"), 0, 0,
      "told between components");
    check.True(meshTest::IsClosed(patches) == closed, "closed");
  }
}

//------------------------------------------------------------------------------
// Kept crossings are counted in the patches, and only where the surface crosses itself.
void TestKept(meshTest::Checker& check)
{
  check.SetSubject("two balls");
  vtkNew<vtkAppendPolyData> append;
  for (const double x : { 0.0, 0.7 })
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(x, 0.0, 0.0);
    sphere->SetThetaResolution(30);
    sphere->SetPhiResolution(30);
    append->AddInputConnection(sphere->GetOutputPort());
  }
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(append->GetOutputPort());
  mesher->SetTargetEdgeLength(0.1);
  mesher->Update();
  const int between = CountCrossings(mesher->GetOutput());
  check.True(between > 0, "they cross");
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfIntersectionsBetweenComponents"),
    between, 0, "crossings between components");
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfSelfIntersections"), 0, 0,
    "crossings within components");
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherCrossings(int, char*[])
{
  meshTest::Checker check;
  TestWall("bowl", MakeBowl(0.02), 0.4, true, check);
  TestWall("thinner bowl", MakeBowl(0.003), 0.4, true, check);
  TestWall("tube", MakeTube(0.02), 0.8, true, check);
  TestWall("shells", MakeShells(0.02), 0.5, true, check);
  TestKept(check);
  return check.GetExitCode();
}
