// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Small holes are filled, crumbs dropped and self-intersections resolved or refused; outlines,
// large holes, and parts of a scene that stick in each other are left alone.
#include "MeshTestTools.h"

#include "vtkAppendPolyData.h"
#include "vtkCubeSource.h"
#include "vtkExecutive.h"
#include "vtkIntArray.h"
#include "vtkSphereSource.h"
#include "vtkTestErrorObserver.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <functional>

namespace
{
using Triangles = std::vector<std::array<vtkIdType, 3>>;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(2 * resolution);
  sphere->SetPhiResolution(resolution);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  return sphere->GetOutput();
}

//------------------------------------------------------------------------------
// A copy without the cells that `drop` says; the cell array "Region" counts the octants.
vtkSmartPointer<vtkPolyData> Cut(vtkPolyData* input,
  const std::function<bool(const meshTest::Vector&)>& drop)
{
  Triangles triangles;
  vtkNew<vtkIntArray> regions;
  regions->SetName("Region");
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    input->GetCellPoints(i, size, ids);
    meshTest::Vector center{ 0.0, 0.0, 0.0 };
    for (int j = 0; j < 9; ++j)
    {
      center[j % 3] += meshTest::GetPoint(input, ids[j / 3])[j % 3] / 3.0;
    }
    if (!drop(center))
    {
      triangles.push_back({ ids[0], ids[1], ids[2] });
      regions->InsertNextValue(center[2] > 0.0);
    }
  }
  std::vector<meshTest::Vector> points;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    points.push_back(meshTest::GetPoint(input, i));
  }
  vtkSmartPointer<vtkPolyData> output = meshTest::MakeSurface(points, triangles);
  output->GetCellData()->AddArray(regions);
  return output;
}

//------------------------------------------------------------------------------
// A sphere with one missing triangle fan at each pole, and the equator's triangles in two regions.
void TestHoles(meshTest::Checker& check)
{
  const int resolution = 24;
  vtkSmartPointer<vtkPolyData> sphere = MakeSphere(resolution);
  // The first ring of points is at this distance from the axis.
  const double radius = std::sin(vtkMath::Pi() / (resolution - 1));
  vtkSmartPointer<vtkPolyData> open =
    Cut(sphere, [](const meshTest::Vector& center) { return std::abs(center[2]) > 0.985; });
  check.Equal(meshTest::GetEdges(open).Borders.size(), 4.0 * resolution, 0, "two holes");

  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(open);
  mesher->SetTargetEdgeLength(0.1);
  mesher->SetHoleSize(0.99 * radius);
  mesher->Update();
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfFilledHoles"), 0, 0, "too large");
  check.Equal(meshTest::GetEdges(mesher->GetOutput()).Borders.empty(), 0, 0, "still open");

  mesher->SetHoleSize(1.01 * radius);
  mesher->Update();
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfFilledHoles"), 2, 0, "filled");
  check.True(meshTest::IsClosed(mesher->GetOutput()), "filled sphere is closed");
  check.True(meshTest::GetVolume(mesher->GetOutput()) > 0.0, "filled sphere faces outward");
  // The lids are flat, inscribed polygons of 2 * resolution sides, one in each region.
  const double lid =
    resolution * radius * radius * std::sin(2.0 * vtkMath::Pi() / (2.0 * resolution));
  std::map<int, double> filled = meshTest::GetAreas(mesher->GetOutput(), "Region");
  mesher->FillHolesOff();
  mesher->Update();
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfFilledHoles"), 0, 0, "off");
  std::map<int, double> kept = meshTest::GetAreas(mesher->GetOutput(), "Region");
  for (const int region : { 0, 1 })
  {
    check.Equal(filled[region] - kept[region], lid, 0.02 * lid, "area of a lid");
  }
}

