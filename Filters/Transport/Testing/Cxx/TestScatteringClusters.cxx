// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Scattering by links from clusters, against links between all pairs of patches.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "RanksInThreads.h"
#include "VoxelBodies.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSMPTools.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <cmath>

using namespace LightTransportTesting;

namespace
{
constexpr int Bands = 3;
using Scattering = vtkSubsurfaceScattering;

//------------------------------------------------------------------------------
// A ball with a smaller one beside it, lit from one side: 1,600 triangles.
vtkSmartPointer<vtkPolyData> MakeBody()
{
  Surface surface;
  AddSphere(surface, 1.0, 3, false);
  vtkSmartPointer<vtkPolyData> ball = surface.Get();
  vtkNew<vtkTransform> transform;
  transform->Translate(1.2, 0.1, 0.0);
  transform->Scale(0.3, 0.4, 0.3);
  vtkNew<vtkTransformPolyDataFilter> move;
  Surface other;
  AddSphere(other, 1.0, 2, false);
  move->SetTransform(transform);
  move->SetInputData(other.Get());
  move->Update();
  Surface both;
  for (vtkPolyData* part : { ball.Get(), move->GetOutput() })
  {
    for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
    {
      std::vector<Point> corners;
      for (vtkIdType k = 0; k < part->GetCell(cell)->GetNumberOfPoints(); ++k)
      {
        Point point;
        part->GetPoint(part->GetCell(cell)->GetPointId(k), point.data());
        corners.push_back(point);
      }
      both.AddPolygon(corners);
    }
  }
  return both.Get();
}

//------------------------------------------------------------------------------
void SetLight(vtkPolyData* data, const std::vector<double>& values)
{
  data->GetCellData()->RemoveArray("TransmittedIrradiance");
  vtkDoubleArray* array = AddArray(data, "TransmittedIrradiance", { 0.0 });
  std::copy(values.begin(), values.end(), array->GetPointer(0));
}

//------------------------------------------------------------------------------
void AddLight(vtkPolyData* data, bool isEven)
{
  std::vector<double> light;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    data->GetCell(cell)->GetBounds(bounds);
    light.push_back(isEven ? 1.0 : std::max(0.0, 0.3 + bounds[4] + 0.2 * bounds[0]));
  }
  SetLight(data, light);
}

//------------------------------------------------------------------------------
vtkSmartPointer<Scattering> MakeFilter(vtkPolyData* data, int method, double millimeters)
{
  auto filter = vtkSmartPointer<Scattering>::New();
  filter->SetInputData(data);
  filter->SetMaterialToMarble();
  filter->SetMillimetersPerUnit(millimeters);
  filter->SetIncidenceToTransmitted();
  filter->SetLinkMethod(method);
  filter->SetDeviceToCPU();
  return filter;
}

//------------------------------------------------------------------------------
std::vector<double> GetResult(Scattering* filter)
{
  filter->Update();
  return GetValues(filter->GetPolyDataOutput()->GetCellData()->GetArray("ScatteredIrradiance"));
}

//------------------------------------------------------------------------------
double GetField(Scattering* filter, const char* name)
{
  return GetSummary(filter->GetPolyDataOutput(), name);
}

