// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Which triangles become neighbours: soups, points that differ by rounding, solids that touch,
// sheets with two sides, surfaces with one side, corners on edges, polygons of any shape; far from
// the origin, small and large.
#include "MeshTestTools.h"

#include "vtkCommand.h"
#include "vtkTestErrorObserver.h"

#include <random>

namespace
{
using Points = std::vector<meshTest::Vector>;
using Triangles = std::vector<std::array<vtkIdType, 3>>;

const Points BOX = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
  { 1, 1, 1 }, { 0, 1, 1 } };
const Triangles FACES = { { 0, 2, 1 }, { 0, 3, 2 }, { 4, 5, 6 }, { 4, 6, 7 }, { 0, 1, 5 },
  { 0, 5, 4 }, { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 7 }, { 2, 7, 6 }, { 3, 0, 4 }, { 3, 4, 7 } };

//------------------------------------------------------------------------------
// Boxes side by side, shifted each by so much more.
vtkSmartPointer<vtkPolyData> MakeBoxes(int number, const meshTest::Vector& shift, double scale,
  double offset)
{
  Points points;
  Triangles triangles;
  for (int box = 0; box < number; ++box)
  {
    const auto first = static_cast<vtkIdType>(points.size());
    for (const meshTest::Vector& p : BOX)
    {
      points.push_back({ offset + scale * (p[0] + box * shift[0]),
        offset + scale * (p[1] + box * shift[1]), scale * (p[2] + box * shift[2]) });
    }
    for (const auto& t : FACES)
    {
      triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
    }
  }
  return meshTest::MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
// Each triangle with points of its own, which differ by up to `noise`.
vtkSmartPointer<vtkPolyData> MakeSoup(vtkPolyData* surface, double noise)
{
  Points points;
  Triangles triangles;
  int turn = 0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    surface->GetCellPoints(cell, size, ids);
    const auto first = static_cast<vtkIdType>(points.size());
    for (vtkIdType i = 0; i < size; ++i)
    {
      points.push_back(meshTest::GetPoint(surface, ids[i]));
      for (double& coordinate : points.back())
      {
        coordinate += noise / 3.0 * (++turn % 7 - 3);
      }
    }
    triangles.push_back({ first, first + 1, first + 2 });
  }
  return meshTest::MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Mesh(vtkPolyData* input, double length, double tolerance = 0.0,
  int intersections = vtkPatchMesher::SELF_INTERSECTIONS_RESOLVE)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetSelfIntersections(intersections);
  mesher->SetInputData(input);
  mesher->SetTargetEdgeLength(length);
  mesher->SetWeldTolerance(tolerance);
  mesher->Update();
  return mesher->GetOutput();
}

//------------------------------------------------------------------------------
// Points less edges and faces more: 2 for each closed piece.
double GetEulerNumber(vtkPolyData* patches)
{
  const double borders = static_cast<double>(meshTest::GetEdges(patches).Borders.size());
  const double faces = static_cast<double>(patches->GetNumberOfCells());
  return static_cast<double>(patches->GetNumberOfPoints()) - 0.5 * (3.0 * faces + borders) + faces;
}

