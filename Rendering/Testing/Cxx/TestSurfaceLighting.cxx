// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What lights translucent surfaces besides lights and environments, against vtkDirectIrradiance:
 * arrays; light at corners, bumps; bodies that share a shadow map; what is refused.
 */
#include "LitScene.h"

#include "vtkTestErrorObserver.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <string>

namespace
{
using namespace EnvironmentTesting;
using namespace LightTransportTesting;
using namespace ScatteringScene;

/// Irradiance that is there already: of one band and of three, that has entered or not.
void TestArrays()
{
  LitScene scene;
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(scene.Ball);
  direct->AddLight(scene.Light);
  direct->SetRefractiveIndex(Index);
  direct->Update();
  auto* lit = vtkPolyData::SafeDownCast(direct->GetOutputDataObject(0));
  vtkDataArray* entered = lit->GetCellData()->GetArray("TransmittedIrradiance");
  scene.Ball->GetCellData()->AddArray(entered);
  scene.Lighting->SetIrradianceArray("TransmittedIrradiance");
  scene.Lighting->SetIncidenceToTransmitted();
  const std::vector<double> expected = AverageOverTexels(scene.Ball, "TransmittedIrradiance", Size);
  const std::vector<double> map = scene.Draw();
  CheckMap(map, expected, 5e-3, "an array of cells");
  scene.Ball->GetCellData()->RemoveArray("TransmittedIrradiance");
  scene.Ball->GetPointData()->AddArray(lit->GetPointData()->GetArray("TransmittedIrradiance"));
  CheckMap(scene.Draw(), expected, 0.02, "an array of points");
  scene.Ball->GetCellData()->AddArray(entered);
  scene.Lighting->SetIncidenceToDiffuse();
  const double mean = vtkSubsurfaceScatteringPass::GetOutgoingWeight(1.0, Index);
  const double direct0 = 1.0 - std::pow((Index - 1.0) / (Index + 1.0), 2);
  Check(GetDifference(scene.Draw(), map, direct0 / mean) < 1e-5, "diffuse light that enters");
  vtkNew<vtkDoubleArray> grey;
  grey->SetName("Grey");
  for (vtkIdType cell = 0; cell < scene.Ball->GetNumberOfCells(); ++cell)
  {
    grey->InsertNextValue(entered->GetComponent(cell, 0));
  }
  scene.Ball->GetCellData()->AddArray(grey);
  scene.Lighting->SetIrradianceArray("Grey");
  Check(GetDifference(scene.Draw(), map, direct0 / mean) < 1e-5, "an array of one component");
}

/// A filter that runs again for another light costs no links, though all its objects are new.
void TestFilterThatRunsAgain()
{
  LitScene scene(8);
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(scene.Ball);
  direct->AddLight(scene.Light);
  scene.Actor->GetMapper()->SetInputConnection(direct->GetOutputPort());
  scene.Lighting->SetIrradianceArray("DirectIrradiance");
  const double before = GetMean(scene.Draw());
  scene.Light->SetIntensity(3.0);
  CheckClose(GetMean(scene.Draw()), 3.0 * before, 1e-5, "a brighter light in an array");
  Check(scene.Pass->GetNumberOfIrradianceRuns() == 2 && scene.Pass->GetNumberOfLinkRuns() == 1 &&
      scene.Pass->GetNumberOfScatteringRuns() == 2,
    "a filter that runs again costs links");
}

/// At corners alone: as good where triangles are small.
void TestCorners()
{
  LitScene scene;
  scene.Lighting->RendererLightsOn();
  scene.Lighting->AtCornersOn();
  scene.Pass->ShadowsOff();
  CheckMap(scene.Draw(), GetTransmitted(scene.Ball, nullptr, { scene.Light }, Index, Size), 0.01,
    "a light at corners");
  const auto sky = MakeSky(64, GetSoftSky);
  scene.Lighting->SetEnvironment(sky);
  CheckMap(scene.Draw(), GetTransmitted(scene.Ball, nullptr, { scene.Light }, Index, Size, sky),
    0.01, "a light and harmonics at corners");
  scene.Lighting->SetEnvironment(nullptr);
  scene.Pass->ShadowsOn();
  scene.AddPlate();
  CheckMap(scene.Draw(), GetTransmitted(scene.Ball, scene.Plate, { scene.Light }, Index, Size), 0.1,
    "shadows at corners");
}

/// A normal texture of one color, tangents along longitude.
void AddBumps(LitScene& scene, const std::array<double, 3>& normal)
{
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkDoubleArray> tangents;
  places->SetName("Places");
  places->SetNumberOfComponents(2);
  tangents->SetName("Tangents");
  tangents->SetNumberOfComponents(3);
  for (vtkIdType point = 0; point < scene.Ball->GetNumberOfPoints(); ++point)
  {
    double place[3];
    scene.Ball->GetPoint(point, place);
    places->InsertNextTuple2(0.5, 0.5);
    tangents->InsertNextTuple3(-place[1], place[0], 0.0);
  }
  scene.Ball->GetPointData()->SetTCoords(places);
  scene.Ball->GetPointData()->SetTangents(tangents);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int pixel = 0; pixel < 4; ++pixel)
  {
    colors->InsertNextTuple3(std::lround(127.5 * (1.0 + normal[0])),
      std::lround(127.5 * (1.0 + normal[1])), std::lround(127.5 * (1.0 + normal[2])));
  }
  image->GetPointData()->SetScalars(colors);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  scene.Actor->GetProperty()->RemoveTexture("normalTex");
  scene.Actor->GetProperty()->SetNormalTexture(texture);
}

