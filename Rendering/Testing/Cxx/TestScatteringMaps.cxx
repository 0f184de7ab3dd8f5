// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The maps of what enters and of what leaves a translucent body, against the CPU filters: lights of
 * each kind, with and without shadows; links of each kind; energy from step to step; what is
 * refused.
 */
#include "LightTransportTesting.h"
#include "ScatteringScene.h"

#include "vtkAppendPolyData.h"
#include "vtkPlaneSource.h"
#include "vtkTestErrorObserver.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace LightTransportTesting;
using namespace ScatteringScene;

constexpr int Size = 128;

void CheckLight(Scene& scene, vtkPolyData* blocker, double tolerance, double outliers,
  const std::string& what)
{
  scene.Window->Render();
  const std::vector<double> map = Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture());
  if (!Check(!map.empty(), what + ": there is no map"))
  {
    return;
  }
  const Difference difference =
    Compare(map, GetTransmitted(scene.Ball, blocker, { scene.Light }, 1.3, Size));
  std::cout << what << ": relative error " << difference.Relative << ", texels off by 5 % "
            << difference.Outliers << "\n";
  Check(difference.Relative <= tolerance, what + ": the map is off");
  Check(difference.Outliers <= outliers, what + ": too many texels are off");
}

/// Directional, point and spot lights, and those that the camera carries.
void TestLights()
{
  Scene scene(Size / ChartsPerSide);
  scene.Material->SetLinkMethodToUniform();
  scene.Material->SetNumberOfLinks(4);
  scene.Pass->SetScatteredMapSize(16);
  scene.Pass->ShadowsOff();
  scene.Light->SetDiffuseColor(1.0, 0.5, 0.25);
  scene.Light->SetIntensity(2.0);
  CheckLight(scene, nullptr, 0.01, 0.0, "directional light");
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(180.0);
  scene.Light->SetAttenuationValues(0.1, 0.2, 0.3);
  CheckLight(scene, nullptr, 0.01, 0.0, "point light");
  scene.Light->SetConeAngle(14.0);
  scene.Light->SetExponent(20.0);
  CheckLight(scene, nullptr, 0.03, 0.005, "spot light");

  const std::vector<double> before = Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture());
  const vtkIdType runs = scene.Pass->GetNumberOfIrradianceRuns();
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(1.0, 2.0, 3.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  scene.Light->SetLightTypeToHeadlight();
  scene.Window->Render();
  std::vector<double> map = Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture());
  double largest = 0.0;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    largest = std::max(largest, std::abs(map[k] - before[k]));
  }
  Check(largest < 1e-5, "a headlight is not a scene light at the camera");
  camera->SetPosition(3.0, 2.0, 1.0);
  scene.Window->Render();
  Check(scene.Pass->GetNumberOfIrradianceRuns() == runs + 1, "a headlight follows its camera");
  scene.Light->SwitchOff();
  scene.Renderer->AutomaticLightCreationOff();
  scene.Window->Render();
  map = Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture());
  double area = 0.0;
  largest = 0.0;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    largest = std::max(largest, k % 4 < 3 ? map[k] : 0.0);
    area += k % 4 == 3 ? map[k] : 0.0;
  }
  Check(largest == 0.0, "light without lights");
  CheckClose(area, Size * Size, 1e-4, "the area in the dark");
}