//------------------------------------------------------------------------------
// Bodies of 7, 70 and 700 mean free paths of red: the error is the one that is told.
void TestErrors(vtkPolyData* data)
{
  for (const double millimeters : { 1.2, 12.0, 120.0 })
  {
    const std::string what = " at " + std::to_string(millimeters) + " mm";
    const std::vector<double> all =
      GetResult(MakeFilter(data, Scattering::LINK_METHOD_DENSE, millimeters));
    double before = 1.0;
    double links = 0.0;
    for (const double tolerance : { 3e-2, 5e-3 })
    {
      auto filter = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, millimeters);
      filter->SetNumberOfLinks(10000);
      filter->SetLinkTolerance(tolerance);
      const double error = CompareBands(GetResult(filter), all);
      Check(GetText(filter->GetPolyDataOutput(), "LinksLimitedBy") == "LinkTolerance",
        "the tolerance is kept" + what);
      Check(GetField(filter, "LinkError") <= tolerance, "estimate within the tolerance" + what);
      Check(error <= 1.5 * tolerance && error < before,
        "adaptive links of " + std::to_string(tolerance) + what + ": " + std::to_string(error));
      Check(GetField(filter, "LinksPerReceiver") > links, "finer links are more" + what);
      before = error;
      links = GetField(filter, "LinksPerReceiver");
    }
    before = 1.0;
    for (const int number : { 16, 128 })
    {
      auto filter = MakeFilter(data, Scattering::LINK_METHOD_UNIFORM, millimeters);
      filter->SetNumberOfLinks(number);
      const double error = CompareBands(GetResult(filter), all);
      Check(GetText(filter->GetPolyDataOutput(), "LinkMethodUsed") == "Uniform" && error < before &&
          error < 0.15,
        std::to_string(number) + " uniform links" + what + ": " + std::to_string(error));
      before = error;
    }
  }
}

//------------------------------------------------------------------------------
void TestNumbers(vtkPolyData* data)
{
  for (const int number : { 24, 64 })
  {
    auto filter = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 12.0);
    filter->SetNumberOfLinks(number);
    filter->SetLinkTolerance(1e-4);
    filter->Update();
    const double links = GetField(filter, "LinksPerReceiver");
    Check(links <= number && links > 0.8 * number,
      std::to_string(number) + " links at most, there are " + std::to_string(links));
    Check(GetText(filter->GetPolyDataOutput(), "LinksLimitedBy") == "NumberOfLinks",
      "and they are the limit");
    CheckClose(GetField(filter, "NumberOfLinks"),
      links * static_cast<double>(data->GetNumberOfCells()), 1e-12, "links of all");
    Check(GetField(filter, "LinkBytes") > 16.0 * GetField(filter, "NumberOfLinks"), "bytes");
  }
}

//------------------------------------------------------------------------------
// Even light, whatever the links: their means are exact to what their factors are.
void TestEvenLight(vtkPolyData* data)
{
  vtkNew<vtkPolyData> even;
  even->DeepCopy(data);
  AddLight(even, true);
  const std::vector<double> all = GetResult(MakeFilter(even, Scattering::LINK_METHOD_DENSE, 12.0));
  for (const int method : { Scattering::LINK_METHOD_UNIFORM, Scattering::LINK_METHOD_ADAPTIVE })
  {
    auto filter = MakeFilter(even, method, 12.0);
    filter->SetNumberOfLinks(16);
    const double error = CompareBands(GetResult(filter), all);
    Check(error < 6e-3, "even light by few links: " + std::to_string(error));
  }
}

//------------------------------------------------------------------------------
// Moved, turned, in another unit, in single precision far away: the same within the tolerance.
void TestPlaces(vtkPolyData* data)
{
  auto original = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 12.0);
  original->SetNumberOfLinks(1000);
  const std::vector<double> expected = GetResult(original);
  vtkNew<vtkTransform> transform;
  transform->Translate(6e5, -3e5, 20.0);
  transform->RotateWXYZ(40.0, 1.0, 2.0, 3.0);
  transform->Scale(1e3, 1e3, 1e3);
  for (const int precision : { vtkAlgorithm::DOUBLE_PRECISION, vtkAlgorithm::SINGLE_PRECISION })
  {
    vtkNew<vtkTransformPolyDataFilter> move;
    move->SetTransform(transform);
    move->SetInputData(data);
    move->SetOutputPointsPrecision(precision);
    move->Update();
    auto moved = MakeFilter(move->GetOutput(), Scattering::LINK_METHOD_ADAPTIVE, 12.0e-3);
    moved->SetNumberOfLinks(1000);
    moved->AddObserver(vtkCommand::WarningEvent, vtkNew<MessageLog>());
    const double error = CompareBands(GetResult(moved), expected);
    Check(error < 1.5e-2, "a moved body: " + std::to_string(error));
  }
}

