// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Frames of vtkRadiosityPass, one after another: what is computed again when, slices of a solution,
 * what is told, what is shown meanwhile.
 */
#include "CornellBoxTesting.h"
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "RadiosityScene.h"

#include "vtkAppendPolyData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkGlyph3DMapper.h"
#include "vtkLineSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStripper.h"
#include "vtkTestErrorObserver.h"
#include "vtkTriangleFilter.h"

#include <array>
#include <iostream>
#include <string>

#ifdef __linux__
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace RadiosityScene;

/// Each step only when what it depends on has changed.
void TestRuns(bool byShots)
{
  Scene scene;
  if (byShots)
  {
    scene.ShootFew();
  }
  // An annotation: not lit.
  auto beside = MakeActor(MakeSquare(2));
  beside->SetPosition(0.0, 0.0, -2.0);
  beside->GetProperty()->LightingOff();
  scene.Renderer->AddActor(beside);
  std::array<vtkIdType, 3> expected = { 0, 0, 0 };
  const auto check = [&](std::array<vtkIdType, 3> more, const std::string& what)
  {
    DrawAll(scene);
    for (int step = 0; step < 3; ++step)
    {
      expected[step] += byShots && step == 0 ? 0 : more[step];
    }
    const auto runs = GetRuns(scene);
    Check(runs == expected,
      what + ": " + std::to_string(runs[0]) + ", " + std::to_string(runs[1]) + ", " +
        std::to_string(runs[2]) + " runs");
  };
  check({ 1, 1, 1 }, "first frame");
  const vtkIdType shots = scene.Pass->GetNumberOfShots();
  check({ 0, 0, 0 }, "the same again");
  scene.Renderer->GetActiveCamera()->Azimuth(30.0);
  scene.Renderer->ResetCameraClippingRange();
  check({ 0, 0, 0 }, "the camera moves");
  beside->SetPosition(0.0, 0.0, -3.0);
  beside->GetProperty()->SetColor(1.0, 0.0, 0.0);
  check({ 0, 0, 0 }, "another actor moves");
  Check(scene.Pass->GetNumberOfShots() == shots, "shots for nothing");
  scene.Light->SetIntensity(0.7);
  check({ 0, 1, 1 }, "the light is brighter");
  scene.Light->SetPosition(2.0, 2.0, 4.0);
  check({ 0, 1, 1 }, "the light moves");
  scene.Lamp->GetProperty()->SetAmbient(0.8);
  check({ 0, 0, 1 }, "the lamp is brighter");
  scene.Floor->GetProperty()->SetDiffuseColor(0.2, 0.8, 0.7);
  check({ 0, 0, 1 }, "another color");
  scene.Floor->GetProperty()->SetSpecular(0.3);
  check({ 0, 0, 0 }, "what does not matter");
  scene.Lamp->SetPosition(0.4, 0.0, 1.5);
  check({ 1, 1, 1 }, "an actor moves");
  vtkPolyData* floor = vtkPolyDataMapper::SafeDownCast(scene.Floor->GetMapper())->GetInput();
  floor->GetPoints()->SetPoint(0, -1.5, -1.0, 0.0);
  floor->GetPoints()->Modified();
  check({ 1, 1, 1 }, "points move");
  scene.Wall->VisibilityOff();
  check({ 1, 1, 1 }, "an actor goes");
  scene.Pass->ShadowsOff();
  check({ 0, 1, 1 }, "without shadows");
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  const vtkIdType before = scene.Pass->GetNumberOfShots();
  check({ 0, 0, 0 }, "after a release");
  Check((scene.Pass->GetNumberOfShots() > before) == byShots, "a release costs the wrong things");
  vtkNew<vtkActor> other;
  other->ShallowCopy(scene.Lamp);
  scene.Renderer->RemoveActor(scene.Lamp);
  scene.Renderer->AddActor(other);
  check({ 0, 0, 1 }, "another actor with the same surface");
  Check(scene.Pass->GetOutput(other) && !scene.Pass->GetOutput(scene.Lamp),
    "an actor in the place of another has no output");
}

