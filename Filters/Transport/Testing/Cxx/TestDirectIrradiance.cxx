// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Lights, shadows, Fresnel transmission and environments with known results.
#include "LightTransportTesting.h"
#include "vtkDirectIrradiance.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTransform.h"
#include "vtkTrivialProducer.h"

#include <algorithm>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkLight> MakeLight(const Point& position, const Point& focus, bool positional)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetPosition(position[0], position[1], position[2]);
  light->SetFocalPoint(focus[0], focus[1], focus[2]);
  light->SetPositional(positional);
  light->SetConeAngle(90.0);
  return light;
}

//------------------------------------------------------------------------------
/// One square of side 1 around the origin, looking to +z.
vtkSmartPointer<vtkPolyData> MakeSquare(double side = 1.0)
{
  Surface surface;
  surface.AddGrid({ -0.5 * side, -0.5 * side, 0 }, { side, 0, 0 }, { 0, side, 0 }, 1, 1);
  return surface.Get();
}

//------------------------------------------------------------------------------
double GetValue(vtkDirectIrradiance* filter, vtkIdType cell = 0, int band = 0,
  const char* name = "DirectIrradiance")
{
  filter->Update();
  vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray(name);
  Check(array && array->GetNumberOfComponents() == 3, std::string(name) + " on cells");
  return array ? array->GetComponent(cell, band) : vtkMath::Nan();
}

//------------------------------------------------------------------------------
void TestDirectional()
{
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(MakeSquare());
  auto light = MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false);
  light->SetIntensity(2.0);
  light->SetDiffuseColor(1.0, 0.5, 0.25);
  filter->AddLight(light);
  filter->AddLight(light);
  Check(filter->GetNumberOfLights() == 1, "a light counts once");
  for (const double angle : { 0.0, 30.0, 60.0, 89.0 })
  {
    const double radians = vtkMath::RadiansFromDegrees(angle);
    light->SetPosition(std::sin(radians), 0.0, std::cos(radians));
    for (int band = 0; band < 3; ++band)
    {
      CheckClose(GetValue(filter, 0, band), 2.0 * std::pow(0.5, band) * std::cos(radians), 1e-12,
        "directional light at " + std::to_string(angle));
    }
  }
  light->SetPosition(0.3, 0.0, -1.0);
  CheckClose(GetValue(filter), 0.0, 0.0, "back faces get nothing");
  light->SetPosition(0.0, 0.0, 1.0);
  vtkNew<vtkTransform> turn;
  turn->RotateY(60.0);
  light->SetTransformMatrix(turn->GetMatrix());
  CheckClose(GetValue(filter), 1.0, 1e-12, "the light's transform matrix");
  turn->Identity();
  light->GetTransformMatrix()->DeepCopy(turn->GetMatrix());
  CheckClose(GetValue(filter), 2.0, 1e-12, "changing the matrix runs the filter again");
  light->SetSwitch(false);
  vtkNew<vtkLight> other;
  other->SetPosition(0.0, 0.0, 1.0);
  other->SetIntensity(0.5);
  filter->AddLight(other);
  CheckClose(GetValue(filter), 0.5, 1e-12, "lights that are off");
  light->SetSwitch(true);
  CheckClose(GetValue(filter), 2.5, 1e-12, "lights add up");
  CheckClose(GetSummary(filter->GetOutput(), "DirectFlux"), 2.5, 1e-12, "flux");
  vtkDataArray* points = filter->GetPolyDataOutput()->GetPointData()->GetArray("DirectIrradiance");
  Check(points && points->GetNumberOfTuples() == 4, "DirectIrradiance on points");
  CheckClose(points->GetComponent(0, 0), 2.5, 1e-12, "point value");
  Check(!filter->GetPolyDataOutput()->GetCellData()->HasArray("TransmittedIrradiance"),
    "an opaque surface transmits nothing");
  filter->RemoveLight(light);
  CheckClose(GetValue(filter), 0.5, 1e-12, "RemoveLight");
  filter->RemoveAllLights();
  Check(filter->GetNumberOfLights() == 0, "RemoveAllLights");
}

//------------------------------------------------------------------------------
void TestPositional()
{
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(MakeSquare(1e-3));
  auto light = MakeLight({ 0, 0, 2 }, { 0, 0, 0 }, true);
  light->SetAttenuationValues(0.0, 0.0, 1.0);
  filter->AddLight(light);
  CheckClose(GetValue(filter), 0.25, 1e-6, "1 / d^2");
  light->SetPosition(2.0, 0.0, 2.0);
  CheckClose(GetValue(filter), std::sqrt(0.5) / 8.0, 2e-5, "1 / d^2 and the cosine");
  light->SetAttenuationValues(1.0, 0.5, 0.0);
  light->SetPosition(0.0, 0.0, 2.0);
  CheckClose(GetValue(filter), 0.5, 1e-6, "linear attenuation");
  light->SetAttenuationValues(1.0, 0.0, 0.0);
  light->SetPosition(1.0, 0.0, 1.0);
  light->SetFocalPoint(1.0, 0.0, 0.0);
  light->SetExponent(3.0);
  light->SetConeAngle(46.0);
  CheckClose(GetValue(filter), std::pow(0.5, 0.5) * std::pow(0.5, 1.5), 1e-2, "within the cone");
  light->SetConeAngle(44.0);
  CheckClose(GetValue(filter), 0.0, 0.0, "outside the cone");
  light->SetConeAngle(90.0);
  CheckClose(GetValue(filter), std::sqrt(0.5), 1e-3, "no cone, no exponent");
}

