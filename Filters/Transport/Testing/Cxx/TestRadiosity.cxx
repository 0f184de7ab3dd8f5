// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiosity against exact solutions: the white furnace, a cube of six patches, energy, thermal
// equilibrium; all solvers.
#include "LightTransportTesting.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkRadiosity.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace LightTransportTesting;

namespace
{
const std::vector<int> Solvers = { vtkRadiosity::SOLVER_AUTO, vtkRadiosity::SOLVER_JACOBI,
  vtkRadiosity::SOLVER_GAUSS_SEIDEL, vtkRadiosity::SOLVER_SOUTHWELL, vtkRadiosity::SOLVER_CHEBYSHEV,
  vtkRadiosity::SOLVER_CONJUGATE_GRADIENT };

//------------------------------------------------------------------------------
double Get(vtkRadiosity* radiosity, const char* name, vtkIdType cell, int component = 0)
{
  vtkDataArray* array = radiosity->GetPolyDataOutput()->GetCellData()->GetArray(name);
  return Check(array && array->GetNumberOfTuples() > cell, std::string("cell array ") + name)
    ? array->GetComponent(cell, component)
    : vtkMath::Nan();
}

//------------------------------------------------------------------------------
// E = 1 - rho in a closed room gives B = 1 everywhere.
void TestFurnace()
{
  auto room = MakeRoom(6);
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(room);
  factors->SetTolerance(1e-8);
  for (const double rho : { 0.0, 0.5, 0.9, 0.99 })
  {
    AddArray(room, "Reflectance", { rho });
    AddArray(room, "Emission", { 1.0 - rho });
    for (const int solver : Solvers)
    {
      vtkNew<vtkRadiosity> radiosity;
      radiosity->SetInputData(room);
      radiosity->SetViewFactors(factors);
      radiosity->SetSolver(solver);
      radiosity->SetTolerance(1e-6);
      radiosity->SetMaximumNumberOfIterations(5000);
      radiosity->Update();
      double worst = 0.0;
      for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
      {
        worst = std::max(worst, std::abs(Get(radiosity, "Radiosity", cell) - 1.0));
      }
      const std::string what =
        "furnace at " + std::to_string(rho) + " with solver " + std::to_string(solver);
      Check(worst <= 1e-5, what + " is off by " + std::to_string(worst));
      Check(GetSummary(radiosity->GetPolyDataOutput(), "Converged") == 1.0, what + " converges");
      if (solver == vtkRadiosity::SOLVER_CONJUGATE_GRADIENT)
      {
        Check(GetSummary(radiosity->GetPolyDataOutput(), "NumberOfIterations") <= 12.0,
          what + ": iterations");
      }
    }
  }
}

//------------------------------------------------------------------------------
// Six quadrilaterals, one of them emitting.
void TestCube()
{
  const double rows[][4] = { { 0.5, 1.0909090981, 0.1817458261, 0.1818362689 },
    { 0.9, 2.3728813748, 1.5253105511, 1.5254520185 },
    { 0.99, 17.3622704726, 16.5274251277, 16.5275760999 } };
  auto cube = MakeRoom(1);
  vtkDoubleArray* emission = AddArray(cube, "Emission", { 0.0 });
  emission->SetValue(0, 1.0);
  for (const auto& row : rows)
  {
    AddArray(cube, "Reflectance", { row[0] });
    for (const int solver : Solvers)
    {
      vtkNew<vtkRadiosity> radiosity;
      radiosity->SetInputData(cube);
      radiosity->SetSolver(solver);
      radiosity->SetTolerance(1e-9);
      radiosity->SetViewFactorTolerance(1e-9);
      radiosity->SetMaximumNumberOfIterations(5000);
      radiosity->Update();
      // Single precision factors, amplified by 1 / (1 - rho).
      const double tolerance = 1e-7 / (1.0 - row[0]);
      CheckClose(Get(radiosity, "Radiosity", 0), row[1], tolerance, "emitter of the cube");
      CheckClose(Get(radiosity, "Radiosity", 1), row[2], tolerance, "opposite side of the cube");
      double power = 0.0, flux = 0.0;
      for (vtkIdType cell = 0; cell < 6; ++cell)
      {
        const double b = Get(radiosity, "Radiosity", cell);
        const double h = Get(radiosity, "Irradiance", cell);
        power += (1.0 - row[0]) * b;
        flux += Get(radiosity, "NetFlux", cell);
        CheckClose(Get(radiosity, "NetFlux", cell), b - h, 1e-14, "NetFlux = B - H");
        CheckClose(b, emission->GetValue(cell) + row[0] * h, 1e-14, "B = E + rho H");
        if (cell > 1)
        {
          CheckClose(b, row[3], tolerance, "adjacent side of the cube");
        }
      }
      CheckClose(power, 1.0, tolerance, "energy");
      CheckClose(flux, 0.0, 2e-7 * row[1] * 6, "the fluxes of a closed room sum to 0");
    }
  }
}

//------------------------------------------------------------------------------
// A finer mesh of the same cube tends to 1.105 for the emitter's mean.
void TestMeshedCube()
{
  auto cube = MakeRoom(8);
  vtkDoubleArray* emission = AddArray(cube, "Emission", { 0.0 });
  AddArray(cube, "Reflectance", { 0.5 });
  for (int cell = 0; cell < 64; ++cell)
  {
    emission->SetValue(cell, 1.0);
  }
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(cube);
  radiosity->Update();
  double mean = 0.0;
  for (int cell = 0; cell < 64; ++cell)
  {
    mean += Get(radiosity, "Radiosity", cell) / 64;
  }
  CheckClose(mean, 1.105, 2e-3, "emitter of a meshed cube");
}

//------------------------------------------------------------------------------
// Bands share the view factors and nothing else; one component serves all bands; the table tells
// the history.
void TestBandsAndTable()
{
  auto room = MakeRoom(3);
  AddArray(room, "Reflectance", { 0.2, 0.5, 0.8, 0.0, 1.0 });
  vtkDoubleArray* emission = AddArray(room, "Emission", { 0.0 });
  emission->SetValue(4, 2.0);
  // A black patch gives the band with reflectance 1 elsewhere a place to go.
  room->GetCellData()->GetArray("Reflectance")->SetComponent(7, 4, 0.0);
  vtkNew<vtkRadiosity> bands;
  bands->SetInputData(room);
  bands->SetTolerance(1e-8);
  bands->Update();
  vtkTable* table = bands->GetConvergence();
  Check(table && table->GetNumberOfColumns() == 4, "the table has four columns");
  const char* const names[] = { "Iteration", "Seconds", "Residual", "ErrorBound" };
  for (int column = 0; column < 4; ++column)
  {
    Check(std::string(table->GetColumnName(column)) == names[column],
      std::string("column ") + names[column]);
  }
  Check(table->GetNumberOfRows() ==
      1 + GetSummary(bands->GetPolyDataOutput(), "NumberOfIterations"),
    "a row per iteration");
  Check(table->GetValue(table->GetNumberOfRows() - 1, 2).ToDouble() <
      1e-6 * table->GetValue(0, 2).ToDouble(),
    "the residual falls");

  vtkNew<vtkDoubleArray> rho;
  rho->DeepCopy(room->GetCellData()->GetArray("Reflectance"));
  for (int band = 0; band < 5; ++band)
  {
    vtkDoubleArray* one = AddArray(room, "Reflectance", { 0.0 });
    one->CopyComponent(0, rho, band);
    vtkNew<vtkRadiosity> alone;
    alone->SetInputData(room);
    alone->SetTolerance(1e-8);
    alone->Update();
    for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
    {
      CheckClose(Get(bands, "Radiosity", cell, band), Get(alone, "Radiosity", cell), 1e-6,
        "a band by itself");
    }
  }
}

//------------------------------------------------------------------------------
// The bound holds: a loose solution differs from a tight one by no more than it.
void TestErrorBound()
{
  auto room = MakeRoom(4);
  AddArray(room, "Reflectance", { 0.9 });
  AddArray(room, "Emission", { 0.0 })->SetValue(10, 1.0);
  room->GetCellData()->GetArray("Reflectance")->SetComponent(30, 0, 1.0);
  vtkNew<vtkRadiosity> tight;
  tight->SetInputData(room);
  tight->SetTolerance(1e-12);
  tight->Update();
  for (const int solver : Solvers)
  {
    vtkNew<vtkRadiosity> loose;
    loose->SetInputData(room);
    loose->SetSolver(solver);
    loose->SetTolerance(0.05);
    loose->Update();
    const double bound = GetSummary(loose->GetPolyDataOutput(), "ErrorBound");
    double worst = 0.0;
    for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
    {
      worst =
        std::max(worst, std::abs(Get(loose, "Radiosity", cell) - Get(tight, "Radiosity", cell)));
    }
    Check(worst > 0.0 && worst <= bound, "the error bound of solver " + std::to_string(solver));
    Check(bound < 100.0 * worst, "the error bound is of use with solver " + std::to_string(solver));
  }
}

//------------------------------------------------------------------------------
// Equal temperatures: no net flux, and radiosity is sigma T^4 whatever the emissivity.
void TestThermal()
{
  auto room = MakeRoom(3);
  AddArray(room, "Temperature", { 300.0 });
  vtkDoubleArray* emissivity = AddArray(room, "Emissivity", { 0.1 });
  emissivity->SetValue(5, 0.9);
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(room);
  radiosity->SetTolerance(1e-7);
  radiosity->SetViewFactorTolerance(1e-8);
  radiosity->Update();
  const double black = 5.670374419e-8 * std::pow(300.0, 4);
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    CheckClose(Get(radiosity, "Radiosity", cell), black, 2e-6, "equilibrium");
    CheckClose(Get(radiosity, "NetFlux", cell) / black, 0.0, 2e-6, "no net flux in equilibrium");
  }
}

