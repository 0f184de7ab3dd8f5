// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shadows in what VTK shades, pixel by pixel: a small triangle where each pixel looks is lit or
 * dark as vtkDirectIrradiance has it. Only next to an edge of a shadow may a pixel be otherwise.
 */
#include "LightTransportTesting.h"
#include "PictureTesting.h"
#include "ScatteringScene.h"

#include "vtkActorCollection.h"
#include "vtkAppendPolyData.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkPlaneSource.h"
#include "vtkPolygon.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkStaticCellLocator.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using namespace PictureTesting;
using namespace ScatteringScene;

constexpr int Side = 80;
constexpr double Near = 0.005; ///< of colours: a step of a byte
constexpr double Lift = 1e-4;  ///< off the surface, where light is looked for

vtkSmartPointer<vtkPolyData> MakeSheet(const double origin[3], const double first[3],
  const double second[3])
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(first[0], first[1], first[2]);
  plane->SetPoint2(second[0], second[1], second[2]);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

/// A translucent ball over a floor, and a sheet that is open all around, between it and the light.
struct Picture : Scene
{
  std::vector<vtkSmartPointer<vtkActor>> Others;
  double Shift[3];

  explicit Picture(const double shift[3] = nullptr) : Scene(16)
  {
    this->Actor->GetProperty()->SetSpecular(0.0);
    this->Actor->GetProperty()->SetDiffuse(1.0);
    this->Material->SetLinkMethodToUniform();
    this->Material->SetNumberOfLinks(4);
    this->Pass->SetScatteredMapSize(16);
    this->Pass->SetExposure(0.5);
    this->Pass->ShadowsOff();
    this->Pass->DirectShadowsOn();
    const double floor[3][3] = { { -4.0, -4.0, -1.0 }, { 4.0, -4.0, -1.0 }, { -4.0, 4.0, -1.0 } };
    const double sheet[3][3] = { { 0.3, 0.3, 1.6 }, { 1.6, 0.5, 1.9 }, { 0.5, 1.4, 2.2 } };
    for (const auto& corners : { floor, sheet })
    {
      this->Add(MakeSheet(corners[0], corners[1], corners[2]));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Shift[axis] = shift ? shift[axis] : 0.0;
    }
    this->Actor->SetPosition(this->Shift);
    for (const auto& other : this->Others)
    {
      other->SetPosition(this->Shift);
    }
    this->Place(this->Light, { 2.0, 3.0, 5.0 }, { 0.0, 0.0, 0.0 });
    this->Look({ 3.0, -5.0, 4.0 });
    this->Window->SetSize(Side, Side);
  }

  ~Picture() { this->Renderer->SetPass(nullptr); }

  void Add(vtkPolyData* surface)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    // The same shading as the ball, so that its pictures tell the same.
    actor->GetProperty()->SetSpecular(0.0);
    actor->GetProperty()->SetAmbient(0.0);
    this->Others.push_back(actor);
    this->Renderer->AddActor(actor);
  }

  void Place(vtkLight* light, std::array<double, 3> position, std::array<double, 3> focus)
  {
    vtkMath::Add(position.data(), this->Shift, position.data());
    vtkMath::Add(focus.data(), this->Shift, focus.data());
    light->SetPosition(position.data());
    light->SetFocalPoint(focus.data());
  }

  void Look(std::array<double, 3> from)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    vtkMath::Add(from.data(), this->Shift, from.data());
    camera->SetFocalPoint(this->Shift);
    camera->SetPosition(from.data());
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCameraClippingRange();
  }
};

/// The triangles of all actors, where they are.
vtkSmartPointer<vtkPolyData> Gather(Picture& scene)
{
  vtkNew<vtkAppendPolyData> all;
  all->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkActorCollection* actors = scene.Renderer->GetActors();
  vtkCollectionSimpleIterator place;
  actors->InitTraversal(place);
  while (vtkActor* actor = actors->GetNextActor(place))
  {
    vtkNew<vtkTransform> transform;
    transform->SetMatrix(actor->GetMatrix());
    vtkNew<vtkTransformPolyDataFilter> moved;
    moved->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    moved->SetTransform(transform);
    moved->SetInputData(vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput());
    moved->Update();
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(moved->GetOutput()->GetPoints());
    shape->SetPolys(moved->GetOutput()->GetPolys());
    all->AddInputData(shape);
  }
  all->Update();
  return all->GetOutput();
}

