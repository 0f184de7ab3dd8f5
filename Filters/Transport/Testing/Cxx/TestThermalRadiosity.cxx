// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Heat exchange against closed forms: two-surface enclosures, given net fluxes, spectral bands,
// backgrounds, series of temperatures.
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "Radiosity/PlanckFraction.h"
#include "Radiosity/RadiosityMaterials.h"
#include "RanksInThreads.h"
#include "Scene/CellArrays.h"
#include "Scene/PatchScene.h"
#include "vtkCallbackCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiosity.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTestErrorObserver.h"
#include "vtkViewFactors.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

//------------------------------------------------------------------------------
double BlackFlux(double temperature)
{
  return 5.670374419e-8 * std::pow(temperature, 4);
}

//------------------------------------------------------------------------------
double Get(vtkRadiosity* radiosity, const char* name, vtkIdType cell, int component = 0)
{
  vtkDataArray* array = radiosity->GetPolyDataOutput()->GetCellData()->GetArray(name);
  return Check(array && array->GetNumberOfTuples() > cell, std::string("cell array ") + name)
    ? array->GetComponent(cell, component)
    : vtkMath::Nan();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadiosity> MakeFilter(vtkPolyData* data)
{
  auto radiosity = vtkSmartPointer<vtkRadiosity>::New();
  radiosity->SetInputData(data);
  radiosity->SetTolerance(1e-9);
  radiosity->SetViewFactorTolerance(1e-9);
  return radiosity;
}

//------------------------------------------------------------------------------
// A cube of edge 1 seen from outside (6 cells) in one of edge 3 seen from inside (6 cells): by
// symmetry each has one radiosity, so the formula for two surfaces is exact.
vtkSmartPointer<vtkPolyData> MakeCubeInCube()
{
  Surface cubes;
  const auto addCube = [&cubes](double low, double size, bool inward)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int side = 0; side < 2; ++side)
      {
        Point origin = { low, low, low }, u = { 0, 0, 0 }, v = { 0, 0, 0 };
        origin[axis] += side * size;
        u[(axis + 1) % 3] = size;
        v[(axis + 2) % 3] = size;
        (side == 1) != inward ? cubes.AddGrid(origin, u, v, 1, 1)
                              : cubes.AddGrid(origin, v, u, 1, 1);
      }
    }
  };
  addCube(1.0, 1.0, false);
  addCube(0.0, 3.0, true);
  return cubes.Get();
}

//------------------------------------------------------------------------------
// Power from the inner to the outer cube for a difference of their black body fluxes; F12 = 1.
double GetExchange(double difference, double emissivity1, double emissivity2)
{
  constexpr double area1 = 6.0, area2 = 54.0;
  return difference /
    ((1.0 - emissivity1) / (area1 * emissivity1) + 1.0 / area1 +
      (1.0 - emissivity2) / (area2 * emissivity2));
}

//------------------------------------------------------------------------------
void SetHalves(vtkDoubleArray* array, const std::vector<double>& first,
  const std::vector<double>& second)
{
  for (vtkIdType cell = 0; cell < 12; ++cell)
  {
    array->SetTuple(cell, cell < 6 ? first.data() : second.data());
  }
}