//------------------------------------------------------------------------------
// New materials cost a solution, not new view factors; a direct irradiance is reflected.
void TestCacheAndDirect()
{
  auto room = MakeRoom(3);
  AddArray(room, "Reflectance", { 0.5 });
  AddArray(room, "DirectIrradiance", { 2.0 });
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(room);
  radiosity->SetTolerance(1e-7);
  radiosity->SetViewFactorTolerance(1e-8);
  radiosity->Update();
  // B = rho (B + 2) everywhere.
  CheckClose(Get(radiosity, "Radiosity", 0), 2.0, 1e-6, "direct irradiance reflected");
  CheckClose(Get(radiosity, "Irradiance", 0), 4.0, 1e-6,
    "direct irradiance is part of the irradiance");
  const double seconds = GetSummary(radiosity->GetPolyDataOutput(), "ViewFactorSeconds");
  AddArray(room, "Reflectance", { 0.25 });
  room->Modified();
  radiosity->Update();
  CheckClose(Get(radiosity, "Radiosity", 0), 2.0 / 3.0, 1e-6, "the new reflectance counts");
  Check(GetSummary(radiosity->GetPolyDataOutput(), "ViewFactorSeconds") == seconds,
    "the view factors were kept");
}

//------------------------------------------------------------------------------
// Blocks are one scene, ghosts do not count, and points are split at creases and materials.
void TestStructures()
{
  auto room = MakeRoom(2);
  AddArray(room, "Reflectance", { 0.5 });
  vtkDoubleArray* emission = AddArray(room, "Emission", { 0.0 });
  emission->SetValue(0, 1.0);
  vtkNew<vtkRadiosity> whole;
  whole->SetInputData(room);
  whole->Update();
  vtkPolyData* output = whole->GetPolyDataOutput();
  // 26 points; 8 corners meet 3 faces, 12 edge middles 2; on the first face cell 0 emits and is
  // another material: 3 points of it get one more copy (its corner of the cube belongs to no other
  // cell of that face).
  Check(output->GetNumberOfPoints() == 26 + 8 * 2 + 12 + 3,
    "points are split at creases and materials: " + std::to_string(output->GetNumberOfPoints()));
  for (const char* name : { "Radiosity", "Irradiance", "NetFlux" })
  {
    Check(output->GetPointData()->HasArray(name), std::string("point array ") + name);
  }
  vtkNew<vtkIdList> corners;
  output->GetCellPoints(0, corners);
  for (vtkIdType k = 0; k < 4; ++k)
  {
    CheckClose(output->GetPointData()->GetArray("Radiosity")->GetComponent(corners->GetId(k), 0),
      Get(whole, "Radiosity", 0), 1e-12, "no average across materials");
  }

  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int half = 0; half < 2; ++half)
  {
    // Both blocks hold all cells; those of the other half are ghosts.
    vtkNew<vtkPolyData> block;
    block->DeepCopy(room);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType cell = 0; cell < 24; ++cell)
    {
      ghosts->InsertNextValue((cell < 12) == (half == 0) ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    }
    block->GetCellData()->AddArray(ghosts);
    blocks->SetBlock(2 * half, block);
  }
  vtkNew<vtkRadiosity> parts;
  parts->SetInputData(blocks);
  parts->Update();
  auto* result = vtkMultiBlockDataSet::SafeDownCast(parts->GetOutputDataObject(0));
  for (vtkIdType cell = 0; Check(result, "blocks in, blocks out") && cell < 24; ++cell)
  {
    auto* block = vtkPolyData::SafeDownCast(result->GetBlock(cell < 12 ? 0 : 2));
    CheckClose(block->GetCellData()->GetArray("Radiosity")->GetComponent(cell, 0),
      Get(whole, "Radiosity", cell), 1e-12, "the same scene in blocks");
  }
}