/// A ball behind a plate, and the plate's edge on it.
void TestShadows()
{
  Scene scene(Size / ChartsPerSide);
  scene.Pass->SetIrradianceSamples(4);
  scene.Material->SetLinkMethodToUniform();
  scene.Material->SetNumberOfLinks(4);
  scene.Pass->SetScatteredMapSize(16);
  vtkNew<vtkPlaneSource> plate;
  plate->SetOrigin(0.1, -0.3, 1.5);
  plate->SetPoint1(1.6, -0.3, 1.4);
  plate->SetPoint2(0.1, 1.6, 1.7);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plate->GetOutputPort());
  triangles->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plate->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.Renderer->AddActor(actor);
  vtkPolyData* blocker = triangles->GetOutput();
  scene.Light->SetPosition(0.2, 0.5, 3.0);
  CheckLight(scene, blocker, 0.03, 0.005, "directional light, shadows");
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(180.0);
  CheckLight(scene, blocker, 0.03, 0.005, "point light, shadows");
  scene.Light->SetConeAngle(25.0);
  CheckLight(scene, blocker, 0.03, 0.005, "spot light, shadows");
  const vtkIdType runs = scene.Pass->GetNumberOfIrradianceRuns();
  actor->VisibilityOff();
  scene.Window->Render();
  Check(scene.Pass->GetNumberOfIrradianceRuns() == runs + 1, "what casts a shadow is hidden");
}

/// What vtkSubsurfaceScattering makes on the CPU of the same texels and light.
std::vector<double> Scatter(Scene& scene, int size)
{
  vtkOpenGLAtlasTexture* entering = scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture();
  const auto level = static_cast<int>(std::lround(std::log2(entering->GetResolution() / size)));
  const std::vector<double> light = Read(entering, level);
  vtkNew<vtkImageData> texels;
  texels->ShallowCopy(scene.Pass->GetScatteredMap(scene.Actor)->GetTexels());
  vtkNew<vtkDoubleArray> values;
  values->SetName("TransmittedIrradiance");
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(texels->GetNumberOfPoints());
  for (vtkIdType texel = 0; texel < values->GetNumberOfTuples(); ++texel)
  {
    const double* value = &light[static_cast<std::size_t>(4 * texel)];
    for (int k = 0; k < 3; ++k)
    {
      values->SetComponent(texel, k, value[3] > 0.0 ? value[k] / value[3] : 0.0);
    }
  }
  texels->GetPointData()->AddArray(values);
  scene.Material->SetInputDataObject(texels);
  scene.Material->SetIncidenceToTransmitted();
  scene.Material->SetDeviceToCPU();
  scene.Material->Update();
  vtkDataArray* scattered = vtkImageData::SafeDownCast(scene.Material->GetOutputDataObject(0))
                              ->GetPointData()
                              ->GetArray("ScatteredIrradiance");
  std::vector<double> map(static_cast<std::size_t>(4 * values->GetNumberOfTuples()), 0.0);
  for (vtkIdType texel = 0; texel < values->GetNumberOfTuples(); ++texel)
  {
    for (int k = 0; k < 3; ++k)
    {
      map[static_cast<std::size_t>(4 * texel + k)] = scattered->GetComponent(texel, k);
    }
  }
  return map;
}

/// All kinds of links, and maps that are finer and coarser than each other.
void TestLinks()
{
  Scene scene(16);
  scene.Material->SetScatteringCoefficient(1.0, 2.0, 3.0);
  Check(scene.Pass->GetScatteredMap(scene.Actor)->GetNumberOfLinkBytes() == 0,
    "links that are not there take bytes");
  const auto check = [&scene](int size, const std::string& what)
  {
    scene.Pass->SetScatteredMapSize(size);
    scene.Window->Render();
    vtkOpenGLScatteredMap* map = scene.Pass->GetScatteredMap(scene.Actor);
    const std::vector<double> found = Read(map->GetTexture());
    if (!Check(!found.empty(), what + ": there is no map"))
    {
      return;
    }
    Check(map->GetNumberOfBytesRead() == 0, what + ": something was read back");
    const Difference difference = Compare(found, Scatter(scene, size));
    std::cout << what << ": relative error " << difference.Relative << "\n";
    Check(difference.Relative < 1e-4, what + ": the map is not the filter's");
  };
  check(32, "adaptive");
  const vtkTypeInt64 bytes = scene.Pass->GetScatteredMap(scene.Actor)->GetNumberOfLinkBytes();
  scene.Material->CompressLinksOn();
  check(32, "adaptive, compressed");
  const vtkTypeInt64 coded = scene.Pass->GetScatteredMap(scene.Actor)->GetNumberOfLinkBytes();
  Check(coded > 0 && 4 * coded < bytes,
    "compressed links take " + std::to_string(coded) + " of " + std::to_string(bytes) + " bytes");
  scene.Material->SetLinkMethodToUniform();
  check(32, "uniform, compressed");
  scene.Material->CompressLinksOff();
  scene.Material->SetNumberOfLinks(16);
  check(32, "uniform");
  scene.Material->SetLinkMethodToDense();
  check(16, "dense");
}

