// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Bad input: one clear error each, an empty output, and no abort.
#include "LightTransportTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkExecutive.h"
#include "vtkPointData.h"
#include "vtkRadiosity.h"
#include "vtkTestErrorObserver.h"
#include "vtkViewFactors.h"

#include <limits>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
// The filter reports exactly this problem, and its output has no radiosity.
void Expect(vtkPolyData* data, const std::string& part,
  const std::function<void(vtkRadiosity*)>& change = {})
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  vtkNew<vtkRadiosity> radiosity;
  radiosity->AddObserver(vtkCommand::ErrorEvent, errors);
  radiosity->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  radiosity->SetInputData(data);
  if (change)
  {
    change(radiosity);
  }
  radiosity->Update();
  Check(errors->GetError(), "an error for: " + part);
  Check(errors->GetErrorMessage().find(part) != std::string::npos,
    "\"" + part + "\" in \"" + errors->GetErrorMessage() + "\"");
  Check(!radiosity->GetPolyDataOutput()->GetCellData()->HasArray("Radiosity"),
    "no output after: " + part);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeScene()
{
  auto room = MakeRoom(2);
  AddArray(room, "Reflectance", { 0.5 });
  AddArray(room, "Emission", { 1.0 });
  return room;
}

//------------------------------------------------------------------------------
void TestGeometry()
{
  auto empty = vtkSmartPointer<vtkPolyData>::New();
  Expect(empty, "no polygons");

  for (const double bad : { vtkMath::Nan(), std::numeric_limits<double>::infinity() })
  {
    auto scene = MakeScene();
    scene->GetPoints()->SetPoint(3, 0.0, bad, 0.0);
    Expect(scene, "not finite");
  }
  {
    Surface line;
    line.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } });
    line.AddPolygon({ { 0, 0, 1 }, { 1, 0, 1 } });
    Expect(line.Get(), "no polygons with an area");
    Expect(line.Get(), "2 polygons (0, 1) without area");
    Surface point;
    point.AddPolygon({ { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 } });
    Expect(point.Get(), "no polygons with an area");
    Surface star;
    std::vector<Point> corners;
    for (int k = 0; k < 5; ++k)
    {
      const double angle = 0.8 * vtkMath::Pi() * k;
      corners.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    }
    star.AddPolygon(corners);
    Expect(star.Get(), "1 polygon (0) with a border that crosses itself");
  }
  {
    auto scene = MakeScene();
    scene->GetPolys()->InsertNextCell({ 0, 1, scene->GetNumberOfPoints() });
    scene->GetCellData()->Initialize();
    Expect(scene, "points do not exist");
  }
  {
    auto huge = MakeScene();
    for (vtkIdType point = 0; point < huge->GetNumberOfPoints(); ++point)
    {
      double x[3];
      huge->GetPoint(point, x);
      huge->GetPoints()->SetPoint(point, (x[0] - 0.5) * 1.7e308, (x[1] - 0.5) * 1.7e308, x[2]);
    }
    Expect(huge, "bounding box");
  }
}