//------------------------------------------------------------------------------
// Each band converges by itself, also beside one whose rounding errors are larger than all of it.
void TestUnequalBands()
{
  auto room = MakeRoom(1);
  AddArray(room, "Emission", { 0.9e15, 0.01 });
  AddArray(room, "Reflectance", { 0.1, 0.99 });
  for (const int solver : { vtkRadiosity::SOLVER_JACOBI, vtkRadiosity::SOLVER_GAUSS_SEIDEL,
         vtkRadiosity::SOLVER_CHEBYSHEV, vtkRadiosity::SOLVER_CONJUGATE_GRADIENT })
  {
    vtkNew<vtkRadiosity> radiosity;
    radiosity->SetInputData(room);
    radiosity->SetSolver(solver);
    radiosity->SetMaximumNumberOfIterations(5000);
    radiosity->Update();
    const std::string what = "unequal bands, solver " + std::to_string(solver);
    Check(GetSummary(radiosity->GetPolyDataOutput(), "Converged") == 1.0, what + " converges");
    CheckClose(Get(radiosity, "Radiosity", 0, 0), 1e15, 1.1e-4, what + ", large band");
    CheckClose(Get(radiosity, "Radiosity", 0, 1), 1.0, 1.1e-4, what + ", small band");
  }
}

