// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Each bad input gets one error that names the problem, and no output.
#include "MeshTestTools.h"

#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkPointData.h"
#include "vtkTestErrorObserver.h"

#include <limits>

namespace
{
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSquare()
{
  return meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSquareWithLength(int components, double length)
{
  vtkSmartPointer<vtkPolyData> square = MakeSquare();
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("EdgeLength");
  lengths->SetNumberOfComponents(components);
  lengths->SetNumberOfTuples(4);
  lengths->Fill(length);
  square->GetPointData()->AddArray(lengths);
  return square;
}

//------------------------------------------------------------------------------
void ExpectError(vtkPatchMesher* mesher, vtkPolyData* input, const std::string& expected,
  meshTest::Checker& check)
{
  vtkNew<vtkTest::ErrorObserver> executive;
  vtkNew<vtkTest::ErrorObserver> observer;
  mesher->SetInputData(input);
  mesher->AddObserver(vtkCommand::ErrorEvent, observer);
  mesher->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  mesher->Update();
  check.True(observer->GetError(), "an error: " + expected);
  check.True(observer->GetErrorMessage().find(expected) != std::string::npos,
    "the error \"" + observer->GetErrorMessage() + "\" says \"" + expected + "\"");
  check.Equal(mesher->GetOutput()->GetNumberOfCells(), 0, 0, "cells after \"" + expected + "\"");
}

//------------------------------------------------------------------------------
void TestInputs(meshTest::Checker& check)
{
  {
    vtkNew<vtkPatchMesher> mesher;
    vtkNew<vtkPolyData> empty;
    ExpectError(mesher, empty, "no cells", check);
  }
  {
    // One of several processes may have nothing to do.
    vtkNew<vtkPatchMesher> mesher;
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkPolyData> empty;
    mesher->SetInputData(empty);
    mesher->AddObserver(vtkCommand::ErrorEvent, observer);
    mesher->UpdatePiece(1, 2, 0);
    check.True(!observer->GetError(), "an empty piece is no error");
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    vtkSmartPointer<vtkPolyData> lines = meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {});
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1 });
    lines->SetLines(cells);
    ExpectError(mesher, lines, "no polygons", check);
  }
  for (const double value : { NOT_A_NUMBER, INFINITE })
  {
    vtkNew<vtkPatchMesher> mesher;
    vtkSmartPointer<vtkPolyData> square = MakeSquare();
    square->GetPoints()->SetPoint(2, 1.0, value, 0.0);
    ExpectError(mesher, square, "coordinates of point 2 are not finite", check);
  }
}

//------------------------------------------------------------------------------
void TestLimits(meshTest::Checker& check)
{
  for (const double length : { -1.0, NOT_A_NUMBER, INFINITE })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetTargetEdgeLength(length);
    ExpectError(mesher, MakeSquare(), "give a positive length", check);
  }
  // 1 / (sqrt(3) / 4 * 1e-8) triangles, and those at the border.
  for (const double length : { 1e-4, 1e-200 })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetTargetEdgeLength(length);
    ExpectError(mesher, MakeSquare(), length == 1e-4 ? "2.3096e+08" : "give larger lengths", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetTargetNumberOfPatches(30000000);
    ExpectError(mesher, MakeSquare(), "TargetNumberOfPatches is 30000000", check);
    mesher->SetTargetNumberOfPatches(100);
    mesher->SetTargetEdgeLength(1e308);
    ExpectError(mesher, MakeSquare(), "too large to be scaled", check);
  }
  for (const double value : { -1.0, NOT_A_NUMBER, INFINITE })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetApproximationError(value);
    ExpectError(mesher, MakeSquare(), "ApproximationError is", check);
    vtkNew<vtkPatchMesher> shortest;
    shortest->SetMinimumEdgeLength(value);
    ExpectError(shortest, MakeSquare(), "MinimumEdgeLength is", check);
    vtkNew<vtkPatchMesher> grading;
    grading->SetGrading(value);
    ExpectError(grading, MakeSquare(), "Grading is", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetGrading(0.0);
    ExpectError(mesher, MakeSquare(), "give a positive number", check);
    vtkNew<vtkPatchMesher> limits;
    limits->SetTargetEdgeLength(0.1);
    limits->SetMinimumEdgeLength(0.2);
    ExpectError(limits, MakeSquare(), "larger than TargetEdgeLength", check);
  }
}

//------------------------------------------------------------------------------
void TestArrays(meshTest::Checker& check)
{
  for (const char* name : { "", "Size" })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetSizeFieldToArray();
    mesher->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    ExpectError(mesher, MakeSquare(),
      std::string("no numeric point array \"") + (*name ? name : "EdgeLength") + "\"", check);
  }
  {
    for (const double value : { 0.0, -1.0, NOT_A_NUMBER, INFINITE })
    {
      vtkNew<vtkPatchMesher> other;
      other->SetSizeFieldToArray();
      ExpectError(other, MakeSquareWithLength(1, value), "positive, finite lengths", check);
    }
    vtkNew<vtkPatchMesher> vectors;
    vectors->SetSizeFieldToArray();
    ExpectError(vectors, MakeSquareWithLength(3, 1.0), "3 components", check);
    vtkNew<vtkPatchMesher> fine;
    fine->SetSizeFieldToArray();
    ExpectError(fine, MakeSquareWithLength(1, 1e-4), "The array of edge lengths would give", check);
  }
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputArrayToProcess(0, 0, 0, association, "Material");
    ExpectError(mesher, MakeSquare(), "no cell array \"Material\"", check);
  }
}

//------------------------------------------------------------------------------
void TestBrokenTriangles(meshTest::Checker& check)
{
  {
    vtkNew<vtkPatchMesher> mesher;
    vtkSmartPointer<vtkPolyData> flat =
      meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } });
    ExpectError(mesher, flat, "no area", check);
    vtkNew<vtkPatchMesher> strict;
    strict->SetRepair(false);
    ExpectError(strict, flat, "1 degenerate triangles: switch Repair on", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetRepair(false);
    vtkSmartPointer<vtkPolyData> fin =
      meshTest::MakeSurface({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } },
        { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } });
    ExpectError(mesher, fin, "1 edges with more than two triangles: switch Repair on", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetRepair(false);
    vtkSmartPointer<vtkPolyData> twisted = meshTest::MakeSurface(
      { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 3, 2 } });
    ExpectError(mesher, twisted, "1 edges between triangles of opposite orientation", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetRepair(false);
    vtkSmartPointer<vtkPolyData> twice = meshTest::MakeSurface(
      { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, { { 0, 1, 2 }, { 1, 2, 0 } });
    ExpectError(mesher, twice, "1 duplicate triangles", check);
  }
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetRepair(false);
    vtkSmartPointer<vtkPolyData> bowTie =
      meshTest::MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { -1, 0, 0 }, { -1, -1, 0 } },
        { { 0, 1, 2 }, { 0, 3, 4 } });
    ExpectError(mesher, bowTie, "only touch", check);
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherErrors(int, char*[])
{
  meshTest::Checker check;
  TestInputs(check);
  TestLimits(check);
  TestArrays(check);
  TestBrokenTriangles(check);
  return check.GetExitCode();
}
