// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Defects are repaired, and what is no defect is left alone.
#include "MeshTestTools.h"

#include "vtkCubeSource.h"
#include "vtkIntArray.h"
#include "vtkReverseSense.h"
#include "vtkTriangleFilter.h"

namespace
{
const std::vector<meshTest::Vector> CUBE_POINTS = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
  { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
// Outward.
const std::vector<std::array<vtkIdType, 3>> CUBE_TRIANGLES = { { 0, 2, 1 }, { 0, 3, 2 },
  { 4, 5, 6 }, { 4, 6, 7 }, { 0, 1, 5 }, { 0, 5, 4 }, { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 7 },
  { 2, 7, 6 }, { 3, 0, 4 }, { 3, 4, 7 } };

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Mesh(vtkPolyData* input, bool flip = false)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(input);
  mesher->SetTargetEdgeLength(0.25);
  mesher->SetFlipNormals(flip);
  mesher->Update();
  return mesher->GetOutput();
}

//------------------------------------------------------------------------------
// A consistent surface keeps its orientation, outward or inward: a room's walls face inward.
void TestOrientationIsKept(meshTest::Checker& check)
{
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkReverseSense> room;
  room->SetInputConnection(cube->GetOutputPort());
  room->Update();
  check.Equal(meshTest::GetVolume(Mesh(cube->GetOutput())), 1.0, 1e-12, "box");
  check.Equal(meshTest::GetVolume(Mesh(cube->GetOutput(), true)), -1.0, 1e-12, "flipped box");
  check.Equal(meshTest::GetVolume(Mesh(room->GetOutput())), -1.0, 1e-12, "room");
  check.Equal(meshTest::GetVolume(Mesh(room->GetOutput(), true)), 1.0, 1e-12, "flipped room");
  check.Equal(meshTest::GetSummary(Mesh(room->GetOutput()), "NumberOfReversedTriangles"), 0, 0,
    "reversed");
}

//------------------------------------------------------------------------------
// The first triangle is a wrong one, so orienting from it would turn all others; in a box and in a
// room, which defects of the other must not touch.
void TestReversedTriangles(meshTest::Checker& check)
{
  std::vector<meshTest::Vector> points = CUBE_POINTS;
  std::vector<std::array<vtkIdType, 3>> triangles = CUBE_TRIANGLES;
  std::swap(triangles[0][1], triangles[0][2]);
  std::swap(triangles[5][1], triangles[5][2]);
  const double roomSize = 8.0;
  for (const meshTest::Vector& p : CUBE_POINTS)
  {
    points.push_back({ roomSize * p[0] - 3.0, roomSize * p[1] - 3.0, roomSize * p[2] - 3.0 });
  }
  for (const auto& t : CUBE_TRIANGLES)
  {
    triangles.push_back({ t[0] + 8, t[2] + 8, t[1] + 8 });
  }
  vtkSmartPointer<vtkPolyData> patches = Mesh(meshTest::MakeSurface(points, triangles));
  check.Equal(meshTest::GetVolume(patches), 1.0 - 512.0, 1e-9, "box in a room: volume");
  check.True(meshTest::IsClosed(patches), "box in a room: closed");
  check.Equal(meshTest::GetSummary(patches, "NumberOfReversedTriangles"), 2, 0, "reversed");
  check.Equal(meshTest::GetSummary(patches, "NumberOfSplitPoints"), 0, 0, "split");
}

//------------------------------------------------------------------------------
// The majority goes by area: one large triangle against many small ones.
void TestMajorityByArea(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> patches =
    Mesh(meshTest::MakeSurface({ { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 9, 1, 0 }, { 8, 2, 0 } },
      { { 1, 2, 3 }, { 0, 1, 2 }, { 2, 3, 4 } }));
  double up = 0.0;
  for (vtkIdType i = 0; i < patches->GetNumberOfCells(); ++i)
  {
    up += meshTest::GetAreaVector(patches, i)[2];
  }
  check.Equal(up, meshTest::GetArea(patches), 1e-12, "all patches face up");
}

//------------------------------------------------------------------------------
void TestDegenerateAndDuplicateTriangles(meshTest::Checker& check)
{
  std::vector<meshTest::Vector> points = CUBE_POINTS;
  std::vector<std::array<vtkIdType, 3>> triangles = CUBE_TRIANGLES;
  // A needle between the two triangles at an edge of the cube: (0, 3, 2) keeps its long side and
  // (2, 3, 7) meets the needle's two short sides instead.
  points.push_back({ 0.5, 1.0, 0.0 });
  points.push_back({ 0.25, 1.0, 0.0 });
  triangles[8] = { 8, 3, 7 };
  triangles.push_back({ 2, 8, 7 });
  triangles.push_back({ 2, 3, 8 });
  // Repeated points, a copy, a reversed copy, and a needle on its own.
  triangles.push_back({ 4, 4, 5 });
  triangles.push_back({ 5, 6, 4 });
  triangles.push_back({ 4, 6, 5 });
  triangles.push_back({ 0, 0, 0 });
  vtkSmartPointer<vtkPolyData> surface = meshTest::MakeSurface(points, triangles);
  vtkNew<vtkIntArray> region;
  region->SetName("Region");
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    region->InsertNextValue(i < 2 ? 1 : 0);
  }
  surface->GetCellData()->AddArray(region);

