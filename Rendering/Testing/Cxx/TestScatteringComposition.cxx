// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * vtkSubsurfaceScatteringPass together with other things of VTK: a body looks as it does without
 * them, or an error says why it cannot.
 */
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "ScatteringScene.h"
#include "vtkRadiosityPass.h"

#include "vtkCameraPass.h"
#include "vtkLightsPass.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkPlaneSource.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkTestErrorObserver.h"
#include "vtkToneMappingPass.h"

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace ScatteringScene;

constexpr int Side = 64;

/// A body before a black background, which fills the middle of a picture; no value is clamped.
struct Picture : Scene
{
  Picture()
  {
    this->Actor->GetProperty()->SetSpecular(0.0);
    this->Pass->SetExposure(6.0);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(1.0, 2.0, 5.0);
    camera->SetParallelScale(1.2);
    this->Renderer->ResetCameraClippingRange();
    this->Window->SetSize(Side, Side);
  }

  std::vector<double> Draw(double left = 0.0, double right = 1.0)
  {
    return PictureTesting::Draw(this->Window, left, right);
  }

  double GetMean(double left = 0.0, double right = 1.0) { return Mean(this->Draw(left, right)); }
};

/// Of a picture without anything else.
double GetPlainMean()
{
  static const double mean = []() { return Picture().GetMean(); }();
  return mean;
}

/// The same mean in a window of another size, too, and nothing is computed again.
void CheckMean(Picture& scene, double expected, const std::string& what)
{
  CheckClose(scene.GetMean(), expected, 0.01, what);
  scene.Window->SetSize(Side + Side / 2, Side + Side / 2);
  CheckClose(scene.GetMean(), expected, 0.02, what + ", resized");
  Check(scene.Pass->GetNumberOfIrradianceRuns() == 1 &&
      scene.Pass->GetNumberOfScatteringRuns() == 1,
    what + ": something is computed again");
  scene.Renderer->SetPass(nullptr);
}

/// Steps of one's own, below the pass, and around it.
void TestSequences()
{
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkCameraPass> camera;
  {
    Picture scene;
    camera->SetDelegatePass(MakeSequence({ lights, opaque }));
    scene.Pass->SetDelegatePass(camera);
    CheckMean(scene, GetPlainMean(), "a camera and a sequence below");
  }
  Picture scene;
  scene.Pass->SetDelegatePass(opaque);
  camera->SetDelegatePass(MakeSequence({ lights, scene.Pass }));
  scene.Renderer->SetPass(camera);
  CheckMean(scene, GetPlainMean(), "a camera and a sequence around");
}

/// What such a pass does to the mean of a picture that VTK shades (vtkSSAAPass makes bodies larger
/// by a part of a pixel).
template <typename OuterPass>
double GetChange()
{
  Picture scene;
  scene.Actor->GetProperty()->SetDiffuse(0.9);
  vtkNew<vtkRenderStepsPass> steps;
  scene.Renderer->SetPass(steps);
  const double plain = scene.GetMean();
  vtkNew<OuterPass> outer;
  Wrap(outer, steps);
  scene.Renderer->SetPass(outer);
  const double changed = scene.GetMean();
  outer->ReleaseGraphicsResources(scene.Window);
  return changed / plain;
}

/// Passes that draw the picture of another one anew.
template <typename OuterPass>
void TestImagePass(const char* name)
{
  Picture scene;
  vtkNew<OuterPass> outer;
  Wrap(outer, scene.Pass);
  scene.Renderer->SetPass(outer);
  const double change = GetChange<OuterPass>();
  Check(std::abs(change - 1.0) < 0.03, std::string(name) + " itself changes the picture");
  CheckMean(scene, change * GetPlainMean(), name);
  outer->ReleaseGraphicsResources(scene.Window);
}

/// Tone mapping takes radiances that no picture can hold. It expects encoded colours: it decodes
/// them by the power 2.2, and encodes its own.
void TestToneMapping()
{
  Picture scene;
  vtkNew<vtkToneMappingPass> tone;
  tone->SetToneMappingType(vtkToneMappingPass::Exponential);
  tone->SetExposure(1.0);
  const std::vector<double> plain = scene.Draw();
  tone->SetDelegatePass(scene.Pass);
  scene.Pass->SetOutputEncodingToSRGB();
  scene.Renderer->SetPass(tone);
  for (const double factor : { 1.0, 4.0 })
  {
    scene.Pass->SetExposure(6.0 * factor);
    std::vector<double> expected;
    for (const double value : plain)
    {
      const double radiance = factor * value;
      const double encoded =
        radiance <= 0.0031308 ? 12.92 * radiance : 1.055 * std::pow(radiance, 1.0 / 2.4) - 0.055;
      expected.push_back(std::pow(1.0 - std::exp(-std::pow(encoded, 2.2)), 1.0 / 2.2));
    }
    CheckClose(scene.GetMean(), Mean(expected), 0.02, "tone mapping at " + std::to_string(factor));
  }
  tone->ReleaseGraphicsResources(scene.Window);
}