//------------------------------------------------------------------------------
// The outline of an open surface is no hole, however small the surface is within its scene.
void TestOutlines(meshTest::Checker& check)
{
  const std::vector<meshTest::Vector> points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
    { 1000, 0, 0 }, { 1001, 0, 0 }, { 1001, 1, 0 }, { 1000, 1, 0 } };
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(meshTest::MakeSurface(points, { { 0, 1, 2 }, { 3, 4, 5 }, { 3, 5, 6 } }));
  mesher->SetTargetEdgeLength(0.5);
  mesher->SetHoleSize(10.0);
  mesher->Update();
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 1.5, 1e-12, "triangle and square");
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfFilledHoles"), 0, 0, "outlines");
}

//------------------------------------------------------------------------------
// Flaps on a closed surface: a copy of a triangle turned over and one that only shares its edge.
void TestCrumbs(meshTest::Checker& check)
{
  const int resolution = 40;
  vtkSmartPointer<vtkPolyData> sphere =
    Cut(MakeSphere(resolution), [](const meshTest::Vector&) { return false; });
  const double volume = meshTest::GetVolume(sphere);
  vtkIdType size;
  const vtkIdType* ids;
  sphere->GetCellPoints(1000, size, ids);
  const std::array<vtkIdType, 3> t = { ids[0], ids[1], ids[2] };
  meshTest::Vector top = meshTest::GetPoint(sphere, t[2]);
  for (double& coordinate : top)
  {
    coordinate *= 1.02;
  }
  const vtkIdType free = sphere->GetPoints()->InsertNextPoint(top.data());
  sphere->GetPolys()->InsertNextCell({ t[0], t[1], free });
  sphere->GetPolys()->InsertNextCell({ t[1], t[0], t[2] });
  sphere->GetCellData()->Initialize();
  sphere->Modified();
  for (const double holeSize : { 0.1, 0.001 })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputData(sphere);
    mesher->SetTargetEdgeLength(0.1);
    mesher->SetHoleSize(holeSize);
    mesher->Update();
    const bool dropped = holeSize == 0.1;
    check.True(meshTest::IsClosed(mesher->GetOutput()) == dropped, "closed without crumbs");
    check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfDroppedTriangles"),
      dropped ? 2 : 1, 0, "dropped");
    check.Equal(meshTest::GetVolume(mesher->GetOutput()), volume, 0.02 * volume, "volume");
  }
}

//------------------------------------------------------------------------------
// A bump whose top is pushed through the surface below it: a fold within one component.
vtkSmartPointer<vtkPolyData> MakeFold()
{
  vtkSmartPointer<vtkPolyData> sphere =
    Cut(MakeSphere(60), [](const meshTest::Vector&) { return false; });
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    meshTest::Vector p = meshTest::GetPoint(sphere, i);
    const double distance = std::hypot(p[0] - 1.0, p[1], p[2]);
    if (distance < 0.1)
    {
      // Pulls the points over each other along the surface.
      p[1] *= -1.0;
      sphere->GetPoints()->SetPoint(i, p.data());
    }
  }
  return sphere;
}

//------------------------------------------------------------------------------
void ExpectError(vtkPatchMesher* mesher, const std::vector<std::string>& expected,
  meshTest::Checker& check)
{
  vtkNew<vtkTest::ErrorObserver> executive;
  vtkNew<vtkTest::ErrorObserver> observer;
  mesher->AddObserver(vtkCommand::ErrorEvent, observer);
  mesher->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  mesher->Update();
  for (const std::string& text : expected)
  {
    check.True(observer->GetErrorMessage().find(text) != std::string::npos,
      "the error \"" + observer->GetErrorMessage() + "\" says \"" + text + "\"");
  }
  check.Equal(mesher->GetOutput()->GetNumberOfCells(), 0, 0, "cells after an error");
}

