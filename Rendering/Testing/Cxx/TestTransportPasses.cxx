// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The render passes for transport results, read back as floating-point radiance: exact values for
 * squares at known angles, energy, encodings, props without the array, several windows, released
 * resources.
 */
#include "LightTransportTesting.h"
#include "vtkRadiosityPass.h"
#include "vtkSubsurfaceScatteringPass.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkFramebufferPass.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkPixelBufferObject.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"
#include "vtkTextureObject.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using LightTransportTesting::Check;
using Color = std::array<double, 3>;
/// Odd, so that a pixel's centre is the centre of the window.
constexpr int WindowSize = 65;
constexpr double Tolerance = 2e-6;

bool IsColor(const Color& found, const Color& expected, const std::string& what)
{
  for (int channel = 0; channel < 3; ++channel)
  {
    if (!(std::abs(found[channel] - expected[channel]) <= Tolerance))
    {
      std::cerr << "ERROR: " << what << ": " << found[0] << " " << found[1] << " " << found[2]
                << " instead of " << expected[0] << " " << expected[1] << " " << expected[2]
                << "\n";
      return false;
    }
  }
  return true;
}

/// A square before a camera, drawn into a floating-point buffer.
struct Scene
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkFramebufferPass> Buffer;
  vtkNew<vtkPolyData> Square;
  vtkNew<vtkActor> Actor;

  Scene()
  {
    vtkNew<vtkPlaneSource> source;
    source->Update();
    this->Square->ShallowCopy(source->GetOutput());
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(this->Square);
    this->Actor->SetMapper(mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(0.25, 0.5, 0.75);
    this->Buffer->SetColorFormat(vtkTextureObject::Float32);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(WindowSize, WindowSize);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 3.0);
    camera->SetParallelScale(1.0);
    camera->SetParallelProjection(true);
  }

  ~Scene() { this->Buffer->ReleaseGraphicsResources(this->Window); }
  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;

  void SetPass(vtkRenderPass* pass)
  {
    this->Buffer->SetDelegatePass(pass);
    this->Renderer->SetPass(pass ? this->Buffer.Get() : nullptr);
  }

  /// The same value at all points.
  void SetArray(const char* name, const std::vector<double>& value, bool asFloat = false)
  {
    vtkSmartPointer<vtkDataArray> array;
    if (asFloat)
    {
      array = vtkSmartPointer<vtkFloatArray>::New();
    }
    else
    {
      array = vtkSmartPointer<vtkDoubleArray>::New();
    }
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(value.size()));
    array->SetNumberOfTuples(this->Square->GetNumberOfPoints());
    for (vtkIdType point = 0; point < array->GetNumberOfTuples(); ++point)
    {
      array->SetTuple(point, value.data());
    }
    this->Square->GetPointData()->AddArray(array);
    this->Square->Modified();
  }

  Color Draw(int x = WindowSize / 2, int y = WindowSize / 2)
  {
    this->Window->Render();
    auto pixels =
      vtkSmartPointer<vtkPixelBufferObject>::Take(this->Buffer->GetColorTexture()->Download());
    std::vector<float> values(4 * WindowSize * WindowSize);
    unsigned int size[2] = { WindowSize, WindowSize };
    vtkIdType increments[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, values.data(), size, 4, increments);
    Check(glGetError() == GL_NO_ERROR, "OpenGL reports an error");
    const float* pixel = &values[static_cast<std::size_t>(4 * (y * WindowSize + x))];
    return { pixel[0], pixel[1], pixel[2] };
  }
};

