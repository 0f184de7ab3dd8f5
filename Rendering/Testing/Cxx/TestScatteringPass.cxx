// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Translucent actors as vtkSubsurfaceScatteringPass draws them: what is computed again when, actors
 * that pay nothing, energy of the picture, charts that do not leak, ways of drawing, windows that
 * change and go.
 */
#include "LightTransportTesting.h"
#include "ScatteringScene.h"

#include "vtkAppendPolyData.h"
#include "vtkFramebufferPass.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkPixelBufferObject.h"
#include "vtkSphereSource.h"
#include "vtkTestErrorObserver.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <string>

namespace
{
using namespace LightTransportTesting;
using namespace ScatteringScene;

/// A scene whose picture is read as numbers.
struct Drawing : Scene
{
  vtkNew<vtkFramebufferPass> Buffer;

  explicit Drawing(int side = 8) : Scene(side)
  {
    this->Buffer->SetColorFormat(vtkTextureObject::Float32);
    this->Buffer->SetDelegatePass(this->Pass);
    this->Renderer->SetPass(this->Buffer);
    this->Renderer->ResetCamera();
  }
  ~Drawing()
  {
    this->Buffer->ReleaseGraphicsResources(this->Window);
    this->Pass->ReleaseGraphicsResources(this->Window);
  }
  Drawing(const Drawing&) = delete;
  void operator=(const Drawing&) = delete;

  /// Four numbers a pixel.
  std::vector<float> Draw()
  {
    this->Window->Render();
    const int* size = this->Window->GetSize();
    auto pixels =
      vtkSmartPointer<vtkPixelBufferObject>::Take(this->Buffer->GetColorTexture()->Download());
    std::vector<float> values(static_cast<std::size_t>(4) * size[0] * size[1]);
    unsigned int sides[2] = { static_cast<unsigned int>(size[0]),
      static_cast<unsigned int>(size[1]) };
    vtkIdType increments[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, values.data(), sides, 4, increments);
    Check(glGetError() == GL_NO_ERROR, "OpenGL reports an error");
    return values;
  }

  std::array<vtkIdType, 3> GetRuns()
  {
    return { this->Pass->GetNumberOfIrradianceRuns(), this->Pass->GetNumberOfLinkRuns(),
      this->Pass->GetNumberOfScatteringRuns() };
  }
};

/// Largest difference between two pictures, over the largest value.
double GetDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0.0;
  double difference = a.size() == b.size() ? 0.0 : 1.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
  {
    if (k % 4 < 3)
    {
      largest = std::max(largest, static_cast<double>(std::abs(a[k])));
      difference = std::max(difference, static_cast<double>(std::abs(a[k] - b[k])));
    }
  }
  return largest > 0.0 ? difference / largest : 1.0;
}

/// Each step only when what it depends on has changed.
void TestRuns()
{
  Drawing scene;
  vtkNew<vtkPoints> older;
  older->DeepCopy(scene.Ball->GetPoints());
  std::array<vtkIdType, 3> expected = { 0, 0, 0 };
  const auto check = [&](std::array<vtkIdType, 3> more, const std::string& what)
  {
    scene.Window->Render();
    for (int step = 0; step < 3; ++step)
    {
      expected[step] += more[step];
    }
    const auto runs = scene.GetRuns();
    Check(runs == expected,
      what + ": " + std::to_string(runs[0]) + ", " + std::to_string(runs[1]) + ", " +
        std::to_string(runs[2]) + " runs");
  };
  check({ 1, 1, 1 }, "first frame");
  check({ 0, 0, 0 }, "the same again");
  scene.Renderer->GetActiveCamera()->Azimuth(30.0);
  scene.Renderer->ResetCameraClippingRange();
  check({ 0, 0, 0 }, "the camera moves");
  scene.Light->SetPosition(3.0, 2.0, 1.0);
  check({ 1, 0, 1 }, "the light moves");
  scene.Light->SetIntensity(2.0);
  check({ 1, 0, 1 }, "the light is brighter");
  scene.Actor->RotateZ(20.0);
  check({ 1, 0, 1 }, "the body turns");
  scene.Material->SetAbsorptionCoefficient(0.1, 0.2, 0.3);
  check({ 0, 1, 1 }, "another absorption");
  scene.Material->SetRefractiveIndex(1.5);
  check({ 1, 1, 1 }, "another index");
  vtkPoints* points = scene.Ball->GetPoints();
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    double place[3];
    points->GetPoint(point, place);
    points->SetPoint(point, 1.2 * place[0], place[1], place[2]);
  }
  points->Modified();
  scene.Ball->Modified();
  check({ 1, 1, 1 }, "points move");
  scene.Ball->SetPoints(older);
  check({ 1, 1, 1 }, "points of an earlier time");
  vtkNew<vtkDoubleArray> array;
  array->SetName("Temperature");
  array->SetNumberOfTuples(scene.Ball->GetNumberOfPoints());
  scene.Ball->GetPointData()->AddArray(array);
  scene.Ball->Modified();
  check({ 0, 0, 0 }, "another array");
  scene.Pass->SetScatteredMapSize(16);
  check({ 0, 1, 1 }, "another size of what leaves");
  scene.Pass->SetIrradianceMapSize(256);
  check({ 1, 0, 1 }, "another size of what enters");
  scene.Pass->SetMaterial(scene.Actor, nullptr);
  expected = { 0, 0, 0 };
  scene.Window->Render();
  Check(scene.GetRuns() == expected && !scene.Pass->GetTransmittedMap(scene.Actor),
    "the material is taken away");
}