/// Where the middles of pixels look, and which way what they see faces; no points for others.
struct Views
{
  vtkNew<vtkPolyData> Triangles; ///< a small one for each pixel that sees something
  std::vector<vtkIdType> Pixels; ///< of each
};

void Look(Picture& scene, vtkPolyData* surfaces, Views& views)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surfaces);
  locator->BuildLocator();
  vtkNew<vtkMatrix4x4> back;
  back->DeepCopy(
    scene.Renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0));
  back->Invert();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType pixel = 0; pixel < static_cast<vtkIdType>(Side) * Side; ++pixel)
  {
    double ends[2][4];
    for (int end = 0; end < 2; ++end)
    {
      const double screen[4] = { (2.0 * (pixel % Side) + 1.0) / Side - 1.0,
        (2.0 * (pixel / Side) + 1.0) / Side - 1.0, 2.0 * end - 1.0, 1.0 };
      back->MultiplyPoint(screen, ends[end]);
      for (int axis = 0; axis < 3; ++axis)
      {
        ends[end][axis] /= ends[end][3];
      }
    }
    double t = 0.0;
    double hit[3];
    double unused[3];
    int subId = 0;
    vtkIdType cell = -1;
    if (!locator->IntersectWithLine(ends[0], ends[1], Lift, t, hit, unused, subId, cell))
    {
      continue;
    }
    double normal[3];
    vtkPolygon::ComputeNormal(surfaces->GetCell(cell)->GetPoints(), normal);
    double ray[3];
    vtkMath::Subtract(ends[1], ends[0], ray);
    vtkMath::MultiplyScalar(normal, vtkMath::Dot(ray, normal) < 0.0 ? 1.0 : -1.0);
    double aside[2][3];
    vtkMath::Perpendiculars(normal, aside[0], aside[1], 0.0);
    triangles->InsertNextCell(3);
    for (int corner = 0; corner < 3; ++corner)
    {
      const double angle = vtkMath::RadiansFromDegrees(120.0 * corner);
      for (int axis = 0; axis < 3; ++axis)
      {
        unused[axis] = hit[axis] + Lift * normal[axis] +
          0.1 * Lift * (std::cos(angle) * aside[0][axis] + std::sin(angle) * aside[1][axis]);
      }
      triangles->InsertCellPoint(points->InsertNextPoint(unused));
    }
    views.Pixels.push_back(pixel);
  }
  views.Triangles->SetPoints(points);
  views.Triangles->SetPolys(triangles);
}

enum class Seen
{
  Nothing,
  Lit,
  Dark,
  Edge
};

/// What vtkDirectIrradiance has.
std::vector<Seen> GetExpected(Picture& scene)
{
  vtkSmartPointer<vtkPolyData> surfaces = Gather(scene);
  Views views;
  Look(scene, surfaces, views);
  std::vector<double> light[2];
  for (const bool hasShadows : { false, true })
  {
    vtkNew<vtkDirectIrradiance> filter;
    filter->SetInputDataObject(Join(views.Triangles, surfaces));
    filter->SetShadows(hasShadows);
    filter->AddLight(scene.Light);
    filter->Update();
    auto* lit = vtkPolyData::SafeDownCast(
      vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetBlock(0));
    vtkDataArray* values = lit->GetCellData()->GetArray("DirectIrradiance");
    for (vtkIdType cell = 0; cell < lit->GetNumberOfCells(); ++cell)
    {
      light[hasShadows ? 1 : 0].push_back(values->GetComponent(cell, 0));
    }
  }
  std::vector<Seen> expected(static_cast<std::size_t>(Side) * Side, Seen::Nothing);
  for (std::size_t k = 0; k < views.Pixels.size(); ++k)
  {
    const double part = light[1][k] / std::max(light[0][k], 1e-9);
    expected[static_cast<std::size_t>(views.Pixels[k])] =
      part > 0.999 ? Seen::Lit : (part < 0.001 ? Seen::Dark : Seen::Edge);
  }
  return expected;
}

