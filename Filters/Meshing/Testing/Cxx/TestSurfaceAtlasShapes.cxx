// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Atlases of shapes of every kind of topology and size: the argument is the name of a group.
#include "LongTriangles.h"
#include "SurfaceAtlasChecks.h"

#include "vtkAppendPolyData.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkTriangleFilter.h"

namespace
{
using atlasTest::Surface;
using meshTest::Checker;
using meshTest::Vector;

//------------------------------------------------------------------------------
Surface Make(vtkPolyDataAlgorithm* source)
{
  source->Update();
  return source->GetOutput();
}

//------------------------------------------------------------------------------
Surface Triangulate(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  return Make(triangles);
}

//------------------------------------------------------------------------------
// A copy in double precision.
template <typename Map>
Surface Transform(vtkPolyData* mesh, const Map& map)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(map(meshTest::GetPoint(mesh, i)).data());
  }
  auto result = Surface::New();
  result->SetPoints(points);
  result->SetPolys(mesh->GetPolys());
  return result;
}

//------------------------------------------------------------------------------
Surface Scale(vtkPolyData* mesh, double scale, double shift)
{
  return Transform(mesh,
    [=](const Vector& p) {
      return Vector{ scale * p[0] + shift, scale * p[1] - shift, scale * p[2] + shift };
    });
}

//------------------------------------------------------------------------------
Surface Append(const std::vector<Surface>& parts)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const Surface& part : parts)
  {
    append->AddInputData(part);
  }
  return Make(append);
}

//------------------------------------------------------------------------------
Surface Reverse(vtkPolyData* mesh)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(mesh);
  reverse->ReverseCellsOn();
  return Make(reverse);
}

//------------------------------------------------------------------------------
Surface MakeSphere(int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution / 2);
  return Make(source);
}

//------------------------------------------------------------------------------
Surface MakePlane(int columns, int rows, double width)
{
  vtkNew<vtkPlaneSource> source;
  source->SetPoint2(0.0, width, 0.0);
  source->SetOrigin(0.0, 0.0, 0.0);
  source->SetPoint1(1.0, 0.0, 0.0);
  source->SetResolution(columns, rows);
  return Make(source);
}

//------------------------------------------------------------------------------
Surface MakeCylinder()
{
  vtkNew<vtkCylinderSource> source;
  source->SetResolution(24);
  source->CappingOff();
  return Make(source);
}

//------------------------------------------------------------------------------
Surface MakeTorus(double thickness)
{
  return Transform(Triangulate(MakePlane(60, 30, 1.0)),
    [thickness](const Vector& p)
    {
      // Exactly the same coordinates where the grid closes.
      const double u = 2.0 * vtkMath::Pi() * (p[0] == 1.0 ? 0.0 : p[0]);
      const double v = 2.0 * vtkMath::Pi() * (p[1] == 1.0 ? 0.0 : p[1]);
      const double radius = 1.0 + thickness * std::cos(v);
      return Vector{ radius * std::cos(u), radius * std::sin(u), thickness * std::sin(v) };
    });
}

//------------------------------------------------------------------------------
// A strip with half a twist that does not quite close: its ends only nearly meet.
Surface MakeTwistedStrip()
{
  return Transform(Triangulate(MakePlane(80, 8, 0.4)),
    [](const Vector& p)
    {
      const double angle = 6.0 * p[0];
      const double across = p[1] - 0.2;
      const double radius = 1.0 + across * std::cos(0.5 * angle);
      return Vector{ radius * std::cos(angle), radius * std::sin(angle),
        across * std::sin(0.5 * angle) };
    });
}

//------------------------------------------------------------------------------
// The surface, as quadrangles, of unit cubes at the places of letters in a text plan.
Surface MakeCubes(const std::vector<std::string>& plan)
{
  const auto isFull = [&plan](int x, int y, int z)
  {
    return z == 0 && y >= 0 && y < static_cast<int>(plan.size()) && x >= 0 &&
      x < static_cast<int>(plan[y].size()) && plan[y][x] == '#';
  };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (int y = 0; y < static_cast<int>(plan.size()); ++y)
  {
    for (int x = 0; x < static_cast<int>(plan[y].size()); ++x)
    {
      for (int side = 0; isFull(x, y, 0) && side < 6; ++side)
      {
        const int axis = side / 2;
        const int sign = side % 2;
        const int step = 2 * sign - 1;
        if (isFull(x + (axis == 0 ? step : 0), y + (axis == 1 ? step : 0), axis == 2 ? step : 0))
        {
          continue;
        }
        cells->InsertNextCell(4);
        for (int corner = 0; corner < 4; ++corner)
        {
          const int turn = sign ? corner : 3 - corner;
          Vector p{ 1.0 * x, 1.0 * y, 0.0 };
          p[axis] += sign;
          p[(axis + 1) % 3] += turn == 1 || turn == 2;
          p[(axis + 2) % 3] += turn >= 2;
          cells->InsertCellPoint(points->InsertNextPoint(p.data()));
        }
      }
    }
  }
  auto result = Surface::New();
  result->SetPoints(points);
  result->SetPolys(cells);
  return result;
}

