// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shadows in what VTK shades, in scenes that are not plain: wide lines, lights that are nowhere,
 * shaders without a place for shadows, several renderers of one pass, and what cannot be seen.
 */
#include "CompositeMapper.h"
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkSubsurfaceScatteringPass.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;

constexpr int Side = 100;
constexpr double Near = 0.005; ///< of colors: a step of a byte
constexpr double Wide = 2.0;   ///< half the floor
constexpr double Narrow = 0.7; ///< half the sheet over it

vtkSmartPointer<vtkPolyData> MakeSquare(double half, double height)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-half, -half, height);
  plane->SetPoint1(half, -half, height);
  plane->SetPoint2(-half, half, height);
  plane->Update();
  return plane->GetOutput();
}

/// A mapper like that of a VTK that has other names in its shaders.
class OtherNames : public vtkOpenGLPolyDataMapper
{
public:
  static OtherNames* New();
  vtkTypeMacro(OtherNames, vtkOpenGLPolyDataMapper);

protected:
  void ReplaceShaderLight(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
    vtkActor* actor) override
  {
    this->Superclass::ReplaceShaderLight(shaders, renderer, actor);
    std::string source = shaders[vtkShader::Fragment]->GetSource();
    vtkShaderProgram::Substitute(source, "lightColor", "lampColor");
    shaders[vtkShader::Fragment]->SetSource(source);
  }
};
vtkStandardNewMacro(OtherNames);

/// A floor under a distant light, seen from above, with shadows; and who listens.
struct View
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;

  View()
  {
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(0.6, 0.4, 3.0);
    this->Renderer->AddLight(this->Light);
    this->Add(MakeSquare(Wide, 0.0))->GetProperty()->SetColor(0.5, 0.5, 0.5);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(-1.0, -2.0, 8.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
  }

  vtkSmartPointer<vtkActor> Add(vtkDataObject* data, vtkPolyDataMapper* mapper = nullptr)
  {
    vtkSmartPointer<vtkPolyDataMapper> drawing = mapper;
    if (!drawing)
    {
      drawing = data->IsA("vtkPolyData")
        ? vtkSmartPointer<vtkPolyDataMapper>::New()
        : vtkSmartPointer<vtkPolyDataMapper>(vtkNew<CompositeMapper>().GetPointer());
    }
    drawing->SetInputDataObject(data);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(drawing);
    this->Renderer->AddActor(actor);
    return actor;
  }
};

struct Picture : View
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> Window;
  vtkNew<vtkSubsurfaceScatteringPass> Pass;
  vtkNew<vtkTest::ErrorObserver> Observer;
  int Errors = 0;
  int Warnings = 0;

  Picture()
  {
    this->Pass->DirectShadowsOn();
    this->Pass->AddObserver(vtkCommand::ErrorEvent, this->Observer);
    this->Pass->AddObserver(vtkCommand::WarningEvent, this->Observer);
    this->Renderer->SetPass(this->Pass);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Side, Side);
    this->Window->AddRenderer(this->Renderer);
  }
  ~Picture() { this->Renderer->SetPass(nullptr); }
  Picture(const Picture&) = delete;
  void operator=(const Picture&) = delete;

  /// Several frames, each of which may be told something of.
  std::vector<double> Look(int frames = 3)
  {
    std::vector<double> picture;
    for (int frame = 0; frame < frames; ++frame)
    {
      picture = Draw(this->Window);
      this->Errors += this->Observer->GetError() ? 1 : 0;
      this->Warnings += this->Observer->GetWarning() ? 1 : 0;
      this->Observer->Clear();
    }
    return picture;
  }

  void CheckTold(int errors, int warnings, const std::string& what)
  {
    std::cout << what << ": " << this->Errors << " errors, " << this->Warnings << " warnings\n";
    Check(this->Errors == errors, what + ": other errors than one for each change");
    Check(this->Warnings == warnings, what + ": other warnings than one for each change");
    this->Errors = 0;
    this->Warnings = 0;
  }
};

int CountDifferences(const std::vector<double>& a, const std::vector<double>& b)
{
  int count = a.size() == b.size() ? 0 : Side * Side;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
  {
    count += std::abs(a[k] - b[k]) > Near ? 1 : 0;
  }
  return count;
}