/// Whether all pixels up to some away are alike.
bool IsInside(const std::vector<Seen>& expected, int pixel, int band)
{
  const auto get = [&expected](int place) { return expected[static_cast<std::size_t>(place)]; };
  for (int j = -band; j <= band; ++j)
  {
    for (int i = -band; i <= band; ++i)
    {
      const int column = pixel % Side + i;
      const int line = pixel / Side + j;
      if (column < 0 || column >= Side || line < 0 || line >= Side ||
        get(line * Side + column) != get(pixel))
      {
        return false;
      }
    }
  }
  return true;
}

void SetDiffuse(Picture& scene, double diffuse)
{
  scene.Actor->GetProperty()->SetDiffuse(diffuse);
  for (const auto& other : scene.Others)
  {
    other->GetProperty()->SetDiffuse(diffuse);
  }
}

/// Pixels that are neither what they are without shadows, where the light comes, nor without what
/// VTK shades, where it does not.
void CheckPicture(Picture& scene, const std::string& what, int band = 1)
{
  const std::vector<double> drawn = Draw(scene.Window);
  SetDiffuse(scene, 0.0);
  const std::vector<double> dark = Draw(scene.Window);
  SetDiffuse(scene, 1.0);
  scene.Pass->DirectShadowsOff();
  const std::vector<double> lit = Draw(scene.Window);
  scene.Pass->DirectShadowsOn();
  const std::vector<Seen> expected = GetExpected(scene);
  int counts[2] = { 0, 0 };
  int wrong = 0;
  int edges = 0;
  for (int pixel = 0; pixel < Side * Side; ++pixel)
  {
    const auto k = static_cast<std::size_t>(pixel);
    if (lit[k] - dark[k] < 4.0 * Near || expected[k] == Seen::Nothing)
    {
      continue;
    }
    if (expected[k] == Seen::Edge || !IsInside(expected, pixel, band))
    {
      ++edges;
      continue;
    }
    const bool isLit = expected[k] == Seen::Lit;
    ++counts[isLit ? 1 : 0];
    wrong += std::abs(drawn[k] - (isLit ? lit[k] : dark[k])) > Near ? 1 : 0;
  }
  std::cout << what << ": " << counts[1] << " lit, " << counts[0] << " dark, " << edges
            << " next to edges, " << wrong << " wrong\n";
  Check(wrong == 0, what + ": pixels are wrong");
  Check(counts[0] > 100 && counts[1] > 100, what + ": there is too little to see");
}

void TestLights()
{
  Picture scene;
  CheckPicture(scene, "a distant light");
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(180.0);
  scene.Place(scene.Light, { 1.5, 1.0, 3.5 }, { 0.0, 0.0, 0.0 });
  CheckPicture(scene, "a near light");
  scene.Light->SetConeAngle(50.0);
  CheckPicture(scene, "a cone of light");
  // Another one before it in the list gives no red.
  scene.Renderer->RemoveAllLights();
  vtkNew<vtkLight> green;
  green->SetLightTypeToSceneLight();
  green->SetColor(0.0, 1.0, 0.0);
  scene.Place(green, { -5.0, 1.0, 3.0 }, { 0.0, 0.0, 0.0 });
  scene.Renderer->AddLight(green);
  scene.Renderer->AddLight(scene.Light);
  CheckPicture(scene, "the second of two lights");
}

