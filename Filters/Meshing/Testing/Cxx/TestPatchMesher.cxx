// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mesher must keep: shape, regions, arrays, orientation; and the size of the patches.
#include "MeshTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkStripper.h"
#include "vtkUnsignedCharArray.h"

namespace
{
//------------------------------------------------------------------------------
// A unit cube whose six faces are six cells with unlike values, and a linear point array.
vtkSmartPointer<vtkPolyData> MakeCube()
{
  vtkNew<vtkCubeSource> source;
  source->SetCenter(0.5, 0.5, 0.5);
  source->Update();
  auto cube = vtkSmartPointer<vtkPolyData>::New();
  cube->ShallowCopy(source->GetOutput());

  vtkNew<vtkIntArray> region;
  region->SetName("Region");
  vtkNew<vtkDoubleArray> temperature;
  temperature->SetName("Temperature");
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("Color");
  color->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> name;
  name->SetName("Name");
  for (int i = 0; i < 6; ++i)
  {
    region->InsertNextValue(10 * i);
    temperature->InsertNextValue(300.0 + 0.1 * i);
    color->InsertNextTuple3(i, 2 * i, 255 - i);
    name->InsertNextValue("face " + std::to_string(i));
  }
  cube->GetCellData()->AddArray(region);
  cube->GetCellData()->AddArray(temperature);
  cube->GetCellData()->SetScalars(color);
  cube->GetCellData()->AddArray(name);

  vtkNew<vtkDoubleArray> linear;
  linear->SetName("Linear");
  for (vtkIdType i = 0; i < cube->GetNumberOfPoints(); ++i)
  {
    const meshTest::Vector p = meshTest::GetPoint(cube, i);
    linear->InsertNextValue(p[0] + 2.0 * p[1] - 3.0 * p[2]);
  }
  cube->GetPointData()->AddArray(linear);
  return cube;
}

//------------------------------------------------------------------------------
void TestTwice(vtkPatchMesher* mesher, meshTest::Checker& check)
{
  vtkPolyData* patches = mesher->GetOutput();
  vtkNew<vtkPolyData> first;
  first->DeepCopy(patches);
  mesher->Modified();
  mesher->Update();
  bool same = patches->GetNumberOfPoints() == first->GetNumberOfPoints();
  for (vtkIdType i = 0; same && i < first->GetNumberOfPoints(); ++i)
  {
    same = meshTest::GetPoint(patches, i) == meshTest::GetPoint(first, i);
  }
  check.True(same, "the same input gives the same output");
}

//------------------------------------------------------------------------------
void TestCube(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> cube = MakeCube();
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(cube);
  mesher->SetTargetEdgeLength(0.1);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  const vtkIdType size = patches->GetNumberOfCells();

  check.Equal(meshTest::GetArea(patches), 6.0, 6e-12, "area of the cube");
  check.Equal(meshTest::GetVolume(patches), 1.0, 1e-12, "volume of the cube");
  check.True(meshTest::IsClosed(patches), "the cube is closed");
  check.True(patches->GetNumberOfPolys() == size, "only polygons");
  // Euler: V - 3/2 F + F = 2.
  check.Equal(patches->GetNumberOfPoints() - 0.5 * size, 2.0, 0.0, "Euler characteristic");
  const std::map<int, double> areas = meshTest::GetAreas(patches, "Region");
  check.Equal(areas.size(), 6, 0, "number of regions");
  for (const auto& area : areas)
  {
    check.Equal(area.second, 1.0, 1e-12, "area of region " + std::to_string(area.first));
  }
  // Equilateral triangles of side 0.1 would be 1386.
  check.True(size > 1000 && size < 2000, "number of patches: " + std::to_string(size));
  const meshTest::Edges edges = meshTest::GetEdges(patches);
  check.Equal(edges.Mean, 0.1, 0.015, "mean edge length");
  check.True(edges.Shortest > 0.04, "shortest edge " + std::to_string(edges.Shortest));
  check.True(edges.Longest < 0.17, "longest edge " + std::to_string(edges.Longest));

  auto ids =
    vtkIdTypeArray::SafeDownCast(patches->GetCellData()->GetAbstractArray("OriginalCellIds"));
  check.True(ids && ids->GetNumberOfTuples() == size, "OriginalCellIds");
  check.Equal(patches->GetCellData()->GetNumberOfArrays(), 5, 0, "number of cell arrays");
  check.True(patches->GetCellData()->GetScalars() != nullptr, "active scalars stay active");
  for (int a = 0; ids && a < cube->GetCellData()->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* from = cube->GetCellData()->GetAbstractArray(a);
    vtkAbstractArray* to = patches->GetCellData()->GetAbstractArray(from->GetName());
    const int components = from->GetNumberOfComponents();
    bool same = to && to->GetDataType() == from->GetDataType() &&
      to->GetNumberOfComponents() == components && to->GetNumberOfTuples() == size;
    for (vtkIdType i = 0; same && i < size * components; ++i)
    {
      const vtkIdType cell = ids->GetValue(i / components);
      same = to->GetVariantValue(i) == from->GetVariantValue(cell * components + i % components);
    }
    check.True(same, std::string("cell array ") + from->GetName());
  }
  for (vtkIdType i = 0; ids && i < size; ++i)
  {
    const meshTest::Vector n = meshTest::GetAreaVector(patches, i);
    const meshTest::Vector m = meshTest::GetAreaVector(cube, ids->GetValue(i));
    const double cosine = vtkMath::Dot(n.data(), m.data()) / vtkMath::Norm(n.data());
    check.Equal(cosine, 1.0, 1e-12, "normal of patch " + std::to_string(i));
  }

  vtkDataArray* linear = patches->GetPointData()->GetArray("Linear");
  check.True(linear != nullptr, "point array");
  check.True(patches->GetPointData()->GetNormals() == nullptr, "no point normals");
  for (vtkIdType i = 0; linear && i < patches->GetNumberOfPoints(); ++i)
  {
    const meshTest::Vector p = meshTest::GetPoint(patches, i);
    check.Equal(linear->GetTuple1(i), p[0] + 2.0 * p[1] - 3.0 * p[2], 1e-12, "linear point array");
  }

  check.Equal(meshTest::GetSummary(patches, "NumberOfPatches"), size, 0, "NumberOfPatches");
  check.Equal(meshTest::GetSummary(patches, "TargetEdgeLength"), 0.1, 0, "TargetEdgeLength");
  for (const char* name :
    { "NumberOfDroppedTriangles", "NumberOfReversedTriangles", "NumberOfSplitPoints" })
  {
    check.Equal(meshTest::GetSummary(patches, name), 0, 0, name);
  }
  TestTwice(mesher, check);
}

//------------------------------------------------------------------------------
void TestFeatureAngleAndDefaults(meshTest::Checker& check)
{
  vtkSmartPointer<vtkPolyData> cube = MakeCube();
  cube->GetCellData()->RemoveArray("Region");
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(cube);
  mesher->Update();
  check.Equal(meshTest::GetSummary(mesher->GetOutput(), "TargetEdgeLength"), std::sqrt(3.0) / 50.0,
    1e-15, "default TargetEdgeLength");
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 6.0, 6e-12, "sharp edges are kept");

