// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Scenes of vtkSubsurfaceScatteringPass: blocks of composite data, several passes and windows, a
 * sheet with two sides.
 */
#include "CompositeMapper.h"
#include "LightTransportTesting.h"
#include "ScatteringScene.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkMultiBlockDataSet.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;
using namespace ScatteringScene;

constexpr double Apart = 3.0;

using Pixels = std::vector<double>;

Pixels Draw(vtkRenderWindow* window)
{
  window->Render();
  const int* size = window->GetSize();
  vtkNew<vtkFloatArray> pixels;
  window->GetRGBAPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

double GetMean(const Pixels& pixels)
{
  double sum = 0.0;
  for (std::size_t value = 0; value < pixels.size(); value += 4)
  {
    sum += 4.0 * pixels[value] / static_cast<double>(pixels.size());
  }
  return sum;
}

double GetLargestDifference(const Pixels& a, const Pixels& b)
{
  double largest = a.size() == b.size() ? 0.0 : 1.0;
  for (std::size_t value = 0; value < std::min(a.size(), b.size()); ++value)
  {
    largest = std::max(largest, std::abs(a[value] - b[value]));
  }
  return largest;
}

void LookAt(vtkRenderer* renderer, const double center[3], double scale)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(center[0], center[1], center[2]);
  camera->SetPosition(center[0] + 1.0, center[1] + 2.0, center[2] + 5.0);
  camera->SetParallelScale(scale);
  renderer->ResetCameraClippingRange();
}

/// Two bodies beside each other, by two actors, or by one with blocks.
struct TwoBalls : Scene
{
  vtkSmartPointer<vtkPolyData> OtherBall;
  vtkNew<vtkActor> Other;
  vtkNew<vtkMultiBlockDataSet> Blocks;
  vtkNew<CompositeMapper> Mapper;

  TwoBalls()
  {
    const double other[3] = { Apart, 0.0, 0.0 };
    this->OtherBall = MakeBall(6, other, 3);
    this->Actor->GetProperty()->SetSpecular(0.0);
    this->Pass->SetExposure(6.0);
    const double middle[3] = { 0.5 * Apart, 0.0, 0.0 };
    LookAt(this->Renderer, middle, 2.6);
    this->Light->SetPosition(-3.0, 1.0, 1.0);
  }

  void UseActors()
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(this->OtherBall);
    mapper->ScalarVisibilityOff();
    this->Other->SetMapper(mapper);
    this->Other->SetProperty(this->Actor->GetProperty());
    this->Renderer->AddActor(this->Other);
    this->Pass->SetMaterial(this->Other, this->Material);
  }

  /// The second block is that of an inner one, beside one without polygons.
  void UseBlocks()
  {
    vtkNew<vtkMultiBlockDataSet> inner;
    inner->SetBlock(0, vtkNew<vtkPolyData>());
    inner->SetBlock(1, this->OtherBall);
    this->Blocks->SetBlock(0, this->Ball);
    this->Blocks->SetBlock(2, inner);
    this->Mapper->SetInputDataObject(this->Blocks);
    this->Mapper->SetCompositeDataDisplayAttributes(vtkNew<vtkCompositeDataDisplayAttributes>());
    this->Mapper->ScalarVisibilityOff();
    this->Actor->SetMapper(this->Mapper);
  }
};

/// Each block is a body: the same picture as by actors, computed as often, shadows included.
void TestBlocks()
{
  TwoBalls actors;
  actors.UseActors();
  const Pixels expected = Draw(actors.Window);
  TwoBalls blocks;
  blocks.UseBlocks();
  const Pixels found = Draw(blocks.Window);
  const double mean = GetMean(expected);
  std::cout << "two bodies: mean " << mean << ", blocks differ by "
            << GetLargestDifference(expected, found) << "\n";
  Check(mean > 0.02, "two bodies are too dark to compare");
  Check(GetLargestDifference(expected, found) < 1e-6, "blocks look unlike actors");
  Check(blocks.Pass->GetNumberOfLinkRuns() == 2 && blocks.Pass->GetNumberOfIrradianceRuns() == 2,
    "two blocks are not two bodies");
  Check(blocks.Pass->GetScatteredMap(blocks.Actor, 1) &&
      !blocks.Pass->GetScatteredMap(blocks.Actor, 2),
    "maps of blocks");

  // Such a mapper takes a single surface, too.
  Scene single;
  Scene plain;
  vtkNew<CompositeMapper> mapper;
  mapper->SetInputDataObject(single.Ball);
  mapper->ScalarVisibilityOff();
  single.Actor->SetMapper(mapper);
  Check(GetLargestDifference(Draw(plain.Window), Draw(single.Window)) < 1e-6 &&
      single.Pass->GetNumberOfLinkRuns() == 1,
    "a single surface in a mapper of composite data");

  // A camera that moves costs nothing, an actor that moves no links.
  blocks.Renderer->GetActiveCamera()->Azimuth(20.0);
  Draw(blocks.Window);
  Check(blocks.Pass->GetNumberOfIrradianceRuns() == 2, "a camera moved: computed again");
  blocks.Actor->RotateY(30.0);
  actors.Actor->RotateY(30.0);
  actors.Other->RotateY(30.0);
  actors.Renderer->GetActiveCamera()->Azimuth(20.0);
  Check(GetLargestDifference(Draw(actors.Window), Draw(blocks.Window)) < 1e-5,
    "blocks that turn look unlike actors");
  Check(blocks.Pass->GetNumberOfLinkRuns() == 2, "blocks turned: new links");
}