void TestCameras()
{
  Picture scene;
  // In the shadow of the sheet, and in that of the ball.
  scene.Look({ -0.6, -0.6, 0.9 });
  scene.Renderer->GetActiveCamera()->SetFocalPoint(-2.0, -3.0, -1.0);
  scene.Renderer->GetActiveCamera()->SetViewAngle(90.0);
  scene.Renderer->ResetCameraClippingRange();
  CheckPicture(scene, "a camera in a shadow");
  scene.Look({ 3.0, -5.0, 4.0 });
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(3.0);
  CheckPicture(scene, "parallel projection");
  Check(scene.Pass->GetNumberOfShadowRuns() == 1, "the tree is made again where nothing moves");
  const std::vector<double> before = Draw(scene.Window);
  scene.Others[1]->AddPosition(0.5, 0.0, 0.0);
  CheckPicture(scene, "a sheet that has moved");
  Check(scene.Pass->GetNumberOfShadowRuns() == 2, "the tree is not made again, or too often");
  Check(GetLargestDifference(before, Draw(scene.Window)) > 0.1, "shadows do not move");
  // Whatever the eye sees, a light there does, too.
  scene.Light->SetLightTypeToHeadlight();
  const std::vector<double> drawn = Draw(scene.Window);
  scene.Pass->DirectShadowsOff();
  Check(GetLargestDifference(drawn, Draw(scene.Window)) <= Near, "a headlight casts shadows");
}

void TestOffset()
{
  const double shift[3] = { 6e5, 6e6, 0.0 };
  Picture scene(shift);
  CheckPicture(scene, "on a map");
}

template <typename OuterPass>
void TestImagePass(const std::string& what, int band)
{
  Picture scene;
  vtkNew<OuterPass> outer;
  Wrap(outer, scene.Pass);
  scene.Renderer->SetPass(outer);
  CheckPicture(scene, what, band);
  scene.Renderer->SetPass(nullptr);
  outer->ReleaseGraphicsResources(scene.Window);
}

void TestDepthPeeling()
{
  Picture scene;
  const auto steps = MakePeelingSteps();
  scene.Pass->SetDelegatePass(steps);
  scene.Actor->ForceTranslucentOn();
  for (const auto& other : scene.Others)
  {
    other->ForceTranslucentOn();
  }
  CheckPicture(scene, "depth peeling");
  Check(steps->GetTranslucentPass()->GetNumberOfRenderedProps() == 3, "nothing is peeled");
}

/// Triangles that are nowhere cast no shadows, and spoil none.
void TestUnusablePoints()
{
  Picture scene;
  const std::vector<double> before = Draw(scene.Window);
  for (const double place : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), 1e300, 1e25 })
  {
    const double corners[3][3] = { { 0.0, 0.0, 3.0 }, { 1.0, 0.0, 3.0 }, { 0.0, 1.0, 3.0 } };
    auto sheet = MakeSheet(corners[0], corners[1], corners[2]);
    for (vtkIdType point = 0; point < sheet->GetNumberOfPoints(); ++point)
    {
      sheet->GetPoints()->SetPoint(point, place, 0.0, 0.0);
    }
    scene.Add(sheet);
    Check(GetLargestDifference(before, Draw(scene.Window)) <= Near,
      "another picture with points at " + std::to_string(place));
  }
}

/// Resources that are let go are made again; without materials there are shadows, too.
void TestRelease()
{
  Picture scene;
  const std::vector<double> before = Draw(scene.Window);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  Check(GetLargestDifference(before, Draw(scene.Window)) == 0.0, "released: another picture");
  Check(scene.Pass->GetNumberOfShadowRuns() == 2, "released: no tree is made");
  scene.Pass->SetMaterial(scene.Actor, nullptr);
  CheckPicture(scene, "without materials");
}
} // namespace

//------------------------------------------------------------------------------
int TestDirectShadows(int, char*[])
{
  TestLights();
  TestCameras();
  TestOffset();
  // Bodies are larger by a part of a pixel.
  TestImagePass<vtkSSAAPass>("supersampling", 2);
  TestImagePass<vtkOpenGLFXAAPass>("smoothed edges", 2);
  TestDepthPeeling();
  TestUnusablePoints();
  TestRelease();
  return Result();
}
