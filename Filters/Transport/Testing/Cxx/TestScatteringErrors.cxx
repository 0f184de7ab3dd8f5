// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Bad input of vtkSubsurfaceScattering and vtkDirectIrradiance: one clear error each, no result,
// and no abort.
#include "LightTransportTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkDirectIrradiance.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkPointData.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTestErrorObserver.h"

#include <limits>

using namespace LightTransportTesting;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSurface()
{
  Surface surface;
  AddSphere(surface, 1.0, 0, false);
  auto data = surface.Get();
  AddArray(data, "Irradiance", { 1.0 });
  return data;
}

//------------------------------------------------------------------------------
/// The filter reports exactly this problem, and its output has no result.
template <typename Filter>
void Expect(vtkPolyData* data, const std::string& part, const std::function<void(Filter*)>& change)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  vtkNew<Filter> filter;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  filter->SetInputData(data);
  change(filter);
  filter->Update();
  Check(errors->GetError(), "an error for: " + part);
  Check(errors->GetErrorMessage().find(part) != std::string::npos,
    "\"" + part + "\" in \"" + errors->GetErrorMessage() + "\"");
  vtkCellData* cells = filter->GetPolyDataOutput()->GetCellData();
  Check(!cells->HasArray("ScatteredIrradiance") && !cells->HasArray("DirectIrradiance"),
    "no output after: " + part);
}

//------------------------------------------------------------------------------
void ExpectScattering(
  vtkPolyData* data, const std::string& part,
  const std::function<void(vtkSubsurfaceScattering*)>& change = [](vtkSubsurfaceScattering*) {})
{
  Expect<vtkSubsurfaceScattering>(data, part, change);
}

//------------------------------------------------------------------------------
void ExpectDirect(const std::string& part, const std::function<void(vtkDirectIrradiance*)>& change)
{
  Expect<vtkDirectIrradiance>(MakeSurface(), part, change);
}

//------------------------------------------------------------------------------
void TestOptics()
{
  using Filter = vtkSubsurfaceScattering;
  auto data = MakeSurface();
  for (const double bad : { -1.0, vtkMath::Nan(), Infinity })
  {
    ExpectScattering(data, "finite and not negative",
      [bad](Filter* filter) { filter->SetScatteringCoefficient(1.0, bad, 1.0); });
    ExpectScattering(data, "finite and not negative",
      [bad](Filter* filter) { filter->SetAbsorptionCoefficient(bad, 0.0, 1.0); });
    ExpectScattering(data, "RefractiveIndex",
      [bad](Filter* filter) { filter->SetRefractiveIndex(bad); });
    ExpectScattering(data, "MillimetersPerUnit",
      [bad](Filter* filter) { filter->SetMillimetersPerUnit(bad); });
  }
  ExpectScattering(data, "both 0 in component 2",
    [](Filter* filter)
    {
      filter->SetScatteringCoefficient(1.0, 1.0, 0.0);
      filter->SetAbsorptionCoefficient(0.0, 0.0, 0.0);
    });
  ExpectScattering(data, "RefractiveIndex is 0.99",
    [](Filter* filter) { filter->SetRefractiveIndex(0.99); });
  ExpectScattering(data, "MillimetersPerUnit is 0",
    [](Filter* filter) { filter->SetMillimetersPerUnit(0.0); });
  for (const double bad : { 1e-300, 1e-17, 1e17, 1e300 })
  {
    ExpectScattering(data, "mm from end to end",
      [bad](Filter* filter) { filter->SetMillimetersPerUnit(bad); });
  }
}

