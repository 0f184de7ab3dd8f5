// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// No more light leaves than enters, with any model of scattering on any body, or a warning says how
// much and why.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "VoxelBodies.h"
#include "vtkPLYReader.h"
#include "vtkSubsurfaceScattering.h"

#ifdef TEST_WITH_MESHING
#include "vtkPatchMesher.h"
#endif

#include <algorithm>
#include <sstream>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
struct Run
{
  vtkNew<vtkSubsurfaceScattering> Filter;
  vtkNew<MessageLog> Warnings;

  Run(vtkPolyData* data, int model, double millimeters)
  {
    if (!data->GetCellData()->HasArray("TransmittedIrradiance"))
    {
      AddArray(data, "TransmittedIrradiance", { 1.0 });
    }
    this->Filter->AddObserver(vtkCommand::WarningEvent, this->Warnings);
    this->Filter->SetInputData(data);
    this->Filter->SetModel(model);
    // Links of all pairs know what goes through air; photons are followed where there are none.
    this->Filter->SetLinkMethod(model == vtkSubsurfaceScattering::MODEL_MONTE_CARLO
        ? vtkSubsurfaceScattering::LINK_METHOD_AUTO
        : vtkSubsurfaceScattering::LINK_METHOD_DENSE);
    this->Filter->SetMillimetersPerUnit(millimeters);
    this->Filter->SetIncidenceToTransmitted();
    this->Filter->SetLinkTolerance(3e-3);
    this->Filter->SetNumberOfPhotons(10000);
    this->Filter->SetDeviceToCPU();
  }
  /// Hardly any absorption, so that most light leaves.
  void SetClear()
  {
    this->Filter->SetScatteringCoefficient(1.0, 1.0, 1.0);
    this->Filter->SetAbsorptionCoefficient(1e-5, 1e-3, 1e-2);
  }
  double Get(const char* name, int band)
  {
    this->Filter->Update();
    vtkDataArray* array = this->Filter->GetPolyDataOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, band) : vtkMath::Nan();
  }
};