  vtkNew<vtkPatchMesher> coarser;
  coarser->SetInputConnection(mesher->GetOutputPort());
  coarser->SetTargetEdgeLength(0.3);
  coarser->SetFeatureAngle(120.0);
  coarser->Update();
  const double area = meshTest::GetArea(coarser->GetOutput());
  check.True(area < 5.999, "edges below the angle are not kept: area " + std::to_string(area));
  check.True(meshTest::IsClosed(coarser->GetOutput()), "the rounded cube is closed");
  mesher->SetTargetEdgeLength(0.15);
  mesher->SetFeatureAngle(89.0);
  mesher->Update();
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 6.0, 6e-12, "edges above the angle are kept");
  mesher->SetFeatureAngle(0.0);
  mesher->Update();
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 6.0, 6e-12, "angle 0");
}

//------------------------------------------------------------------------------
// Regions on a plane: nothing but the array tells them apart.
void TestRegions(meshTest::Checker& check)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetXResolution(3);
  plane->SetYResolution(2);
  plane->Update();
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(plane->GetOutput());
  vtkNew<vtkStringArray> material;
  material->SetName("Material");
  vtkNew<vtkIntArray> number;
  number->SetName("Number");
  for (int i = 0; i < 6; ++i)
  {
    material->InsertNextValue(i == 0 || i == 5 ? "brass" : "steel");
    number->InsertNextValue(i == 0 || i == 5);
  }
  input->GetCellData()->AddArray(material);
  input->GetCellData()->AddArray(number);

  std::map<int, double> before = meshTest::GetAreas(input, "Number");

  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(input);
  mesher->SetTargetEdgeLength(0.07);
  for (const char* name : { "Material", "Number" })
  {
    mesher->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, name);
    mesher->Update();
    std::map<int, double> areas = meshTest::GetAreas(mesher->GetOutput(), "Number");
    check.Equal(areas[0], before[0], 1e-12, std::string("area of steel by ") + name);
    check.Equal(areas[1], before[1], 1e-12, std::string("area of brass by ") + name);
    check.Equal(meshTest::GetEdges(mesher->GetOutput()).Bad, 0, 0, "bad edges");
  }
  vtkNew<vtkPolyData> withDefault;
  withDefault->ShallowCopy(input);
  vtkNew<vtkIntArray> region;
  region->DeepCopy(number);
  region->SetName("Region");
  withDefault->GetCellData()->AddArray(region);
  mesher->SetInputData(withDefault);
  mesher->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "");
  mesher->Update();
  check.Equal(meshTest::GetAreas(mesher->GetOutput(), "Number")[1], before[1], 1e-12,
    "an empty name stands for Region");

  mesher->SetInputData(input);
  mesher->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Region");
  mesher->Update();
  std::map<int, double> areas = meshTest::GetAreas(mesher->GetOutput(), "Number");
  check.True(std::abs(areas[0] - before[0]) > 1e-6, "without regions nothing is kept");
  check.Equal(areas[0] + areas[1], 1.0, 1e-12, "area of the plane");
}

