// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Scenes that vtkRadiosityPass solves while it draws them: the filter's arrays, what is computed
 * again when, slices of a solution, pictures, scenes that are none.
 */
#include "CompositeMapper.h"
#include "CornellBoxTesting.h"
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "RadiosityScene.h"
#include "vtkDirectIrradiance.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkRenderStepsPass.h"
#include "vtkReverseSense.h"
#include "vtkStripper.h"
#include "vtkTestErrorObserver.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"

#include <array>
#include <iostream>
#include <string>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace RadiosityScene;

void Fill(vtkPolyData* surface, const char* name, const std::array<double, 3>& value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    array->InsertNextTuple(value.data());
  }
  surface->GetCellData()->AddArray(array);
}

/// Values of an array of all actors of a scene, one after another.
std::vector<double> Read(Scene& scene, const char* name)
{
  std::vector<double> values;
  for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get(), scene.Lamp.Get() })
  {
    vtkPolyData* output = scene.Pass->GetOutput(actor);
    if (Check(output != nullptr, "an actor has no output"))
    {
      const std::vector<double> more = GetCellValues(output, name);
      values.insert(values.end(), more.begin(), more.end());
    }
  }
  return values;
}

double GetLargest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// The same scene by hand: one mesh, by the filters.
vtkSmartPointer<vtkPolyData> SolveByHand(Scene& scene, bool hasLight = true)
{
  vtkNew<vtkAppendPolyData> all;
  for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get(), scene.Lamp.Get() })
  {
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput());
    surface->GetPointData()->Initialize();
    std::array<double, 3> emission, reflectance;
    vtkProperty* property = actor->GetProperty();
    for (int band = 0; band < 3; ++band)
    {
      emission[band] = property->GetAmbient() * property->GetAmbientColor()[band];
      reflectance[band] = property->GetDiffuse() * property->GetDiffuseColor()[band];
    }
    Fill(surface, "Emission", emission);
    Fill(surface, "Reflectance", reflectance);
    vtkNew<vtkTransform> transform;
    actor->ComputeMatrix();
    transform->SetMatrix(actor->GetMatrix());
    vtkNew<vtkTransformPolyDataFilter> moved;
    moved->SetTransform(transform);
    moved->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkNew<vtkReverseSense> mirrored;
    mirrored->SetInputData(surface);
    mirrored->Update();
    moved->SetInputData(
      actor->GetMatrix()->Determinant() < 0.0 ? mirrored->GetOutput() : surface.Get());
    moved->Update();
    all->AddInputData(moved->GetOutput());
  }
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputConnection(all->GetOutputPort());
  if (hasLight)
  {
    direct->AddLight(scene.Light);
  }
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputConnection(direct->GetOutputPort());
  radiosity->Update();
  return vtkPolyData::SafeDownCast(radiosity->GetOutputDataObject(0));
}

std::array<vtkIdType, 3> GetRuns(Scene& scene)
{
  return { scene.Pass->GetNumberOfLinkRuns(), scene.Pass->GetNumberOfLightRuns(),
    scene.Pass->GetNumberOfSolverRuns() };
}

/// Frames until it has converged; 0 where it does not.
int DrawAll(Scene& scene, int most = 100000)
{
  for (int frame = 1; frame <= most; ++frame)
  {
    scene.Window->Render();
    if (scene.Pass->IsConverged())
    {
      return frame;
    }
  }
  Check(false, "it does not converge");
  return 0;
}

/// With links the arrays are the filter's, by shots they are near.
void TestCornellBox()
{
  const auto box = MakeCornellBox(200.0);
  vtkNew<vtkRadiosity> filter;
  filter->SetInputData(box);
  filter->Update();
  auto* solved = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  for (const bool byShots : { false, true })
  {
    Scene scene;
    scene.Renderer->RemoveAllViewProps();
    scene.Light->SwitchOff();
    auto actor = MakeActor(box);
    scene.Renderer->AddActor(actor);
    if (byShots)
    {
      scene.ShootInstead(1e-2);
      scene.Radiosity->SetTolerance(1e-2);
    }
    scene.Window->Render();
    Check(scene.Pass->IsConverged(), "a whole budget is not enough");
    for (const char* name : { "Radiosity", "Irradiance" })
    {
      const double error = Compare(box, GetCellValues(scene.Pass->GetOutput(actor), name),
        GetCellValues(solved, name));
      std::cout << name << (byShots ? " by shots" : " with links") << " is off by " << error
                << "\n";
      Check(error < (byShots ? 0.02 : 1e-12), std::string(name) + " is not the filter's");
    }
    Check((scene.Pass->GetNumberOfLinkRuns() == 0) == byShots &&
        (scene.Pass->GetNumberOfShots() > 10) == byShots,
      "links and shots");
    Check(byShots || scene.Pass->GetNumberOfBytesRead() == 0, "something is read back");
  }
}