//------------------------------------------------------------------------------
void TestTouchingBoxes(meshTest::Checker& check)
{
  for (const meshTest::Vector& shift :
    { meshTest::Vector{ 1, 0, 0 }, meshTest::Vector{ 1, 1, 0 }, meshTest::Vector{ 1, 1, 1 } })
  {
    for (const double scale : { 1e-6, 1.0, 1e6 })
    {
      for (const double offset : { 0.0, 6e5 * scale })
      {
        vtkSmartPointer<vtkPolyData> boxes = MakeBoxes(2, shift, scale, offset);
        for (const auto& input : { boxes, MakeSoup(boxes, 0.0) })
        {
          vtkSmartPointer<vtkPolyData> patches = Mesh(input, 0.3 * scale);
          check.True(meshTest::IsClosed(patches), "boxes that touch: closed");
          check.Equal(GetEulerNumber(patches), 4, 0, "boxes that touch: Euler number");
          check.Equal(meshTest::GetArea(patches) / (scale * scale), 12.0, 1e-6, "their area");
          check.Equal(meshTest::GetSummary(patches, "NumberOfDroppedTriangles"), 0, 0, "dropped");
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void TestWelding(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> box = MakeBoxes(1, { 0, 0, 0 }, 1.0, 0.0);
  vtkSmartPointer<vtkPolyData> welded = Mesh(MakeSoup(box, 1e-9), 0.3, 1e-8);
  check.True(meshTest::IsClosed(welded), "welded: closed");
  check.Equal(GetEulerNumber(welded), 2, 0, "welded: Euler number");
  check.True(meshTest::GetSummary(welded, "NumberOfWeldedPoints") > 0, "welded: told");
  // Noise of about the default tolerance is welded whole, not in part.
  for (const double noise : { 1e-15, 3e-15, 1e-14 })
  {
    vtkSmartPointer<vtkPolyData> whole = Mesh(MakeSoup(box, noise), 0.3);
    check.True(meshTest::IsClosed(whole), "some rounding: closed");
    check.Equal(GetEulerNumber(whole), 2, 0, "some rounding: Euler number");
  }
}

//------------------------------------------------------------------------------
// Coordinates that are 0 have no relative error: corners lie on edges, next to their ends.
void TestRelativeNoise(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> box = MakeBoxes(1, { 0, 0, 0 }, 1.0, 0.0);
  for (const double noise : { 1e-12, 1e-9, 1e-7 })
  {
    vtkSmartPointer<vtkPolyData> soup = MakeSoup(box, 0.0);
    int turn = 0;
    for (vtkIdType i = 0; i < soup->GetNumberOfPoints(); ++i)
    {
      meshTest::Vector point = meshTest::GetPoint(soup, i);
      for (double& coordinate : point)
      {
        ++turn;
        coordinate *= 1.0 + noise / 3.0 * (turn * turn % 7 - 3);
      }
      soup->GetPoints()->SetPoint(i, point.data());
    }
    vtkSmartPointer<vtkPolyData> patches = Mesh(soup, 0.3);
    check.True(meshTest::IsClosed(patches), "relative noise: closed");
    check.Equal(GetEulerNumber(patches), 2, 0, "relative noise: Euler number");
  }
}

//------------------------------------------------------------------------------
// What is far apart beside the coordinates' digits stays, and is said to be loose.
void TestLooseTriangles(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> boxes = MakeBoxes(2, { 2, 0, 0 }, 1.0, 0.0);
  vtkSmartPointer<vtkPolyData> soup = MakeSoup(boxes, 0.0);
  std::mt19937 numbers(1);
  for (vtkIdType i = 0; i < soup->GetNumberOfPoints(); ++i)
  {
    meshTest::Vector point = meshTest::GetPoint(soup, i);
    for (double& coordinate : point)
    {
      coordinate += 1e-9 * (static_cast<double>(numbers()) / 4294967296.0 - 0.5);
    }
    soup->GetPoints()->SetPoint(i, point.data());
  }
  vtkNew<vtkPatchMesher> mesher;
  vtkNew<vtkTest::ErrorObserver> warnings;
  mesher->AddObserver(vtkCommand::WarningEvent, warnings);
  mesher->SetInputData(soup);
  mesher->SetTargetEdgeLength(0.3);
  mesher->Update();
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 12.0, 1e-6, "all of it is there");
  check.True(!meshTest::IsClosed(mesher->GetOutput()), "more apart than coordinates are worth");
  check.True(warnings->GetWarningMessage().find("are loose") != std::string::npos, "told");
}

//------------------------------------------------------------------------------
// Of two sheets in one plane with other triangles, each stays for itself; far from the origin, too,
// where few digits are left that single precision has not.
void TestSheetsInOnePlane(meshTest::Checker& check)
{
  for (const meshTest::Vector& offset :
    { meshTest::Vector{ 0, 0, 0 }, meshTest::Vector{ 6e5, 0, 0 }, meshTest::Vector{ 6e5, 6e6, 0 } })
  {
    Points points;
    Triangles triangles;
    for (const int size : { 1, 2 })
    {
      const auto first = static_cast<vtkIdType>(points.size());
      for (int i = 0; i < (size + 1) * (size + 1); ++i)
      {
        points.push_back({ offset[0] + static_cast<double>(i % (size + 1)) / size,
          offset[1] + static_cast<double>(i / (size + 1)) / size, 0 });
      }
      for (int i = 0; i < size * size; ++i)
      {
        const vtkIdType a = first + i / size * (size + 1) + i % size;
        triangles.push_back({ a, a + 1, a + size + 2 });
        triangles.push_back({ a, a + size + 2, a + size + 1 });
      }
    }
    vtkSmartPointer<vtkPolyData> patches = Mesh(meshTest::MakeSurface(points, triangles), 0.2);
    check.Equal(meshTest::GetArea(patches), 2.0, 1e-6, "sheets in one plane: area");
    check.Equal(GetEulerNumber(patches), 2, 0, "sheets in one plane: Euler number");
  }
}

//------------------------------------------------------------------------------
void TestSheets(meshTest::Checker& check)
{
  const Points points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const Triangles sides = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 2, 1 }, { 0, 3, 2 } };
  vtkSmartPointer<vtkPolyData> sheet = meshTest::MakeSurface(points, sides);
  for (const auto& input : { sheet, MakeSoup(sheet, 0.0) })
  {
    vtkSmartPointer<vtkPolyData> patches = Mesh(input, 0.3);
    check.Equal(meshTest::GetArea(patches), 2.0, 1e-12, "both sides of a sheet");
    check.Equal(GetEulerNumber(patches), 2, 0, "two discs");
  }
}

//------------------------------------------------------------------------------
void TestMoebius(meshTest::Checker& check)
{
  const int size = 24;
  Points points;
  Triangles triangles;
  for (int i = 0; i < size; ++i)
  {
    const double turn = 2.0 * vtkMath::Pi() * i / size;
    for (const double across : { -0.3, 0.3 })
    {
      const double radius = 1.0 + across * std::cos(0.5 * turn);
      points.push_back(
        { radius * std::cos(turn), radius * std::sin(turn), across * std::sin(0.5 * turn) });
    }
    const vtkIdType a = 2 * i;
    const bool last = i + 1 == size;
    const vtkIdType c = last ? 1 : a + 2;
    const vtkIdType d = last ? 0 : a + 3;
    triangles.push_back({ a, c, d });
    triangles.push_back({ a, d, a + 1 });
  }
  vtkSmartPointer<vtkPolyData> band = meshTest::MakeSurface(points, triangles);
  vtkSmartPointer<vtkPolyData> patches = Mesh(band, 0.2);
  check.Equal(meshTest::GetSummary(patches, "NumberOfSeamEdges"), 1, 0, "one seam");
  check.Equal(GetEulerNumber(patches), 1, 0, "a strip");
  check.Equal(meshTest::GetEdges(patches).Bad, 0, 0, "oriented alike");
}

//------------------------------------------------------------------------------
// Two squares beside a rectangle: a corner lies on its long side.
void TestCornerOnEdge(meshTest::Checker& check)
{
  for (const double offset : { 0.0, 6e5 })
  {
    Points points;
    for (const std::array<double, 2>& p : std::vector<std::array<double, 2>>{ { 0, 0 }, { 2, 0 },
           { 2, 1 }, { 0, 1 }, { 0.7, 0 }, { 0, -1 }, { 0.7, -1 }, { 2, -1 } })
    {
      points.push_back({ offset + 0.6 * p[0], offset + 0.8 * p[0], p[1] });
    }
    vtkSmartPointer<vtkPolyData> patches =
      Mesh(meshTest::MakeSurface(points,
             { { 0, 1, 2 }, { 0, 2, 3 }, { 5, 6, 4 }, { 5, 4, 0 }, { 6, 7, 1 }, { 6, 1, 4 } }),
        0.3);
    check.Equal(GetEulerNumber(patches), 1, 0, "corner on an edge: one disc");
    check.Equal(meshTest::GetArea(patches), 4.0, 1e-8, "corner on an edge: area");
    check.Equal(meshTest::GetSummary(patches, "NumberOfSplitEdges"), 1, 0, "split");
  }
}

//------------------------------------------------------------------------------
void TestPolygons(meshTest::Checker& check)
{
  struct Case
  {
    Points Corners;
    std::vector<vtkIdType> Polygon;
    double Area;
    double Skipped;
  };
  const Points holed = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 0, 3, 0 }, { 1, 1, 0 },
    { 1, 2, 0 }, { 2, 2, 0 }, { 2, 1, 0 } };
  const Case cases[] = { { holed, { 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 }, 8.0, 0 },
    // A spike, and a corner that repeats.
    { holed, { 0, 1, 2, 2, 3, 5, 3 }, 9.0, 0 },
    // The border crosses itself.
    { { { 0, 0, 0 }, { 2, 2, 0 }, { 2, 0, 0 }, { 0, 1, 0 } }, { 0, 1, 2, 3 }, 0.0, 1 } };
  for (const Case& one : cases)
  {
    Points points = one.Corners;
    for (const double x : { 5.0, 6.0 })
    {
      points.push_back({ x, 0, 0 });
    }
    points.push_back({ 5, 1, 0 });
    const auto last = static_cast<vtkIdType>(points.size());
    vtkSmartPointer<vtkPolyData> input =
      meshTest::MakeSurface(points, { { last - 3, last - 2, last - 1 } });
    input->GetPolys()->InsertNextCell(static_cast<vtkIdType>(one.Polygon.size()),
      one.Polygon.data());
    vtkSmartPointer<vtkPolyData> patches = Mesh(input, 0.5);
    check.Equal(meshTest::GetArea(patches), one.Area + 0.5, 1e-9, "polygon: area");
    check.Equal(meshTest::GetSummary(patches, "NumberOfSkippedPolygons"), one.Skipped, 0,
      "skipped");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherJoining(int, char*[])
{
  meshTest::Checker check;
  TestTouchingBoxes(check);
  TestWelding(check);
  TestRelativeNoise(check);
  TestLooseTriangles(check);
  TestSheetsInOnePlane(check);
  TestSheets(check);
  TestMoebius(check);
  TestCornerOnEdge(check);
  TestPolygons(check);
  return check.GetExitCode();
}