//------------------------------------------------------------------------------
void TestFold(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> fold = MakeFold();
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(fold);
  mesher->SetTargetEdgeLength(0.05);
  mesher->SetHoleSize(0.1);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  const double found = meshTest::GetSummary(patches, "NumberOfInputSelfIntersections");
  check.Equal(meshTest::GetSummary(patches, "NumberOfSelfIntersections"), 0, 0, "none is left");
  check.True(found > 0.0, "the fold intersects itself");
  check.True(meshTest::IsClosed(patches), "resolved: closed");
  const double volume = 4.0 / 3.0 * vtkMath::Pi();
  check.Equal(meshTest::GetVolume(patches), volume, 0.01 * volume, "resolved: volume");
  check.True(meshTest::GetAreas(patches, "Region").size() == 2, "resolved: regions");

  vtkNew<vtkPatchMesher> again;
  again->SetInputData(patches);
  again->SetTargetEdgeLength(0.05);
  again->SetSelfIntersectionsToRefuse();
  again->Update();
  check.Equal(meshTest::GetSummary(again->GetOutput(), "NumberOfInputSelfIntersections"), 0, 0,
    "self-intersections of the resolved surface");

  mesher->SetSelfIntersectionsToKeep();
  mesher->Update();
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "NumberOfInputSelfIntersections"), found, 0,
    "self-intersections to keep");
  check.True(meshTest::GetSummary(mesher->GetOutput(), "NumberOfSelfIntersections") > 0.0,
    "kept self-intersections");

  const std::string number = std::to_string(static_cast<vtkIdType>(found)) + " pairs of triangles";
  vtkNew<vtkPatchMesher> refuse;
  refuse->SetInputData(fold);
  refuse->SetSelfIntersectionsToRefuse();
  ExpectError(refuse, { number, "the first near (0.99", "cells" }, check);
  vtkNew<vtkPatchMesher> strict;
  strict->SetInputData(fold);
  strict->RepairOff();
  ExpectError(strict, { number, "with Repair on" }, check);
  // Nothing that moves the surface by less than this resolves it.
  vtkNew<vtkPatchMesher> careful;
  careful->SetInputData(fold);
  careful->SetHoleSize(1e-6);
  ExpectError(careful, { number, "give a larger HoleSize" }, check);
}

//------------------------------------------------------------------------------
// A strip that crosses itself at a right angle: no local change helps, and it says where.
void TestCrossingSheets(meshTest::Checker& check)
{
  const std::vector<meshTest::Vector> points = { { -1, -1, 0 }, { -1, 1, 0 }, { 1, -1, 0 },
    { 1, 1, 0 }, { 1, -1, 2 }, { 1, 1, 2 }, { 0.5, -1, -1 }, { 0.5, 1, -1 } };
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(meshTest::MakeSurface(points,
    { { 0, 2, 1 }, { 1, 2, 3 }, { 2, 4, 3 }, { 3, 4, 5 }, { 4, 6, 5 }, { 5, 6, 7 } }));
  // They cross at x = 2/3; the sides in between end at y = -2/3 on one sheet, y = -1/3 on the
  // other.
  ExpectError(mesher, { "3 pairs of triangles", "cells 0 and 4" }, check);
}

//------------------------------------------------------------------------------
// Boxes that stick in each other, that share an edge, or lie on a face are a scene.
void TestScene(meshTest::Checker& check)
{
  vtkNew<vtkAppendPolyData> append;
  const std::vector<meshTest::Vector> centers = { { 0, 0, 0 }, { 0.5, 0.25, 0.75 }, { 3, 0, 0 },
    { 4, 1, 0 }, { 6, 0, 0 }, { 6.25, 0.25, 1 } };
  for (const meshTest::Vector& center : centers)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    cube->SetCenter(center.data());
    append->AddInputConnection(cube->GetOutputPort());
  }
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(append->GetOutputPort());
  mesher->SetTargetEdgeLength(0.5);
  mesher->SetHoleSize(0.9);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  check.Equal(meshTest::GetVolume(patches), 6.0, 1e-11, "six boxes: volume");
  check.Equal(meshTest::GetArea(patches), 36.0, 1e-10, "six boxes: area");
  check.True(meshTest::IsClosed(patches), "six boxes: closed");
  check.Equal(meshTest::GetSummary(patches, "NumberOfSelfIntersections"), 0, 0, "no defect");
  check.True(meshTest::GetSummary(patches, "NumberOfIntersectionsBetweenComponents") > 0.0,
    "counted");
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherHoles(int, char*[])
{
  meshTest::Checker check;
  TestHoles(check);
  TestOutlines(check);
  TestCrumbs(check);
  TestFold(check);
  TestCrossingSheets(check);
  TestScene(check);
  return check.GetExitCode();
}
