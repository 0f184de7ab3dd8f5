// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Several blocks are one scene, and small components keep their shape.
#include "MeshTestTools.h"

#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnstructuredGrid.h"

namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(double radius, double x, double y = 0.0)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->SetRadius(radius);
  sphere->SetCenter(x, y, 0.0);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->Update();
  vtkSmartPointer<vtkPolyData> copy = sphere->GetOutput();
  copy->GetPointData()->Initialize();
  return copy;
}

//------------------------------------------------------------------------------
void AddArray(vtkPolyData* surface, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(surface->GetNumberOfCells());
  array->Fill(value);
  surface->GetCellData()->AddArray(array);
}

//------------------------------------------------------------------------------
// Blocks of three sizes, an empty one, one that is missing, and one in a block of its own.
vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(5);
  vtkSmartPointer<vtkPolyData> large = MakeSphere(1.0, 0.0);
  AddArray(large, "Large", 1.0);
  blocks->SetBlock(0, large);
  vtkNew<vtkPolyData> empty;
  blocks->SetBlock(1, empty);
  vtkSmartPointer<vtkPolyData> middle = MakeSphere(0.3, 3.0);
  AddArray(middle, "Middle", 2.0);
  blocks->SetBlock(3, middle);
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, MakeSphere(0.3, 5.0));
  blocks->SetBlock(4, inner);
  return blocks;
}

//------------------------------------------------------------------------------
vtkPolyData* GetBlock(vtkDataObject* blocks, int index)
{
  auto* outer = vtkMultiBlockDataSet::SafeDownCast(blocks);
  vtkDataObject* block = outer ? outer->GetBlock(index) : nullptr;
  if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block))
  {
    block = inner->GetBlock(0);
  }
  return vtkPolyData::SafeDownCast(block);
}

//------------------------------------------------------------------------------
double GetSummary(vtkDataObject* object, const char* name)
{
  vtkDataArray* array = object->GetFieldData()->GetArray(name);
  return array ? array->GetTuple1(0) : vtkMath::Nan();
}

//------------------------------------------------------------------------------
void TestScene(meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputDataObject(MakeBlocks());
  mesher->Update();
  vtkDataObject* result = mesher->GetOutputDataObject(0);
  vtkPolyData* large = GetBlock(result, 0);
  vtkPolyData* middle = GetBlock(result, 3);
  vtkPolyData* inner = GetBlock(result, 4);
  const bool complete = large && middle && inner && GetBlock(result, 1) && !GetBlock(result, 2);
  check.True(complete, "the output has the structure of the input");
  if (!complete)
  {
    return;
  }
  check.Equal(GetBlock(result, 1)->GetNumberOfCells(), 0, 0, "cells of an empty block");
  const double length = GetSummary(result, "TargetEdgeLength");
  check.Equal(length, std::hypot(6.3, 2.0, 2.0) / 50.0, 2e-3, "default length of all blocks");
  check.Equal(GetSummary(middle, "TargetEdgeLength"), length, 0.0, "the same in each block");
  check.Equal(GetSummary(result, "NumberOfPatches"),
    large->GetNumberOfCells() + middle->GetNumberOfCells() + inner->GetNumberOfCells(), 0,
    "patches of all blocks");
  check.Equal(GetSummary(middle, "NumberOfPatches"), middle->GetNumberOfCells(), 0,
    "patches of a block");
  check.Equal(meshTest::GetAreas(large, "Large").count(1), 1, 0, "array of the first block");
  check.Equal(meshTest::GetAreas(middle, "Middle").count(2), 1, 0, "array of the second block");
  check.True(!middle->GetCellData()->HasArray("Large"), "each block has its own arrays");
  vtkDataArray* ids = inner->GetCellData()->GetArray("OriginalCellIds");
  check.True(ids && ids->GetRange()[0] >= 0.0 &&
      ids->GetRange()[1] < MakeSphere(0.3, 5.0)->GetNumberOfCells(),
    "original ids count within the block");
  for (vtkPolyData* block : { large, middle, inner })
  {
    check.True(meshTest::IsClosed(block), "blocks are closed");
  }

  mesher->SetTargetNumberOfPatches(3000);
  mesher->Update();
  result = mesher->GetOutputDataObject(0);
  check.Equal(GetSummary(result, "NumberOfPatches"), 3000.0, 150.0, "number for all blocks");
  const double share = GetSummary(GetBlock(result, 3), "NumberOfPatches") / 3000.0;
  check.Equal(share, 0.09 / 1.18, 0.02, "share of a block by its area");
}