/// Straight ones change nothing; slanted ones are as if the light came from elsewhere about the
/// axis: a light that turns about it meets them as it meets straight ones, turned.
void TestBumps()
{
  LitScene scene;
  scene.Lighting->RendererLightsOn();
  scene.Pass->ShadowsOff();
  const std::vector<double> plain = scene.Draw();
  AddBumps(scene, { 0.0, 0.0, 1.0 });
  const std::vector<double> straight = scene.Draw();
  Check(GetDifference(straight, plain) < 0.02, "bumps that are straight");
  const vtkIdType runs = scene.Pass->GetNumberOfIrradianceRuns();
  AddBumps(scene, { 0.6, 0.0, 0.8 });
  const std::vector<double> slanted = scene.Draw();
  Check(scene.Pass->GetNumberOfIrradianceRuns() == runs + 1, "bumps that change");
  // By hand, at the equator: the texels in the middle of a face around the axis.
  double light[3];
  scene.Light->GetPosition(light);
  vtkMath::Normalize(light);
  int checked = 0;
  for (vtkIdType pair = 0; pair < scene.Ball->GetNumberOfCells() / 2; ++pair)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    scene.Ball->GetPolys()->GetCellAtId(2 * pair, count, ids);
    double corners[3][3];
    for (int corner = 0; corner < 3; ++corner)
    {
      scene.Ball->GetPoint(ids[corner], corners[corner]);
    }
    double facet[3];
    vtkTriangle::ComputeNormal(corners[0], corners[1], corners[2], facet);
    if (std::abs(facet[2]) > 0.3)
    {
      continue;
    }
    double tangent[3] = { -facet[1], facet[0], 0.0 };
    vtkMath::Normalize(tangent);
    double normal[3];
    for (int k = 0; k < 3; ++k)
    {
      normal[k] = 0.6 * tangent[k] + 0.8 * facet[k];
    }
    const double cosine = vtkMath::Dot(normal, light);
    const double onFacet = vtkMath::Dot(facet, light);
    if (std::abs(onFacet) < 0.1 || std::abs(cosine) < 0.1)
    {
      continue;
    }
    const double weight = vtkSubsurfaceScatteringPass::GetOutgoingWeight(std::abs(cosine), Index) /
      vtkSubsurfaceScatteringPass::GetOutgoingWeight(1.0, Index) *
      (1.0 - std::pow((Index - 1.0) / (Index + 1.0), 2));
    const double expected = onFacet > 0.0 && cosine > 0.0 ? cosine * weight : 0.0;
    const auto texel = static_cast<std::size_t>(4 * GetTexel(pair, Size));
    const double found = slanted[texel] / slanted[texel + 3];
    Check(std::abs(found - expected) < 0.04,
      "a slanted bump: " + std::to_string(found) + " instead of " + std::to_string(expected));
    ++checked;
  }
  Check(checked > 500, "no bumps were checked");
  scene.Lighting->BumpsOff();
  Check(GetDifference(scene.Draw(), plain) == 0.0, "bumps that are off");
}