/// An actor beside the translucent one is drawn as if there were no pass, and has no maps.
void TestOpaqueActor()
{
  Drawing scene;
  vtkNew<vtkSphereSource> source;
  source->SetCenter(3.0, 0.0, 0.0);
  source->SetThetaResolution(32);
  source->SetPhiResolution(32);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> opaque;
  opaque->SetMapper(mapper);
  scene.Renderer->AddActor(opaque);
  scene.Renderer->GetActiveCamera()->SetFocalPoint(1.5, 0.0, 0.0);
  scene.Renderer->GetActiveCamera()->SetPosition(1.5, 0.0, 10.0);
  scene.Renderer->ResetCameraClippingRange();
  const std::vector<float> together = scene.Draw();
  Check(scene.GetRuns() == std::array<vtkIdType, 3>{ 1, 1, 1 } &&
      !scene.Pass->GetTransmittedMap(opaque) && !scene.Pass->GetScatteredMap(opaque),
    "an opaque actor has maps");
  scene.Renderer->SetPass(nullptr);
  scene.Buffer->SetDelegatePass(nullptr);
  vtkNew<vtkSubsurfaceScatteringPass> none;
  none->SetOutputEncodingToLinear();
  scene.Buffer->SetDelegatePass(none);
  scene.Renderer->SetPass(scene.Buffer);
  none->GlobalWarningDisplayOff();
  const std::vector<float> alone = scene.Draw();
  none->GlobalWarningDisplayOn();
  none->ReleaseGraphicsResources(scene.Window);
  const int width = scene.Window->GetSize()[0];
  double difference = 0.0;
  double brightest = 0.0;
  for (int line = 0; line < width; ++line)
  {
    for (int column = width / 2 + 4; column < width; ++column)
    {
      const std::size_t k = 4 * (static_cast<std::size_t>(line) * width + column);
      difference = std::max(difference, static_cast<double>(std::abs(together[k] - alone[k])));
      brightest = std::max(brightest, static_cast<double>(alone[k]));
    }
  }
  Check(brightest > 0.5 && difference < 1e-6, "an opaque actor looks other than without the pass");
}

