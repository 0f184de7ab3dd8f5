// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Scenes that vtkRadiosityPass solves while it draws them: the filter's arrays, pictures, scenes
 * that are none.
 */
#include "CornellBoxTesting.h"
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "RadiosityScene.h"
#include "vtkDirectIrradiance.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkRenderStepsPass.h"
#include "vtkReverseSense.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <array>
#include <iostream>
#include <string>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace RadiosityScene;

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
    vtkNew<vtkReverseSense> mirrored;
    mirrored->SetInputData(surface);
    mirrored->Update();
    all->AddInputData(MoveToWorld(actor,
      actor->GetMatrix()->Determinant() < 0.0 ? mirrored->GetOutput() : surface));
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
      blocks->SetBlock(blocks->GetNumberOfBlocks(),
        MoveToWorld(actor, vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput()));
      together.Renderer->RemoveActor(actor);
    }
    blocks->SetBlock(2, MakeSquare(1));
    vtkNew<vtkCompositePolyDataMapper2> mapper;
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
  TestPictures();
  TestComposite();
  TestSmallScenes();
  TestOffset();
  return Result();
}