/// Two bodies share a shadow map; maps keep their textures.
void TestSharing()
{
  LitScene scene(8);
  scene.Lighting->RendererLightsOn();
  const double alone = GetMean(scene.Draw());
  const double center[3] = { 0.0, 0.0, 8.0 };
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeBall(8, center));
  vtkNew<vtkActor> other;
  other->SetMapper(mapper);
  scene.Renderer->AddActor(other);
  scene.Pass->SetMaterial(other, scene.Material);
  scene.Renderer->ResetCamera();
  CheckClose(GetMean(scene.Draw()), alone, 0.01, "another body far away");
  const vtkIdType runs = scene.Pass->GetNumberOfIrradianceRuns();
  scene.Draw();
  Check(scene.Pass->GetNumberOfIrradianceRuns() == runs, "two bodies are lit again and again");
  vtkOpenGLAtlasTexture* texture = scene.Pass->GetTransmittedMap(other)->GetTexture();
  const std::vector<double> second = Read(texture);
  CheckClose(GetMean(second), alone, 0.01, "the second body");

  vtkNew<vtkTest::ErrorObserver> observer;
  texture->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkImageData> image;
  Check(!texture->Build(image, "Value") && observer->CheckErrorMessage("drawn by a map") == 0,
    "the texture of a map is built");
  texture->ReleaseGraphicsResources();
  scene.Draw();
  Check(GetDifference(Read(texture), second) == 0.0, "a texture that was released");
  scene.Pass->GetScatteredMap(other)->GetTexture()->ReleaseGraphicsResources();
  scene.Draw();
  Check(!Read(scene.Pass->GetScatteredMap(other)->GetTexture()).empty(),
    "a texture of what leaves that was released");
  scene.Pass->SetMaterial(scene.Actor, nullptr);
  scene.Light->SetPosition(3.0, 1.0, 1.0);
  scene.Window->Render();
  Check(!Read(texture).empty(), "the first body has gone");
}

/// Points of single precision on a map, where their steps are half a unit.
void TestOffset()
{
  constexpr double Scale = 1000.0;
  const double place[3] = { 6e5, 6e6, 0.0 };
  LitScene near(8);
  LitScene far(8);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (vtkIdType point = 0; point < far.Ball->GetNumberOfPoints(); ++point)
  {
    double at[3];
    far.Ball->GetPoint(point, at);
    points->InsertNextPoint(place[0] + Scale * at[0], place[1] + Scale * at[1],
      place[2] + Scale * at[2]);
  }
  far.Ball->SetPoints(points);
  double light[3];
  near.Light->GetPosition(light);
  far.Light->SetPosition(place[0] + Scale * light[0], place[1] + Scale * light[1],
    place[2] + Scale * light[2]);
  near.Light->GetFocalPoint(light);
  far.Light->SetFocalPoint(place[0] + Scale * light[0], place[1] + Scale * light[1],
    place[2] + Scale * light[2]);
  far.Renderer->ResetCamera();
  const auto sky = MakeSky(32, GetSoftSky);
  for (LitScene* scene : { &near, &far })
  {
    scene->Lighting->RendererLightsOn();
    scene->Lighting->SetEnvironment(sky);
    scene->Lighting->SetNumberOfEnvironmentDirections(4);
  }
  for (const int method : { vtkSurfaceLighting::ENVIRONMENT_METHOD_HARMONICS,
         vtkSurfaceLighting::ENVIRONMENT_METHOD_DIRECTIONS })
  {
    for (LitScene* scene : { &near, &far })
    {
      scene->Lighting->SetEnvironmentMethod(method);
    }
    std::vector<double> expected = near.Draw();
    for (std::size_t k = 0; k < expected.size(); ++k)
    {
      const double area = expected[k | 3];
      expected[k] = k % 4 < 3 && area > 0.0 ? expected[k] / area : expected[k];
    }
    CheckMap(far.Draw(), expected, 0.02, "single precision on a map");
  }
}