/// What a convex body sends into all directions is what leaves it.
void TestEnergy()
{
  Drawing scene(16);
  constexpr int Directions = 16;
  constexpr int Pixels = 96;
  scene.Window->SetSize(Pixels, Pixels);
  scene.Actor->GetProperty()->SetSpecular(0.0);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  double seen = 0.0;
  for (int k = 0; k < Directions; ++k)
  {
    // Evenly spread.
    const double height = (2.0 * k + 1.0) / Directions - 1.0;
    const double angle = vtkMath::Pi() * (3.0 - std::sqrt(5.0)) * k;
    const double radius = std::sqrt(1.0 - height * height);
    camera->SetViewUp(0.0, 0.0, std::abs(height) < 0.9 ? 1.0 : 0.0);
    if (std::abs(height) >= 0.9)
    {
      camera->SetViewUp(1.0, 0.0, 0.0);
    }
    camera->SetPosition(5.0 * radius * std::cos(angle), 5.0 * radius * std::sin(angle),
      5.0 * height);
    camera->SetParallelScale(1.1);
    scene.Renderer->ResetCameraClippingRange();
    const std::vector<float> picture = scene.Draw();
    for (std::size_t pixel = 0; pixel < picture.size(); pixel += 4)
    {
      seen += picture[pixel];
    }
  }
  seen *= 4.0 * vtkMath::Pi() / Directions * std::pow(2.2 / Pixels, 2);
  const std::vector<double> map = Read(scene.Pass->GetScatteredMap(scene.Actor)->GetTexture());
  double scattered = 0.0;
  double areas = 0.0;
  for (std::size_t k = 0; k < map.size(); k += 4)
  {
    scattered += map[k];
    areas += map[k + 3];
  }
  double area = 0.0;
  for (vtkIdType cell = 0; cell < scene.Ball->GetNumberOfCells(); ++cell)
  {
    area += GetArea(scene.Ball, cell);
  }
  std::cout << "drawn over scattered: " << seen / (area * scattered / areas) << "\n";
  CheckClose(seen, area * scattered / areas, 0.01, "what is drawn from all sides");
}

/// Twice the exposure is twice each number, of what is scattered and of what is reflected.
void TestExposure()
{
  Drawing scene;
  scene.Actor->GetProperty()->SetDiffuse(0.5);
  std::vector<float> picture = scene.Draw();
  for (float& value : picture)
  {
    value *= 2.5f;
  }
  scene.Pass->SetExposure(2.5);
  Check(GetDifference(picture, scene.Draw()) < 1e-6, "exposure is not linear");
  Check(scene.GetRuns() == std::array<vtkIdType, 3>{ 1, 1, 1 }, "exposure costs something");
}

/// Body, light and camera that turn together change nothing.
void TestTurning()
{
  constexpr double Degrees = 50.0;
  Drawing scene;
  scene.Pass->ShadowsOff();
  const auto read = [&scene]()
  { return Read(scene.Pass->GetScatteredMap(scene.Actor)->GetTexture()); };
  const std::vector<float> before = scene.Draw();
  const std::vector<double> map = read();
  scene.Actor->RotateY(Degrees);
  scene.Draw();
  const std::vector<double> other = read();
  const double angle = vtkMath::RadiansFromDegrees(Degrees);
  double at[3];
  scene.Light->GetPosition(at);
  scene.Light->SetPosition(at[0] * std::cos(angle) + at[2] * std::sin(angle), at[1],
    at[2] * std::cos(angle) - at[0] * std::sin(angle));
  scene.Renderer->GetActiveCamera()->Azimuth(Degrees);
  const std::vector<float> after = scene.Draw();
  const std::vector<double> again = read();
  double largest = 0.0;
  double difference = 0.0;
  double change = 0.0;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    largest = std::max(largest, map[k]);
    difference = std::max(difference, std::abs(again[k] - map[k]));
    change = std::max(change, std::abs(other[k] - map[k]));
  }
  Check(change > 0.05 * largest, "a body that turns alone changes nothing");
  Check(difference < 1e-5 * largest, "what leaves a body that turns with its light");
  // Pixels at the rim may be those of the background.
  std::size_t off = 0;
  for (std::size_t k = 0; k < before.size(); k += 4)
  {
    off += std::abs(after[k] - before[k]) > 1e-4f ? 1 : 0;
  }
  Check(after.size() == before.size() && off < before.size() / 400,
    "the picture of a body that turns with its light and camera: " + std::to_string(off) +
      " pixels are off");
}