//------------------------------------------------------------------------------
// The links that are kept serve new light.
void TestReuse(vtkPolyData* data)
{
  auto filter = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 12.0);
  const std::vector<double> before = GetResult(filter);
  Check(GetField(filter, "LinksReused") == 0.0, "links are made");
  vtkNew<vtkPolyData> brighter;
  brighter->ShallowCopy(data);
  vtkDataArray* light = data->GetCellData()->GetArray("TransmittedIrradiance");
  std::vector<double> twice;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    twice.push_back(2.0 * light->GetComponent(cell, 0));
  }
  SetLight(brighter, twice);
  filter->SetInputData(brighter);
  std::vector<double> after = GetResult(filter);
  Check(GetField(filter, "LinksReused") == 1.0, "links are kept");
  std::transform(after.begin(), after.end(), after.begin(),
    [](double value) { return 0.5 * value; });
  Check(CompareBands(after, before) < 1e-14, "twice the light");
}

//------------------------------------------------------------------------------
// A sheet with an open border, one of two sides in one place, and a thin one whose sides are meshed
// differently; the last in two blocks as well.
void TestSheets()
{
  const auto add = [](Surface& surface, double height, int parts)
  {
    if (height > 0.0)
    {
      surface.AddGrid({ 0, 0, height }, { 1, 0, 0 }, { 0, 1, 0 }, parts, parts);
    }
    else
    {
      surface.AddGrid({ 0, 0, height }, { 0, 1, 0 }, { 1, 0, 0 }, parts, parts);
    }
  };
  const std::vector<std::vector<std::pair<double, int>>> sheets = { { { 0.004, 28 } },
    { { 0.0, 20 }, { 1e-9, 20 } }, { { 0.0, 20 }, { 0.004, 14 } } };
  for (const auto& sides : sheets)
  {
    Surface surface;
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (const auto& side : sides)
    {
      add(surface, side.first, side.second);
      Surface block;
      add(block, side.first, side.second);
      auto data = block.Get();
      AddLight(data, false);
      blocks->SetBlock(blocks->GetNumberOfBlocks(), data);
    }
    auto data = surface.Get();
    AddLight(data, false);
    auto pairs = MakeFilter(data, Scattering::LINK_METHOD_DENSE, 5.0);
    auto clusters = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 5.0);
    clusters->SetNumberOfLinks(1000);
    const double error = CompareBands(GetResult(clusters), GetResult(pairs));
    Check(error < 1e-2, std::to_string(sides.size()) + " sides: " + std::to_string(error));
    const double leaving = GetSummary(clusters->GetPolyDataOutput(), "LeavingFlux");
    clusters->SetInputDataObject(blocks);
    clusters->Update();
    CheckClose(GetSummary(clusters->GetOutputDataObject(0), "LeavingFlux"), leaving, 1e-6,
      "blocks are one body");
  }
}

//------------------------------------------------------------------------------
void TestMethods(vtkPolyData* data)
{
  Surface one;
  one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  auto triangle = one.Get();
  AddArray(triangle, "TransmittedIrradiance", { 1.0 });
  const std::vector<double> exact =
    GetResult(MakeFilter(triangle, Scattering::LINK_METHOD_DENSE, 1.0));
  for (const int method : { Scattering::LINK_METHOD_AUTO, Scattering::LINK_METHOD_UNIFORM,
         Scattering::LINK_METHOD_ADAPTIVE })
  {
    Check(CompareBands(GetResult(MakeFilter(triangle, method, 1.0)), exact) < 1e-6, "one triangle");
  }
  auto few = MakeFilter(triangle, Scattering::LINK_METHOD_AUTO, 1.0);
  few->Update();
  Check(GetText(few->GetPolyDataOutput(), "LinkMethodUsed") == "Dense",
    "few patches are linked each with each");
  auto many = MakeFilter(data, Scattering::LINK_METHOD_AUTO, 120.0);
  many->Update();
  Check(GetText(many->GetPolyDataOutput(), "LinkMethodUsed") == "Adaptive",
    "many patches by clusters");

  auto photons = MakeFilter(data, Scattering::LINK_METHOD_UNIFORM, 1.0);
  vtkNew<MessageLog> errors;
  photons->AddObserver(vtkCommand::ErrorEvent, errors);
  photons->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, vtkNew<MessageLog>());
  photons->SetModelToMonteCarlo();
  photons->Update();
  Check(errors->GetAll().find("set it to Auto, or to Dense") != std::string::npos,
    "photons have no clusters: " + errors->GetAll());
}