//------------------------------------------------------------------------------
void TestTwoSurfaces()
{
  auto cubes = MakeCubeInCube();
  SetHalves(AddArray(cubes, "Temperature", { 0.0 }), { 900.0 }, { 300.0 });
  for (const double e1 : { 0.1, 0.8, 1.0 })
  {
    for (const double e2 : { 0.05, 0.5, 1.0 })
    {
      SetHalves(AddArray(cubes, "Emissivity", { 0.0 }), { e1 }, { e2 });
      auto radiosity = MakeFilter(cubes);
      radiosity->SetViewFactorTolerance(1e-6);
      radiosity->EnforceClosureOn();
      radiosity->Update();
      const double power = GetExchange(BlackFlux(900.0) - BlackFlux(300.0), e1, e2);
      for (vtkIdType cell = 0; cell < 12; ++cell)
      {
        CheckClose(Get(radiosity, "NetFlux", cell), cell < 6 ? power / 6.0 : -power / 54.0, 3e-6,
          "exchange between two surfaces");
        CheckClose(GetSummary(radiosity->GetPolyDataOutput(), "NetPower") / power, 0.0, 3e-6,
          "nothing leaves the closed scene");
        Check(Get(radiosity, "SurfaceTemperature", cell) == (cell < 6 ? 900.0 : 300.0),
          "a given temperature stays");
      }
    }
  }
  // The other way round: the flux of the inner cube is given, and its temperature follows.
  SetHalves(AddArray(cubes, "Emissivity", { 0.0 }), { 0.3 }, { 0.6 });
  SetHalves(AddArray(cubes, "Temperature", { 0.0 }), { 0.0 }, { 300.0 });
  SetHalves(AddArray(cubes, "BoundaryCondition", { 0.0 }), { 1.0 }, { 0.0 });
  const double power = GetExchange(BlackFlux(900.0) - BlackFlux(300.0), 0.3, 0.6);
  SetHalves(AddArray(cubes, "PrescribedNetFlux", { 0.0 }), { power / 6.0 }, { 77.0 });
  auto radiosity = MakeFilter(cubes);
  radiosity->SetViewFactorTolerance(1e-6);
  radiosity->EnforceClosureOn();
  radiosity->Update();
  for (vtkIdType cell = 0; cell < 6; ++cell)
  {
    CheckClose(Get(radiosity, "SurfaceTemperature", cell), 900.0, 1e-6, "its temperature follows");
    CheckClose(Get(radiosity, "NetFlux", cell), power / 6.0, 1e-12, "a given flux stays");
    CheckClose(Get(radiosity, "NetFlux", 6 + cell), -power / 54.0, 3e-6, "the other surface");
  }
}

//------------------------------------------------------------------------------
// A cube of six patches, its given temperatures and fluxes, and the exact solution of its system.
struct CubeCase
{
  double Temperature[6];
  double Emissivity[6];
  double Condition[6];
  double Flux[6];

  vtkSmartPointer<vtkPolyData> MakeScene() const
  {
    auto cube = MakeRoom(1);
    vtkDoubleArray* temperature = AddArray(cube, "Temperature", { 0.0 });
    vtkDoubleArray* emissivity = AddArray(cube, "Emissivity", { 0.0 });
    vtkDoubleArray* condition = AddArray(cube, "BoundaryCondition", { 0.0 });
    vtkDoubleArray* flux = AddArray(cube, "PrescribedNetFlux", { 0.0 });
    for (int i = 0; i < 6; ++i)
    {
      temperature->SetValue(i, this->Temperature[i]);
      emissivity->SetValue(i, this->Emissivity[i]);
      condition->SetValue(i, this->Condition[i]);
      flux->SetValue(i, this->Flux[i]);
    }
    return cube;
  }

  // Returns the radiosities; irradiances = F B.
  Eigen::VectorXd Solve(Eigen::VectorXd& irradiances) const
  {
    constexpr double opposite = 0.199824895698387;
    Eigen::MatrixXd factors(6, 6), system = Eigen::MatrixXd::Identity(6, 6);
    Eigen::VectorXd source(6);
    for (int i = 0; i < 6; ++i)
    {
      const bool given = this->Condition[i] == 1.0;
      const double e = this->Emissivity[i];
      source[i] = given ? this->Flux[i] : e * BlackFlux(this->Temperature[i]);
      for (int j = 0; j < 6; ++j)
      {
        factors(i, j) = i == j ? 0.0 : i / 2 == j / 2 ? opposite : (1.0 - opposite) / 4.0;
        system(i, j) -= (given ? 1.0 : 1.0 - e) * factors(i, j);
      }
    }
    const Eigen::VectorXd radiosities = system.fullPivLu().solve(source);
    irradiances = factors * radiosities;
    return radiosities;
  }
};