//------------------------------------------------------------------------------
// Strips, a polygon that is not convex, vertices and lines before them, and a ghost cell.
void TestCellTypes(meshTest::Checker& check)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(stripper->GetOutputPort());
  mesher->SetTargetEdgeLength(0.05);
  mesher->SetRepair(false);
  mesher->Update();
  check.True(stripper->GetOutput()->GetNumberOfStrips() > 0, "the input has strips");
  check.True(meshTest::IsClosed(mesher->GetOutput()), "strips: closed");
  check.Equal(meshTest::GetVolume(mesher->GetOutput()), meshTest::GetVolume(sphere->GetOutput()),
    0.02, "strips: volume");

  vtkSmartPointer<vtkPolyData> shape =
    meshTest::MakeSurface({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 },
                            { 0, 2, 0 }, { 5, 5, 5 }, { 6, 5, 5 } },
      {});
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 6 });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 6, 7 });
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 6 });
  polygons->InsertNextCell({ 0, 1, 2, 3, 4, 5 });
  shape->SetVerts(vertices);
  shape->SetLines(lines);
  shape->SetPolys(polygons);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (const int ghost : { 0, 0, 1, 0 })
  {
    ghosts->InsertNextValue(ghost ? vtkDataSetAttributes::DUPLICATECELL : 0);
  }
  shape->GetCellData()->AddArray(ghosts);
  mesher->SetInputDataObject(shape);
  mesher->SetTargetEdgeLength(0.3);
  mesher->Update();
  check.Equal(meshTest::GetArea(mesher->GetOutput()), 3.0, 1e-12, "polygon: area");
  check.Equal(meshTest::GetAreaVector(mesher->GetOutput(), 0)[2] > 0.0, 1, 0, "polygon: normal");
  vtkDataArray* ids = mesher->GetOutput()->GetCellData()->GetArray("OriginalCellIds");
  check.Equal(ids->GetRange()[0], 3, 0, "polygon: smallest original id");
  check.Equal(ids->GetRange()[1], 3, 0, "polygon: largest original id");
}