/// Properties, matrices (a mirror, too) and lights of several actors.
void TestProperties()
{
  for (const bool isMirrored : { false, true })
  {
    Scene scene;
    if (isMirrored)
    {
      scene.Wall->SetScale(1.0, -1.2, 1.0);
      scene.Wall->SetPosition(1.0, 0.0, 1.2);
    }
    scene.Window->Render();
    const auto solved = SolveByHand(scene);
    const double error =
      Compare(solved, Read(scene, "Radiosity"), GetCellValues(solved, "Radiosity"));
    std::cout << "several actors are off by " << error << "\n";
    Check(error < 1e-10, "several actors");
    scene.ShootInstead(1e-2);
    DrawAll(scene);
    const double byShots =
      Compare(solved, Read(scene, "Radiosity"), GetCellValues(solved, "Radiosity"));
    std::cout << "by shots they are off by " << byShots << "\n";
    Check(byShots < 0.02, "several actors by shots");
  }
}

/// Arrays win over properties, also under names that a user chose.
void TestArrays()
{
  Scene scene;
  vtkPolyData* floor = vtkPolyDataMapper::SafeDownCast(scene.Floor->GetMapper())->GetInput();
  Fill(floor, "Reflectance", { 0.1, 0.2, 0.3 });
  vtkNew<vtkDoubleArray> glow;
  glow->SetName("Glow");
  glow->SetNumberOfTuples(floor->GetNumberOfCells());
  glow->Fill(0.25);
  floor->GetCellData()->AddArray(glow);
  scene.Radiosity->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Glow");
  scene.Window->Render();
  vtkPolyData* output = scene.Pass->GetOutput(scene.Floor);
  if (!Check(output != nullptr, "arrays: no output"))
  {
    return;
  }
  double radiosity[3], irradiance[3];
  output->GetCellData()->GetArray("Radiosity")->GetTuple(20, radiosity);
  output->GetCellData()->GetArray("Irradiance")->GetTuple(20, irradiance);
  for (int band = 0; band < 3; ++band)
  {
    CheckClose(radiosity[band], 0.25 + 0.1 * (band + 1) * irradiance[band], 1e-12, "arrays");
  }
}

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

/// What is drawn are the arrays, from either way of solving.
void TestPictures()
{
  for (const bool byShots : { false, true })
  {
    Scene scene;
    if (byShots)
    {
      scene.ShootInstead(1e-2);
    }
    const std::vector<double> solved = Draw(scene.Window);
    vtkNew<vtkRadiosityPass> old;
    old->SetOutputEncodingToLinear();
    old->SetExposure(1.5);
    std::vector<vtkSmartPointer<vtkActor>> actors;
    for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get(), scene.Lamp.Get() })
    {
      actors.push_back(MakeActor(scene.Pass->GetOutput(actor)));
      scene.Renderer->AddActor(actors.back());
      actor->VisibilityOff();
    }
    scene.Renderer->SetPass(old);
    const std::vector<double> drawn = Draw(scene.Window);
    Check(GetLargest(drawn) > 0.3 && Mean(drawn) > 0.02, "the picture is dark");
    Check(GetLargestDifference(solved, drawn) < 1.5 / 255.0,
      std::string("the picture is not that of the arrays") + (byShots ? ", by shots" : ""));
    old->ReleaseGraphicsResources(scene.Window);
  }
  // A convex body alone reflects but once: as VTK shades it.
  Scene scene;
  scene.Wall->VisibilityOff();
  scene.Lamp->VisibilityOff();
  scene.Floor->GetProperty()->SetAmbient(0.1);
  scene.Floor->GetProperty()->SetAmbientColor(1.0, 0.5, 0.5);
  scene.Pass->SetExposure(vtkMath::Pi());
  const std::vector<double> solved = Draw(scene.Window);
  vtkNew<vtkRenderStepsPass> plain;
  scene.Renderer->SetPass(plain);
  const std::vector<double> shaded = Draw(scene.Window);
  Check(GetLargest(shaded) > 0.3 && GetLargestDifference(solved, shaded) < 1.5 / 255.0,
    "a plate is not as VTK shades it");
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
  vtkNew<CompositeMapper> composite;
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