//------------------------------------------------------------------------------
// Columns x rows of a plane, without the cells at some places.
Surface MakePlate(int columns, int rows, const std::vector<std::array<int, 2>>& holes)
{
  Surface plane = MakePlane(columns, rows, 0.8);
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < plane->GetNumberOfCells(); ++cell)
  {
    const std::array<int, 2> place{ static_cast<int>(cell) % columns,
      static_cast<int>(cell) / columns };
    if (std::count(holes.begin(), holes.end(), place) == 0)
    {
      vtkIdType size;
      const vtkIdType* ids;
      plane->GetCellPoints(cell, size, ids);
      cells->InsertNextCell(size, ids);
    }
  }
  auto result = Surface::New();
  result->SetPoints(plane->GetPoints());
  result->SetPolys(cells);
  return result;
}

//------------------------------------------------------------------------------
Surface MakeTetrahedron()
{
  return meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } });
}

//------------------------------------------------------------------------------
Surface MakeCubeOfTriangles()
{
  vtkNew<vtkCubeSource> source;
  return Triangulate(Make(source));
}

//------------------------------------------------------------------------------
// Seen from inside, with a table, a bench and a ball in it.
Surface MakeRoom()
{
  return Append(
    { Reverse(Scale(MakeCubes({ "###", "###" }), 4.0, 0.0)), Scale(MakeCubes({ "##" }), 1.0, 1.25),
      Scale(MakeCubes({ "#" }), 0.8, 5.5), Scale(MakeSphere(24), 0.9, 3.5) });
}

//------------------------------------------------------------------------------
// Each triangle that is long in two sides becomes a ladder: 2 k - 1 triangles where its sides have
// k pieces. A few more come from corners of charts.
void CheckLadders(const std::string& what, vtkPolyData* input, double ladders, double pieces,
  double stretch, Checker& check)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputData(input);
  atlas->SetResolution(64);
  atlas->TexelMapsOff();
  atlas->Update();
  vtkPolyData* output = atlas->GetOutput();
  const double least = ladders * (2.0 * pieces - 1.0);
  const double triangles = static_cast<double>(output->GetNumberOfCells());
  check.SetSubject(what);
  check.True(triangles >= least && triangles <= 1.1 * least,
    std::to_string(triangles) + " triangles of " + std::to_string(least));
  const double area = meshTest::GetArea(input);
  check.Equal(meshTest::GetArea(output), area, 1e-12 * area, "area");
  std::cout << what << ": stretch " << meshTest::GetSummary(output, "L2Stretch") << "\n";
  check.Equal(meshTest::GetSummary(output, "L2Stretch"), 1.0, stretch - 1.0, "stretch");
}

//------------------------------------------------------------------------------
void TestLong(Checker& check)
{
  CheckLadders("rod 100:2", meshTest::MakeRod(64, 100.0), 128.0, 64.0, 1.05, check);
  CheckLadders("rod 100:2 far away", Scale(meshTest::MakeRod(16, 100.0), 1.0, 6e6), 32.0, 64.0, 2.3,
    check);
  CheckLadders("rod 20:2", meshTest::MakeRod(64, 20.0), 128.0, 64.0, 1.3, check);
  CheckLadders("fan", meshTest::MakeFan(500), 500.0, 16.0, 1.1, check);
  CheckLadders("strip 10000:1", MakePlane(1, 1, 1e-4), 2.0, 64.0, 11.0, check);
}

//------------------------------------------------------------------------------
void TestBoxes(Checker& check)
{
  using atlasTest::CheckAtlas;
  CheckAtlas("cube of 12 triangles", MakeCubeOfTriangles(), 256, { 1.12, 0.998, 1.0 }, check);
  CheckAtlas("cube", MakeCubes({ "#" }), 256, { 1.12, 0.998, 1.0 }, check);
  CheckAtlas("room", MakeRoom(), 512, { 1.16, 0.998, 1.0 }, check);
  CheckAtlas("tetrahedron", MakeTetrahedron(), 128, { 1.18, 0.998, 1.0 }, check);
}