double Encode(double value)
{
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

bool TestRadiosity()
{
  const double pi = vtkMath::Pi();
  Scene scene;
  vtkNew<vtkRadiosityPass> pass;
  scene.SetPass(pass);
  pass->SetOutputEncodingToLinear();
  scene.SetArray("Radiosity", { 0.3, 1.2, 2.4 });
  bool good = IsColor(scene.Draw(), { 0.3 / pi, 1.2 / pi, 2.4 / pi }, "radiosity") &&
    IsColor(scene.Draw(2, 2), { 0.25, 0.5, 0.75 }, "background");
  pass->SetExposure(3.0);
  good = IsColor(scene.Draw(), { 0.9 / pi, 3.6 / pi, 7.2 / pi }, "exposure") && good;
  pass->SetExposure(1.0);
  pass->SetOutputEncodingToSRGB();
  scene.SetArray("Radiosity", { 0.003, 0.3, 2.4 }, true);
  good =
    IsColor(scene.Draw(), { Encode(0.003 / pi), Encode(0.3 / pi), Encode(2.4 / pi) }, "sRGB") &&
    good;
  pass->SetOutputEncodingToLinear();
  scene.SetArray("Radiosity", { 0.7 });
  good = IsColor(scene.Draw(), { 0.7 / pi, 0.7 / pi, 0.7 / pi }, "one component") && good;
  scene.SetArray("Other", { 0.1, 0.2, 0.3 });
  pass->SetArrayName("Other");
  good = IsColor(scene.Draw(), { 0.1 / pi, 0.2 / pi, 0.3 / pi }, "another array") && good;
  // Neither VTK's lights nor the angle matter.
  scene.Actor->RotateY(60.0);
  scene.Renderer->GetActiveCamera()->SetParallelProjection(false);
  return IsColor(scene.Draw(), { 0.1 / pi, 0.2 / pi, 0.3 / pi }, "rotated") && good;
}

/// Fresnel's formulas with the angles themselves.
double ReflectanceAt(double degrees, double index)
{
  const double outside = vtkMath::RadiansFromDegrees(degrees);
  const double inside = std::asin(std::sin(outside) / index);
  const double s =
    (std::cos(outside) - index * std::cos(inside)) / (std::cos(outside) + index * std::cos(inside));
  const double p =
    (index * std::cos(outside) - std::cos(inside)) / (index * std::cos(outside) + std::cos(inside));
  return 0.5 * (s * s + p * p);
}

/// The hemisphere's cosine-weighted mean is 1, and the mean reflectance has its known values.
bool TestWeight()
{
  bool good = true;
  for (double index : { 1.0, 1.05, 1.3, 1.5, 3.0 })
  {
    constexpr int Steps = 4000;
    double sum = 0.0;
    for (int step = 0; step < Steps; ++step)
    {
      const double cosine = (step + 0.5) / Steps;
      sum += 2.0 * cosine * vtkSubsurfaceScatteringPass::GetOutgoingWeight(cosine, index) / Steps;
    }
    good =
      Check(std::abs(sum - 1.0) < 1e-6, "energy is lost at index " + std::to_string(index)) && good;
  }
  const double straight = vtkSubsurfaceScatteringPass::GetOutgoingWeight(1.0, 1.5);
  good =
    Check(std::abs(straight - 0.96 / (1.0 - 0.091778)) < 1e-6, "the mean at index 1.5") && good;
  const double slanted = vtkSubsurfaceScatteringPass::GetOutgoingWeight(0.5, 1.3);
  return Check(std::abs(slanted - (1.0 - ReflectanceAt(60.0, 1.3)) / (1.0 - 0.061132)) < 1e-6,
           "the weight at 60 degrees") &&
    good;
}

bool TestScattering()
{
  const double pi = vtkMath::Pi();
  Scene scene;
  vtkNew<vtkSubsurfaceScatteringPass> pass;
  scene.SetPass(pass);
  pass->SetOutputEncodingToLinear();
  scene.SetArray("ScatteredIrradiance", { 0.5, 1.0, 1.5 });
  vtkProperty* property = scene.Actor->GetProperty();
  property->SetAmbient(0.0);
  property->SetDiffuse(0.5);
  property->SetSpecular(0.0);
  property->SetColor(0.2, 0.4, 0.6);
  const auto expect = [pi](double degrees, double index, double mean, double direct)
  {
    const double weight = (1.0 - ReflectanceAt(degrees, index)) / (1.0 - mean);
    return Color{ direct * 0.2 + weight * 0.5 / pi, direct * 0.4 + weight * 1.0 / pi,
      direct * 0.6 + weight * 1.5 / pi };
  };
  bool good = IsColor(scene.Draw(), expect(0.0, 1.3, 0.061132, 0.5), "straight");
  scene.Actor->RotateY(60.0);
  good = IsColor(scene.Draw(), expect(60.0, 1.3, 0.061132, 0.25), "at 60 degrees") && good;
  pass->SetRefractiveIndex(1.5);
  good = IsColor(scene.Draw(), expect(60.0, 1.5, 0.091778, 0.25), "index 1.5") && good;
  scene.Renderer->GetActiveCamera()->SetParallelProjection(false);
  good = IsColor(scene.Draw(), expect(60.0, 1.5, 0.091778, 0.25), "perspective") && good;

  // Without lights VTK's shading is the colour itself, and there is no normal but that of the
  // facet.
  property->LightingOff();
  good = IsColor(scene.Draw(), expect(60.0, 1.5, 0.091778, 0.5), "without lights") && good;
  property->SetColor(0.0, 0.0, 0.0);
  pass->SetRefractiveIndex(1.0);
  good = IsColor(scene.Draw(), { 0.5 / pi, 1.0 / pi, 1.5 / pi }, "index 1") && good;
  pass->SetRefractiveIndex(0.5);
  return Check(pass->GetRefractiveIndex() == 1.0, "an index below 1 is taken") && good;
}

/// Ways of drawing a surface that change VTK's shaders.
bool TestRepresentations()
{
  Scene scene;
  vtkNew<vtkSubsurfaceScatteringPass> pass;
  pass->SetOutputEncodingToLinear();
  scene.SetArray("ScatteredIrradiance", { 0.5, 1.0, 1.5 });
  vtkProperty* property = scene.Actor->GetProperty();
  property->SetColor(0.0, 0.0, 0.0);
  scene.SetPass(pass);
  const double straight = vtkSubsurfaceScatteringPass::GetOutgoingWeight(1.0, 1.3) / vtkMath::Pi();
  const Color scattered = { 0.5 * straight, straight, 1.5 * straight };
  property->EdgeVisibilityOn();
  bool good = IsColor(scene.Draw(), scattered, "with edges");
  property->EdgeVisibilityOff();
  property->SetInterpolationToFlat();
  scene.Square->GetPointData()->SetNormals(nullptr);
  good = IsColor(scene.Draw(), scattered, "flat, without normals") && good;

  // Physically based shading writes colours to the power of 1 / 2.2; they are decoded before they
  // are added.
  property->SetInterpolationToPBR();
  property->SetColor(0.2, 0.4, 0.6);
  vtkNew<vtkRenderStepsPass> plain;
  scene.SetPass(plain);
  Color shaded = scene.Draw();
  for (int channel = 0; channel < 3; ++channel)
  {
    shaded[channel] = std::pow(shaded[channel], 2.2) + scattered[channel];
  }
  scene.SetPass(pass);
  good = Check(shaded[0] > scattered[0] + 0.01, "physically based shading is black") && good;
  return IsColor(scene.Draw(), shaded, "physically based shading") && good;
}

/// Props without the array are drawn as if there were no pass, and somebody is told when no prop
/// has it.
bool TestWithoutArray()
{
  Scene scene;
  vtkNew<vtkRadiosityPass> pass;
  vtkNew<vtkTest::ErrorObserver> observer;
  pass->AddObserver(vtkCommand::WarningEvent, observer);
  scene.Actor->GetProperty()->SetColor(0.2, 0.4, 0.6);
  scene.SetPass(pass);
  bool good = IsColor(scene.Draw(), { 0.2, 0.4, 0.6 }, "no array") &&
    observer->CheckWarningMessage("Radiosity") == 0;
  scene.Draw();
  good = Check(!observer->GetWarning(), "the same warning twice") && good;
  scene.SetArray("Radiosity", { 0.1, 0.2 });
  good = IsColor(scene.Draw(), { 0.2, 0.4, 0.6 }, "two components") && good;
  scene.SetArray("Radiosity", { 1.0 });
  pass->SetOutputEncodingToLinear();
  const double expected = 1.0 / vtkMath::Pi();
  good = IsColor(scene.Draw(), { expected, expected, expected }, "the array appears") && good;
  scene.Square->GetPointData()->RemoveArray("Radiosity");
  scene.Square->Modified();
  return IsColor(scene.Draw(), { 0.2, 0.4, 0.6 }, "the array disappears") &&
    observer->CheckWarningMessage("Radiosity") == 0 && good;
}

/// A pass moves from window to window, gives its resources back, and leaves mappers as it found
/// them.
bool TestWindows()
{
  const double expected = 0.6 / vtkMath::Pi();
  const Color color = { expected, expected, expected };
  vtkNew<vtkRadiosityPass> pass;
  pass->SetOutputEncodingToLinear();
  bool good = true;
  Scene second;
  second.SetArray("Radiosity", { 0.6 });
  {
    Scene first;
    first.SetArray("Radiosity", { 0.6 });
    first.SetPass(pass);
    good = IsColor(first.Draw(), color, "first window");
    pass->ReleaseGraphicsResources(first.Window);
    good = IsColor(first.Draw(), color, "after a release") && good;
    first.SetPass(nullptr);
    pass->ReleaseGraphicsResources(first.Window);
    first.Window->Render();
  }
  second.SetPass(pass);
  good = IsColor(second.Draw(), color, "second window") && good;
  second.Window->Finalize();
  good = IsColor(second.Draw(), color, "second window, made again") && good;
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestTransportPasses(int, char*[])
{
  bool good = TestRadiosity();
  good = TestWeight() && good;
  good = TestScattering() && good;
  good = TestRepresentations() && good;
  good = TestWithoutArray() && good;
  good = TestWindows() && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
