// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Progressive refinement on OpenGL against exact values (one shot between plates, what a wall
 * hides, the furnace), against the dense solution of the CPU (the Cornell box), and in its
 * promises: energy is kept, bands do not mix, the order of shots is the same in every run.
 */
#include "vtkOpenGLShooter.h"

#include "CornellBoxTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
#include "vtkRadiosity.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <numeric>

using namespace LightTransportTesting;

namespace
{
using Vector = std::vector<double>;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadiosity> MakeSolver(vtkPolyData* scene, double tolerance = 1e-4)
{
  auto radiosity = vtkSmartPointer<vtkRadiosity>::New();
  radiosity->SetInputData(scene);
  radiosity->SetSolverToSouthwell();
  radiosity->SetDeviceToOpenGL();
  radiosity->SetTolerance(tolerance);
  return radiosity;
}

//------------------------------------------------------------------------------
Vector GetCells(vtkRadiosity* radiosity, const char* name)
{
  return GetCellValues(radiosity->GetPolyDataOutput(), name);
}

//------------------------------------------------------------------------------
// E = 1 - rho in a closed room gives B = 1 everywhere, and the mean of H is 1 as far as no energy
// is lost, whatever the error of single patches.
void TestFurnace()
{
  for (const int divisions : { 1, 4 })
  {
    auto room = MakeRoom(divisions);
    AddArray(room, "Emission", { 0.5 });
    AddArray(room, "Reflectance", { 0.5 });
    auto radiosity = MakeSolver(room, 1e-3);
    radiosity->Update();
    const Vector irradiance = GetCells(radiosity, "Irradiance");
    const double mean = std::accumulate(irradiance.begin(), irradiance.end(), 0.0) /
      static_cast<double>(irradiance.size());
    const double error = Compare(room, irradiance, Vector(irradiance.size(), 1.0));
    std::cout << room->GetNumberOfCells() << " patches: mean irradiance " << mean << ", L2 error "
              << error << "\n";
    CheckClose(mean, 1.0, 1e-3, "the furnace's mean irradiance");
    Check(error < 1e-2, "the furnace is not uniform");
    Check(GetSummary(radiosity->GetOutput(), "Converged") == 1.0, "the furnace does not converge");
    Check(GetSummary(radiosity->GetOutput(), "ErrorBound") <= 1e-3, "the error bound is too large");
  }
}

//------------------------------------------------------------------------------
Vector ShootOnce(vtkPolyData* scene, vtkIdType emitter)
{
  vtkDataArray* emission = AddArray(scene, "Emission", { 0.0 });
  emission->SetComponent(emitter, 0, 1.0);
  AddArray(scene, "Reflectance", { 0.0 });
  auto radiosity = MakeSolver(scene);
  radiosity->Update();
  Check(GetSummary(radiosity->GetOutput(), "NumberOfShots") <= 1.0, "more than one shot");
  return GetCells(radiosity, "Irradiance");
}

//------------------------------------------------------------------------------
// Unit squares at distance 1: F = 0.199824895698; sharing an edge at a right angle: F =
// 0.200043776075 (Howell's catalogue, C-11 and C-14).
void TestPairs()
{
  Surface parallel;
  parallel.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  parallel.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  CheckClose(ShootOnce(parallel.Get(), 0)[1], 0.199824895698, 2e-3, "parallel squares");

  Surface corner;
  corner.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  corner.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  CheckClose(ShootOnce(corner.Get(), 0)[1], 0.200043776075, 1e-2, "squares at a right angle");
}

//------------------------------------------------------------------------------
// Two sheets with two sides each, the outer ones cut in another way, with points in single
// precision and turned: neither is the outer side in the way, nor is it seen in place of the inner
// one.
void TestSheets()
{
  Surface sheets;
  sheets.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  sheets.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  sheets.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3);
  sheets.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  for (int turn = 0; turn < 10; ++turn)
  {
    vtkNew<vtkTransform> transform;
    transform->Translate(20.0, 10.0, 5.0);
    transform->RotateWXYZ(37.0 * turn, 0.3, 0.5, 0.1 * turn);
    vtkNew<vtkTransformPolyDataFilter> filter;
    filter->SetInputData(sheets.Get());
    filter->SetTransform(transform);
    filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    filter->Update();
    const Vector irradiance = ShootOnce(filter->GetOutput(), 0);
    CheckClose(irradiance[1], 0.199824895698, 3e-3, "the inner side of the other sheet");
    CheckClose(*std::max_element(irradiance.begin() + 2, irradiance.end()), 0.0, 1e-6,
      "the outer sides");
  }
}