//------------------------------------------------------------------------------
// The same block alone and in a scene.
void TestAlone(meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> alone;
  alone->SetInputData(MakeSphere(1.0, 0.0));
  alone->SetTargetEdgeLength(0.2);
  alone->Update();
  vtkNew<vtkPatchMesher> scene;
  scene->SetInputDataObject(MakeBlocks());
  scene->SetTargetEdgeLength(0.2);
  scene->Update();
  vtkPolyData* block = GetBlock(scene->GetOutputDataObject(0), 0);
  check.Equal(block ? block->GetNumberOfCells() : 0, alone->GetOutput()->GetNumberOfCells(), 0,
    "a given length knows nothing of other blocks");
}

//------------------------------------------------------------------------------
void TestBlockErrors(meshTest::Checker& check)
{
  const auto expect = [&check](vtkDataObject* input, const std::string& expected)
  {
    vtkNew<vtkTest::ErrorObserver> executive;
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputDataObject(input);
    mesher->AddObserver(vtkCommand::ErrorEvent, observer);
    mesher->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
    mesher->Update();
    check.True(observer->GetErrorMessage().find(expected) != std::string::npos,
      "the error \"" + observer->GetErrorMessage() + "\" says \"" + expected + "\"");
  };
  vtkNew<vtkMultiBlockDataSet> none;
  none->SetNumberOfBlocks(2);
  expect(none, "no polygons");
  vtkNew<vtkMultiBlockDataSet> grid;
  vtkNew<vtkUnstructuredGrid> cells;
  grid->SetBlock(0, cells);
  expect(grid, "Block 1 is a vtkUnstructuredGrid");
  vtkSmartPointer<vtkPolyData> sphere = MakeSphere(1.0, 0.0);
  AddArray(sphere, "Short", 1.0);
  sphere->GetCellData()->GetArray("Short")->SetNumberOfTuples(3);
  expect(sphere, "\"Short\" has 3 tuples where");
  vtkNew<vtkMultiBlockDataSet> bad;
  bad->SetBlock(0, MakeSphere(1.0, 0.0));
  bad->SetBlock(1, sphere);
  expect(bad, "Block 2: In the input the cell array \"Short\"");
}

//------------------------------------------------------------------------------
// A wide ground with trees, which are small beside it.
void TestTrees(meshTest::Checker& check)
{
  vtkNew<vtkAppendPolyData> append;
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-50.0, -50.0, -3.0);
  ground->SetPoint1(50.0, -50.0, -3.0);
  ground->SetPoint2(-50.0, 50.0, -3.0);
  append->AddInputConnection(ground->GetOutputPort());
  const int trees = 16;
  for (int i = 0; i < trees; ++i)
  {
    append->AddInputData(MakeSphere(1.0, 10.0 * (i % 4) - 20.0, 10.0 * (i / 4) - 20.0));
  }
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->Update();
  vtkNew<vtkPatchMesher> mesher;
  vtkNew<vtkTest::ErrorObserver> observer;
  mesher->AddObserver(vtkCommand::WarningEvent, observer);
  mesher->SetInputConnection(append->GetOutputPort());
  mesher->Update();
  const double area = meshTest::GetArea(append->GetOutput()) - 1e4;
  check.Equal(meshTest::GetArea(mesher->GetOutput()) - 1e4, area, 0.05 * area, "area of the trees");
  check.True(!observer->GetWarning(), "a default length needs no warning");
  check.True(mesher->GetOutput()->GetNumberOfCells() < 2 * 2500 + trees * 1000,
    "patches: " + std::to_string(mesher->GetOutput()->GetNumberOfCells()));

  mesher->SetTargetEdgeLength(3.0);
  mesher->Update();
  check.True(observer->GetWarning(), "a length that is too long is warned of");
  check.True(observer->GetWarningMessage().find("16 of 17 components") != std::string::npos,
    "the warning \"" + observer->GetWarningMessage() + "\" counts components");
}