//------------------------------------------------------------------------------
void TestMixedCube()
{
  const CubeCase mixed{ { 1000.0, 0.0, 400.0, 5.0, 0.0, 300.0 }, { 0.9, 0.5, 0.2, 0.7, 0.4, 1.0 },
    { 0, 1, 0, 1, 1, 0 }, { 9.0, 1500.0, 9.0, 0.0, -700.0, 9.0 } };
  Eigen::VectorXd irradiances;
  const Eigen::VectorXd radiosities = mixed.Solve(irradiances);
  auto cube = mixed.MakeScene();
  vtkNew<vtkRadiosity> any;
  for (int solver = 0; solver <= any->GetSolverMaxValue(); ++solver)
  {
    auto radiosity = MakeFilter(cube);
    radiosity->SetSolver(solver);
    radiosity->Update();
    const std::string what = "mixed cube, solver " + std::to_string(solver) + ", patch ";
    for (int i = 0; i < 6; ++i)
    {
      const std::string patch = what + std::to_string(i);
      const bool given = mixed.Condition[i] == 1.0;
      const double flux = radiosities[i] - irradiances[i];
      const double black = irradiances[i] + flux / mixed.Emissivity[i];
      CheckClose(Get(radiosity, "Radiosity", i), radiosities[i], 1e-6, patch);
      CheckClose(Get(radiosity, "Irradiance", i), irradiances[i], 1e-6, patch);
      CheckClose(Get(radiosity, "SurfaceTemperature", i), std::pow(black / 5.670374419e-8, 0.25),
        1e-6, patch + ": temperature");
      CheckClose(Get(radiosity, "NetFlux", i), given ? mixed.Flux[i] : flux, given ? 1e-11 : 1e-5,
        patch + ": net flux");
    }
  }
}

//------------------------------------------------------------------------------
// Hot floor, cold ceiling, adiabatic walls: a network of resistances. The emissivity of the walls
// does not matter, and needs no flux to be given.
void TestAdiabaticWalls()
{
  constexpr double f12 = 0.199824895698387, e1 = 0.8, e2 = 0.3;
  const double flux = (BlackFlux(1200.0) - BlackFlux(500.0)) /
    ((1.0 - e1) / e1 + 1.0 / (f12 + 0.5 * (1.0 - f12)) + (1.0 - e2) / e2);
  const double b1 = BlackFlux(1200.0) - flux * (1.0 - e1) / e1;
  const double b2 = BlackFlux(500.0) + flux * (1.0 - e2) / e2;
  const double wall = std::pow(0.5 * (b1 + b2) / 5.670374419e-8, 0.25);
  const CubeCase furnace{ { 1200.0, 500.0 }, { e1, e2, 0.9, 0.1, 0.0, 1.0 }, { 0, 0, 1, 1, 1, 1 },
    {} };
  auto cube = furnace.MakeScene();
  cube->GetCellData()->RemoveArray("PrescribedNetFlux");
  auto radiosity = MakeFilter(cube);
  radiosity->Update();
  CheckClose(Get(radiosity, "NetFlux", 0), flux, 1e-6, "floor of the furnace");
  CheckClose(Get(radiosity, "NetFlux", 1), -flux, 1e-6, "ceiling of the furnace");
  for (vtkIdType cell = 2; cell < 6; ++cell)
  {
    CheckClose(Get(radiosity, "SurfaceTemperature", cell), wall, 1e-6, "adiabatic wall");
    CheckClose(Get(radiosity, "NetFlux", cell) / flux, 0.0, 1e-14, "no net flux through it");
  }
  // Points belong to one wall each, and to one kind of boundary condition.
  vtkPolyData* output = radiosity->GetPolyDataOutput();
  Check(output->GetNumberOfPoints() == 24 && output->GetPointData()->HasArray("SurfaceTemperature"),
    "temperatures at points");
}