/// A hidden block is not drawn, one may be translucent, one may go; without a material all is as
/// VTK has it.
void TestAttributes()
{
  TwoBalls scene;
  scene.UseBlocks();
  scene.Pass->ShadowsOff();
  const double both = GetMean(Draw(scene.Window));
  vtkCompositeDataDisplayAttributes* attributes = scene.Mapper->GetCompositeDataDisplayAttributes();
  vtkDataObject* inner = scene.Blocks->GetBlock(2);
  attributes->SetBlockVisibility(inner, false);
  const double first = GetMean(Draw(scene.Window));
  attributes->RemoveBlockVisibilities();
  attributes->SetBlockVisibility(scene.Ball, false);
  const double second = GetMean(Draw(scene.Window));
  CheckClose(first + second, both, 0.01, "blocks one by one");
  attributes->RemoveBlockVisibilities();
  scene.Actor->GetProperty()->BackfaceCullingOn();
  attributes->SetBlockOpacity(inner, 0.5);
  CheckClose(GetMean(Draw(scene.Window)), first + 0.5 * second, 0.02, "a block of opacity 0.5");
  attributes->RemoveBlockOpacities();
  Check(scene.Pass->GetNumberOfLinkRuns() == 2, "attributes: new links");

  scene.Blocks->SetBlock(2, nullptr);
  scene.Blocks->Modified();
  CheckClose(GetMean(Draw(scene.Window)), first, 0.01, "a block less");
  Check(!scene.Pass->GetScatteredMap(scene.Actor, 1), "a body without a block");
  scene.Blocks->SetBlock(0, nullptr);
  scene.Blocks->Modified();
  Check(GetMean(Draw(scene.Window)) == 0.0, "no block, and something is drawn");
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  scene.UseBlocks();
  CheckClose(GetMean(Draw(scene.Window)), both, 0.01, "blocks after none, and new resources");
}

/// One pass within another, each with a body of its own.
void TestNestedPasses()
{
  TwoBalls expected;
  expected.UseActors();
  const Pixels picture = Draw(expected.Window);
  TwoBalls scene;
  scene.UseActors();
  scene.Pass->SetMaterial(scene.Other, nullptr);
  vtkNew<vtkSubsurfaceScatteringPass> outer;
  outer->SetIrradianceMapSize(128);
  outer->SetScatteredMapSize(32);
  outer->SetExposure(6.0);
  outer->SetOutputEncodingToLinear();
  outer->SetMaterial(scene.Other, scene.Material);
  outer->SetDelegatePass(scene.Pass);
  scene.Renderer->SetPass(outer);
  Check(GetLargestDifference(picture, Draw(scene.Window)) < 1e-6, "two passes look unlike one");
  Check(outer->GetNumberOfLinkRuns() == 1 && scene.Pass->GetNumberOfLinkRuns() == 1,
    "two passes: each has a body");
  scene.Renderer->SetPass(nullptr);
  outer->ReleaseGraphicsResources(scene.Window);
}