/// Of two balls in one atlas one is lit, and nothing goes from one to the other: the other stays
/// dark however far away it is drawn.
void TestSeams()
{
  Drawing scene;
  const double far[3] = { 0.0, 6.0, 0.0 };
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(scene.Ball);
  both->AddInputData(MakeBall(8, far, Faces));
  both->Update();
  vtkPolyDataMapper::SafeDownCast(scene.Actor->GetMapper())->SetInputData(both->GetOutput());
  scene.Actor->GetProperty()->SetSpecular(0.0);
  scene.Material->SetMillimetersPerUnit(100.0);
  scene.Material->SetLinkMethodToDense();
  scene.Pass->SetScatteredMapSize(16);
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(20.0);
  scene.Light->SetPosition(0.0, 0.0, 6.0);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 3.0, 0.0);
  for (const double distance : { 12.0, 24.0, 48.0, 96.0 })
  {
    camera->SetPosition(0.0, 3.0, distance);
    scene.Renderer->ResetCameraClippingRange();
    const std::vector<float> picture = scene.Draw();
    const std::size_t half = picture.size() / 2;
    float lit = 0.0f;
    float dark = 0.0f;
    for (std::size_t k = 0; k < picture.size(); k += 4)
    {
      float& brightest = k < half ? lit : dark;
      brightest = std::max(brightest, picture[k]);
    }
    Check(lit > 1e-3f && dark < 1e-6f * lit,
      "light leaks between charts, seen from " + std::to_string(distance) + ": " +
        std::to_string(dark / lit));
  }
}

/// What changes VTK's shaders.
void TestRepresentations()
{
  Drawing scene;
  vtkProperty* property = scene.Actor->GetProperty();
  property->SetSpecular(0.0);
  const std::vector<float> plain = scene.Draw();
  property->EdgeVisibilityOn();
  property->SetEdgeColor(1.0, 1.0, 1.0);
  property->SetLineWidth(3.0);
  std::vector<float> picture = scene.Draw();
  std::size_t same = 0;
  for (std::size_t k = 0; k < plain.size(); k += 4)
  {
    same += std::abs(plain[k] - picture[k]) < 1e-5f ? 1 : 0;
  }
  Check(same > plain.size() / 12 && same < plain.size() / 4,
    "edges are not seen, or too much: " + std::to_string(same) + " pixels are as without");
  property->EdgeVisibilityOff();
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(1.1);
  scene.Draw();
  const auto runs = scene.GetRuns();
  property->SetInterpolationToPBR();
  property->SetColor(0.0, 0.0, 0.0);
  picture = scene.Draw();
  Check(*std::max_element(picture.begin(), picture.end()) > 0.0f && scene.GetRuns() == runs,
    "physically based shading");
}

/// Sizes, released resources, windows that end and others, two renderers.
void TestWindows()
{
  Drawing scene;
  const std::vector<float> first = scene.Draw();
  scene.Window->SetSize(96, 80);
  scene.Draw();
  scene.Window->SetSize(64, 64);
  Check(GetDifference(first, scene.Draw()) < 1e-6, "the window has another size for a while");
  Check(scene.GetRuns() == std::array<vtkIdType, 3>{ 1, 1, 1 }, "a size costs something");
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  Check(GetDifference(first, scene.Draw()) < 1e-5, "after a release");
  Check(scene.GetRuns() == std::array<vtkIdType, 3>{ 2, 1, 2 }, "a release costs links");
  scene.Window->Finalize();
  Check(GetDifference(first, scene.Draw()) < 1e-5, "after the window has ended");
  Check(scene.GetRuns()[1] == 1, "a window that ends costs links");

  // The same actor in two renderers, of which the other one is darker.
  vtkNew<vtkRenderer> second;
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(1.0, 2.0, 3.0);
  light->SetIntensity(0.5);
  second->AddLight(light);
  second->AddActor(scene.Actor);
  second->SetPass(scene.Pass);
  second->SetActiveCamera(scene.Renderer->GetActiveCamera());
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  scene.Renderer->SetPass(scene.Pass);
  scene.Window->SetSize(128, 64);
  scene.Window->AddRenderer(second);
  scene.Actor->GetProperty()->SetSpecular(0.0);
  scene.Window->Render();
  vtkNew<vtkFloatArray> pixels;
  scene.Window->GetRGBAPixelData(0, 0, 127, 63, 0, pixels);
  const auto* values = pixels->GetPointer(4 * 32 * 128);
  Check(values[4 * 32] > 0.02f, "the first of two renderers is black");
  CheckClose(values[4 * 96], 0.5 * values[4 * 32], 0.05, "the second of two renderers");
  CheckClose(Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture()).size(), 4 * 128 * 128,
    0.0, "the map of two renderers");
  scene.Window->RemoveRenderer(second);
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringPass(int, char*[])
{
  TestRuns();
  TestOpaqueActor();
  TestEnergy();
  TestExposure();
  TestTurning();
  TestSeams();
  TestRepresentations();
  TestWindows();
  return Result();
}