//------------------------------------------------------------------------------
// More heat taken out than there is: no temperature, and a warning.
void TestImpossibleTemperature()
{
  const CubeCase cold{ { 300.0, 300.0, 300.0, 300.0, 300.0, 0.0 }, { 1, 1, 1, 1, 1, 0.5 },
    { 0, 0, 0, 0, 0, 1 }, { 0, 0, 0, 0, 0, -0.6 * BlackFlux(300.0) } };
  auto radiosity = MakeFilter(cold.MakeScene());
  vtkNew<vtkTest::ErrorObserver> observer;
  radiosity->AddObserver(vtkCommand::WarningEvent, observer);
  radiosity->Update();
  Check(observer->GetWarningMessage().find("1 patches have no temperature") != std::string::npos,
    "a warning counts them: " + observer->GetWarningMessage());
  Check(Get(radiosity, "SurfaceTemperature", 5) == 0.0, "0 where there is none");
  Check(Get(radiosity, "SurfaceTemperature", 4) == 300.0, "the others have theirs");
}

//------------------------------------------------------------------------------
void AddLimits(vtkRadiosity* radiosity, const std::vector<double>& limits)
{
  for (const double limit : limits)
  {
    radiosity->AddBandLimit(limit);
  }
}

//------------------------------------------------------------------------------
// The bands of grey surfaces add up to the total.
void TestGreyBands()
{
  auto room = MakeRoom(2);
  vtkDoubleArray* temperature = AddArray(room, "Temperature", { 300.0 });
  vtkDoubleArray* emissivity = AddArray(room, "Emissivity", { 0.7 });
  for (vtkIdType cell = 0; cell < 24; ++cell)
  {
    temperature->SetValue(cell, 100.0 + 80.0 * cell);
    emissivity->SetValue(cell, 1.0 - 0.03 * cell);
  }
  auto total = MakeFilter(room);
  total->Update();
  auto bands = MakeFilter(room);
  AddLimits(bands, { 0.0, 0.7, 3.0, 8.0, 14.0, Infinity });
  bands->Update();
  vtkDataArray* array = bands->GetPolyDataOutput()->GetCellData()->GetArray("Radiosity");
  Check(array && array->GetNumberOfComponents() == 5, "five bands");
  Check(!total->GetPolyDataOutput()->GetCellData()->HasArray("TotalNetFlux"),
    "one band is the total");
  for (vtkIdType cell = 0; cell < 24; ++cell)
  {
    double sum = 0.0;
    for (int band = 0; band < 5; ++band)
    {
      sum += Get(bands, "Radiosity", cell, band);
    }
    CheckClose(sum, Get(total, "Radiosity", cell), 1e-9, "the bands add up");
    Check(std::abs(Get(bands, "TotalNetFlux", cell) - Get(total, "NetFlux", cell)) <
        1e-9 * BlackFlux(1940.0),
      "total net flux");
    Check(Get(bands, "SurfaceTemperature", cell) == temperature->GetValue(cell), "temperature");
  }
}