/// One actor in two windows with a pass each, drawn in turn; and then one pass for both of them.
void TestWindows()
{
  Scene scene;
  scene.Actor->GetProperty()->SetSpecular(0.0);
  const double origin[3] = { 0.0, 0.0, 0.0 };
  LookAt(scene.Renderer, origin, 1.2);
  const Pixels expected = Draw(scene.Window);
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(scene.Ball);
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  actor->SetProperty(scene.Actor->GetProperty());
  window->SetMultiSamples(0);
  window->SetSize(64, 64);
  window->AddRenderer(renderer);
  renderer->AddActor(actor);
  renderer->AddLight(scene.Light);
  LookAt(renderer, origin, 1.2);
  vtkNew<vtkSubsurfaceScatteringPass> pass;
  pass->SetIrradianceMapSize(128);
  pass->SetScatteredMapSize(32);
  pass->SetOutputEncodingToLinear();
  pass->SetMaterial(actor, scene.Material);
  renderer->SetPass(pass);
  for (int frame = 0; frame < 2; ++frame)
  {
    Check(GetLargestDifference(expected, Draw(window)) < 1e-6, "a second window");
    Check(GetLargestDifference(expected, Draw(scene.Window)) < 1e-6, "the first of two windows");
  }
  Check(pass->GetNumberOfScatteringRuns() == 1 && scene.Pass->GetNumberOfScatteringRuns() == 1,
    "windows in turn: computed again");

  // What is on one device cannot serve the other: it is made anew, and is right.
  scene.Pass->SetMaterial(actor, scene.Material);
  renderer->SetPass(scene.Pass);
  pass->ReleaseGraphicsResources(window);
  for (int frame = 0; frame < 2; ++frame)
  {
    Check(GetLargestDifference(expected, Draw(window)) < 1e-6, "one pass, second window");
    Check(GetLargestDifference(expected, Draw(scene.Window)) < 1e-6, "one pass, first window");
  }
  renderer->SetPass(nullptr);
}

/// A square of side x side smaller ones, each halved, and again from behind: charts 0 and 1.
vtkSmartPointer<vtkPolyData> MakeSheet(int side)
{
  auto sheet = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> coordinates;
  vtkNew<vtkIntArray> charts;
  coordinates->SetName("AtlasCoordinates");
  coordinates->SetNumberOfComponents(2);
  charts->SetName("ChartId");
  for (int face = 0; face < 2; ++face)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i)
      {
        const double u = static_cast<double>(i) / side;
        const double v = static_cast<double>(j) / side;
        // Seen from behind, left is right.
        points->InsertNextPoint(face == 0 ? 2.0 * u - 1.0 : 1.0 - 2.0 * u, 2.0 * v - 1.0, 0.0);
        coordinates->InsertNextTuple2((face + u) / 2.0, v / 2.0);
      }
    }
    AddSquares(side, first, face, triangles, charts);
  }
  sheet->SetPoints(points);
  sheet->SetPolys(triangles);
  sheet->GetPointData()->AddArray(coordinates);
  sheet->GetCellData()->AddArray(charts);
  return sheet;
}

/// Two sides in one place do not shade each other: all that falls on one enters, nothing at the
/// other, and what leaves is seen from both.
void TestTwoSidedSheet()
{
  Scene scene;
  vtkPolyDataMapper::SafeDownCast(scene.Actor->GetMapper())->SetInputData(MakeSheet(16));
  scene.Actor->GetProperty()->SetSpecular(0.0);
  scene.Light->SetPosition(0.0, 0.0, 5.0);
  scene.Pass->SetExposure(6.0);
  const double origin[3] = { 0.0, 0.0, 0.0 };
  LookAt(scene.Renderer, origin, 1.2);
  const double front = GetMean(Draw(scene.Window));
  const std::vector<double> entering =
    Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture());
  const double index = scene.Material->GetRefractiveIndex();
  const double transmitted = 1.0 - std::pow((index - 1.0) / (index + 1.0), 2.0);
  const int size = scene.Pass->GetIrradianceMapSize();
  double worst[2] = {};
  for (int line = 0; line < size / 2; ++line)
  {
    for (int column = 0; column < size; ++column)
    {
      const double* texel = &entering[std::size_t(4) * (line * size + column)];
      const int face = column < size / 2 ? 0 : 1;
      const double value = texel[3] > 0.0 ? texel[0] / texel[3] : 0.0;
      worst[face] = std::max(worst[face], std::abs(value - (face == 0 ? transmitted : 0.0)));
    }
  }
  std::cout << "a sheet: entering is off by " << worst[0] << ", behind by " << worst[1] << "\n";
  Check(worst[0] < 1e-3 * transmitted && worst[1] < 1e-6, "the sides of a sheet shade each other");
  scene.Renderer->GetActiveCamera()->SetPosition(-1.0, 2.0, -5.0);
  scene.Renderer->ResetCameraClippingRange();
  const double behind = GetMean(Draw(scene.Window));
  std::cout << "a sheet: " << front << " from the front, " << behind << " from behind\n";
  // In one place both sides get the same.
  Check(front > 0.05, "a sheet is dark");
  CheckClose(behind, front, 0.02, "a sheet from behind");
}
/// What enters, in texels of the map of what leaves, and what leaves; over the area.
struct Maps
{
  std::vector<double> Entering;
  std::vector<double> Leaving;