/// A small budget leads to the same solution, over many frames, whatever happens meanwhile.
void TestSlices(bool byShots)
{
  Scene whole;
  Scene sliced;
  for (Scene* scene : { &whole, &sliced })
  {
    vtkPolyDataMapper::SafeDownCast(scene->Floor->GetMapper())->SetInputData(MakeSquare(12));
    if (byShots)
    {
      scene->ShootFew();
    }
  }
  DrawAll(whole);
  sliced.Pass->SetFrameBudget(byShots ? 0.01 : 0.0);
  sliced.Window->Render();
  Check(!sliced.Pass->IsConverged(), "no budget is enough");
  sliced.Light->SetIntensity(7.0);
  sliced.Window->Render();
  sliced.Light->SetIntensity(0.5);
  int frames = 0;
  while (frames < 100000 && !sliced.Pass->IsConverged())
  {
    ++frames;
    sliced.Renderer->GetActiveCamera()->Azimuth(0.1);
    sliced.Window->Render();
  }
  std::cout << frames << " frames\n";
  Check(sliced.Pass->IsConverged() && frames > 3, "slices");
  // With shots it may have begun.
  Check(byShots || GetRuns(sliced)[2] == 1, "what has been given up was ended");
  // Drawn in other pieces, sums of single precision are rounded otherwise.
  const std::vector<double> expected = Read(whole, "Radiosity");
  const double error =
    GetLargestDifference(expected, Read(sliced, "Radiosity")) / GetLargest(expected);
  std::cout << "slices change it by " << error << "\n";
  Check(error <= (byShots ? 1e-3 : 0.0), "slices have another solution");
  // Ended in the midst of it.
  sliced.Floor->SetPosition(0.0, 0.0, -0.1);
  sliced.Window->Render();
  Check(!sliced.Pass->IsConverged(), "the end comes too late");
}

/// An estimate is there before the first shot; in a room an ambient term brings it nearer.
void TestEstimates()
{
  Scene scene;
  scene.Renderer->RemoveAllViewProps();
  auto box = MakeActor(MakeCornellBox(300.0));
  scene.Renderer->AddActor(box);
  scene.Light->SwitchOff();
  scene.Pass->SetExposure(0.5);
  scene.Renderer->GetActiveCamera()->SetPosition(278.0, 273.0, -800.0);
  scene.Renderer->GetActiveCamera()->SetFocalPoint(278.0, 273.0, 280.0);
  scene.Renderer->GetActiveCamera()->SetViewUp(0.0, 1.0, 0.0);
  scene.Renderer->GetActiveCamera()->SetParallelScale(270.0);
  scene.Renderer->ResetCameraClippingRange();
  scene.ShootInstead(1e-2);
  scene.Radiosity->SetTolerance(1e-2);
  DrawAll(scene);
  const std::vector<double> picture = Draw(scene.Window);
  scene.Pass->SetFrameBudget(0.0);
  double errors[2] = {};
  for (const bool isAmbient : { false, true })
  {
    scene.Pass->SetAmbientTerm(isAmbient);
    scene.Radiosity->Modified();
    while (GetRuns(scene)[2] < (isAmbient ? 3 : 2))
    {
      scene.Window->Render();
    }
    const std::vector<double> early = Draw(scene.Window);
    for (std::size_t pixel = 0; pixel < early.size(); ++pixel)
    {
      errors[isAmbient ? 1 : 0] += std::abs(early[pixel] - picture[pixel]);
    }
    Check(!scene.Pass->IsConverged(), "no estimate, but a solution");
  }
  const double all = Mean(picture) * static_cast<double>(picture.size());
  std::cout << "early estimates are off by " << errors[0] / all << ", with an ambient term by "
            << errors[1] / all << "\n";
  // Shots that there was time for make both better.
  Check(errors[0] > 0.1 * all && errors[1] < 0.8 * errors[0], "estimates");
}

/// An actor that moves is drawn where it is, before there is a new estimate.
void TestMovingActor()
{
  Scene scene;
  const std::vector<double> before = Draw(scene.Window);
  scene.Pass->SetFrameBudget(0.0);
  for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get(), scene.Lamp.Get() })
  {
    actor->AddPosition(0.0, 0.0, 100.0);
  }
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(4.0, -4.0, 104.0);
  camera->SetFocalPoint(-0.3, 0.0, 100.6);
  scene.Renderer->ResetCameraClippingRange();
  const std::vector<double> after = Draw(scene.Window);
  Check(!scene.Pass->IsConverged(), "a moved actor is there too early");
  Check(GetLargestDifference(before, after) < 2.0 / 255.0, "a moved actor looks otherwise");
}

/// What is told, and how often.
void CheckMessage(Scene& scene, const std::string& message, bool isError)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  scene.Pass->AddObserver(vtkCommand::ErrorEvent, observer);
  scene.Pass->AddObserver(vtkCommand::WarningEvent, observer);
  scene.Window->Render();
  Check((isError ? observer->CheckErrorMessage(message) : observer->CheckWarningMessage(message)) ==
      0,
    "nothing says \"" + message + "\"");
  observer->Clear();
  scene.Window->Render();
  scene.Renderer->GetActiveCamera()->Azimuth(1.0);
  scene.Window->Render();
  Check(!observer->GetError() && !observer->GetWarning(), "told twice: " + message);
}