//------------------------------------------------------------------------------
// An emissivity per band: each band is a two-surface enclosure of its own. What lies outside of all
// bands does not count.
void TestWindow()
{
  auto cubes = MakeCubeInCube();
  SetHalves(AddArray(cubes, "Temperature", { 0.0 }), { 300.0 }, { 0.0 });
  SetHalves(AddArray(cubes, "Emissivity", { 0.0, 0.0 }), { 0.2, 0.9 }, { 0.5, 1.0 });
  auto radiosity = MakeFilter(cubes);
  radiosity->SetViewFactorTolerance(1e-6);
  radiosity->EnforceClosureOn();
  AddLimits(radiosity, { 5.0, 8.0, 14.0 });
  Check(radiosity->GetNumberOfBandLimits() == 3 && radiosity->GetBandLimit(1) == 8.0 &&
      radiosity->GetBandLimit(3) == 0.0 && radiosity->GetBandLimit(-1) == 0.0,
    "limits are kept");
  radiosity->Update();
  // 5 to 8 and 8 to 14 micrometres at 300 K.
  const double black[] = { BlackFlux(300.0) * 0.12740730255887309,
    BlackFlux(300.0) * 0.37574229364592431 };
  const double power[] = { GetExchange(black[0], 0.2, 0.5), GetExchange(black[1], 0.9, 1.0) };
  for (vtkIdType cell = 0; cell < 6; ++cell)
  {
    CheckClose(Get(radiosity, "NetFlux", cell, 0), power[0] / 6.0, 3e-6, "first band");
    CheckClose(Get(radiosity, "NetFlux", cell, 1), power[1] / 6.0, 3e-6, "window");
    CheckClose(Get(radiosity, "TotalNetFlux", cell + 6), -(power[0] + power[1]) / 54.0, 3e-6,
      "total at the outer cube");
  }
  radiosity->ClearBandLimits();
  AddLimits(radiosity, { 8.0, 14.0 });
  SetHalves(AddArray(cubes, "Emissivity", { 0.0 }), { 0.9 }, { 1.0 });
  cubes->Modified();
  radiosity->Update();
  CheckClose(Get(radiosity, "NetFlux", 0), power[1] / 6.0, 3e-6, "the window alone");
}

//------------------------------------------------------------------------------
void TestPlateUnderSky()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 }, 2, 1);
  auto plate = surface.Get();
  AddArray(plate, "Temperature", { 400.0 });
  AddArray(plate, "Emissivity", { 0.25 });
  auto radiosity = MakeFilter(plate);
  radiosity->SetBackgroundTemperature(100.0);
  AddLimits(radiosity, { 0.0, 5.0, 10.0, Infinity });
  radiosity->Update();
  CheckClose(GetSummary(radiosity->GetPolyDataOutput(), "NetPower"),
    6.0 * 0.25 * (BlackFlux(400.0) - BlackFlux(100.0)), 1e-12, "power of a plate of 6 m2");
}

//------------------------------------------------------------------------------
// A convex body under the open sky.
void TestBodyUnderSky()
{
  Surface surface;
  AddSphere(surface, 2.0, 1, false);
  auto body = surface.Get();
  AddArray(body, "Temperature", { 350.0 });
  AddArray(body, "Emissivity", { 0.6 });
  auto radiosity = MakeFilter(body);
  radiosity->SetBackgroundTemperature(250.0);
  radiosity->Update();
  auto light = MakeFilter(body);
  light->SetBackgroundRadiance(BlackFlux(250.0) / vtkMath::Pi());
  light->Update();
  for (vtkIdType cell = 0; cell < body->GetNumberOfCells(); ++cell)
  {
    const double flux = 0.6 * (BlackFlux(350.0) - BlackFlux(250.0));
    CheckClose(Get(radiosity, "NetFlux", cell), flux, 1e-12, "a body under the sky");
    CheckClose(Get(radiosity, "Irradiance", cell), BlackFlux(250.0), 1e-12, "the sky");
    CheckClose(Get(light, "NetFlux", cell), flux, 1e-12, "the same as radiance");
  }
  // Two bands of the sky's temperature, and a radiance for each.
  radiosity->SetBackgroundTemperature(300.0);
  AddLimits(radiosity, { 8.0, 14.0, Infinity });
  radiosity->AddBackgroundRadiance(10.0);
  radiosity->AddBackgroundRadiance(20.0);
  Check(radiosity->GetNumberOfBackgroundRadiances() == 2 &&
      radiosity->GetBackgroundRadiance(1) == 20.0 && radiosity->GetBackgroundRadiance(2) == 0.0,
    "radiances are kept");
  radiosity->Update();
  CheckClose(Get(radiosity, "Irradiance", 3, 0),
    BlackFlux(300.0) * 0.37574229364592431 + 10.0 * vtkMath::Pi(), 1e-12, "sky in the window");
  CheckClose(Get(radiosity, "Irradiance", 3, 1),
    BlackFlux(300.0) * PlanckFraction::GetAbove(14.0 * 300.0) + 20.0 * vtkMath::Pi(), 1e-12,
    "sky beyond it");
}