/// Lines all around a place, which face the light, and a point at the end of each.
vtkSmartPointer<vtkPolyData> MakeStar(int lines)
{
  auto star = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkCellArray> ends;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  for (int line = 0; line < lines; ++line)
  {
    const double angle = 2.0 * vtkMath::Pi() * (line + 0.3) / lines;
    cells->InsertNextCell(2);
    for (const double radius : { 0.3, 1.8 })
    {
      normals->InsertNextTuple3(0.0, 0.0, 1.0);
      cells->InsertCellPoint(points->InsertNextPoint(radius * std::cos(angle),
        radius * std::sin(angle), 0.6 + 0.2 * radius * std::sin(3.0 * angle)));
    }
    const vtkIdType end = points->GetNumberOfPoints() - 1;
    ends->InsertNextCell(1, &end);
  }
  star->SetPoints(points);
  star->SetLines(cells);
  star->SetVerts(ends);
  star->GetPointData()->SetNormals(normals);
  return star;
}

/// Where nothing is in the way of the light lines look as they do without shadows; what is, makes
/// them dark as a whole.
void TestLines(double width, bool isByHardware, double distance)
{
  const std::string what = "lines " + std::to_string(width) + " wide" +
    (isByHardware ? "" : ", made of triangles") + (distance > 10.0 ? ", far away" : "");
  Picture scene;
  if (!isByHardware)
  {
    scene.Window->SetForceMaximumHardwareLineWidth(1);
  }
  auto star = scene.Add(MakeStar(25));
  star->GetProperty()->SetInterpolationToGouraud();
  star->GetProperty()->SetLineWidth(static_cast<float>(width));
  star->GetProperty()->SetPointSize(static_cast<float>(width + 1.0));
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(-0.2 * distance, -0.4 * distance, distance);
  camera->SetViewAngle(vtkMath::DegreesFromRadians(2.0 * std::atan(2.0 / distance)));
  scene.Renderer->ResetCameraClippingRange();
  const std::vector<double> drawn = scene.Look();
  scene.CheckTold(0, 0, what);
  scene.Pass->DirectShadowsOff();
  const std::vector<double> lit = scene.Look();
  star->VisibilityOff();
  const std::vector<double> without = scene.Look();
  star->VisibilityOn();
  scene.Pass->DirectShadowsOn();
  const int wrong = CountDifferences(drawn, lit);
  std::cout << what << ": " << wrong << " pixels of " << CountDifferences(lit, without)
            << " wrong\n";
  Check(wrong == 0, what + ": shadows on themselves");
  Check(CountDifferences(lit, without) > 100, what + ": there is nothing to see");
  // Behind the camera: the same light is taken away by a sheet as by no light.
  auto sheet = scene.Add(MakeSquare(distance, distance + 1.0));
  const std::vector<double> shadowed = scene.Look();
  scene.Renderer->RemoveActor(sheet);
  scene.Light->SetIntensity(0.0);
  const int bright = CountDifferences(shadowed, scene.Look());
  Check(bright == 0, what + ": there is light in a shadow");
}

