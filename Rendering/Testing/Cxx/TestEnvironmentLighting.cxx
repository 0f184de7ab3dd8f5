// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Environments that light translucent surfaces, by each method, against vtkDirectIrradiance; what
 * is computed again when they turn.
 */
#include "LitScene.h"

#include <array>
#include <string>
#include <utility>

namespace
{
using namespace EnvironmentTesting;
using namespace LightTransportTesting;
using namespace ScatteringScene;

/// Harmonics of degree 2 in skies that they hold better and worse.
void TestHarmonics()
{
  LitScene scene;
  for (const auto& sky : { std::make_pair(MakeSky(64, GetSoftSky), 0.01),
         std::make_pair(MakeSky(64, GetSunnySky), 0.06) })
  {
    scene.Lighting->SetEnvironment(sky.first);
    CheckMap(scene.Draw(), GetTransmitted(scene.Ball, nullptr, {}, Index, Size, sky.first),
      sky.second, "harmonics");
  }
}

/// What the ball beside the plate gets of a sky with a sun.
const std::vector<double>& GetSunnyExpectation(const LitScene& scene)
{
  static const std::vector<double> expected =
    GetTransmitted(scene.Ball, scene.Plate, {}, Index, Size, MakeSky(64, GetSunnySky));
  return expected;
}

/// More directions come nearer, with shadows and without. Samples of this ball that lie in its
/// dents are darker than they should be, from all sides: see vtkOpenGLTransmittedMap.
void TestDirections()
{
  LitScene scene;
  const auto sky = MakeSky(64, GetSunnySky);
  scene.Lighting->SetEnvironment(sky);
  scene.Lighting->SetEnvironmentMethodToDirections();
  scene.Pass->SetIrradianceSamples(1);
  scene.Pass->ShadowsOff();
  scene.Lighting->SetNumberOfEnvironmentDirections(64);
  CheckMap(scene.Draw(), GetTransmitted(scene.Ball, nullptr, {}, Index, Size, sky), 0.01,
    "64 directions");
  scene.Pass->SetIrradianceSamples(2);
  scene.Pass->ShadowsOn();
  scene.AddPlate();
  const std::vector<double>& expected = GetSunnyExpectation(scene);
  double before = 1.0;
  for (const int count : { 8, 32 })
  {
    scene.Lighting->SetNumberOfEnvironmentDirections(count);
    const double error =
      CheckMap(scene.Draw(), expected, 1.0, std::to_string(count) + " directions, shadows");
    Check(error < 0.75 * before, "more directions are not better");
    before = error;
  }
  Check(before < 0.07, "32 directions are off");
}

/// The surface's own shadows, and those of what was beside it.
void TestTransfer()
{
  LitScene scene;
  const auto sky = MakeSky(64, GetSoftSky);
  scene.Lighting->SetEnvironment(sky);
  scene.Lighting->SetEnvironmentMethodToTransfer();
  scene.AddTransfer(true);
  CheckMap(scene.Draw(), GetTransmitted(scene.Ball, scene.Plate, {}, Index, Size, sky), 0.015,
    "transfer");
  const auto sunny = MakeSky(64, GetSunnySky);
  scene.Lighting->SetEnvironment(sunny);
  const std::vector<double>& expected = GetSunnyExpectation(scene);
  double before = 1.0;
  for (const int degree : { 2, 5 })
  {
    scene.AddTransfer(true, degree);
    const double error = CheckMap(scene.Draw(), expected, 0.5,
      "transfer of degree " + std::to_string(degree) + " with a sun");
    Check(error < before, "a higher degree is not better");
    before = error;
  }
  Check(before < 0.06, "transfer with a sun");
}

/// Turning sky and ball together changes nothing, more light is more light, and only the first step
/// and the application of the links run again.
void TestProperties()
{
  LitScene scene(16);
  scene.Pass->ShadowsOff();
  scene.Pass->SetShadowMapSize(64);
  scene.Pass->SetIrradianceSamples(1);
  const auto sky = MakeSky(32, GetSoftSky);
  const auto brighter = MakeSky(32,
    [](const Direction& w)
    {
      Direction value = GetSoftSky(w);
      for (double& band : value)
      {
        band *= 4.0;
      }
      return value;
    });
  scene.AddTransfer(false);
  for (const int method : { vtkSurfaceLighting::ENVIRONMENT_METHOD_HARMONICS,
         vtkSurfaceLighting::ENVIRONMENT_METHOD_DIRECTIONS,
         vtkSurfaceLighting::ENVIRONMENT_METHOD_TRANSFER })
  {
    const std::string what = "method " + std::to_string(method);
    scene.Lighting->SetEnvironment(sky);
    scene.Lighting->SetEnvironmentMethod(method);
    scene.Lighting->SetNumberOfEnvironmentDirections(16);
    const std::vector<double> before = scene.Draw();
    std::array<vtkIdType, 3> runs = { scene.Pass->GetNumberOfIrradianceRuns(),
      scene.Pass->GetNumberOfLinkRuns(), scene.Pass->GetNumberOfScatteringRuns() };
    const auto check = [&](vtkIdType more, const char* change)
    {
      runs[0] += more;
      runs[2] += more;
      Check(scene.Pass->GetNumberOfIrradianceRuns() == runs[0] &&
          scene.Pass->GetNumberOfLinkRuns() == runs[1] &&
          scene.Pass->GetNumberOfScatteringRuns() == runs[2],
        what + ", runs: " + change);
    };
    scene.Draw();
    check(0, "nothing");
    scene.Lighting->SetEnvironmentUp(0.0, 0.6, 0.8);
    Check(GetDifference(scene.Draw(), before) > 0.05, what + ": a turn changes nothing");
    check(1, "the sky turns");
    scene.Actor->RotateX(-vtkMath::DegreesFromRadians(std::atan2(0.6, 0.8)));
    const double difference = GetDifference(scene.Draw(), before);
    Check(difference < 1e-5,
      what + ": sky and ball turned together: " + std::to_string(difference));
    check(1, "the ball turns");
    scene.Actor->SetOrientation(0.0, 0.0, 0.0);
    scene.Lighting->SetEnvironmentUp(0.0, 0.0, 1.0);
    scene.Lighting->SetEnvironment(brighter);
    Check(GetDifference(scene.Draw(), before, 4.0) < 1e-5, what + ": light is not linear");
    check(1, "another sky");
    scene.Renderer->GetActiveCamera()->Azimuth(20.0);
    scene.Draw();
    check(0, "the camera moves");
    // Of these directions alone cast shadows.
    scene.Pass->ShadowsOn();
    scene.Draw();
    check(1, "shadows");
    vtkActor* other = scene.AddPlate();
    scene.Draw();
    check(method == vtkSurfaceLighting::ENVIRONMENT_METHOD_DIRECTIONS ? 1 : 0, "another actor");
    scene.Renderer->RemoveActor(other);
    scene.Pass->ShadowsOff();
  }
}

} // namespace

//------------------------------------------------------------------------------
int TestEnvironmentLighting(int, char*[])
{
  TestHarmonics();
  TestDirections();
  TestTransfer();
  TestProperties();
  return Result();
}