//------------------------------------------------------------------------------
// A room without its ceiling.
vtkSmartPointer<vtkPolyData> MakeOpenRoom(int n)
{
  Surface room;
  room.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  room.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, n, n);
  room.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, n, n);
  room.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, n, n);
  room.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, n, n);
  return room.Get();
}

//------------------------------------------------------------------------------
void TestOpenRoom()
{
  auto room = MakeOpenRoom(3);
  AddArray(room, "Temperature", { 290.0 });
  vtkDoubleArray* emissivity = AddArray(room, "Emissivity", { 0.3 });
  vtkDoubleArray* condition = AddArray(room, "BoundaryCondition", { 0.0 });
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    emissivity->SetValue(cell, 0.02 * (cell + 1));
    condition->SetValue(cell, cell % 5 == 0 ? 1.0 : 0.0);
  }
  auto radiosity = MakeFilter(room);
  radiosity->SetBackgroundTemperature(290.0);
  radiosity->Update();
  const double black = BlackFlux(290.0);
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    CheckClose(Get(radiosity, "Radiosity", cell), black, 1e-6, "equilibrium with the background");
    CheckClose(Get(radiosity, "NetFlux", cell) / black, 0.0, 1e-6, "no net flux");
    CheckClose(Get(radiosity, "SurfaceTemperature", cell), 290.0, 1e-6, "adiabatic, too");
  }
  // All of it adiabatic: only the background tells how warm it is.
  condition->Fill(1.0);
  room->Modified();
  radiosity->Update();
  CheckClose(Get(radiosity, "SurfaceTemperature", 4), 290.0, 1e-6, "as warm as the background");
  // The furnace under a sky of radiance 1 / pi, which emits alone where reflectance is 1.
  auto white = MakeOpenRoom(2);
  AddArray(white, "Reflectance", { 1.0 });
  auto furnace = MakeFilter(white);
  furnace->SetBackgroundRadiance(1.0 / vtkMath::Pi());
  furnace->Update();
  for (vtkIdType cell = 0; cell < white->GetNumberOfCells(); ++cell)
  {
    CheckClose(Get(furnace, "Radiosity", cell), 1.0, 1e-6, "white room under a white sky");
  }
}

//------------------------------------------------------------------------------
// Heat that is put in leaves through the opening: what each patch sends into the sky less what the
// sky sends it. A block shades the room.
void TestHeatBalance()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  surface.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 3, 3);
  surface.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 3, 3);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3);
  surface.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 3, 3);
  constexpr double areaOfBlock = 0.04;
  surface.AddGrid({ 0.4, 0.4, 0.2 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1);
  surface.AddGrid({ 0.4, 0.4, 0.4 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1, 1);
  surface.AddGrid({ 0.4, 0.4, 0.2 }, { 0.2, 0, 0 }, { 0, 0, 0.2 }, 1, 1);
  surface.AddGrid({ 0.4, 0.6, 0.2 }, { 0, 0, 0.2 }, { 0.2, 0, 0 }, 1, 1);
  surface.AddGrid({ 0.4, 0.4, 0.2 }, { 0, 0, 0.2 }, { 0, 0.2, 0 }, 1, 1);
  surface.AddGrid({ 0.6, 0.4, 0.2 }, { 0, 0.2, 0 }, { 0, 0, 0.2 }, 1, 1);
  auto scene = surface.Get();
  const vtkIdType cells = scene->GetNumberOfCells();
  vtkDoubleArray* condition = AddArray(scene, "BoundaryCondition", { 0.0 });
  AddArray(scene, "PrescribedNetFlux", { 800.0 });
  AddArray(scene, "Temperature", { 350.0 });
  AddArray(scene, "Emissivity", { 0.4 });
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    condition->SetValue(cell, cell % 3 == 0 ? 1.0 : 0.0);
  }
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(scene);
  factors->SetTolerance(1e-5);
  factors->Update();
  vtkDataArray* sky = factors->GetPolyDataOutput()->GetCellData()->GetArray("SkyFraction");
  auto radiosity = MakeFilter(scene);
  radiosity->SetViewFactors(factors);
  radiosity->SetBackgroundTemperature(280.0);
  radiosity->Update();
  double escaping = 0.0, leaving = 0.0;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const double area = cell < 45 ? 1.0 / 9.0 : areaOfBlock;
    leaving += area * Get(radiosity, "NetFlux", cell);
    escaping +=
      area * sky->GetComponent(cell, 0) * (Get(radiosity, "Radiosity", cell) - BlackFlux(280.0));
  }
  CheckClose(leaving, escaping, 1e-4, "what leaves the surfaces leaves through the opening");
  CheckClose(GetSummary(radiosity->GetPolyDataOutput(), "NetPower"), leaving, 1e-12, "net power");
}

