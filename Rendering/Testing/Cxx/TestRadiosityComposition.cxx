// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * vtkRadiosityPass, solving by shots and with links, together with other things of VTK: a scene
 * looks as it does without them, and nothing is computed for them.
 */
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "RadiosityScene.h"
#include "ScatteringScene.h"
#include "vtkSurfaceLighting.h"

#include "vtkCameraPass.h"
#include "vtkLightsPass.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkRenderStepsPass.h"
#include "vtkToneMappingPass.h"

#include <iostream>
#include <string>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace RadiosityScene;

/// A scene with a solution of one kind.
struct Solved : Scene
{
  explicit Solved(bool byShots)
  {
    if (byShots)
    {
      this->ShootFew();
      this->Pass->SetExposure(3.0);
    }
  }
  double GetMean(double left = 0.0, double right = 1.0)
  {
    return Mean(Draw(this->Window, left, right));
  }
};

double GetPlainMean(bool byShots)
{
  static const double means[2] = { Solved(false).GetMean(), Solved(true).GetMean() };
  return means[byShots ? 1 : 0];
}

/// The same mean in a window of another size, too, and nothing is computed again.
void CheckMean(Solved& scene, double expected, const std::string& what)
{
  CheckClose(scene.GetMean(), expected, 0.01, what);
  const vtkIdType shots = scene.Pass->GetNumberOfShots();
  scene.Window->SetSize(Side + Side / 2, Side + Side / 2);
  CheckClose(scene.GetMean(), expected, 0.02, what + ", resized");
  Check(scene.Pass->GetNumberOfSolverRuns() == 1 && scene.Pass->GetNumberOfShots() == shots,
    what + ": something is computed again");
  scene.Renderer->SetPass(nullptr);
}

/// Steps of one's own, below the pass, and around it.
void TestSequences(bool byShots)
{
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkCameraPass> camera;
  {
    Solved scene(byShots);
    camera->SetDelegatePass(MakeSequence({ lights, opaque }));
    scene.Pass->SetDelegatePass(camera);
    CheckMean(scene, GetPlainMean(byShots), "a camera and a sequence below");
  }
  Solved scene(byShots);
  scene.Pass->SetDelegatePass(opaque);
  camera->SetDelegatePass(MakeSequence({ lights, scene.Pass }));
  scene.Renderer->SetPass(camera);
  CheckMean(scene, GetPlainMean(byShots), "a camera and a sequence around");
}

/// Passes that draw the picture of another one anew.
template <typename OuterPass>
void TestImagePass(bool byShots, const char* name)
{
  Solved scene(byShots);
  vtkNew<OuterPass> outer;
  Wrap(outer, scene.Pass);
  scene.Renderer->SetPass(outer);
  // What such a pass does to edges is not ours.
  CheckClose(scene.GetMean(), GetPlainMean(byShots), 0.06, name);
  CheckMean(scene, scene.GetMean(), name);
  outer->ReleaseGraphicsResources(scene.Window);
}

/// Tone mapping expects encoded colours: it decodes them by the power 2.2, and encodes its own.
void TestToneMapping(bool byShots)
{
  Solved scene(byShots);
  const std::vector<double> plain = Draw(scene.Window);
  vtkNew<vtkToneMappingPass> tone;
  tone->SetToneMappingType(vtkToneMappingPass::Exponential);
  tone->SetExposure(1.0);
  tone->SetDelegatePass(scene.Pass);
  scene.Pass->SetOutputEncodingToSRGB();
  scene.Renderer->SetPass(tone);
  std::vector<double> expected;
  for (const double value : plain)
  {
    const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    expected.push_back(std::pow(1.0 - std::exp(-std::pow(encoded, 2.2)), 1.0 / 2.2));
  }
  CheckClose(scene.GetMean(), Mean(expected), 0.02, "tone mapping");
  tone->ReleaseGraphicsResources(scene.Window);
}

/// A neighbour that one sees through takes no part.
void TestDepthPeeling(bool byShots)
{
  Solved scene(byShots);
  scene.Pass->SetDelegatePass(MakePeelingSteps());
  auto veil = MakeActor(MakeSquare(1));
  veil->GetProperty()->SetOpacity(0.5);
  veil->GetProperty()->SetDiffuse(0.0);
  veil->SetScale(10.0);
  veil->RotateX(60.0);
  veil->SetPosition(2.0, -2.0, 2.0);
  scene.Renderer->AddActor(veil);
  scene.Renderer->ResetCameraClippingRange();
  CheckClose(scene.GetMean(), 0.5 * GetPlainMean(byShots), 0.03, "a veil");
  scene.Renderer->SetPass(nullptr);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
}