/// Relative L2 difference of `name` on a ball, averaged over pairs of triangles, and the texels of
/// a map that these are in, `finest` texels a side where each has its own.
double GetErrorOnTriangles(vtkPolyData* lit, const char* name, int finest,
  const std::vector<double>& map)
{
  const std::vector<double> expected = AverageOverTexels(lit, name, finest);
  const int size = static_cast<int>(std::lround(std::sqrt(map.size() / 4.0)));
  double squares = 0.0;
  double errors = 0.0;
  for (vtkIdType pair = 0; pair < lit->GetNumberOfCells() / 2; ++pair)
  {
    const double area = GetArea(lit, 2 * pair) + GetArea(lit, 2 * pair + 1);
    const vtkIdType place = GetTexel(pair, finest);
    const vtkIdType line = place / finest * size / finest;
    const vtkIdType column = place % finest * size / finest;
    const double* texel = &map[static_cast<std::size_t>(4 * (line * size + column))];
    for (int k = 0; k < 3; ++k)
    {
      const double value = expected[static_cast<std::size_t>(4 * place + k)];
      squares += area * value * value;
      errors += area * std::pow(texel[k] / texel[3] - value, 2);
    }
  }
  return std::sqrt(errors / squares);
}

/// The filters know triangles and no atlas: both maps come to their results as they grow.
void TestSizes()
{
  constexpr int Finest = 64;
  Scene scene(Finest / ChartsPerSide);
  scene.Pass->ShadowsOff();
  scene.Pass->SetIrradianceSamples(1);
  scene.Material->SetLinkMethodToDense();
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(scene.Ball);
  direct->AddLight(scene.Light);
  direct->SetShadows(false);
  direct->SetRefractiveIndex(scene.Material->GetRefractiveIndex());
  vtkNew<vtkSubsurfaceScattering> filter;
  filter->SetInputConnection(direct->GetOutputPort());
  filter->SetMillimetersPerUnit(scene.Material->GetMillimetersPerUnit());
  filter->SetLinkMethodToDense();
  filter->SetIncidenceToTransmitted();
  filter->SetDeviceToCPU();
  filter->Update();
  auto* lit = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  double before[2] = { 1.0, 1.0 };
  for (const int level : { 1, 2, 3 })
  {
    scene.Pass->SetIrradianceMapSize(Finest << level);
    scene.Pass->SetScatteredMapSize(Finest >> (3 - level));
    scene.Window->Render();
    const double errors[2] = { GetErrorOnTriangles(lit, "TransmittedIrradiance", Finest,
                                 Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture(),
                                   level)),
      GetErrorOnTriangles(lit, "ScatteredIrradiance", Finest,
        Read(scene.Pass->GetScatteredMap(scene.Actor)->GetTexture())) };
    std::cout << "larger and larger maps: what enters is off by " << errors[0]
              << ", what leaves by " << errors[1] << "\n";
    for (int map = 0; map < 2; ++map)
    {
      Check(errors[map] < 0.6 * before[map], "a larger map is not better");
      before[map] = errors[map];
    }
  }
  Check(before[1] < 0.01, "what leaves is not that of the filter on triangles");
}