/// A window without a context is told of once, and looked at again each time.
void TestLateContext()
{
  LitScene scene(8);
  vtkNew<vtkOpenGLTransmittedMap> map;
  vtkNew<vtkTest::ErrorObserver> observer;
  map->AddObserver(vtkCommand::ErrorEvent, observer);
  map->SetResolution(16);
  Check(!map->Update(scene.Actor, scene.Renderer) &&
      observer->CheckErrorMessage("No OpenGL context") == 0,
    "a window that has not been drawn");
  observer->Clear();
  Check(!map->Update(scene.Actor, scene.Renderer) && !observer->GetError(),
    "the same window is told of twice");
  scene.Window->Render();
  Check(map->Update(scene.Actor, scene.Renderer) && !observer->GetError() &&
      map->GetNumberOfRuns() == 1,
    "a window that has been drawn by now");
}

/// Each error names the actor, and is told once.
void TestErrors()
{
  LitScene scene(8);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkOpenGLTransmittedMap* map = scene.Pass->GetTransmittedMap(scene.Actor);
  map->AddObserver(vtkCommand::ErrorEvent, observer);
  map->AddObserver(vtkCommand::WarningEvent, observer);
  const auto expect = [&](const std::string& text)
  {
    scene.Window->Render();
    std::string message = observer->GetErrorMessage();
    message += observer->GetWarningMessage();
    Check(message.find(text) != std::string::npos &&
        message.find("Actor 1 of 1 of the renderer: ") != std::string::npos,
      "no message \"" + text + "\": " + message);
    observer->Clear();
    scene.Window->Render();
    Check(!observer->GetError() && !observer->GetWarning(), "the same message twice: " + text);
    observer->Clear();
  };
  vtkNew<vtkImageData> empty;
  scene.Lighting->SetEnvironment(empty);
  expect("two-dimensional image");
  scene.Lighting->SetEnvironment(MakeSky(8, GetSoftSky));
  scene.Lighting->SetEnvironmentUp(2.0, 0.0, 0.0);
  expect("parallel");
  scene.Lighting->SetEnvironmentUp(0.0, 0.0, 1.0);
  scene.Lighting->SetEnvironmentMethodToTransfer();
  expect("use vtkRadianceTransfer");
  scene.AddTransfer(false);
  scene.Actor->SetScale(1.0, 2.0, 1.0);
  expect("scaled evenly");
  scene.Actor->SetScale(2.0, 2.0, 2.0);
  scene.Window->Render();
  Check(!observer->GetError(), "an even scale: " + observer->GetErrorMessage());
  vtkNew<vtkDoubleArray> recorded;
  recorded->SetName("RefractiveIndex");
  recorded->InsertNextValue(1.0);
  scene.Ball->GetFieldData()->AddArray(recorded);
  scene.Lighting->Modified();
  expect("refractive index of 1,");
  scene.Lighting->SetEnvironmentUp(0.0, 0.6, 0.8);
  scene.Window->Render();
  Check(!observer->GetWarning(), "a sky that turns repeats a warning");
  scene.Lighting->SetEnvironment(nullptr);
  scene.Lighting->SetIrradianceArray("Nothing");
  expect("no cell or point array \"Nothing\"");
  scene.Lighting->SetIrradianceArray("RadianceTransfer");
  expect("needs 1 or 3");
  vtkNew<vtkDoubleArray> bad;
  bad->SetName("Bad");
  bad->SetNumberOfTuples(scene.Ball->GetNumberOfCells());
  bad->Fill(std::nan(""));
  scene.Ball->GetCellData()->AddArray(bad);
  scene.Lighting->SetIrradianceArray("Bad");
  expect("not finite");
  scene.Lighting->SetIrradianceArray("");
  scene.Window->Render();
  Check(!observer->GetError(), "all is well again: " + observer->GetErrorMessage());
}
} // namespace

//------------------------------------------------------------------------------
int TestSurfaceLighting(int, char*[])
{
  TestArrays();
  TestFilterThatRunsAgain();
  TestCorners();
  TestBumps();
  TestSharing();
  TestOffset();
  TestLateContext();
  TestErrors();
  return Result();
}