//------------------------------------------------------------------------------
// A wall between two squares hides all or half of one from the other. Its front receives, its back
// absorbs.
void TestOcclusion()
{
  for (const bool facing : { true, false })
  {
    Surface surface;
    surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    surface.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
    const Point u = { 3, 0, 0 }, v = { 0, 3, 0 };
    facing ? surface.AddGrid({ -1, -1, 0.5 }, v, u, 1, 1)
           : surface.AddGrid({ -1, -1, 0.5 }, u, v, 1, 1);
    const Vector irradiance = ShootOnce(surface.Get(), 0);
    CheckClose(irradiance[1], 0.0, 1e-6, "the hidden square's irradiance");
    // From the square to nine times its size at half the distance, by Howell's C-11 for parts.
    CheckClose(9.0 * irradiance[2], facing ? 0.91 : 0.0, 3e-2, "the wall's share");
  }
  // The wall ends in the middle: by symmetry it hides half of the exchange.
  Surface half;
  half.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  half.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  half.AddGrid({ -2, -2, 0.5 }, { 2.5, 0, 0 }, { 0, 5, 0 }, 1, 1);
  CheckClose(ShootOnce(half.Get(), 0)[1], 0.5 * 0.199824895698, 1e-2, "half hidden");
}

//------------------------------------------------------------------------------
// The irradiance, since the lamp's own emission would hide errors of the radiosity.
void TestCornellBox()
{
  auto box = MakeCornellBox(150.0);
  vtkNew<vtkRadiosity> dense;
  dense->SetInputData(box);
  dense->SetDeviceToCPU();
  dense->SetViewFactorTolerance(1e-3);
  dense->Update();
  auto radiosity = MakeSolver(box, 1e-3);
  radiosity->Update();
  const double error =
    Compare(box, GetCells(radiosity, "Irradiance"), GetCells(dense, "Irradiance"));
  std::cout << "Cornell box, " << box->GetNumberOfCells() << " patches, "
            << GetSummary(radiosity->GetOutput(), "NumberOfShots") << " shots: L2 error " << error
            << "\n";
  Check(error < 2e-2, "the Cornell box is off by " + std::to_string(error));

  vtkTable* table = radiosity->GetConvergence();
  const vtkIdType last = table->GetNumberOfRows() - 1;
  Check(table->GetValueByName(0, "Iteration").ToInt() == 0 &&
      table->GetValueByName(last, "Iteration").ToDouble() ==
        GetSummary(radiosity->GetOutput(), "NumberOfShots"),
    "the table does not count shots");
  Check(table->GetValueByName(last, "Residual").ToDouble() <
      1e-3 * table->GetValueByName(0, "Residual").ToDouble(),
    "the residual does not fall");
}

//------------------------------------------------------------------------------
// Bands that are multiples of each other stay so, up to 32 of them.
void TestBands()
{
  for (const int bands : { 5, 32 })
  {
    auto room = MakeRoom(2);
    Vector emission(static_cast<std::size_t>(bands));
    std::iota(emission.begin(), emission.end(), 1.0);
    AddArray(room, "Emission", emission);
    AddArray(room, "Reflectance", { 0.3 });
    auto radiosity = MakeSolver(room, 0.5);
    radiosity->Update();
    const Vector found = GetCells(radiosity, "Radiosity");
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      const std::size_t band = k % static_cast<std::size_t>(bands);
      CheckClose(found[k], found[k - band] * emission[band], 1e-5, "a band");
    }
  }
}

//------------------------------------------------------------------------------
// A band that is 1e-30 of another, in a scene that is 1e8 large, is solved all the same.
void TestScales()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1e8, 0, 0 }, { 0, 1e8, 0 }, 1, 1);
  surface.AddGrid({ 0, 0, 1e8 }, { 0, 1e8, 0 }, { 1e8, 0, 0 }, 1, 1);
  auto scene = surface.Get();
  AddArray(scene, "Emission", { 1e30, 0.0, 1.0 });
  // So open that overshooting expects far too much to come back.
  AddArray(scene, "Reflectance", { 0.95 });
  auto radiosity = MakeSolver(scene);
  radiosity->Update();
  const Vector found = GetCells(radiosity, "Radiosity");
  const double expected = 1.0 / (1.0 - 0.95 * 0.199824895698);
  CheckClose(found[0], 1e30 * expected, 1e-3, "the brightest band");
  CheckClose(found[1], 0.0, 0.0, "the dark band");
  CheckClose(found[2], expected, 1e-3, "the darkest band");
}