//------------------------------------------------------------------------------
std::string ToText(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

//------------------------------------------------------------------------------
void CheckPhotons(Run& run, const std::string& what)
{
  for (int band = 0; band < 3; ++band)
  {
    const double leaving = run.Get("LeavingShare", band);
    const double error = run.Get("LeavingShareError", band);
    Check(leaving <= 1.0 + 4.0 * error,
      what + ": photons leave by " + ToText(leaving) + " +- " + ToText(error));
  }
  Check(run.Warnings->GetAll().find("leaves again") == std::string::npos,
    what + ": photons keep energy");
}

//------------------------------------------------------------------------------
/// Returns the largest part of the entering light that leaves.
double CheckProfile(Run& run, const std::string& what)
{
  double gain = 0.0;
  int worst = 0;
  for (int band = 0; band < 3; ++band)
  {
    const double leaving = run.Get("LeavingFlux", band) / run.Get("EnteringFlux", band);
    worst = leaving > gain ? band : worst;
    gain = std::max(gain, leaving);
  }
  const std::string& text = run.Warnings->GetAll();
  const bool isTold = text.find("leaves again") != std::string::npos;
  const double margin = 0.01 + run.Get("LinkErrorBound", 0);
  Check(isTold == (gain > 1.0 + margin),
    what + ": " + ToText(gain) + " leaves, and the warning is: " + text);
  if (isTold)
  {
    const auto has = [&text](const std::string& part)
    { return text.find(part) != std::string::npos; };
    const double flat = run.Get("ProfileTotal", worst);
    const double air = run.Get("LinksThroughAir", worst);
    Check(has("In component " + std::to_string(worst) + " " + ToText(gain) + " times the light"),
      what + ": the warning says how much: " + text);
    Check(has("a flat surface gives back " + ToText(flat) + " by this model"),
      what + ": the model's part");
    const bool isDropped = run.Filter->GetDropLinksThroughAir();
    Check(isDropped || air == 0.0 ? !has("through the air")
                                  : has(ToText(100.0 * air) + " % goes through the air"),
      what + ": the part of the air");
    Check(has("straight links claim too much") == (gain > flat), what + ": the part of links");
  }
  return gain;
}

//------------------------------------------------------------------------------
void TestBodies()
{
  struct Body
  {
    const char* Name;
    vtkSmartPointer<vtkPolyData> Data;
    double Millimeters;
  };
  Surface slab;
  slab.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3);
  slab.AddGrid({ 0, 0, 0.02 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  const Body bodies[] = { { "a box", MakeCubes({ { 0, 0, 0 } }, 3), 30.0 },
    { "a horseshoe", MakeCubes(MakeHorseshoe(), 2), 10.0 },
    { "a bowl", MakeBowl(3, 1.0, 1.2), 50.0 }, { "two sides of a thin slab", slab.Get(), 30.0 } };
  for (const Body& body : bodies)
  {
    double largest = 0.0;
    for (int model = vtkSubsurfaceScattering::MODEL_DIPOLE;
         model <= vtkSubsurfaceScattering::MODEL_TABULATED; ++model)
    {
      const std::string what = std::string(body.Name) + ", model " + std::to_string(model);
      Run run(body.Data, model, body.Millimeters);
      run.SetClear();
      if (model != vtkSubsurfaceScattering::MODEL_MONTE_CARLO)
      {
        largest = std::max(largest, CheckProfile(run, what));
      }
      else if (body.Data != bodies[3].Data)
      {
        CheckPhotons(run, what);
      }
    }
    Check(largest > 1.02, std::string(body.Name) + " is one that gives back too much");
  }
}

//------------------------------------------------------------------------------
/// Where it is the model's own fault, where air is, and where it is none.
void TestReasons()
{
  auto box = MakeCubes({ { 0, 0, 0 } }, 2);
  Run model(box, vtkSubsurfaceScattering::MODEL_BETTER_DIPOLE, 1e4);
  model.SetClear();
  model.Filter->SetRefractiveIndex(1.0);
  Check(CheckProfile(model, "the better dipole at index 1") > 1.1, "a model that claims too much");
  auto horseshoe = MakeCubes(MakeHorseshoe(), 2);
  Run air(horseshoe, vtkSubsurfaceScattering::MODEL_DIPOLE, 10.0);
  air.SetClear();
  const double with = CheckProfile(air, "a horseshoe");
  Run without(horseshoe, vtkSubsurfaceScattering::MODEL_DIPOLE, 10.0);
  without.SetClear();
  without.Filter->DropLinksThroughAirOn();
  const double share = without.Get("LinksThroughAir", 0);
  const double leaving = CheckProfile(without, "a horseshoe without links through air");
  CheckClose(leaving, (1.0 - share) * with, 1e-5, "less where links are dropped");
  Check(share > 0.01, "some are dropped");

  // Differences of light may leave more than they bring.
  vtkDoubleArray* light = AddArray(box, "TransmittedIrradiance", { -1.0 });
  light->SetValue(0, 23.5);
  Run difference(box, vtkSubsurfaceScattering::MODEL_DIPOLE, 1.0);
  difference.SetClear();
  difference.Filter->Update();
  Check(difference.Warnings->GetAll().empty(), "of differences nothing is told");
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
/// Skim milk of a size where little is lost.
void TestBunny()
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(reader->GetOutputPort());
  mesher->SetTargetNumberOfPatches(400);
  mesher->Update();
  for (int model = vtkSubsurfaceScattering::MODEL_DIPOLE;
       model <= vtkSubsurfaceScattering::MODEL_TABULATED; ++model)
  {
    const std::string what = "a bunny of milk, model " + std::to_string(model);
    Run run(mesher->GetOutput(), model, 10.0);
    run.Filter->SetMaterialToSkimmilk();
    if (model == vtkSubsurfaceScattering::MODEL_MONTE_CARLO)
    {
      run.Filter->SetNumberOfPhotons(2000);
      CheckPhotons(run, what);
      continue;
    }
    const double gain = CheckProfile(run, what);
    Check(gain > 0.8 && gain < 1.0, what + ": " + ToText(gain) + " leaves");
  }
}
#endif
} // namespace

//------------------------------------------------------------------------------
int TestScatteringEnergy(int, char*[])
{
  TestBodies();
  TestReasons();
#ifdef TEST_WITH_MESHING
  TestBunny();
#endif
  return Result();
}