//------------------------------------------------------------------------------
// Nothing enters a closed room. View factors of which some were left out are computed again when a
// background needs whole rows.
void TestWhatBackgroundNeeds()
{
  auto closed = MakeRoom(2);
  AddArray(closed, "Temperature", { 300.0 })->SetValue(3, 400.0);
  AddArray(closed, "Emissivity", { 0.5 });
  auto without = MakeFilter(closed);
  without->Update();
  auto with = MakeFilter(closed);
  with->SetBackgroundTemperature(1000.0);
  with->Update();

  auto black = MakeOpenRoom(2);
  AddArray(black, "Temperature", { 0.0 })->SetValue(0, 300.0);
  AddArray(black, "Emissivity", { 1.0 });
  auto late = MakeFilter(black);
  late->Update();
  Check(GetSummary(late->GetPolyDataOutput(), "PairsNotSending") > 0.0, "pairs were left out");
  late->SetBackgroundTemperature(200.0);
  late->Update();
  vtkNew<vtkViewFactors> shared;
  shared->SetTolerance(1e-9);
  auto fresh = MakeFilter(black);
  fresh->SetViewFactors(shared);
  fresh->SetBackgroundTemperature(200.0);
  fresh->Update();
  for (vtkIdType cell = 0; cell < 20; ++cell)
  {
    Check(Get(with, "Radiosity", cell) == Get(without, "Radiosity", cell), "closed to the sky");
    const double irradiance = Get(fresh, "Irradiance", cell);
    Check(irradiance > 0.0, "something of the sky is seen");
    CheckClose(Get(late, "Irradiance", cell), irradiance, 1e-12, "a background switched on later");
  }
}

//------------------------------------------------------------------------------
// A room that is made anew for each time; only its temperatures change.
class HeatingRoom : public vtkPolyDataAlgorithm
{
public:
  static HeatingRoom* New();
  vtkTypeMacro(HeatingRoom, vtkPolyDataAlgorithm);

protected:
  HeatingRoom() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation*, vtkInformationVector**,
    vtkInformationVector* outputs) override
  {
    const double times[] = { 0.0, 1.0, 2.0 };
    vtkInformation* information = outputs->GetInformationObject(0);
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 3);
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), &times[0], 2);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double time =
      outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    auto room = MakeRoom(12);
    AddArray(room, "Temperature", { 300.0 + 100.0 * time });
    AddArray(room, "Emissivity", { 0.5 });
    vtkPolyData::GetData(outputs)->ShallowCopy(room);
    return 1;
  }
};
vtkStandardNewMacro(HeatingRoom);