//------------------------------------------------------------------------------
// Heat taken out of a wall is unshot radiosity below 0. The wall counts as one that reflects
// everything, for which the error bound is infinite: shots go on until they change nothing.
void TestGivenFlux()
{
  auto room = MakeRoom(2);
  AddArray(room, "Emissivity", { 0.9 });
  AddArray(room, "Temperature", { 400.0 });
  vtkDataArray* condition = AddArray(room, "BoundaryCondition", { 0.0 });
  vtkDataArray* flux = AddArray(room, "PrescribedNetFlux", { 0.0 });
  for (vtkIdType cell = 0; cell < 4; ++cell)
  {
    condition->SetComponent(cell, 0, 1.0);
    flux->SetComponent(cell, 0, -200.0);
  }
  vtkNew<vtkTest::ErrorObserver> observer;
  auto radiosity = MakeSolver(room);
  radiosity->AddObserver(vtkCommand::WarningEvent, observer);
  radiosity->Update();
  Check(observer->CheckWarningMessage("nothing to single precision") == 0, "no warning");
  vtkNew<vtkRadiosity> dense;
  dense->SetInputData(room);
  dense->SetDeviceToCPU();
  dense->Update();
  const double error =
    Compare(room, GetCells(radiosity, "Irradiance"), GetCells(dense, "Irradiance"));
  std::cout << "given net flux: L2 error " << error << "\n";
  Check(error < 2e-3, "the room with a given flux is off by " + std::to_string(error));

  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  auto open = MakeSolver(room);
  open->SetBackgroundTemperature(300.0);
  open->AddObserver(vtkCommand::ErrorEvent, errors);
  open->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  open->Update();
  Check(errors->CheckErrorMessage("no sky fractions") == 0, "a background is taken");
}