//------------------------------------------------------------------------------
// What goes through the air of a horseshoe is known as of pairs.
void TestAir()
{
  auto data = MakeCubes(MakeHorseshoe(), 4);
  AddLight(data, true);
  auto pairs = MakeFilter(data, Scattering::LINK_METHOD_DENSE, 2.0);
  auto clusters = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 2.0);
  pairs->Update();
  clusters->Update();
  for (int band = 0; band < Bands; ++band)
  {
    const auto get = [band](Scattering* from, const char* name)
    { return from->GetPolyDataOutput()->GetFieldData()->GetArray(name)->GetComponent(0, band); };
    const double expected = get(pairs, "LinksThroughAir");
    const double error =
      std::hypot(get(pairs, "LinksThroughAirError"), get(clusters, "LinksThroughAirError"));
    Check(expected > 10.0 * error && error > 0.0, "there is air, and its share is known");
    CheckClose(get(clusters, "LinksThroughAir"), expected, 4.0 * error / expected,
      "share of the air");
  }
  clusters->DropLinksThroughAirOn();
  vtkNew<MessageLog> errors;
  clusters->AddObserver(vtkCommand::ErrorEvent, errors);
  clusters->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, vtkNew<MessageLog>());
  clusters->Update();
  Check(errors->GetAll().find("looks at pairs of patches") != std::string::npos,
    "clusters are not dropped: " + errors->GetAll());
}

//------------------------------------------------------------------------------
void TestThreads(vtkPolyData* data)
{
  std::vector<double> results[2];
  for (const int threads : { 1, 4 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]() {
        results[threads / 4] = GetResult(MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 12.0));
      });
  }
  Check(results[0] == results[1] && !results[0].empty(), "links do not depend on threads");
}

//------------------------------------------------------------------------------
// Last: ranks make vtkSMPTools sequential.
void TestRanks(vtkPolyData* data)
{
  auto whole = MakeFilter(data, Scattering::LINK_METHOD_ADAPTIVE, 12.0);
  GetResult(whole);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      vtkNew<vtkPolyData> part;
      part->DeepCopy(data);
      part->BuildLinks();
      for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
      {
        if (rank != (cell < 900 ? 0 : 1))
        {
          part->DeleteCell(cell);
        }
      }
      part->RemoveDeletedCells();
      auto filter = MakeFilter(part, Scattering::LINK_METHOD_ADAPTIVE, 12.0);
      filter->SetController(controller);
      filter->Update();
      for (const char* name : { "NumberOfLinks", "LinkError", "LinksPerReceiver" })
      {
        CheckClose(GetField(filter, name), GetField(whole, name), 1e-12, name);
      }
      for (int band = 0; band < Bands; ++band)
      {
        const auto get = [band](Scattering* from)
        {
          return from->GetPolyDataOutput()
            ->GetFieldData()
            ->GetArray("LeavingFlux")
            ->GetComponent(0, band);
        };
        CheckClose(get(filter), get(whole), 1e-9, "ranks: leaving");
      }
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringClusters(int, char*[])
{
  auto data = MakeBody();
  AddLight(data, false);
  TestErrors(data);
  TestNumbers(data);
  TestEvenLight(data);
  TestPlaces(data);
  TestReuse(data);
  TestSheets();
  TestMethods(data);
  TestAir();
  TestThreads(data);
  TestRanks(data);
  return Result();
}