//------------------------------------------------------------------------------
// Polygons with points on their sides and one with a notch, in planes that are not axis-aligned.
void TestPolygons(meshTest::Checker& check)
{
  const std::vector<std::vector<std::array<double, 2>>> shapes = {
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 0, 2 }, { 0, 1 } },
    { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 0.001 }, { 0, 4 } }, { { 0, 0 }, { 3, 0 }, { 0, 3 } }
  };
  const std::vector<double> areas = { 4.0, 8.002, 4.5 };
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    std::vector<meshTest::Vector> points;
    for (const auto& p : shapes[i])
    {
      points.push_back({ 0.6 * p[0] + 7.0, 0.8 * p[0], p[1] - 9.0 });
    }
    vtkSmartPointer<vtkPolyData> shape = meshTest::MakeSurface(points, {});
    shape->GetPolys()->InsertNextCell(static_cast<int>(points.size()));
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      shape->GetPolys()->InsertCellPoint(static_cast<vtkIdType>(j));
    }
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputData(shape);
    mesher->SetRepair(false);
    mesher->SetTargetEdgeLength(0.3);
    mesher->Update();
    meshTest::Vector sum{ 0.0, 0.0, 0.0 };
    for (vtkIdType cell = 0; cell < mesher->GetOutput()->GetNumberOfCells(); ++cell)
    {
      const meshTest::Vector area = meshTest::GetAreaVector(mesher->GetOutput(), cell);
      vtkMath::Add(sum.data(), area.data(), sum.data());
    }
    const std::string name = "polygon " + std::to_string(i);
    check.Equal(meshTest::GetArea(mesher->GetOutput()), areas[i], 1e-12, name + ": area");
    check.Equal(sum[0], 0.8 * areas[i], 1e-12, name + ": x of the normal");
    check.Equal(sum[1], -0.6 * areas[i], 1e-12, name + ": y of the normal");
  }
}

//------------------------------------------------------------------------------
void TestBunny(const std::string& file, meshTest::Checker& check)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(reader->GetOutputPort());
  mesher->SetTargetEdgeLength(0.2);
  mesher->Update();
  const double area = meshTest::GetArea(reader->GetOutput());
  const double volume = meshTest::GetVolume(reader->GetOutput());
  check.True(meshTest::IsClosed(mesher->GetOutput()), "the bunny is closed");
  check.Equal(meshTest::GetArea(mesher->GetOutput()) / area, 1.0, 0.01, "area of the bunny");
  check.Equal(meshTest::GetVolume(mesher->GetOutput()) / volume, 1.0, 0.01, "volume of the bunny");
}

//------------------------------------------------------------------------------
void TestAbort(meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(MakeCube());
  mesher->SetTargetEdgeLength(0.02);
  double stoppedAt = 0.0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&stoppedAt);
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto algorithm = static_cast<vtkAlgorithm*>(caller);
      double* progress = static_cast<double*>(data);
      if (algorithm->GetProgress() <= 0.2 || *progress > 0.0)
      {
        return;
      }
      *progress = algorithm->GetProgress();
      algorithm->SetAbortExecute(1);
    });
  mesher->AddObserver(vtkCommand::ProgressEvent, stop);
  mesher->Update();
  check.True(stoppedAt > 0.2 && stoppedAt < 0.5, "stopped while remeshing");
  check.Equal(mesher->GetOutput()->GetNumberOfCells(), 0, 0, "no output after an abort");
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesher(int argc, char* argv[])
{
  meshTest::Checker check;
  TestCube(check);
  TestFeatureAngleAndDefaults(check);
  TestRegions(check);
  TestCellTypes(check);
  TestPolygons(check);
  TestBunny(meshTest::GetDataFile(argc, argv, "bunny.ply"), check);
  TestAbort(check);
  return check.GetExitCode();
}