//------------------------------------------------------------------------------
/// A wide square and, above it, a blocker whose edge cuts the shadow off at x.
vtkSmartPointer<vtkPolyData> MakeShadowScene(double x)
{
  Surface surface;
  surface.AddGrid({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  surface.AddGrid({ -2, -2, 1 }, { 0, 4, 0 }, { x + 2, 0, 0 }, 1, 1);
  return surface.Get();
}

//------------------------------------------------------------------------------
void TestShadows()
{
  vtkNew<vtkDirectIrradiance> filter;
  auto light = MakeLight({ 0, 0, 3 }, { 0, 0, 0 }, false);
  filter->AddLight(light);
  for (const double x : { -1.0, -0.2, 0.0, 0.17, 0.4, 1.0 })
  {
    filter->SetInputData(MakeShadowScene(x));
    const double lit = std::min(1.0, std::max(0.0, 0.5 - x));
    CheckClose(GetValue(filter) - lit, 0.0, 1e-2, "shadow up to " + std::to_string(x));
  }
  filter->SetInputData(MakeShadowScene(0.0));
  filter->ShadowsOff();
  CheckClose(GetValue(filter), 1.0, 1e-12, "without shadows");
  filter->ShadowsOn();
  // A light between the blocker and the square is not blocked.
  light->SetPositional(true);
  light->SetConeAngle(90.0);
  light->SetPosition(0.0, 0.0, 0.9);
  Check(GetValue(filter) > 0.5, "a blocker behind the light");

  light->SetPositional(false);
  light->SetPosition(0.1, 0.2, 3.0);
  filter->SetInputData(MakeRoom(3));
  double range[2];
  GetValue(filter);
  filter->GetPolyDataOutput()->GetCellData()->GetArray("DirectIrradiance")->GetRange(range, 0);
  CheckClose(range[1], 0.0, 0.0, "a closed room is dark");
}

//------------------------------------------------------------------------------
void TestThreads()
{
  Surface surface;
  AddSphere(surface, 1.0, 2, false);
  surface.AddGrid({ -2, -2, -1.2 }, { 4, 0, 0 }, { 0, 4, 0 }, 8, 8);
  vtkNew<vtkDoubleArray> first;
  for (const int threads : { 1, 2, 3 })
  {
    vtkNew<vtkDirectIrradiance> filter;
    filter->SetInputData(surface.Get());
    auto light = MakeLight({ 1, 1, 2 }, { 0, 0, 0 }, true);
    filter->AddLight(light);
    vtkSMPTools::Config config(threads);
    vtkSMPTools::LocalScope(config, [&]() { GetValue(filter); });
    vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray("DirectIrradiance");
    if (threads == 1)
    {
      first->DeepCopy(array);
    }
    bool same = true;
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
    {
      same = same && array->GetComponent(k, 0) == first->GetComponent(k, 0);
    }
    Check(same, "the same with " + std::to_string(threads) + " threads");
  }
}

//------------------------------------------------------------------------------
void TestTransmission()
{
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(MakeSquare());
  auto light = MakeLight({ 0, 0, 1 }, { 0, 0, 0 }, false);
  filter->AddLight(light);
  filter->SetRefractiveIndex(1.5);
  CheckClose(GetValue(filter, 0, 0, "TransmittedIrradiance"), 0.96, 1e-12, "normal incidence");
  CheckClose(GetSummary(filter->GetOutput(), "RefractiveIndex"), 1.5, 0.0, "index recorded");
  // Brewster's angle: only the perpendicular half is reflected.
  const double angle = std::atan(1.5);
  light->SetPosition(std::sin(angle), 0.0, std::cos(angle));
  const double reflected = (1.0 - 1.5 * 1.5) / (1.0 + 1.5 * 1.5);
  CheckClose(GetValue(filter, 0, 0, "TransmittedIrradiance"),
    std::cos(angle) * (1.0 - 0.5 * reflected * reflected), 1e-12, "Brewster's angle");
}

//------------------------------------------------------------------------------
/// Radiance 1 in the directions that `inside` picks by longitude (0 to 1) and latitude (0 at -z, 1
/// at +z).
vtkSmartPointer<vtkImageData> MakeEnvironment(int components,
  const std::function<bool(double, double)>& inside)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(256, 128, 1);
  image->AllocateScalars(VTK_DOUBLE, components);
  for (int y = 0; y < 128; ++y)
  {
    for (int x = 0; x < 256; ++x)
    {
      for (int k = 0; k < components; ++k)
      {
        image->SetScalarComponentFromDouble(x, y, 0, k,
          inside((x + 0.5) / 256.0, (y + 0.5) / 128.0) ? 1.0 + k : 0.0);
      }
    }
  }
  return image;
}

//------------------------------------------------------------------------------
void TestEnvironment()
{
  Surface sphere;
  AddSphere(sphere, 1.0, 1, false);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(sphere.Get());
  filter->SetEnvironment(MakeEnvironment(3, [](double, double) { return true; }));
  filter->SetRefractiveIndex(1.5);
  for (const vtkIdType cell : { 0, 17, 79 })
  {
    for (int band = 0; band < 3; ++band)
    {
      CheckClose(GetValue(filter, cell, band), (1.0 + band) * vtkMath::Pi(), 1e-2,
        "uniform environment on a convex body");
      CheckClose(GetValue(filter, cell, band, "TransmittedIrradiance"),
        (1.0 + band) * vtkMath::Pi() * (1.0 - 0.091778), 5e-3, "transmitted diffuse light");
    }
  }
  filter->SetRefractiveIndex(1.0);
  filter->SetEnvironmentSamples(4096);
  // Squares that look to +z, -z, +x, -x and +y.
  Surface squares;
  squares.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  squares.AddGrid({ 10, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  squares.AddGrid({ 20, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  squares.AddGrid({ 30, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 1, 1);
  squares.AddGrid({ 40, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1, 1);
  filter->SetInputData(squares.Get());
  filter->ShadowsOff();
  const double pi = vtkMath::Pi();
  filter->SetEnvironment(
    MakeEnvironment(1, [](double, double latitude) { return latitude > 0.5; }));
  const double upper[] = { pi, 0.0, 0.5 * pi, 0.5 * pi, 0.5 * pi };
  filter->Update();
  for (int k = 0; k < 5; ++k)
  {
    CheckClose(GetValue(filter, k) - upper[k], 0.0, 3e-2,
      "upper half sky, square " + std::to_string(k));
  }
  // Longitudes 0 to 90 degrees: between +x and +y.
  filter->SetEnvironment(
    MakeEnvironment(1, [](double longitude, double) { return longitude < 0.25; }));
  const double quarter[] = { 0.25 * pi, 0.25 * pi, 0.5 * pi, 0.0, 0.5 * pi };
  for (int k = 0; k < 5; ++k)
  {
    CheckClose(GetValue(filter, k) - quarter[k], 0.0, 3e-2,
      "quarter sky, square " + std::to_string(k));
  }
  // From a pipeline that changes, as readers do, and from nothing again.
  vtkNew<vtkTrivialProducer> reader;
  reader->SetOutput(MakeEnvironment(1, [](double, double latitude) { return latitude > 0.5; }));
  filter->SetInputConnection(1, reader->GetOutputPort());
  CheckClose(GetValue(filter, 0), pi, 3e-2, "upper half sky from a reader");
  reader->SetOutput(MakeEnvironment(1, [](double, double latitude) { return latitude < 0.5; }));
  CheckClose(GetValue(filter, 1), pi, 3e-2, "lower half sky from a reader");
  filter->SetEnvironment(nullptr);
  Check(!filter->GetEnvironment() && filter->GetNumberOfInputConnections(1) == 0, "no sky");
}

//------------------------------------------------------------------------------
/// A lamp on a surface shines in front of it, and a thin wall of two patches does not shade itself.
void TestOnSurface()
{
  Surface room;
  room.AddGrid({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  room.AddGrid({ -0.5, -0.5, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  room.AddGrid({ -5, -5, 10 }, { 0, 10, 0 }, { 10, 0, 0 }, 1, 1);
  vtkNew<vtkDirectIrradiance> filter;
  filter->SetInputData(room.Get());
  filter->SetRefractiveIndex(1.5);
  filter->AddLight(MakeLight({ 0, 0, 10 }, { 0, 0, 0 }, true));
  filter->Update();
  CheckClose(GetValue(filter, 0), 1.0, 5e-3, "a lamp on the ceiling");
  Check(GetValue(filter, 1) == 0.0, "the other side of a thin wall");
  // Where the lamp touches the ceiling there is no angle of incidence.
  const double ceiling = filter->GetPolyDataOutput()
                           ->GetCellData()
                           ->GetArray("TransmittedIrradiance")
                           ->GetComponent(2, 0);
  Check(ceiling == 0.0, "a lamp does not light the plane that it is in");
}
} // namespace

//------------------------------------------------------------------------------
int TestDirectIrradiance(int, char*[])
{
  TestDirectional();
  TestPositional();
  TestShadows();
  TestThreads();
  TestOnSurface();
  TestTransmission();
  TestEnvironment();
  return Result();
}