/// An actor with this mapper is told of, and left out.
void CheckRefused(vtkMapper* mapper)
{
  Scene scene;
  vtkNew<vtkActor> other;
  other->SetMapper(mapper);
  other->SetPosition(0.0, 0.0, -2.0);
  scene.Renderer->AddActor(other);
  CheckMessage(scene, "Actor 4 of the renderer takes no part", false);
  Check(scene.Pass->GetOutput(scene.Floor) && !scene.Pass->GetOutput(other),
    "the others are not solved");
}

/// Surfaces that one sees through, or that are not what is drawn.
void TestRefusals()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeSquare(2));
  vtkNew<vtkCompositePolyDataMapper2> composite;
  composite->SetInputDataObject(blocks);
  composite->SetCompositeDataDisplayAttributes(vtkNew<vtkCompositeDataDisplayAttributes>());
  composite->SetBlockOpacity(1, 0.5);
  CheckRefused(composite);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(MakeSquare(1));
  glyphs->SetSourceData(MakeSquare(1));
  CheckRefused(glyphs);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(MakeSquare(2));
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(strips->GetOutputPort());
  CheckRefused(mapper);
}

void TestMessages()
{
  {
    Scene scene;
    Fill(vtkPolyDataMapper::SafeDownCast(scene.Wall->GetMapper())->GetInput(), "Reflectance",
      { 1.5, 0.5, 0.5 });
    CheckMessage(scene, "Reflectance", true);
    scene.Pass->SetRadiosity(nullptr);
    scene.Pass->SetRadiosity(scene.Radiosity);
    vtkPolyDataMapper::SafeDownCast(scene.Wall->GetMapper())
      ->GetInput()
      ->GetCellData()
      ->RemoveArray("Reflectance");
    scene.Window->Render();
    Check(scene.Pass->IsConverged(), "what has been corrected stays wrong");
  }
  {
    Scene scene;
    vtkNew<vtkDoubleArray> two;
    two->SetName("Emission");
    two->SetNumberOfComponents(2);
    two->SetNumberOfTuples(36);
    two->FillValue(1.0);
    vtkPolyDataMapper::SafeDownCast(scene.Wall->GetMapper())
      ->GetInput()
      ->GetCellData()
      ->AddArray(two);
    CheckMessage(scene, "\"Emission\" has not 1 or 3 components", true);
  }
  {
    Scene scene;
    scene.Radiosity->TwoSidedOn();
    CheckMessage(scene, "TwoSided", true);
  }
  {
    Scene scene;
    scene.Lamp->GetProperty()->SetAmbient(0.0);
    scene.Light->SetLightTypeToHeadlight();
    CheckMessage(scene, "Nothing shines", false);
  }
}

/// An actor that is not shown takes part, and is drawn as usual.
void TestShown()
{
  Scene scene;
  scene.Wall->GetProperty()->SetDiffuse(0.0);
  scene.Wall->GetProperty()->SetSpecular(0.0);
  Draw(scene.Window);
  scene.Pass->SetShown(scene.Wall, false);
  const auto without = Read(scene, "Radiosity");
  const std::vector<double> picture = Draw(scene.Window);
  Check(!scene.Pass->IsShown(scene.Wall) && scene.Pass->IsShown(scene.Floor) &&
      GetRuns(scene)[2] == 1 && GetLargest(without) > 0.0,
    "what is not shown");
  scene.Wall->GetProperty()->SetAmbient(1.0);
  scene.Wall->GetProperty()->SetAmbientColor(0.9, 0.9, 0.9);
  const std::vector<double> asUsual = Draw(scene.Window);
  scene.Pass->SetShown(scene.Wall, true);
  const std::vector<double> asRadiosity = Draw(scene.Window);
  // VTK draws the ambient color as it is, the pass over pi.
  Check(GetLargest(asUsual) > 0.88 && GetLargestDifference(asUsual, asRadiosity) > 0.3,
    "an actor that is not shown is drawn otherwise than VTK does");
}