/// Blocks are as many actors, with the colors that their mapper gives them.
void TestComposite()
{
  for (const bool byShots : { false, true })
  {
    Scene apart;
    Scene together;
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (vtkActor* actor : { together.Floor.Get(), together.Wall.Get() })
    {
      vtkNew<vtkTransform> transform;
      actor->ComputeMatrix();
      transform->SetMatrix(actor->GetMatrix());
      vtkNew<vtkTransformPolyDataFilter> moved;
      moved->SetTransform(transform);
      moved->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      moved->SetInputData(vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput());
      moved->Update();
      blocks->SetBlock(blocks->GetNumberOfBlocks(), moved->GetOutput());
      together.Renderer->RemoveActor(actor);
    }
    blocks->SetBlock(2, MakeSquare(1));
    vtkNew<CompositeMapper> mapper;
    mapper->SetInputDataObject(blocks);
    mapper->SetCompositeDataDisplayAttributes(vtkNew<vtkCompositeDataDisplayAttributes>());
    const double red[3] = { 0.9, 0.1, 0.1 };
    mapper->SetBlockColor(2, red[0], red[1], red[2]);
    mapper->SetBlockVisibility(3, false);
    vtkNew<vtkActor> composite;
    composite->SetMapper(mapper);
    composite->GetProperty()->SetDiffuseColor(0.8, 0.8, 0.7);
    together.Renderer->AddActor(composite);
    apart.Wall->GetProperty()->SetDiffuse(1.0);
    for (Scene* scene : { &apart, &together })
    {
      if (byShots)
      {
        scene->ShootInstead(0.05);
      }
      DrawAll(*scene);
    }
    int block = 0;
    for (vtkActor* actor : { apart.Floor.Get(), apart.Wall.Get() })
    {
      vtkPolyData* output = together.Pass->GetOutput(composite, block++);
      if (Check(output != nullptr, "a block has no output"))
      {
        const auto expected = GetCellValues(apart.Pass->GetOutput(actor), "Radiosity");
        Check(GetLargestDifference(GetCellValues(output, "Radiosity"), expected) <
            (byShots ? 1e-2 : 1e-10),
          "a block differs from an actor");
      }
    }
    Check(!together.Pass->GetOutput(composite, 2), "what cannot be seen takes part");
    Check(GetLargestDifference(Draw(apart.Window), Draw(together.Window)) < 3.0 / 255.0,
      "blocks look otherwise");
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

/// Scenes that are hardly any.
void TestSmallScenes()
{
  Scene scene;
  scene.Renderer->RemoveAllViewProps();
  scene.Window->Render();
  Check(scene.Pass->IsConverged() && GetRuns(scene)[2] == 0, "a renderer without actors");
  vtkNew<vtkPolyData> nothing;
  scene.Renderer->AddActor(MakeActor(nothing));
  scene.Renderer->AddActor(vtkNew<vtkActor>());
  scene.Window->Render();
  Check(scene.Pass->IsConverged() && GetRuns(scene)[2] == 0, "actors without polygons");
  auto alone = MakeActor(MakeSquare(1));
  scene.Renderer->AddActor(alone);
  for (const bool byShots : { false, true })
  {
    if (byShots)
    {
      scene.ShootInstead(1e-2);
    }
    DrawAll(scene);
    vtkPolyData* output = scene.Pass->GetOutput(alone);
    double radiosity[3] = {};
    if (Check(output != nullptr, "one patch has no output"))
    {
      output->GetCellData()->GetArray("Radiosity")->GetTuple(0, radiosity);
    }
    CheckClose(radiosity[0], 0.5 * 4.0 / std::sqrt(26.0), 1e-6, "one patch");
  }
  // Back to back with it: a sheet of two sides, the other one dark.
  auto back = MakeActor(MakeSquare(3));
  back->RotateX(180.0);
  scene.Renderer->AddActor(back);
  DrawAll(scene);
  double front[3] = {};
  double behind[3] = {};
  scene.Pass->GetOutput(alone)->GetCellData()->GetArray("Radiosity")->GetTuple(0, front);
  scene.Pass->GetOutput(back)->GetCellData()->GetArray("Radiosity")->GetTuple(4, behind);
  CheckClose(front[0], 0.5 * 4.0 / std::sqrt(26.0), 1e-6, "the front of a sheet");
  Check(behind[0] == 0.0, "light goes through a sheet");
}

/// Points of single precision on a map.
void TestOffset()
{
  Scene near;
  near.Window->Render();
  const std::vector<double> expected = Read(near, "Radiosity");
  Scene far;
  for (vtkActor* actor : { far.Floor.Get(), far.Wall.Get(), far.Lamp.Get() })
  {
    // Steps of 1/16 there: corners are on them, or a little off.
    vtkNew<vtkTransform> transform;
    actor->ComputeMatrix();
    transform->Translate(6e5, 6e6, 0.0);
    transform->Scale(100.0, 100.0, 100.0);
    transform->Concatenate(actor->GetMatrix());
    vtkNew<vtkTransformPolyDataFilter> moved;
    moved->SetTransform(transform);
    moved->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    moved->SetInputData(vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput());
    moved->Update();
    vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(moved->GetOutput());
    actor->SetPosition(0.0, 0.0, 0.0);
    actor->SetOrientation(0.0, 0.0, 0.0);
    actor->SetScale(1.0);
  }
  far.Light->SetPosition(6e5 + 300.0, 6e6 + 100.0, 400.0);
  far.Light->SetFocalPoint(6e5, 6e6, 0.0);
  for (const bool byShots : { false, true })
  {
    if (byShots)
    {
      far.ShootInstead(1e-2);
    }
    DrawAll(far);
    const double error =
      GetLargestDifference(Read(far, "Radiosity"), expected) / GetLargest(expected);
    std::cout << "on a map it is off by " << error << "\n";
    Check(error < 0.02, "single precision on a map");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiosityPass(int, char*[])
{
  TestCornellBox();
  TestProperties();
  TestArrays();
  TestRuns(false);
  TestRuns(true);
  TestSlices(false);
  TestSlices(true);
  TestEstimates();
  TestPictures();
  TestMovingActor();
  TestRefusals();
  TestMessages();
  TestComposite();
  TestShown();
  TestSmallScenes();
  TestOffset();
  return Result();
}
