// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Links from clusters that are chosen for the light of vtkSubsurfaceScattering, against links
// between all pairs of patches and against links for any light.
#include "LightTransportTesting.h"
#include "RanksInThreads.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace LightTransportTesting;

namespace
{
constexpr int Bands = 3;
constexpr double Size = 12.0;
constexpr const char* Light = "TransmittedIrradiance";
using Scattering = vtkSubsurfaceScattering;
using Values = std::vector<double>;
/// Of light in a direction.
using Brightness = std::function<double(const Point&)>;

//------------------------------------------------------------------------------
/// From one side, with a sharp border of light and shade.
double ShineFromAside(const Point& place)
{
  return 0.02 + std::max(0.0, 0.3 * place[0] + 0.5 * place[1] + 0.8 * place[2]);
}

//------------------------------------------------------------------------------
double ShineOnSpot(const Point& place)
{
  return place[2] > 0.9 ? 1.0 : 0.0;
}

//------------------------------------------------------------------------------
/// A ball in these lights, of 1,280 triangles with 3 levels.
vtkSmartPointer<vtkPolyData> MakeBody(const std::vector<Brightness>& lights, int levels = 3)
{
  Surface surface;
  AddSphere(surface, 1.0, levels, false);
  auto body = surface.Get();
  const int components = Bands * static_cast<int>(lights.size());
  vtkDoubleArray* array = AddArray(body, Light, Values(components, 0.0));
  for (vtkIdType cell = 0; cell < body->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    body->GetCell(cell)->GetBounds(bounds);
    const Point place{ 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) };
    for (int component = 0; component < components; ++component)
    {
      array->SetComponent(cell, component, lights[component / Bands](place));
    }
  }
  return body;
}

//------------------------------------------------------------------------------
vtkSmartPointer<Scattering> MakeFilter(vtkPolyData* body, int method, bool refines,
  double millimeters = Size)
{
  auto filter = vtkSmartPointer<Scattering>::New();
  filter->SetInputData(body);
  filter->SetMaterialToMarble();
  filter->SetMillimetersPerUnit(millimeters);
  filter->SetIncidenceToTransmitted();
  filter->SetDeviceToCPU();
  filter->SetLinkMethod(method);
  filter->SetRefineByIrradiance(refines);
  return filter;
}

//------------------------------------------------------------------------------
double GetField(Scattering* filter, const char* name)
{
  return GetSummary(filter->GetPolyDataOutput(), name);
}

//------------------------------------------------------------------------------
Values GetResult(Scattering* filter)
{
  filter->Update();
  return GetValues(filter->GetPolyDataOutput()->GetCellData()->GetArray("ScatteredIrradiance"));
}

//------------------------------------------------------------------------------
/// With as many links the error is smaller, and what is told of it is true.
void TestErrors()
{
  auto body = MakeBody({ ShineFromAside });
  for (const double millimeters : { 1.2, 12.0 })
  {
    const std::string what = " at " + std::to_string(millimeters) + " mm";
    const Values all =
      GetResult(MakeFilter(body, Scattering::LINK_METHOD_DENSE, false, millimeters));
    for (const int method : { Scattering::LINK_METHOD_ADAPTIVE, Scattering::LINK_METHOD_UNIFORM })
    {
      const std::string name =
        (method == Scattering::LINK_METHOD_UNIFORM ? "uniform" : "adaptive") + what;
      auto any = MakeFilter(body, method, false, millimeters);
      auto chosen = MakeFilter(body, method, true, millimeters);
      for (Scattering* filter : { any.Get(), chosen.Get() })
      {
        filter->SetNumberOfLinks(40);
        filter->SetLinkTolerance(3e-3);
      }
      const double before = CompareBands(GetResult(any), all);
      const double now = CompareBands(GetResult(chosen), all);
      const double told = GetField(chosen, "LinkError");
      std::cout << name << ": error " << before << " for any light, " << now << " for this, told "
                << told << ", links " << GetField(chosen, "LinksPerReceiver") << " of "
                << GetField(any, "LinksPerReceiver") << "\n";
      Check(now < 0.9 * before,
        name + ": error " + std::to_string(now) + " after " + std::to_string(before));
      Check(now < 1.4 * told && told < 2.0 * now,
        name + ": error " + std::to_string(now) + ", told " + std::to_string(told));
    }
  }
}