/// One pass in two renderers with the same actors, of which one is darker.
void TestViewports(bool byShots)
{
  Solved scene(byShots);
  vtkNew<vtkRenderer> second;
  vtkNew<vtkLight> dim;
  dim->DeepCopy(scene.Light);
  dim->SetIntensity(0.25);
  second->AddLight(dim);
  // Light of a lamp would be the same.
  scene.Lamp->VisibilityOff();
  for (vtkActor* actor : { scene.Floor.Get(), scene.Wall.Get() })
  {
    second->AddActor(actor);
  }
  second->SetActiveCamera(scene.Renderer->GetActiveCamera());
  second->SetPass(scene.Pass);
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  scene.Window->SetSize(2 * Side, Side);
  scene.Window->AddRenderer(second);
  for (int frame = 0; frame < 2; ++frame)
  {
    const double left = scene.GetMean(0.0, 0.5);
    Check(left > 0.02, "the left one of two viewports is dark");
    CheckClose(scene.GetMean(0.5, 1.0), 0.5 * left, 0.02, "the right one of two viewports");
  }
  Check(scene.Pass->GetNumberOfSolverRuns() == 2 && scene.Pass->IsConverged(),
    "two viewports: something is computed again");
  scene.Window->RemoveRenderer(second);
  second->SetPass(nullptr);
}

/// Resources that are released, windows that end, and others.
void TestWindows(bool byShots)
{
  Solved scene(byShots);
  const std::vector<double> first = Draw(scene.Window);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  Check(GetLargestDifference(first, Draw(scene.Window)) < 1.5 / 255.0, "after a release");
  scene.Window->Finalize();
  Check(GetLargestDifference(first, Draw(scene.Window)) < 1.5 / 255.0,
    "after the window has ended");
  vtkNew<vtkOffScreenOpenGLRenderWindow> other;
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  scene.Window->RemoveRenderer(scene.Renderer);
  other->SetMultiSamples(0);
  other->SetSize(Side, Side);
  other->AddRenderer(scene.Renderer);
  Check(GetLargestDifference(first, Draw(other)) < 1.5 / 255.0, "in another window");
  Check(scene.Pass->GetNumberOfSolverRuns() == 1 && scene.Pass->GetNumberOfLightRuns() == 1,
    "windows cost a solution");
  scene.Pass->ReleaseGraphicsResources(other);
  other->RemoveRenderer(scene.Renderer);
}

/// What a solution sends to a translucent body enters it, and the body is drawn by another pass.
void TestTranslucentBody(bool byShots)
{
  Solved scene(byShots);
  const double center[3] = {};
  const auto ball = ScatteringScene::MakeBall(8, center);
  auto body = MakeActor(ball);
  body->SetScale(0.4);
  body->SetPosition(0.2, -0.2, 0.6);
  body->GetProperty()->SetDiffuse(0.5);
  scene.Renderer->AddActor(body);
  scene.Pass->SetShown(body, false);
  scene.Window->Render();
  vtkPolyData* solved = scene.Pass->GetOutput(body);
  if (!Check(solved != nullptr, "a translucent body takes no part"))
  {
    return;
  }
  vtkDataArray* irradiance = solved->GetCellData()->GetArray("Irradiance");
  ball->GetCellData()->AddArray(irradiance);
  double falling = 0.0;
  double whole = 0.0;
  for (vtkIdType cell = 0; cell < ball->GetNumberOfCells(); ++cell)
  {
    const double area = ScatteringScene::GetArea(ball, cell);
    falling += area * irradiance->GetComponent(cell, 0);
    whole += area;
  }
  vtkNew<vtkSubsurfaceScattering> material;
  material->SetMillimetersPerUnit(5.0);
  material->SetLinkMethodToAdaptive();
  vtkNew<vtkSubsurfaceScatteringPass> scattering;
  scattering->SetIrradianceMapSize(128);
  scattering->SetScatteredMapSize(32);
  scattering->SetMaterial(body, material);
  scattering->GetLighting()->RendererLightsOff();
  scattering->GetLighting()->SetIrradianceArray("Irradiance");
  const double before = scene.GetMean();
  scene.Pass->SetDelegatePass(scattering);
  const double after = scene.GetMean();
  double entered = 0.0;
  double areas = 0.0;
  const auto map = ScatteringScene::Read(scattering->GetTransmittedMap(body)->GetTexture());
  for (std::size_t texel = 0; texel < map.size(); texel += 4)
  {
    entered += map[texel];
    areas += map[texel + 3];
  }
  constexpr double MeanReflectance = 0.061132; // external, of index 1.3
  CheckClose(entered / areas, (1.0 - MeanReflectance) * falling / whole, 0.01,
    "what of a solution enters");
  Check(std::abs(after - before) > 0.01 * before && scene.Pass->GetNumberOfSolverRuns() == 1,
    "a translucent body is not drawn, or solved again");
  scattering->ReleaseGraphicsResources(scene.Window);
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiosityComposition(int, char*[])
{
  for (const bool byShots : { false, true })
  {
    Check(GetPlainMean(byShots) > 0.02, "the plain picture is too dark to compare with");
    std::cout << "mean of the plain picture: " << GetPlainMean(byShots) << "\n";
    TestSequences(byShots);
    TestImagePass<vtkSSAAPass>(byShots, "supersampling");
    TestImagePass<vtkOpenGLFXAAPass>(byShots, "smoothed edges");
    TestToneMapping(byShots);
    TestDepthPeeling(byShots);
    TestViewports(byShots);
    TestWindows(byShots);
    TestTranslucentBody(byShots);
  }
  return Result();
}