//------------------------------------------------------------------------------
// Three sheets above each other, the middle one shines to both sides: each of the others gets what
// faces it (two unit squares at distance 1: Howell C-11), and nothing on its far side.
void TestTwoSides()
{
  constexpr int patches = 16;
  Surface surface;
  for (const double z : { 0.0, 1.0, 2.0 })
  {
    surface.AddGrid({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  }
  auto sheets = surface.Get();
  AddArray(sheets, "Reflectance", { 0.0 });
  vtkDoubleArray* fronts = AddArray(sheets, "Emission", { 0.0 });
  vtkDoubleArray* backs = AddArray(sheets, "EmissionBack", { 0.0 });
  for (int patch = patches; patch < 2 * patches; ++patch)
  {
    fronts->SetValue(patch, 1.0);
    backs->SetValue(patch, 2.0);
  }
  auto radiosity = MakeSolver(sheets);
  radiosity->TwoSidedOn();
  radiosity->Update();
  const auto getMean = [&](const char* name, int sheet)
  {
    const Vector values = GetCells(radiosity, name);
    const auto first = values.begin() + sheet * patches;
    return std::accumulate(first, first + patches, 0.0) / patches;
  };
  const double factor = 0.199824895698387;
  CheckClose(getMean("Irradiance", 0), 2.0 * factor, 1e-2, "the lower sheet's front");
  CheckClose(getMean("IrradianceBack", 2), factor, 1e-2, "the upper sheet's back");
  for (const auto& [name, sheet] : { std::pair{ "IrradianceBack", 0 }, { "Irradiance", 1 },
         { "IrradianceBack", 1 }, { "Irradiance", 2 } })
  {
    CheckClose(getMean(name, sheet), 0.0, 1e-6, "a side that no light reaches");
  }
}

//------------------------------------------------------------------------------
void TestOnePatch()
{
  Surface surface;
  surface.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  auto scene = surface.Get();
  AddArray(scene, "Emission", { 2.0 });
  AddArray(scene, "Reflectance", { 1.0 });
  AddArray(scene, "DirectIrradiance", { 3.0 });
  auto radiosity = MakeSolver(scene);
  radiosity->Update();
  CheckClose(GetCells(radiosity, "Radiosity")[0], 5.0, 1e-12, "one patch");
  CheckClose(GetCells(radiosity, "Irradiance")[0], 3.0, 1e-12, "one patch's irradiance");
  Check(GetSummary(radiosity->GetOutput(), "Converged") == 1.0, "one patch does not converge");
}

//------------------------------------------------------------------------------
// The same in every run, with little read back; a limit on sweeps; an abort.
void TestRuns()
{
  auto room = MakeRoom(3);
  AddArray(room, "Emission", { 1.0 });
  AddArray(room, "Reflectance", { 0.5 });
  auto first = MakeSolver(room, 1e-1);
  auto second = MakeSolver(room, 1e-1);
  first->Update();
  second->Update();
  Check(GetCells(first, "Irradiance") == GetCells(second, "Irradiance"), "two runs differ");

  vtkNew<vtkTest::ErrorObserver> observer;
  auto limited = MakeSolver(room, 1e-6);
  limited->AddObserver(vtkCommand::WarningEvent, observer);
  limited->SetMaximumNumberOfIterations(1);
  limited->Update();
  Check(observer->CheckWarningMessage("Southwell stopped") == 0, "no warning");
  Check(GetSummary(limited->GetOutput(), "NumberOfShots") == 54.0, "a sweep is not 54 shots");
  Check(GetSummary(limited->GetOutput(), "NumberOfIterations") == 1.0, "54 shots are no sweep");

  auto aborted = MakeSolver(room, 1e-6);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  aborted->AddObserver(vtkCommand::ProgressEvent, abort);
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  aborted->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  aborted->Update();
  Check(aborted->GetPolyDataOutput()->GetNumberOfCells() == 0, "an aborted run has an output");
}

//------------------------------------------------------------------------------
void TestShooter()
{
  vtkDeviceShooter::Patches patches;
  patches.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1 };
  patches.Offsets = { 0, 3, 6 };
  patches.Corners = { 0, 1, 2, 3, 5, 4 };
  patches.Normals = { 0, 0, 1, 0, 0, -1 };
  patches.Areas = { 0.5, 0.5 };
  const double source[2] = { 1.0, 0.0 };
  const double reflectance[2] = { 0.0, 0.5 };

  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOpenGLShooter> shooter;
  shooter->AddObserver(vtkCommand::ErrorEvent, observer);
  shooter->OvershootingOff();
  Check(shooter->Shoot(1) == -1 && observer->CheckErrorMessage("Initialize()") == 0,
    "a shot without a scene");
  Check(!shooter->Initialize(patches, 33, source, reflectance) &&
      observer->CheckErrorMessage("32 bands") == 0,
    "33 bands are taken");
  Check(shooter->Initialize(patches, 1, source, reflectance), "two triangles are not taken");
  double largest = 0.0;
  double unshot[2];
  double irradiance[2];
  Check(shooter->GetLargestUnshot(&largest) && largest == 1.0, "the emission is not unshot");
  Check(shooter->Shoot(1) == 1 && shooter->GetIrradiance(irradiance) && shooter->GetUnshot(unshot),
    "a shot fails");
  Check(irradiance[0] == 0.0 && irradiance[1] > 0.0 && unshot[0] == 0.0, "one shot goes astray");
  CheckClose(unshot[1], 0.5 * irradiance[1], 1e-6, "what is reflected");
  // The second triangle shoots back, the first one reflects nothing.
  const vtkTypeInt64 before = shooter->GetNumberOfBytesRead();
  Check(shooter->Shoot(10) == 1, "black patches shoot");
  Check(shooter->GetNumberOfBytesRead() - before <= 2 * 256, "shots read vectors back");
  Check(shooter->GetUnshot(unshot) && unshot[0] == 0.0 && unshot[1] == 0.0, "something is left");
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenGLShooter(int, char*[])
{
  std::string reason;
  vtkNew<vtkOpenGLShooter> shooter;
  if (!Check(shooter->Open(reason), "no context: " + reason))
  {
    return Result();
  }
  TestShooter();
  TestTwoSides();
  TestOnePatch();
  TestPairs();
  TestSheets();
  TestOcclusion();
  TestFurnace();
  TestBands();
  TestScales();
  TestGivenFlux();
  TestRuns();
  TestCornellBox();
  return Result();
}