/// Opacity below 1, of a neighbour, and of the body itself.
void TestDepthPeeling()
{
  Picture scene;
  scene.Pass->SetDelegatePass(MakePeelingSteps());
  vtkNew<vtkPlaneSource> source;
  source->SetCenter(100.0, 0.0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> neighbour;
  neighbour->SetMapper(mapper);
  neighbour->GetProperty()->SetOpacity(0.5);
  neighbour->GetProperty()->SetColor(0.0, 0.0, 0.0);
  neighbour->GetProperty()->LightingOff();
  scene.Pass->ShadowsOff();
  scene.Renderer->AddActor(neighbour);
  CheckClose(scene.GetMean(), GetPlainMean(), 0.01, "a neighbour of opacity 0.5 beside");
  // Before the whole body.
  source->SetOrigin(-2.0, -2.0, 2.0);
  source->SetPoint1(2.0, -2.0, 2.0);
  source->SetPoint2(-2.0, 2.0, 2.0);
  neighbour->SetPosition(0.4, 0.8, 0.0);
  scene.Renderer->ResetCameraClippingRange();
  CheckClose(scene.GetMean(), 0.5 * GetPlainMean(), 0.02, "a neighbour of opacity 0.5 before");
  scene.Renderer->RemoveActor(neighbour);
  scene.Actor->GetProperty()->SetOpacity(0.5);
  scene.Actor->GetProperty()->BackfaceCullingOn();
  CheckClose(scene.GetMean(), 0.5 * GetPlainMean(), 0.02, "a body of opacity 0.5");
  scene.Renderer->SetPass(nullptr);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
}

/// Its reflection is added to what is scattered, in radiance.
void TestPhysicallyBasedShading()
{
  Picture scene;
  scene.Actor->GetProperty()->SetInterpolationToPBR();
  scene.Actor->GetProperty()->SetColor(0.2, 0.2, 0.2);
  const std::vector<double> together = scene.Draw();
  scene.Renderer->SetPass(nullptr);
  const std::vector<double> encoded = scene.Draw();
  double reflected = 0.0;
  for (const double value : encoded)
  {
    reflected += std::pow(value, 2.2) / static_cast<double>(encoded.size());
  }
  Check(reflected > 0.001, "physically based shading is black");
  CheckClose(Mean(together), GetPlainMean() + 6.0 * reflected, 0.02, "physically based shading");
}

/// Each of two renderers of a window has a pass, and the other one's light is half as bright.
void TestViewports()
{
  Picture scene;
  Picture other;
  other.Window->RemoveRenderer(other.Renderer);
  other.Light->SetIntensity(0.5);
  scene.Window->SetSize(2 * Side, Side);
  scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  other.Renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  scene.Window->AddRenderer(other.Renderer);
  for (int frame = 1; frame < 3; ++frame)
  {
    CheckClose(scene.GetMean(0.0, 0.5), GetPlainMean(), 0.01, "the left one of two viewports");
    CheckClose(scene.GetMean(0.5, 1.0), 0.5 * GetPlainMean(), 0.02,
      "the right one of two viewports");
  }
  Check(scene.Pass->GetNumberOfIrradianceRuns() == 1 &&
      other.Pass->GetNumberOfIrradianceRuns() == 1,
    "two viewports: something is computed again");
  scene.Window->RemoveRenderer(other.Renderer);
}

/// Another transport pass around this one draws its own actors, and only those.
void TestTwoPasses()
{
  Picture scene;
  scene.Pass->ShadowsOff();
  vtkNew<vtkPlaneSource> source;
  source->Update();
  vtkNew<vtkDoubleArray> radiosity;
  radiosity->SetName("Radiosity");
  radiosity->SetNumberOfTuples(source->GetOutput()->GetNumberOfPoints());
  radiosity->Fill(0.5 * vtkMath::Pi());
  source->GetOutput()->GetPointData()->AddArray(radiosity);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(source->GetOutput());
  vtkNew<vtkActor> wall;
  wall->SetMapper(mapper);
  // Behind the body, and larger than the picture.
  wall->SetScale(20.0);
  wall->SetPosition(0.0, 0.0, -3.0);
  scene.Renderer->AddActor(wall);
  scene.Renderer->ResetCameraClippingRange();
  vtkNew<vtkRadiosityPass> outer;
  outer->SetOutputEncodingToLinear();
  outer->SetDelegatePass(scene.Pass);
  scene.Renderer->SetPass(outer);
  const std::vector<double> picture = scene.Draw();
  scene.Renderer->RemoveActor(wall);
  outer->GlobalWarningDisplayOff();
  scene.Renderer->SetPass(scene.Pass);
  const std::vector<double> alone = scene.Draw();
  outer->GlobalWarningDisplayOn();
  double body = 0.0;
  bool isWallSeen = true;
  for (std::size_t pixel = 0; pixel < picture.size(); ++pixel)
  {
    body += alone[pixel] > 0.0 ? picture[pixel] : 0.0;
    isWallSeen = isWallSeen && (alone[pixel] > 0.0 || std::abs(picture[pixel] - 0.5) < 0.01);
  }
  Check(isWallSeen, "the wall of another pass is not seen");
  CheckClose(body / static_cast<double>(picture.size()), GetPlainMean(), 0.01,
    "a body within another pass");
}

/// What is refused says so once, and is drawn as without a material.
void CheckRefusal(Picture& scene, const std::string& message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  scene.Pass->GetTransmittedMap(scene.Actor)->AddObserver(vtkCommand::ErrorEvent, observer);
  scene.Pass->GetScatteredMap(scene.Actor)->AddObserver(vtkCommand::ErrorEvent, observer);
  scene.Pass->AddObserver(vtkCommand::WarningEvent, observer);
  scene.Actor->GetProperty()->SetDiffuse(0.5);
  scene.Material->AddObserver(vtkCommand::ErrorEvent, observer);
  const double mean = scene.GetMean();
  Check(!observer->GetWarning(), message + ": a warning that misleads");
  Check(observer->CheckErrorMessage(message) == 0, "no error says \"" + message + "\"");
  CheckClose(scene.GetMean(), mean, 0.0, message + ": the second frame");
  Check(!observer->GetError() && !observer->GetWarning(), "the same error twice: " + message);
  scene.Renderer->SetPass(nullptr);
  CheckClose(mean, scene.GetMean(), 0.01, message + ": drawn as usual");
  Check(mean > 0.05, message + ": black");
}

void TestRefusals()
{
  {
    Picture scene;
    scene.Ball->GetPointData()->RemoveArray("AtlasCoordinates");
    CheckRefusal(scene, "AtlasCoordinates");
  }
  {
    Picture scene;
    scene.Ball->GetPolys()->Initialize();
    scene.Ball->GetCellData()->Initialize();
    vtkNew<vtkTest::ErrorObserver> observer;
    scene.Pass->GetTransmittedMap(scene.Actor)->AddObserver(vtkCommand::ErrorEvent, observer);
    scene.Window->Render();
    Check(observer->CheckErrorMessage("no triangles") == 0, "a surface without triangles");
  }
  {
    Picture scene;
    scene.Pass->SetIrradianceMapSize(192);
    CheckRefusal(scene, "IrradianceMapSize is 192");
  }
  {
    Picture scene;
    scene.Pass->SetScatteredMapSize(48);
    CheckRefusal(scene, "ScatteredMapSize is 48");
  }
  {
    Picture scene;
    scene.Material->SetLinkMethodToDense();
    scene.Material->SetModelToMonteCarlo();
    CheckRefusal(scene, "Monte");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringComposition(int, char*[])
{
  Check(GetPlainMean() > 0.05, "the plain picture is too dark to compare with");
  std::cout << "mean of the plain picture: " << GetPlainMean() << "\n";
  TestSequences();
  TestImagePass<vtkSSAAPass>("supersampling");
  TestImagePass<vtkOpenGLFXAAPass>("smoothed edges");
  TestToneMapping();
  TestDepthPeeling();
  TestPhysicallyBasedShading();
  TestViewports();
  TestTwoPasses();
  TestRefusals();
  return Result();
}