/// What enters is the integral of the first map, what leaves the links' sum of it.
void TestEnergy()
{
  Scene scene(16);
  scene.Window->Render();
  const auto integrate = [](vtkOpenGLAtlasTexture* texture, int level)
  {
    const std::vector<double> map = Read(texture, level);
    std::array<double, 4> sum = {};
    for (std::size_t k = 0; k < map.size(); ++k)
    {
      sum[k % 4] += map[k];
    }
    return sum[0] / sum[3];
  };
  vtkOpenGLAtlasTexture* transmitted = scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture();
  const double entered = integrate(transmitted, 0);
  CheckClose(integrate(transmitted, 4), entered, 1e-5, "energy is lost from level to level");
  // Of a ball in parallel light: its cross section, times Fresnel's mean for it.
  const std::vector<double> exact = GetTransmitted(scene.Ball, nullptr, { scene.Light }, 1.3, 64);
  double sum = 0.0;
  double area = 0.0;
  for (vtkIdType pair = 0; pair < scene.Ball->GetNumberOfCells() / 2; ++pair)
  {
    const double both = GetArea(scene.Ball, 2 * pair) + GetArea(scene.Ball, 2 * pair + 1);
    sum += both * exact[static_cast<std::size_t>(4 * GetTexel(pair, 64))];
    area += both;
  }
  CheckClose(entered, sum / area, 0.01, "what enters");
  const double left = integrate(scene.Pass->GetScatteredMap(scene.Actor)->GetTexture(), 0);
  const std::vector<double> scattered = Scatter(scene, 32);
  vtkFieldData* fields = scene.Material->GetOutputDataObject(0)->GetFieldData();
  CheckClose(left / entered,
    fields->GetArray("LeavingFlux")->GetComponent(0, 0) /
      fields->GetArray("EnteringFlux")->GetComponent(0, 0),
    0.01, "what leaves, over what enters");
}

/// Each error tells what to do, once, and the surface is drawn as usual.
void TestErrors()
{
  Scene scene;
  vtkNew<vtkTest::ErrorObserver> observer;
  const auto expect = [&](const std::string& text)
  {
    scene.Window->Render();
    Check(observer->CheckErrorMessage(text) == 0, "no error \"" + text + "\"");
    scene.Window->Render();
    Check(!observer->GetError(), "the same error twice: " + observer->GetErrorMessage());
    observer->Clear();
  };
  scene.Pass->GetTransmittedMap(scene.Actor)->AddObserver(vtkCommand::ErrorEvent, observer);
  scene.Pass->GetScatteredMap(scene.Actor)->AddObserver(vtkCommand::ErrorEvent, observer);
  scene.Material->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkTest::ErrorObserver> warnings;
  scene.Pass->AddObserver(vtkCommand::WarningEvent, warnings);

  vtkSmartPointer<vtkDataArray> coordinates =
    scene.Ball->GetPointData()->GetArray("AtlasCoordinates");
  scene.Ball->GetPointData()->RemoveArray("AtlasCoordinates");
  expect("use vtkSurfaceAtlas");
  scene.Ball->GetPointData()->AddArray(coordinates);
  vtkSmartPointer<vtkDataArray> charts = scene.Ball->GetCellData()->GetArray("ChartId");
  charts->SetComponent(0, 0, 77.0);
  charts->Modified();
  expect("belongs to two charts");
  charts->SetComponent(0, 0, 0.0);
  charts->Modified();
  scene.Pass->SetIrradianceMapSize(200);
  expect("no power of two");
  scene.Pass->SetIrradianceMapSize(128);
  scene.Material->SetModelToMonteCarlo();
  expect("Model is MonteCarlo");
  scene.Material->SetModelToPhotonBeamDiffusion();
  scene.Material->RefineByIrradianceOn();
  expect("RefineByIrradiance is on");
  scene.Material->RefineByIrradianceOff();
  scene.Light->SetIntensity(-1.0);
  expect("A light has");
  scene.Light->SetIntensity(1.0);
  scene.Window->Render();
  Check(!observer->GetError() && scene.Pass->GetNumberOfScatteringRuns() == 1,
    "all is well again: " + observer->GetErrorMessage());
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringMaps(int, char*[])
{
  TestLights();
  TestShadows();
  TestLinks();
  TestSizes();
  TestEnergy();
  TestErrors();
  return Result();
}
