// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Each bad input gets an error that names the problem, and no output; runs can be stopped.
#include "MeshTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceAtlas.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{
using meshTest::Checker;
using meshTest::MakeSurface;
using meshTest::Vector;
using Surface = vtkSmartPointer<vtkPolyData>;

//------------------------------------------------------------------------------
Surface MakeSquare()
{
  return MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } });
}

//------------------------------------------------------------------------------
Surface MakeSphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(40);
  source->SetPhiResolution(20);
  source->Update();
  return source->GetOutput();
}

//------------------------------------------------------------------------------
// Triangles that are apart from each other.
Surface MakeTriangles(int number)
{
  std::vector<Vector> points;
  std::vector<std::array<vtkIdType, 3>> triangles;
  for (int i = 0; i < number; ++i)
  {
    const double x = 2.0 * i;
    const auto first = static_cast<vtkIdType>(points.size());
    points.insert(points.end(), { { x, 0, 0 }, { x + 1, 0, 0 }, { x, 1, 0 } });
    triangles.push_back({ first, first + 1, first + 2 });
  }
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
// A strip of triangles, all alike oriented along it, that meets its start the other way around.
Surface MakeMoebiusStrip()
{
  const int steps = 30;
  std::vector<Vector> points;
  std::vector<std::array<vtkIdType, 3>> triangles;
  for (vtkIdType i = 0; i < steps; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / steps;
    for (const double across : { -0.2, 0.2 })
    {
      const double radius = 1.0 + across * std::cos(0.5 * angle);
      points.push_back(
        { radius * std::cos(angle), radius * std::sin(angle), across * std::sin(0.5 * angle) });
    }
    const vtkIdType next[2] = { i + 1 < steps ? 2 * i + 2 : 1, i + 1 < steps ? 2 * i + 3 : 0 };
    triangles.push_back({ 2 * i, next[0], next[1] });
    triangles.push_back({ 2 * i, next[1], 2 * i + 1 });
  }
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
bool IsEmpty(vtkSurfaceAtlas* atlas)
{
  return atlas->GetOutput()->GetNumberOfCells() == 0 &&
    atlas->GetOutput()->GetNumberOfPoints() == 0 &&
    atlas->GetOutput()->GetFieldData()->GetNumberOfArrays() == 0 &&
    atlas->GetCharts()->GetNumberOfColumns() == 0 && atlas->GetMaps()->GetNumberOfPoints() == 0 &&
    atlas->GetMaps()->GetPointData()->GetNumberOfArrays() == 0;
}

//------------------------------------------------------------------------------
void ExpectError(vtkSurfaceAtlas* atlas, vtkPolyData* input, const std::string& expected,
  Checker& check)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executive;
  atlas->AddObserver(vtkCommand::ErrorEvent, observer);
  atlas->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  atlas->SetInputData(input);
  atlas->Update();
  check.SetSubject(expected);
  check.True(observer->GetError(), "an error");
  check.True(observer->GetErrorMessage().find(expected) != std::string::npos,
    "the error is \"" + observer->GetErrorMessage() + "\"");
  check.True(IsEmpty(atlas), "empty outputs");
  atlas->RemoveObservers(vtkCommand::ErrorEvent);
  atlas->GetExecutive()->RemoveObservers(vtkCommand::ErrorEvent);
}

//------------------------------------------------------------------------------
void ExpectError(vtkPolyData* input, const std::string& expected, Checker& check)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetResolution(16);
  ExpectError(atlas, input, expected, check);
}

//------------------------------------------------------------------------------
void TestNoSurface(Checker& check)
{
  vtkNew<vtkPolyData> empty;
  ExpectError(empty, "no cells", check);
  Surface lines = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {});
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1 });
  lines->SetLines(cells);
  ExpectError(lines, "no polygons", check);

  Surface ghosts = MakeSquare();
  vtkNew<vtkUnsignedCharArray> types;
  types->SetName(vtkDataSetAttributes::GhostArrayName());
  types->InsertNextValue(vtkDataSetAttributes::DUPLICATECELL);
  types->InsertNextValue(vtkDataSetAttributes::DUPLICATECELL);
  ghosts->GetCellData()->AddArray(types);
  ExpectError(ghosts, "ghost cells", check);

  vtkNew<vtkSurfaceAtlas> piece;
  vtkNew<vtkTest::ErrorObserver> observer;
  piece->SetInputData(empty);
  piece->AddObserver(vtkCommand::ErrorEvent, observer);
  piece->UpdatePiece(1, 2, 0);
  check.SetSubject("an empty piece");
  check.True(!observer->GetError() && IsEmpty(piece), "no error, no output");
}