//------------------------------------------------------------------------------
// One small black patch emits and all others reflect everything: every patch has its radiosity.
// Only closed rows are good enough for that where rays decide what is visible.
void TestMirrors()
{
  Surface spheres;
  AddSphere(spheres, 1.0, 2, true);
  AddSphere(spheres, 0.4, 1, false);
  auto data = spheres.Get();
  AddArray(data, "Reflectance", { 1.0 })->SetValue(0, 0.0);
  AddArray(data, "Emission", { 0.0 })->SetValue(0, 3.0);
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(data);
  radiosity->EnforceClosureOn();
  radiosity->Update();
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    CheckClose(Get(radiosity, "Radiosity", cell), 3.0, 1e-3, "mirrors around a lamp");
  }
}

//------------------------------------------------------------------------------
// The largest difference between two results, all three arrays.
double Compare(vtkRadiosity* a, vtkRadiosity* b)
{
  double worst = 0.0;
  for (const char* name : { "Radiosity", "Irradiance", "NetFlux" })
  {
    vtkDataArray* first = a->GetPolyDataOutput()->GetCellData()->GetArray(name);
    vtkDataArray* second = b->GetPolyDataOutput()->GetCellData()->GetArray(name);
    Check(first && second && first->GetNumberOfValues() == second->GetNumberOfValues(), name);
    for (vtkIdType k = 0; k < first->GetNumberOfTuples(); ++k)
    {
      for (int band = 0; band < first->GetNumberOfComponents(); ++band)
      {
        worst =
          std::max(worst, std::abs(first->GetComponent(k, band) - second->GetComponent(k, band)));
      }
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadiosity> MakeTightRadiosity(vtkPolyData* data, vtkViewFactors* factors,
  double tolerance)
{
  auto radiosity = vtkSmartPointer<vtkRadiosity>::New();
  radiosity->SetInputData(data);
  radiosity->SetViewFactors(factors);
  radiosity->SetTolerance(1e-13);
  radiosity->SetViewFactorTolerance(tolerance);
  radiosity->Update();
  return radiosity;
}

//------------------------------------------------------------------------------
void CheckBlack(vtkRadiosity* radiosity, vtkIdType patches)
{
  for (vtkIdType cell = 0; cell < patches; ++cell)
  {
    const double irradiance = Get(radiosity, "Irradiance", cell);
    Check(irradiance > 0.3, "black patches receive");
    CheckClose(Get(radiosity, "Radiosity", cell), 0.0, 0.0, "black patches send nothing");
    CheckClose(Get(radiosity, "NetFlux", cell), -irradiance, 1e-15, "black patches absorb all");
  }
}

//------------------------------------------------------------------------------
// Half of a room is black and cold: nothing is computed between those patches (but where leaves of
// the tree hold both sorts), all else is as with the whole matrix, what they receive included.
// Patches that send in one band only are senders.
void TestSenders()
{
  // Single precision view factors.
  constexpr double Single = 2e-7;
  auto room = MakeRoom(4);
  const vtkIdType patches = room->GetNumberOfCells(), receivers = patches / 2;
  const double pairs = static_cast<double>(patches * (patches - 1) / 2);
  const double skipped = static_cast<double>(receivers * (receivers - 1) / 2);
  vtkDoubleArray* reflectance = AddArray(room, "Reflectance", { 0.0, 0.0 });
  vtkDoubleArray* emission = AddArray(room, "Emission", { 0.0, 0.0 });
  AddArray(room, "DirectIrradiance", { 0.25 });
  for (vtkIdType cell = receivers; cell < patches; ++cell)
  {
    // Either band alone makes a sender, and so does emission alone.
    reflectance->SetComponent(cell, static_cast<int>(cell % 2), cell % 3 == 0 ? 0.0 : 0.5);
    emission->SetComponent(cell, static_cast<int>(cell % 2), cell % 3 == 0 ? 1.0 : 0.0);
  }
  vtkNew<vtkViewFactors> all;
  all->SetTolerance(1e-9);
  auto whole = MakeTightRadiosity(room, all, 1e-9);
  auto part = MakeTightRadiosity(room, nullptr, 1e-9);
  vtkPolyData* output = part->GetPolyDataOutput();
  CheckClose(Compare(whole, part), 0.0, Single, "with and without pairs that do not send");
  const double notSending = GetSummary(output, "PairsNotSending");
  Check(notSending <= skipped && notSending > 0.25 * skipped,
    "pairs not sending: " + std::to_string(notSending) + " of " + std::to_string(skipped));
  CheckClose(GetSummary(output, "PairsExamined"), pairs - notSending, 0.0, "pairs examined");
  vtkPolyData* wholeOutput = whole->GetPolyDataOutput();
  CheckClose(GetSummary(wholeOutput, "PairsNotSending"), 0.0, 0.0, "shared view factors: all");
  CheckClose(GetSummary(wholeOutput, "PairsExamined"), pairs, 0.0, "shared view factors: pairs");
  CheckBlack(part, receivers);

  // Fewer senders need nothing new, more of them do, and closing needs whole rows.
  emission->SetComponent(patches - 1, 0, 0.0);
  emission->SetComponent(patches - 1, 1, 0.0);
  reflectance->SetComponent(patches - 1, 0, 0.0);
  reflectance->SetComponent(patches - 1, 1, 0.0);
  room->Modified();
  part->Update();
  whole->Update();
  CheckClose(GetSummary(output, "PairsNotSending"), notSending, 0.0, "a sender less");
  CheckClose(Compare(whole, part), 0.0, Single, "a sender less: result");
  reflectance->FillComponent(0, 0.3);
  room->Modified();
  part->Update();
  whole->Update();
  CheckClose(GetSummary(output, "PairsNotSending"), 0.0, 0.0, "all are senders");
  CheckClose(Compare(whole, part), 0.0, Single, "all are senders: result");
  reflectance->FillComponent(0, 0.0);
  reflectance->FillComponent(1, 0.0);
  vtkNew<vtkRadiosity> closed;
  closed->SetInputData(room);
  closed->EnforceClosureOn();
  closed->Update();
  CheckClose(GetSummary(closed->GetPolyDataOutput(), "PairsNotSending"), 0.0, 0.0,
    "closing needs all pairs");
}

//------------------------------------------------------------------------------
// Occluders count whether they send or not.
void TestBlackOccluder()
{
  Surface spheres;
  AddSphere(spheres, 1.0, 1, true);
  AddSphere(spheres, 0.5, 0, false);
  auto data = spheres.Get();
  vtkDoubleArray* reflectance = AddArray(data, "Reflectance", { 0.0 });
  vtkDoubleArray* emission = AddArray(data, "Emission", { 0.0 });
  for (vtkIdType cell = 0; cell < 32; ++cell)
  {
    reflectance->SetValue(cell, 0.5);
    emission->SetValue(cell, cell % 2 == 0 ? 1.0 : 0.0);
  }
  vtkNew<vtkViewFactors> all;
  all->SetTolerance(1e-4);
  auto whole = MakeTightRadiosity(data, all, 1e-4);
  auto part = MakeTightRadiosity(data, nullptr, 1e-4);
  const double notSending = GetSummary(part->GetPolyDataOutput(), "PairsNotSending");
  Check(notSending > 0.0, "pairs not sending around an occluder");
  // Both have the error of their view factors.
  CheckClose(Compare(whole, part), 0.0, 3e-4, "a black occluder");
}

//------------------------------------------------------------------------------
// What PrintSelf tells of the filter's own properties, a line each.
std::vector<std::string> PrintProperties(vtkRadiosity* radiosity)
{
  std::ostringstream text;
  radiosity->PrintSelf(text, vtkIndent());
  std::istringstream lines(text.str());
  std::vector<std::string> properties;
  for (std::string line; std::getline(lines, line);)
  {
    const bool isOwn = !properties.empty() || line.find("FeatureAngle:") == 0;
    if (isOwn && line.find("ProgressInterval:") != 0 && line.find("Controller:") != 0)
    {
      properties.push_back(line);
    }
  }
  return properties;
}

//------------------------------------------------------------------------------
// A copy has all properties of its source: the test has to change each that PrintSelf knows, and so
// finds one that was forgotten.
void TestCopies()
{
  vtkNew<vtkViewFactors> factors;
  vtkNew<vtkRadiosity> source, copy;
  const std::vector<std::string> before = PrintProperties(copy);
  source->SetFeatureAngle(10.0);
  source->SetSolverToJacobi();
  source->SetTolerance(1e-3);
  source->SetMaximumNumberOfIterations(7);
  source->AddBandLimit(4.0);
  source->SetBackgroundTemperature(300.0);
  source->SetBackgroundRadiance(2.0);
  source->SetLinkMethodToSampled();
  source->SetLinkTolerance(0.02);
  source->SetAccuracy(0.03);
  source->ComputeErrorsOn();
  source->SetClusterTreeToAtlas();
  source->RefineByBrightnessOn();
  source->SetDeviceToCPU();
  source->SetViewFactorTolerance(0.04);
  source->EnforceClosureOn();
  source->TwoSidedOn();
  source->SetViewFactors(factors);
  const std::vector<std::string> given = PrintProperties(source);
  copy->CopyProperties(source);
  const std::vector<std::string> copied = PrintProperties(copy);
  if (!Check(before.size() == given.size() && given.size() == copied.size() && given.size() > 10,
        "properties are printed"))
  {
    return;
  }
  for (std::size_t k = 0; k < given.size(); ++k)
  {
    Check(given[k] != before[k], "the test changes this property: " + before[k]);
    Check(given[k] == copied[k], given[k] + " is copied, not: " + copied[k]);
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiosity(int, char*[])
{
  TestFurnace();
  TestCube();
  TestMeshedCube();
  TestBandsAndTable();
  TestErrorBound();
  TestThermal();
  TestCacheAndDirect();
  TestStructures();
  TestUnequalBands();
  TestMirrors();
  TestSenders();
  TestBlackOccluder();
  TestCopies();
  return Result();
}