//------------------------------------------------------------------------------
// Properties at the ends of their ranges: a result or an error, and both soon.
void TestExtremes(meshTest::Checker& check)
{
  using Set = void (*)(vtkPatchMesher*);
  const struct
  {
    const char* Name;
    Set Properties;
    bool Refused;
  } cases[] = {
    { "tiny length", [](vtkPatchMesher* m) { m->SetTargetEdgeLength(1e-300); }, true },
    { "huge length", [](vtkPatchMesher* m) { m->SetTargetEdgeLength(1e300); }, false },
    { "huge length by curvature",
      [](vtkPatchMesher* m)
      {
        m->SetTargetEdgeLength(1e300);
        m->SetSizeFieldToCurvature();
      },
      false },
    { "huge error",
      [](vtkPatchMesher* m)
      {
        m->SetApproximationError(1e300);
        m->SetSizeFieldToCurvature();
      },
      false },
    { "fewest patches", [](vtkPatchMesher* m) { m->SetTargetNumberOfPatches(1); }, false },
    { "most patches", [](vtkPatchMesher* m) { m->SetTargetNumberOfPatches(VTK_INT_MAX); }, true },
    { "number below 0", [](vtkPatchMesher* m) { m->SetTargetNumberOfPatches(VTK_INT_MIN); },
      false },
    { "iterations below 0", [](vtkPatchMesher* m) { m->SetNumberOfIterations(VTK_INT_MIN); },
      false },
    { "flat grading", [](vtkPatchMesher* m) { m->SetGrading(1e-300); }, false },
    { "steep grading", [](vtkPatchMesher* m) { m->SetGrading(1e300); }, false },
  };
  vtkSmartPointer<vtkPolyData> triangle =
    meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } });
  for (const auto& extreme : cases)
  {
    for (const bool single : { true, false })
    {
      vtkNew<vtkTest::ErrorObserver> executive;
      vtkNew<vtkTest::ErrorObserver> observer;
      vtkNew<vtkPatchMesher> mesher;
      mesher->SetInputData(single ? triangle : MakeSphere(1.0, 0.0));
      extreme.Properties(mesher);
      mesher->AddObserver(vtkCommand::ErrorEvent, observer);
      mesher->AddObserver(vtkCommand::WarningEvent, observer);
      mesher->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
      mesher->Update();
      const vtkIdType cells = mesher->GetOutput()->GetNumberOfCells();
      check.True(observer->GetError() == extreme.Refused,
        std::string(extreme.Name) + ": \"" + observer->GetErrorMessage() + "\"");
      check.True((cells == 0) == extreme.Refused,
        std::string(extreme.Name) + ": patches " + std::to_string(cells));
      for (vtkIdType i = 0; i < mesher->GetOutput()->GetNumberOfPoints(); ++i)
      {
        check.True(
          vtkMath::IsFinite(vtkMath::Norm(meshTest::GetPoint(mesher->GetOutput(), i).data())),
          std::string(extreme.Name) + ": point");
      }
    }
  }
}

//------------------------------------------------------------------------------
// A wish to abort at any event leads to an empty output, and is no error.
void TestAborts(meshTest::Checker& check)
{
  struct Stop
  {
    double At;
    int EventsAfter;
  };
  for (const double at : { 0.0, 0.05, 0.12, 0.3, 0.6, 0.8, 0.9 })
  {
    Stop stop{ at, 0 };
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&stop);
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* data, void*)
      {
        auto* algorithm = static_cast<vtkAlgorithm*>(caller);
        auto* wish = static_cast<Stop*>(data);
        wish->EventsAfter += algorithm->GetAbortExecute() != 0;
        algorithm->SetAbortExecute(algorithm->GetProgress() >= wish->At);
      });
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkPatchMesher> mesher;
    mesher->AddObserver(vtkCommand::ProgressEvent, command);
    mesher->AddObserver(vtkCommand::ErrorEvent, observer);
    mesher->SetInputData(MakeSphere(1.0, 0.0));
    mesher->SetTargetEdgeLength(0.05);
    mesher->Update();
    const std::string when = "aborted at " + std::to_string(at) + ": ";
    check.Equal(mesher->GetOutput()->GetNumberOfCells(), 0, 0, when + "cells");
    check.True(!observer->GetError(), when + "no error");
    // The one that hears it first, and the 1 that VTK reports at the end.
    check.True(stop.EventsAfter <= 2, when + std::to_string(stop.EventsAfter) + " events after it");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherBlocks(int, char*[])
{
  meshTest::Checker check;
  TestScene(check);
  TestAlone(check);
  TestBlockErrors(check);
  TestTrees(check);
  TestExtremes(check);
  TestAborts(check);
  return check.GetExitCode();
}