//------------------------------------------------------------------------------
void TestDefects(Checker& check)
{
  for (const double value :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    Surface square = MakeSquare();
    square->GetPoints()->SetPoint(2, 1.0, value, 0.0);
    ExpectError(square, "point 2 are not finite", check);
  }
  ExpectError(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } },
                { { 0, 1, 2 }, { 1, 0, 3 } }),
    "1 degenerate triangles: pass it through vtkPatchMesher first", check);
  ExpectError(MakeSurface({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } },
                { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } }),
    "1 edges with more than two triangles: pass it through vtkPatchMesher first", check);
  ExpectError(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
                { { 0, 1, 2 }, { 0, 3, 2 } }),
    "1 edges between triangles of opposite orientation", check);
  ExpectError(MakeMoebiusStrip(), "1 edges between triangles of opposite orientation", check);
  ExpectError(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, { { 0, 1, 2 }, { 1, 2, 0 } }),
    "1 duplicate triangles", check);
  ExpectError(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { -1, 0, 0 }, { -1, -1, 0 } },
                { { 0, 1, 2 }, { 0, 3, 4 } }),
    "only touch", check);
}

//------------------------------------------------------------------------------
void TestProperties(Checker& check)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  for (const int resolution : { std::numeric_limits<int>::min(), -4, 0, 3, 511, 32768, 100000,
         std::numeric_limits<int>::max() })
  {
    atlas->SetResolution(resolution);
    ExpectError(atlas, MakeSquare(),
      "Resolution is " + std::to_string(resolution) + ": give a power of two up to 16384", check);
  }
  atlas->SetResolution(16);
  for (const double stretch : { 1.0, 0.0, -1e300, std::numeric_limits<double>::quiet_NaN() })
  {
    atlas->SetMaximumStretch(stretch);
    ExpectError(atlas, MakeSquare(), "give a number above 1", check);
  }
}

//------------------------------------------------------------------------------
void TestTooFewTexels(Checker& check)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetResolution(4);
  ExpectError(atlas, MakeTriangles(100), "Resolution 4 leaves no texels for the surface near",
    check);
  ExpectError(atlas, MakeTriangles(17), "double the Resolution", check);
  // The same filter with what is enough.
  atlas->SetInputData(MakeTriangles(4));
  atlas->Update();
  check.SetSubject("4 triangles");
  check.Equal(meshTest::GetSummary(atlas->GetOutput(), "NumberOfCharts"), 4, 0, "charts");
  check.Equal(meshTest::GetSummary(atlas->GetOutput(), "DeepestLeakFreeLevel"), 1, 0, "level");
  atlas->SetResolution(1);
  atlas->SetInputData(MakeSquare());
  atlas->Update();
  check.SetSubject("one texel");
  check.Equal(meshTest::GetSummary(atlas->GetOutput(), "NumberOfCharts"), 1, 0, "charts");
  check.Equal(atlas->GetMaps()->GetPointData()->GetArray("Area")->GetTuple1(0), 1.0, 1e-15, "area");
  atlas->SetInputData(MakeSphere());
  ExpectError(atlas, MakeSphere(), "closed", check);
}

//------------------------------------------------------------------------------
void TestTexelMapsOff(Checker& check)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetResolution(16);
  atlas->TexelMapsOff();
  atlas->SetInputData(MakeSquare());
  atlas->Update();
  check.SetSubject("TexelMaps off");
  check.True(atlas->GetOutput()->GetNumberOfCells() > 0, "a surface");
  check.Equal(static_cast<double>(atlas->GetMaps()->GetNumberOfPoints()), 0, 0, "texels");
}

//------------------------------------------------------------------------------
Surface MakeScaled(double scale, double shift)
{
  Surface square = MakeSquare();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    const Vector p = meshTest::GetPoint(square, i);
    points->InsertNextPoint(scale * p[0] + shift, scale * p[1], scale * p[2]);
  }
  square->SetPoints(points);
  return square;
}