//------------------------------------------------------------------------------
void TestIrradiance()
{
  using Filter = vtkSubsurfaceScattering;
  ExpectScattering(MakeSurface(), "\"TransmittedIrradiance\"",
    [](Filter* filter) { filter->SetIncidenceToTransmitted(); });
  ExpectScattering(MakeSurface(), "\"Sun\"",
    [](Filter* filter)
    { filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Sun"); });
  for (const double bad : { vtkMath::Nan(), Infinity })
  {
    auto data = MakeSurface();
    AddArray(data, "Irradiance", { 1.0 })->SetValue(7, bad);
    ExpectScattering(data, "\"Irradiance\"");
  }
  auto data = MakeSurface();
  AddArray(data, "Irradiance", { 1.0, 1.0 });
  ExpectScattering(data, "2 components");
  ExpectScattering(vtkSmartPointer<vtkPolyData>::New(), "no polygons");
}

//------------------------------------------------------------------------------
/// Not an error, but said: light that entered through a surface of another index.
void TestIndexWarning()
{
  vtkNew<vtkLight> light;
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(MakeSurface());
  direct->AddLight(light);
  direct->SetRefractiveIndex(1.5);
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkNew<vtkSubsurfaceScattering> filter;
  filter->AddObserver(vtkCommand::WarningEvent, messages);
  filter->SetInputConnection(direct->GetOutputPort());
  filter->SetIncidenceToTransmitted();
  filter->SetDeviceToCPU();
  filter->Update();
  Check(messages->GetWarningMessage().find("refractive index of 1.5") != std::string::npos,
    "a warning of another refractive index");
  messages->Clear();
  filter->SetRefractiveIndex(1.5);
  filter->Update();
  Check(!messages->GetWarning(), "no warning for the same index");
}

//------------------------------------------------------------------------------
void TestModels()
{
  ExpectScattering(MakeSurface(), "diffuse mean free path is infinite",
    [](vtkSubsurfaceScattering* filter)
    {
      filter->SetModelToChristensenBurley();
      filter->SetBurleyFitToDiffuseMeanFreePath();
      filter->SetAbsorptionCoefficient(0.1, 0.0, 0.1);
    });
  // More light than there is: said for the model that claims it, and for no other.
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkNew<vtkSubsurfaceScattering> filter;
  filter->AddObserver(vtkCommand::WarningEvent, messages);
  filter->SetInputData(MakeSurface());
  filter->SetMillimetersPerUnit(1e4);
  filter->SetAbsorptionCoefficient(0.0, 0.0, 0.0);
  filter->SetLinkTolerance(1e-2);
  filter->SetRefractiveIndex(1.0);
  filter->SetDeviceToCPU();
  for (int model = 0; model <= vtkSubsurfaceScattering::MODEL_CHRISTENSEN_BURLEY; ++model)
  {
    filter->SetModel(model);
    filter->Update();
    const bool claims = model == vtkSubsurfaceScattering::MODEL_BETTER_DIPOLE ||
      model == vtkSubsurfaceScattering::MODEL_PHOTON_BEAM_DIFFUSION;
    Check((messages->GetWarningMessage().find("times the light that enters") !=
            std::string::npos) == claims,
      "a warning of too much light, model " + std::to_string(model));
    messages->Clear();
  }
}

//------------------------------------------------------------------------------
void TestLights()
{
  using Filter = vtkDirectIrradiance;
  const auto addLight = [](const std::function<void(vtkLight*)>& change)
  {
    return [change](Filter* filter)
    {
      vtkNew<vtkLight> light;
      change(light);
      filter->AddLight(light);
    };
  };
  ExpectDirect("headlight", addLight([](vtkLight* light) { light->SetLightTypeToHeadlight(); }));
  ExpectDirect("camera light",
    addLight([](vtkLight* light) { light->SetLightTypeToCameraLight(); }));
  ExpectDirect("intensity", addLight([](vtkLight* light) { light->SetIntensity(-1.0); }));
  ExpectDirect("intensity", addLight([](vtkLight* light) { light->SetIntensity(vtkMath::Nan()); }));
  ExpectDirect("color",
    addLight([](vtkLight* light) { light->SetDiffuseColor(1.0, Infinity, 0.0); }));
  ExpectDirect("attenuation",
    addLight([](vtkLight* light) { light->SetAttenuationValues(0.0, 0.0, 0.0); }));
  ExpectDirect("attenuation",
    addLight([](vtkLight* light) { light->SetAttenuationValues(1.0, -1.0, 0.0); }));
  ExpectDirect("no direction",
    addLight([](vtkLight* light) { light->SetFocalPoint(light->GetPosition()); }));
  for (const double bad : { 0.5, vtkMath::Nan(), Infinity })
  {
    ExpectDirect("RefractiveIndex", [bad](Filter* filter) { filter->SetRefractiveIndex(bad); });
  }
}

//------------------------------------------------------------------------------
void TestEnvironments()
{
  using Filter = vtkDirectIrradiance;
  vtkNew<vtkImageData> image;
  ExpectDirect("two-dimensional", [&](Filter* filter) { filter->SetEnvironment(image); });
  image->SetDimensions(4, 2, 2);
  image->AllocateScalars(VTK_DOUBLE, 3);
  ExpectDirect("two-dimensional", [&](Filter* filter) { filter->SetEnvironment(image); });
  image->SetDimensions(4, 2, 1);
  image->AllocateScalars(VTK_DOUBLE, 2);
  ExpectDirect("2 components", [&](Filter* filter) { filter->SetEnvironment(image); });
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (int x = 0; x < 4; ++x)
  {
    image->SetScalarComponentFromDouble(x, 0, 0, 0, 1.0);
    image->SetScalarComponentFromDouble(x, 1, 0, 0, x == 2 ? vtkMath::Nan() : 1.0);
  }
  ExpectDirect("pixel 6", [&](Filter* filter) { filter->SetEnvironment(image); });
  image->GetPointData()->GetScalars()->SetNumberOfTuples(5);
  ExpectDirect("has 5 tuples where there are 8 points",
    [&](Filter* filter) { filter->SetEnvironment(image); });
}

//------------------------------------------------------------------------------
/// Abort leaves early and without a result.
void TestAbort()
{
  vtkNew<vtkSubsurfaceScattering> filter;
  filter->SetInputData(MakeSurface());
  filter->SetDeviceToCPU();
  int calls = 0;
  vtkNew<vtkCallbackCommand> abort;
  abort->SetClientData(&calls);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      if (++*static_cast<int*>(data) == 3)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
      }
    });
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  Check(calls >= 3 && calls < 20, "left after " + std::to_string(calls) + " reports");
  Check(!filter->GetPolyDataOutput()->GetCellData()->HasArray("ScatteredIrradiance"),
    "no result after an abort");
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringErrors(int, char*[])
{
  TestOptics();
  TestIrradiance();
  TestIndexWarning();
  TestModels();
  TestLights();
  TestEnvironments();
  TestAbort();
  return Result();
}