//------------------------------------------------------------------------------
void TestArrays()
{
  auto room = MakeRoom(2);
  Expect(room, "no reflectance");
  AddArray(room, "Reflectance", { 0.5 });
  Expect(room, "Nothing emits");
  vtkNew<vtkDoubleArray> atPoints;
  atPoints->SetName("Emission");
  atPoints->SetNumberOfTuples(room->GetNumberOfPoints());
  atPoints->Fill(1.0);
  room->GetPointData()->AddArray(atPoints);
  Expect(room, "vtkPointDataToCellData");

  const std::map<std::string, std::vector<double>> bad = {
    { "Reflectance", { 1.5, -0.1, vtkMath::Nan() } }, { "Emission", { -1.0, vtkMath::Inf() } }
  };
  for (const auto& array : bad)
  {
    for (const double value : array.second)
    {
      auto scene = MakeScene();
      scene->GetCellData()->GetArray(array.first.c_str())->SetComponent(7, 0, value);
      Expect(scene, "\"" + array.first + "\"");
      if (std::isfinite(value))
      {
        Expect(scene, "at polygon 7");
      }
    }
  }
  {
    auto scene = MakeScene();
    AddArray(scene, "Emission", { 1.0, 2.0 });
    AddArray(scene, "Reflectance", { 0.1, 0.2, 0.3 });
    Expect(scene, "components");
  }
  {
    auto scene = MakeScene();
    AddArray(scene, "Temperature", { 300.0 });
    Expect(scene, "no emissivity");
    AddArray(scene, "Emissivity", { 0.5 });
    Expect(scene, "both");
    scene->GetCellData()->RemoveArray("Emission");
    AddArray(scene, "Temperature", { -3.0 });
    Expect(scene, "kelvin");
    AddArray(scene, "Temperature", { 300.0, 400.0 });
    AddArray(scene, "Emissivity", { 0.5 });
    Expect(scene, "one band");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeThermalScene()
{
  auto room = MakeRoom(2);
  AddArray(room, "Temperature", { 300.0 });
  AddArray(room, "Emissivity", { 0.5 });
  return room;
}

//------------------------------------------------------------------------------
void TestGivenFluxes()
{
  auto scene = MakeThermalScene();
  vtkDoubleArray* flux = AddArray(scene, "PrescribedNetFlux", { 10.0 });
  Expect(scene, "nothing says where it holds");
  vtkDoubleArray* condition = AddArray(scene, "BoundaryCondition", { 0.0 });
  condition->SetValue(5, 2.0);
  Expect(scene, "\"BoundaryCondition\" is 2 at polygon 5");
  condition->SetValue(5, 0.5);
  Expect(scene, "must be 0");
  condition->SetValue(5, 1.0);
  flux->SetValue(5, vtkMath::Nan());
  Expect(scene, "not finite");
  flux->SetValue(5, 10.0);
  vtkDataArray* emissivity = scene->GetCellData()->GetArray("Emissivity");
  emissivity->SetComponent(5, 0, 0.0);
  Expect(scene, "\"Emissivity\" is 0 at polygon 5");
  emissivity->SetComponent(5, 0, 0.5);
  Expect(scene, "no BandLimits",
    [](vtkRadiosity* radiosity)
    {
      radiosity->AddBandLimit(0.0);
      radiosity->AddBandLimit(10.0);
    });
  condition->Fill(1.0);
  Expect(scene, "each closed part of the scene needs a patch with a given temperature");
  // Where there are no temperatures the same arrays belong to something else.
  auto other = MakeScene();
  AddArray(other, "BoundaryCondition", { 7.0 });
  AddArray(other, "PrescribedNetFlux", { vtkMath::Nan() });
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(other);
  radiosity->Update();
  Check(radiosity->GetPolyDataOutput()->GetCellData()->HasArray("Radiosity"), "ignored arrays");
}

//------------------------------------------------------------------------------
void TestBandsAndBackground()
{
  const auto setLimits = [](const std::vector<double>& limits)
  {
    return [limits](vtkRadiosity* radiosity)
    {
      for (const double limit : limits)
      {
        radiosity->AddBandLimit(limit);
      }
    };
  };
  auto scene = MakeThermalScene();
  for (const auto& limits : std::vector<std::vector<double>>{ { 5.0 }, { 5.0, 5.0 }, { 5.0, 3.0 },
         { -1.0, 3.0 }, { 0.0, vtkMath::Nan() }, { vtkMath::Nan(), 1.0 } })
  {
    Expect(scene, "BandLimits are no limits", setLimits(limits));
  }
  AddArray(scene, "Emissivity", { 0.5, 0.5, 0.5 });
  Expect(scene, "set BandLimits");
  Expect(scene, "\"Emissivity\" has 3 components where BandLimits has 2", setLimits({ 0, 5, 9 }));
  Expect(scene, "\"Emissivity\" has 3 components where BandLimits has 1", setLimits({ 0, 5 }));
  AddArray(scene, "Temperature", { 300.0, 300.0, 300.0 });
  Expect(scene, "one temperature", setLimits({ 0, 5, 9, 20 }));

  auto light = MakeScene();
  AddArray(light, "Emission", { 1.0, 2.0 });
  Expect(light, "BackgroundTemperature gives the total of one band",
    [](vtkRadiosity* radiosity) { radiosity->SetBackgroundTemperature(3.0); });
  for (const double bad : { -1.0, vtkMath::Nan(), vtkMath::Inf() })
  {
    Expect(light, "BackgroundRadiance at least 0",
      [bad](vtkRadiosity* radiosity) { radiosity->SetBackgroundRadiance(bad); });
  }
  Expect(light, "BackgroundTemperature is not a number",
    [](vtkRadiosity* radiosity) { radiosity->SetBackgroundTemperature(vtkMath::Nan()); });
  Expect(light, "BackgroundRadiance has 3 components",
    [](vtkRadiosity* radiosity)
    {
      for (int band = 0; band < 3; ++band)
      {
        radiosity->AddBackgroundRadiance(1.0);
      }
    });
  light->GetCellData()->RemoveArray("Emission");
  Expect(light, "Nothing emits",
    [](vtkRadiosity* radiosity) { radiosity->SetBackgroundRadiance(0.0); });
}

//------------------------------------------------------------------------------
void TestSolvers()
{
  auto scene = MakeScene();
  AddArray(scene, "Reflectance", { 1.0 });
  Expect(scene, "no unique solution");
  auto good = MakeScene();
  Expect(good, "CPU of one process",
    [](vtkRadiosity* radiosity)
    {
      radiosity->SetDeviceToOpenGL();
      radiosity->SetSolverToGaussSeidel();
    });
  // No module with a device is linked to this test.
  Expect(good, "vtkLightTransportRendering",
    [](vtkRadiosity* radiosity) { radiosity->SetDeviceToOpenGL(); });
  vtkNew<vtkRadiosity> automatic;
  automatic->SetInputData(good);
  automatic->Update();
  auto* explanation =
    automatic->GetPolyDataOutput()->GetFieldData()->GetAbstractArray("DeviceExplanation");
  Check(explanation && explanation->GetVariantValue(0).ToString().find("CPU: ") == 0,
    "Auto says why it took the CPU");

  // Too few iterations: the result so far, and a warning.
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkRadiosity> hasty;
  hasty->AddObserver(vtkCommand::WarningEvent, observer);
  hasty->SetInputData(good);
  hasty->SetSolverToJacobi();
  hasty->SetTolerance(1e-12);
  hasty->SetMaximumNumberOfIterations(3);
  hasty->Update();
  Check(observer->GetWarningMessage().find("stopped after 3 iterations") != std::string::npos,
    "the warning names the iterations");
  Check(GetSummary(hasty->GetPolyDataOutput(), "Converged") == 0.0, "not converged");
}

//------------------------------------------------------------------------------
void TestAbort()
{
  auto scene = MakeRoom(16);
  AddArray(scene, "Reflectance", { 0.5 });
  AddArray(scene, "Emission", { 1.0 });
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(scene);
  double last = 0.0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&last);
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      auto* filter = static_cast<vtkRadiosity*>(caller);
      // The executive ends every run, this one too, with a progress of 1.
      if (filter->GetProgress() < 1.0)
      {
        *static_cast<double*>(client) = filter->GetProgress();
        filter->SetAbortExecute(filter->GetProgress() > 0.1);
      }
    });
  radiosity->AddObserver(vtkCommand::ProgressEvent, stop);
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  radiosity->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  radiosity->Update();
  Check(last > 0.1 && last < 0.5, "an abort stops at once");
  Check(!radiosity->GetPolyDataOutput()->GetCellData()->HasArray("Radiosity"),
    "no output after an abort");
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiosityErrors(int, char*[])
{
  TestGeometry();
  TestArrays();
  TestGivenFluxes();
  TestBandsAndBackground();
  TestSolvers();
  TestAbort();
  return Result();
}