//------------------------------------------------------------------------------
/// A spot, and even light, need few links; two lights those of both.
void TestLinks()
{
  const auto run = [](const std::vector<Brightness>& lights, bool refines, double& links)
  {
    auto body = MakeBody(lights);
    const Values all = GetResult(MakeFilter(body, Scattering::LINK_METHOD_DENSE, false));
    auto filter = MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE, refines);
    filter->SetNumberOfLinks(10000);
    const double error = CompareBands(GetResult(filter), all, Bands * lights.size());
    links = GetField(filter, "LinksPerReceiver");
    std::cout << lights.size() << " lights, " << refines << ": " << links << " links, error "
              << error << "\n";
    return error;
  };
  const Brightness even = [](const Point&) { return 0.7; };
  double any = 0.0;
  double ofAside = 0.0;
  double ofSpot = 0.0;
  double ofBoth = 0.0;
  double ofEven = 0.0;
  run({ ShineFromAside }, false, any);
  Check(run({ ShineFromAside }, true, ofAside) < 1.4e-2 && ofAside < 0.8 * any, "light from aside");
  Check(run({ ShineOnSpot }, true, ofSpot) < 1.4e-2 && ofSpot < 0.5 * any, "a spot");
  Check(run({ ShineFromAside, ShineOnSpot }, true, ofBoth) < 1.4e-2 && ofBoth > ofAside &&
      ofBoth > ofSpot,
    "two lights");
  Check(run({ even }, true, ofEven) < 3e-3 && ofEven < 0.3 * any, "even light");
  double ofDark = 0.0;
  const Brightness dark = [](const Point&) { return 0.0; };
  run({ even, dark }, true, ofDark);
  Check(ofDark == ofEven, "a dark light beside it");
}

//------------------------------------------------------------------------------
/// New light gets new links, the same light keeps them; what is not chosen for light does not look
/// at it.
void TestReuse()
{
  auto first = MakeBody({ ShineFromAside }, 2);
  auto second = MakeBody({ ShineOnSpot }, 2);
  auto filter = MakeFilter(first, Scattering::LINK_METHOD_ADAPTIVE, true);
  GetResult(filter);
  filter->Modified();
  GetResult(filter);
  Check(GetField(filter, "LinksReused") == 1.0, "the same light keeps its links");
  filter->SetInputData(second);
  const Values changed = GetResult(filter);
  Check(GetField(filter, "LinksReused") == 0.0, "new light gets new links");
  Check(changed == GetResult(MakeFilter(second, Scattering::LINK_METHOD_ADAPTIVE, true)),
    "which are those of the new light");
  filter->RefineByIrradianceOff();
  Check(GetResult(filter) == GetResult(MakeFilter(second, Scattering::LINK_METHOD_ADAPTIVE, false)),
    "links for any light");
  auto pairs = MakeFilter(first, Scattering::LINK_METHOD_DENSE, true);
  pairs->Update();
  pairs->SetInputData(second);
  pairs->Update();
  Check(GetField(pairs, "LinksReused") == 1.0, "all pairs serve any light");
}

//------------------------------------------------------------------------------
/// All ranks choose alike, whatever each has of the light. Last: ranks make vtkSMPTools sequential.
void TestRanks()
{
  auto body = MakeBody({ ShineFromAside }, 2);
  auto whole = MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE, true);
  whole->Update();
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      vtkNew<vtkPolyData> part;
      part->DeepCopy(body);
      part->BuildLinks();
      for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
      {
        if (rank != (cell < 100 ? 0 : 1))
        {
          part->DeleteCell(cell);
        }
      }
      part->RemoveDeletedCells();
      auto filter = MakeFilter(part, Scattering::LINK_METHOD_ADAPTIVE, true);
      filter->SetController(controller);
      filter->Update();
      for (const char* name : { "NumberOfLinks", "LinkError", "LeavingFlux" })
      {
        CheckClose(GetField(filter, name), GetField(whole, name), 1e-12, name);
      }
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestRefineByIrradiance(int, char*[])
{
  TestErrors();
  TestLinks();
  TestReuse();
  TestRanks();
  return Result();
}