//------------------------------------------------------------------------------
// New temperatures on the same geometry cost a solution and no view factors.
void TestTimeSeries()
{
  vtkNew<HeatingRoom> source;
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputConnection(source->GetOutputPort());
  radiosity->SetTolerance(1e-9);
  radiosity->SetViewFactorTolerance(1e-6);
  // The view factors take the first 80 % of the progress, if they are computed.
  int reports = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&reports);
  count->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      const double progress = static_cast<vtkAlgorithm*>(caller)->GetProgress();
      *static_cast<int*>(client) += progress > 0.0 && progress < 0.8 ? 1 : 0;
    });
  radiosity->AddObserver(vtkCommand::ProgressEvent, count);
  double seconds = 0.0;
  vtkSmartPointer<vtkPoints> points;
  for (int time = 0; time < 3; ++time)
  {
    reports = 0;
    radiosity->UpdateTimeStep(time);
    vtkPolyData* output = radiosity->GetPolyDataOutput();
    CheckClose(Get(radiosity, "Radiosity", 7), BlackFlux(300.0 + 100.0 * time), 1e-5,
      "the temperature of this time");
    const double now = GetSummary(output, "ViewFactorSeconds");
    Check(time > 0 ? now == seconds : reports > 0, "view factors are computed once");
    Check(time == 0 || reports == 0, "and not reported again");
    auto* input = vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
    Check(input && input->GetPoints() != points, "the source makes everything anew");
    points = input->GetPoints();
    seconds = now;
  }
}

//------------------------------------------------------------------------------
std::string ReadMaterials(vtkPolyData* data, vtkMultiProcessController* controller,
  RadiosityMaterials& materials)
{
  std::vector<std::string> names;
  for (int array = 0; array < MaterialArrays::NUMBER_OF_ARRAYS; ++array)
  {
    names.emplace_back(MaterialArrays::GetDefaultName(array));
  }
  PatchScene scene;
  const Ranks ranks(controller);
  CheckDone(scene.Build(data, ranks), "the scene");
  return materials.Read(CellArrays(scene, data, ranks), scene, names).GetMessage();
}

//------------------------------------------------------------------------------
// Every rank knows all materials, also one that has no patch; and all agree on what is wrong.
void TestRanks()
{
  constexpr int ranks = 3;
  const auto makePart = [](int rank)
  {
    Surface surface;
    for (int side = 0; side < 6; ++side)
    {
      // Both others share the sides.
      if (rank < 0 || rank == 2 * (side / 3))
      {
        const double height = side;
        surface.AddGrid({ 0, 0, height }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
      }
    }
    auto part = surface.Get();
    vtkDoubleArray* temperature = AddArray(part, "Temperature", { 300.0 });
    vtkDoubleArray* condition = AddArray(part, "BoundaryCondition", { 0.0 });
    AddArray(part, "Emissivity", { 0.5 });
    AddArray(part, "PrescribedNetFlux", { 42.0 });
    for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
    {
      const double height = part->GetCell(cell)->GetBounds()[4];
      temperature->SetValue(cell, 100.0 + height);
      condition->SetValue(cell, height == 4.0 ? 1.0 : 0.0);
    }
    return part;
  };
  RadiosityMaterials whole;
  Check(ReadMaterials(makePart(-1), nullptr, whole).empty(), "one rank reads");
  std::vector<std::string> errors(ranks);
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto part = makePart(rank);
      RadiosityMaterials materials;
      const std::string error = ReadMaterials(part, controller, materials);
      Check(error.empty(), "all ranks read: " + error);
      Check(materials.Emission == whole.Emission && materials.Reflectance == whole.Reflectance &&
          materials.HasGivenFlux == whole.HasGivenFlux,
        "every rank knows all materials");
      if (rank == 2)
      {
        part->GetCellData()->GetArray("BoundaryCondition")->SetComponent(1, 0, 3.0);
      }
      errors[rank] = ReadMaterials(part, controller, materials);
    });
  for (const std::string& error : errors)
  {
    Check(error.find("is 3 at polygon 4") != std::string::npos, "all know: " + error);
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestThermalRadiosity(int, char*[])
{
  TestTwoSurfaces();
  TestMixedCube();
  TestAdiabaticWalls();
  TestImpossibleTemperature();
  TestGreyBands();
  TestWindow();
  TestPlateUnderSky();
  TestBodyUnderSky();
  TestOpenRoom();
  TestHeatBalance();
  TestWhatBackgroundNeeds();
  TestTimeSeries();
  TestRanks();
  return Result();
}