  explicit Maps(Scene& scene)
  {
    int level = 0;
    while ((scene.Pass->GetIrradianceMapSize() >> level) > scene.Pass->GetScatteredMapSize())
    {
      ++level;
    }
    this->Entering = Divide(Read(scene.Pass->GetTransmittedMap(scene.Actor)->GetTexture(), level));
    this->Leaving = Divide(Read(scene.Pass->GetScatteredMap(scene.Actor)->GetTexture()));
  }

  static std::vector<double> Divide(const std::vector<double>& texels)
  {
    std::vector<double> values;
    for (std::size_t texel = 0; texel < texels.size(); texel += 4)
    {
      values.push_back(texels[texel + 3] > 0.0 ? texels[texel] / texels[texel + 3] : -1.0);
    }
    return values;
  }
};

/// No light enters on the dark side, and some leaves there; from behind that is what is seen.
/// Through a body of many free paths there comes none.
void TestDarkSide()
{
  for (const bool isSmall : { true, false })
  {
    Scene scene;
    scene.Material->SetMillimetersPerUnit(isSmall ? 2.0 : 500.0);
    scene.Actor->GetProperty()->SetSpecular(0.0);
    scene.Light->SetPosition(0.0, 0.0, -10.0);
    scene.Pass->SetExposure(6.0);
    const double origin[3] = { 0.0, 0.0, 0.0 };
    LookAt(scene.Renderer, origin, 0.7);
    scene.Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
    const double seen = GetMean(Draw(scene.Window));
    const Maps maps(scene);
    double enters = 0.0;
    double least = 1.0;
    double most = 0.0;
    // The face that looks along z is the fifth chart: the first of the second line of four.
    const int side = scene.Pass->GetScatteredMapSize() / ChartsPerSide;
    for (int texel = 0; texel < side * side; ++texel)
    {
      const int line = side + texel / side;
      const std::size_t place =
        static_cast<std::size_t>(line) * ChartsPerSide * side + texel % side;
      enters = std::max(enters, maps.Entering[place]);
      least = std::min(least, maps.Leaving[place]);
      most = std::max(most, maps.Leaving[place]);
    }
    std::cout << "dark side: " << enters << " enters, " << least << " to " << most
              << " leaves, mean of the picture " << seen << "\n";
    Check(enters == 0.0, "light enters on the dark side");
    Check(isSmall ? least > 1e-3 && seen > 1e-3 : most < 1e-3 && seen < 1e-6,
      "what comes through to the dark side");
  }
}

/// Where light goes no further than a texel, what leaves is what enters there, times what the
/// material gives back: a diffuse body.
void TestDiffuseBody()
{
  double spread[2] = {};
  for (const bool isLarge : { false, true })
  {
    Scene scene;
    scene.Material->SetMillimetersPerUnit(isLarge ? 3000.0 : 3.0);
    Draw(scene.Window);
    const Maps maps(scene);
    double low = 1e9;
    double high = 0.0;
    for (std::size_t texel = 0; texel < maps.Leaving.size(); ++texel)
    {
      if (maps.Entering[texel] > 0.3)
      {
        low = std::min(low, maps.Leaving[texel] / maps.Entering[texel]);
        high = std::max(high, maps.Leaving[texel] / maps.Entering[texel]);
      }
    }
    spread[isLarge ? 1 : 0] = high / low - 1.0;
  }
  std::cout << "a body of many free paths is diffuse within " << spread[1] << ", a small one "
            << spread[0] << "\n";
  Check(spread[1] < 0.05 && spread[0] > 0.2, "a body of many free paths is not diffuse");
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringScenes(int, char*[])
{
  TestBlocks();
  TestAttributes();
  TestNestedPasses();
  TestWindows();
  TestTwoSidedSheet();
  TestDarkSide();
  TestDiffuseBody();
  return Result();
}