/// A light that has no place gives the others no other number.
void TestLightsThatAreNowhere()
{
  Picture scene;
  scene.Add(MakeSquare(Narrow, 1.0));
  const std::vector<double> before = scene.Look();
  vtkNew<vtkLight> bad;
  bad->SetLightTypeToSceneLight();
  bad->SetColor(0.0, -1.0, 0.0);
  scene.Renderer->RemoveAllLights();
  scene.Renderer->AddLight(bad);
  scene.Renderer->AddLight(scene.Light);
  Check(CountDifferences(before, scene.Look()) == 0, "a dark light: other shadows");
  scene.CheckTold(0, 0, "a dark light has shadows as all have");
  bad->SetPosition(0.0, 0.0, 0.0);
  Check(CountDifferences(before, scene.Look()) == 0, "a light without direction: other shadows");
  scene.CheckTold(1, 0, "a light without direction");
  bad->SetPosition(1.0, 0.0, 0.0);
  scene.Look();
  scene.CheckTold(0, 0, "a light that is corrected");
  bad->SetPositional(true);
  bad->SetPosition(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  scene.Look();
  scene.CheckTold(1, 0, "a light at no place");
  // No array is asked for where only shadows are.
  scene.Renderer->RemoveAllLights();
  scene.Renderer->AddLight(bad);
  bad->SetAttenuationValues(0.0, 0.0, 0.0);
  scene.Look();
  scene.CheckTold(0, 0, "the same light, alone");
}

void TestOtherNames()
{
  Picture scene;
  scene.Add(MakeSquare(Narrow, 1.0), vtkNew<OtherNames>());
  scene.Look();
  scene.CheckTold(0, 1, "other names");
  scene.Add(MakeSquare(Narrow, 1.5), vtkNew<OtherNames>());
  scene.Look();
  scene.CheckTold(0, 0, "two with other names");
}

/// Each renderer keeps its own.
void TestRenderers()
{
  Picture scene;
  scene.Add(MakeSquare(Narrow, 1.0));
  View beside;
  View within;
  within.Add(MakeSquare(Narrow, 0.5));
  scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  beside.Renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  beside.Renderer->SetPass(scene.Pass);
  scene.Window->AddRenderer(beside.Renderer);
  vtkNew<vtkOffScreenOpenGLRenderWindow> other;
  other->SetSize(Side, Side);
  other->SetMultiSamples(0);
  other->AddRenderer(within.Renderer);
  within.Renderer->SetPass(scene.Pass);
  const std::vector<double> first[2] = { Draw(scene.Window), Draw(other) };
  for (int frame = 0; frame < 3; ++frame)
  {
    Check(CountDifferences(first[0], Draw(scene.Window)) == 0, "two renderers: another picture");
    Check(CountDifferences(first[1], Draw(other)) == 0, "two windows: another picture");
  }
  std::cout << "three renderers: " << scene.Pass->GetNumberOfShadowRuns() << " trees\n";
  Check(scene.Pass->GetNumberOfShadowRuns() == 3, "trees are made in each frame");
  scene.Pass->DirectShadowsOff();
  Check(CountDifferences(first[1], Draw(other)) > 100, "the other window has no shadows");
  scene.Pass->DirectShadowsOn();
  within.Renderer->SetPass(nullptr);
  scene.Pass->ReleaseGraphicsResources(other);
  beside.Renderer->SetPass(nullptr);
}

/// What cannot be seen casts no shadow: blocks, actors, assemblies and what is in them.
void TestInvisible()
{
  Picture scene;
  const std::vector<double> before = scene.Look();
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, MakeSquare(Narrow, 1.0));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, inner);
  blocks->SetBlock(1, MakeSquare(0.3 * Narrow, 1.5));
  vtkNew<CompositeMapper> mapper;
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  auto actor = scene.Add(blocks, mapper);
  Check(CountDifferences(before, scene.Look()) > 100, "blocks: there is nothing to see");
  attributes->SetBlockVisibility(blocks->GetBlock(1), false);
  mapper->Modified();
  const std::vector<double> one = scene.Look();
  scene.Renderer->RemoveActor(actor);
  auto plain = scene.Add(MakeSquare(Narrow, 1.0));
  Check(CountDifferences(one, scene.Look()) == 0, "an invisible block casts a shadow");
  scene.Renderer->RemoveActor(plain);
  scene.Renderer->AddActor(actor);
  attributes->SetBlockVisibility(inner, false);
  mapper->Modified();
  Check(CountDifferences(before, scene.Look()) == 0, "blocks of an invisible one cast shadows");
  attributes->SetBlockVisibility(inner, true);
  attributes->SetBlockOpacity(inner, 0.0);
  mapper->Modified();
  Check(CountDifferences(before, scene.Look()) == 0, "a block of opacity 0 casts a shadow");
  scene.Renderer->RemoveActor(actor);
  scene.Renderer->AddActor(plain);
  plain->VisibilityOff();
  Check(CountDifferences(before, scene.Look()) == 0, "an invisible actor casts a shadow");
  scene.Renderer->RemoveActor(plain);
  plain->VisibilityOn();
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(plain);
  scene.Renderer->AddActor(assembly);
  Check(CountDifferences(before, scene.Look()) > 100, "an assembly: there is nothing to see");
  assembly->VisibilityOff();
  Check(CountDifferences(before, scene.Look()) == 0, "an invisible assembly casts a shadow");
}
} // namespace

//------------------------------------------------------------------------------
int TestDirectShadowsScenes(int, char*[])
{
  for (const double width : { 1.0, 3.0, 8.0 })
  {
    TestLines(width, true, 5.0);
    TestLines(width, true, 500.0);
    TestLines(width, false, 5.0);
  }
  TestLightsThatAreNowhere();
  TestOtherNames();
  TestRenderers();
  TestInvisible();
  return Result();
}