//------------------------------------------------------------------------------
void TestHandles(Checker& check)
{
  using atlasTest::CheckAtlas;
  CheckAtlas("torus", MakeTorus(0.4), 256, { 1.13, 0.995, 1.0 }, check);
  CheckAtlas("ring", MakeTorus(0.05), 256, { 1.48, 0.96, 1.0 }, check);
  CheckAtlas("genus 2", MakeCubes({ "#####", "#.#.#", "#####" }), 512, { 1.15, 0.995, 1.0 }, check);
  CheckAtlas("genus 6", MakeCubes({ "#######", "#.#.#.#", "#######", "#.#.#.#", "#######" }), 512,
    { 1.2, 0.99, 1.0 }, check);
}

//------------------------------------------------------------------------------
void TestOpen(Checker& check)
{
  using atlasTest::CheckAtlas;
  CheckAtlas("triangle",
    meshTest::MakeSurface({ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } }), 128,
    { 1.1, 0.998, 1.0 }, check);
  CheckAtlas("two triangles",
    meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 1 } },
      { { 0, 1, 2 }, { 0, 2, 3 } }),
    128, { 1.06, 0.998, 1.0 }, check);
  CheckAtlas("plane", MakePlane(30, 20, 1.0), 256, { 1.001, 0.998, 1.0 }, check);
  CheckAtlas("cylinder", MakeCylinder(), 256, { 1.05, 0.998, 1.0 }, check);
  CheckAtlas("three holes", MakePlate(20, 16, { { 4, 4 }, { 10, 11 }, { 14, 5 } }), 256,
    { 1.12, 0.998, 1.0 }, check);
  CheckAtlas("twisted strip", MakeTwistedStrip(), 256, { 1.06, 0.998, 1.0 }, check);
}

//------------------------------------------------------------------------------
void TestThin(Checker& check)
{
  using atlasTest::CheckAtlas;
  const auto thin = [](const Vector& p) { return Vector{ p[0], 0.1 * p[1], 0.1 * p[2] }; };
  CheckAtlas("wire", Transform(MakeCubes({ "#" }), thin), 512, { 1.2, 0.998, 1.0 }, check);
  CheckAtlas("tape", MakePlane(1, 1, 0.1), 256, { 1.21, 0.998, 1.0 }, check);
}

//------------------------------------------------------------------------------
void TestTiny(Checker& check)
{
  using atlasTest::CheckAtlas;
  CheckAtlas("sphere, small part", Append({ MakeSphere(60), Scale(MakeTetrahedron(), 1e-4, 2.0) }),
    512, { 1.13, 0.998, 1.0 }, check);
  CheckAtlas("100 cubes", MakeCubes(std::vector<std::string>(19, "#.#.#.#.#.#.#.#.#.#")), 512,
    { 1.26, 0.99, 1.0 }, check);
}

//------------------------------------------------------------------------------
void TestScales(Checker& check)
{
  using atlasTest::CheckAtlas;
  Surface sphere = MakeSphere(60);
  CheckAtlas("sphere", sphere, 256, { 1.11, 0.998, 1.0 }, check);
  CheckAtlas("sphere x 1e-9", Scale(sphere, 1e-9, 0.0), 256, { 1.11, 0.998, 1.0 }, check);
  CheckAtlas("sphere x 1e9", Scale(sphere, 1e9, 0.0), 256, { 1.11, 0.998, 1.0 }, check);
  CheckAtlas("sphere + 1e6", Scale(sphere, 1.0, 1e6), 256, { 1.11, 0.998, 1.0 }, check);
}
} // namespace

//------------------------------------------------------------------------------
int TestSurfaceAtlasShapes(int argc, char* argv[])
{
  const std::map<std::string, void (*)(Checker&)> groups = { { "Boxes", TestBoxes },
    { "Handles", TestHandles }, { "Long", TestLong }, { "Open", TestOpen }, { "Thin", TestThin },
    { "Tiny", TestTiny }, { "Scales", TestScales } };
  Checker check;
  const auto group = argc > 1 ? groups.find(argv[1]) : groups.end();
  check.True(group != groups.end(), "the name of a group");
  if (group != groups.end())
  {
    group->second(check);
  }
  return check.GetExitCode();
}