//------------------------------------------------------------------------------
// Sizes whose powers no double holds are refused; all others give the same.
void TestScales(Checker& check)
{
  ExpectError(MakeScaled(1e-300, 0.0), "give coordinates whose size is nearer to 1", check);
  for (const double scale : { 1e-100, 1e100, 1e300, 1.7e308 })
  {
    ExpectError(MakeScaled(scale, 0.0), "scale the surface to a size between", check);
  }
  for (const double scale : { 1e-39, 1e-30, 1e30, 1e39 })
  {
    vtkNew<vtkSurfaceAtlas> atlas;
    atlas->SetResolution(16);
    atlas->SetInputData(MakeScaled(scale, 0.0));
    atlas->Update();
    check.SetSubject("a square of size " + std::to_string(std::log10(scale)));
    check.Equal(meshTest::GetSummary(atlas->GetOutput(), "L2Stretch"), 1.0, 1e-3, "stretch");
    check.Equal(meshTest::GetArea(atlas->GetOutput()), scale * scale, 1e-12 * scale * scale,
      "area");
  }
  // Edges are halved no more when their middles would be their ends.
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetResolution(16);
  atlas->SetInputData(MakeScaled(std::ldexp(1.0, -12), 1e12));
  atlas->Update();
  check.SetSubject("a square of few steps between numbers");
  check.Equal(static_cast<double>(atlas->GetOutput()->GetNumberOfCells()), 2, 0, "triangles");
}

struct Progress
{
  double Last = 0.0;
  bool Falls = false;
  /// Whether more is done after the abort; VTK itself reports the end.
  bool GoesOn = false;
  int Number = 0;
  double AbortAt = 2.0;
};

//------------------------------------------------------------------------------
void Follow(vtkObject* caller, unsigned long, void* data, void*)
{
  auto atlas = vtkSurfaceAtlas::SafeDownCast(caller);
  auto progress = static_cast<Progress*>(data);
  const double now = atlas->GetProgress();
  progress->GoesOn = progress->GoesOn || (progress->Last >= progress->AbortAt && now < 1.0);
  progress->Falls = progress->Falls || now < progress->Last || now > 1.0;
  progress->Last = now;
  ++progress->Number;
  if (now >= progress->AbortAt)
  {
    atlas->SetAbortExecute(true);
  }
}

//------------------------------------------------------------------------------
void TestProgress(Checker& check)
{
  Surface sphere = MakeSphere();
  for (const double abortAt : { 2.0, 0.01, 0.3, 0.88 })
  {
    Progress progress;
    progress.AbortAt = abortAt;
    vtkNew<vtkSurfaceAtlas> atlas;
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkCallbackCommand> command;
    command->SetCallback(Follow);
    command->SetClientData(&progress);
    atlas->AddObserver(vtkCommand::ProgressEvent, command);
    atlas->AddObserver(vtkCommand::ErrorEvent, observer);
    atlas->SetInputData(sphere);
    atlas->SetResolution(128);
    atlas->Update();
    check.SetSubject("aborted at " + std::to_string(abortAt));
    check.True(!observer->GetError(), "no error: " + observer->GetErrorMessage());
    check.True(!progress.Falls, "progress grows");
    if (abortAt > 1.0)
    {
      check.True(!IsEmpty(atlas) && progress.Last == 1.0 && progress.Number > 4, "a whole run");
    }
    else
    {
      check.True(IsEmpty(atlas), "empty outputs");
      check.True(!progress.GoesOn, "nothing is done after the abort");
    }
  }
}

//------------------------------------------------------------------------------
// Stopped at each report in turn, a run leaves nothing and says nothing.
void TestAborts(Checker& check)
{
  for (int number = 1; number <= 16; number += 3)
  {
    int left = number;
    vtkNew<vtkSurfaceAtlas> atlas;
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&left);
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* data, void*)
      {
        if (--*static_cast<int*>(data) == 0)
        {
          vtkSurfaceAtlas::SafeDownCast(caller)->SetAbortExecute(true);
        }
      });
    atlas->AddObserver(vtkCommand::ProgressEvent, command);
    atlas->AddObserver(vtkCommand::ErrorEvent, observer);
    atlas->SetInputData(MakeSphere());
    atlas->SetResolution(512);
    atlas->Update();
    check.SetSubject("aborted at report " + std::to_string(number));
    check.True(left <= 0, "there is such a report");
    check.True(!observer->GetError() && IsEmpty(atlas), "no error, no output");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSurfaceAtlasErrors(int, char*[])
{
  Checker check;
  TestNoSurface(check);
  TestDefects(check);
  TestProperties(check);
  TestTooFewTexels(check);
  TestTexelMapsOff(check);
  TestScales(check);
  TestProgress(check);
  TestAborts(check);
  return check.GetExitCode();
}