  vtkSmartPointer<vtkPolyData> patches = Mesh(surface);
  check.Equal(meshTest::GetArea(patches), 6.0, 6e-12, "needles: area");
  check.Equal(meshTest::GetVolume(patches), 1.0, 1e-12, "needles: volume");
  check.True(meshTest::IsClosed(patches), "needles: closed");
  check.Equal(meshTest::GetAreas(patches, "Region")[1], 1.0, 1e-12, "needles: area of a region");
  check.Equal(meshTest::GetSummary(patches, "NumberOfDroppedTriangles"), 5, 0, "dropped");
  check.Equal(meshTest::GetSummary(patches, "NumberOfSplitPoints"), 0, 0, "split");
}

//------------------------------------------------------------------------------
// Two cubes that share an edge, and a third that shares a corner: three surfaces afterwards.
void TestNonManifold(meshTest::Checker& check)
{
  std::vector<meshTest::Vector> points;
  std::vector<std::array<vtkIdType, 3>> triangles;
  const std::vector<meshTest::Vector> shifts = { { 0, 0, 0 }, { 1, 1, 0 }, { 2, 2, 1 } };
  for (const meshTest::Vector& shift : shifts)
  {
    const vtkIdType first = static_cast<vtkIdType>(points.size());
    for (const meshTest::Vector& p : CUBE_POINTS)
    {
      points.push_back({ p[0] + shift[0], p[1] + shift[1], p[2] + shift[2] });
    }
    for (const auto& t : CUBE_TRIANGLES)
    {
      triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
    }
  }
  std::swap(triangles[20][0], triangles[20][1]);
  vtkSmartPointer<vtkPolyData> patches = Mesh(meshTest::MakeSurface(points, triangles));
  check.Equal(meshTest::GetArea(patches), 18.0, 2e-11, "three cubes: area");
  check.Equal(meshTest::GetVolume(patches), 3.0, 1e-11, "three cubes: volume");
  check.Equal(meshTest::GetEdges(patches).Bad, 0, 0, "three cubes: bad edges");
  check.Equal(meshTest::GetSummary(patches, "NumberOfReversedTriangles"), 1, 0, "reversed");
  check.True(meshTest::GetSummary(patches, "NumberOfSplitPoints") >= 3, "split points");
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherRepair(int, char*[])
{
  meshTest::Checker check;
  TestOrientationIsKept(check);
  TestReversedTriangles(check);
  TestMajorityByArea(check);
  TestDegenerateAndDuplicateTriangles(check);
  TestNonManifold(check);
  return check.GetExitCode();
}