/// A light that moves in each frame, faster than its light is computed.
void TestMovingLight(bool byShots)
{
  Scene scene;
  if (byShots)
  {
    scene.ShootFew();
  }
  vtkPolyDataMapper::SafeDownCast(scene.Floor->GetMapper())->SetInputData(MakeSquare(16));
  DrawAll(scene);
  scene.Pass->SetFrameBudget(0.0);
  const std::vector<double> before = Draw(scene.Window);
  int frames = 0;
  while (frames < 100000 && GetRuns(scene)[1] < 3)
  {
    scene.Light->SetPosition(3.0, 1.0, 4.0 + 0.01 * ++frames);
    scene.Window->Render();
  }
  std::cout << "light that moves is shown after " << frames << " frames\n";
  Check(GetRuns(scene)[1] == 3, "a light that moves is never shown");
  // One that stands is shown where it is.
  scene.Light->SetPosition(-2.0, 0.0, 4.0);
  DrawAll(scene);
  Scene other;
  if (byShots)
  {
    other.ShootFew();
  }
  vtkPolyDataMapper::SafeDownCast(other.Floor->GetMapper())->SetInputData(MakeSquare(16));
  other.Light->SetPosition(-2.0, 0.0, 4.0);
  DrawAll(other);
  Check(GetLargestDifference(Draw(scene.Window), Draw(other.Window)) < 2.0 / 255.0,
    "a light that has moved leaves something behind");
}

/// Lines and vertices of an actor that takes part look like those of one that has nothing else.
void TestLines()
{
  Scene scene;
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-1.0, -1.0, 0.5);
  line->SetPoint2(1.0, 1.0, 0.5);
  line->Update();
  Draw(scene.Window);
  auto apart = MakeActor(line->GetOutput());
  apart->SetProperty(scene.Floor->GetProperty());
  scene.Floor->GetProperty()->SetLineWidth(3.0);
  const std::vector<double> without = Draw(scene.Window);
  scene.Renderer->AddActor(apart);
  const std::vector<double> expected = Draw(scene.Window);
  Check(GetLargestDifference(without, expected) > 0.1, "no line is drawn");
  scene.Renderer->RemoveActor(apart);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(MakeSquare(6));
  both->AddInputData(line->GetOutput());
  both->Update();
  vtkPolyDataMapper::SafeDownCast(scene.Floor->GetMapper())->SetInputData(both->GetOutput());
  Check(GetLargestDifference(Draw(scene.Window), expected) < 1.5 / 255.0,
    "lines of an actor that takes part are not drawn as usual");
}

#ifdef __linux__
/// As long as it lives there is no memory for textures.
class LittleMemory
{
public:
  LittleMemory()
  {
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit little = this->Before;
    little.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + Spare;
    setrlimit(RLIMIT_AS, &little);
  }
  ~LittleMemory() { setrlimit(RLIMIT_AS, &this->Before); }
  LittleMemory(const LittleMemory&) = delete;
  void operator=(const LittleMemory&) = delete;

private:
  static constexpr rlim_t Spare = 1u << 25;
  rlimit Before = {};
};

/// Shots that fail in one window are told of by the pass, once, and tried in another.
void TestFailingShots()
{
  Scene scene;
  scene.ShootFew();
  DrawAll(scene);
  const std::vector<double> expected = Draw(scene.Window);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  vtkNew<vtkTest::ErrorObserver> observer;
  scene.Pass->AddObserver(vtkCommand::ErrorEvent, observer);
  {
    const LittleMemory little;
    scene.Window->Render();
  }
  Check(observer->CheckErrorMessage("set Device to CPU") == 0, "the pass does not tell of shots");
  observer->Clear();
  scene.Window->Render();
  Check(!observer->GetError() && !scene.Pass->IsConverged(), "shots that failed are tried again");
  scene.Window->RemoveRenderer(scene.Renderer);
  vtkNew<vtkOffScreenOpenGLRenderWindow> other;
  other->SetMultiSamples(0);
  other->SetSize(Side, Side);
  other->AddRenderer(scene.Renderer);
  Check(GetLargestDifference(Draw(other), expected) < 1.5 / 255.0 && scene.Pass->IsConverged(),
    "shots are not tried in another window");
  Check(!observer->GetError(), "shots fail in another window, too");
  scene.Pass->ReleaseGraphicsResources(other);
  other->RemoveRenderer(scene.Renderer);
}
#endif
} // namespace

//------------------------------------------------------------------------------
int TestRadiosityFrames(int, char*[])
{
  for (const bool byShots : { false, true })
  {
    TestRuns(byShots);
    TestSlices(byShots);
    TestMovingLight(byShots);
  }
  TestEstimates();
  TestMovingActor();
  TestRefusals();
  TestMessages();
  TestShown();
  TestLines();
#ifdef __linux__
  TestFailingShots();
#endif
  return Result();
}
