// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * vtkOpenGLAtlasTexture on random quadtrees of charts of 1 to 256 texels a side, and on the atlas
 * of a bunny where the module that makes it is there: charts of one colour stay so at every level,
 * whole or between two (and do not where samples may leave the block); texels of all levels are the
 * area-weighted means of what is below them; samples against filtering in double precision; shaders
 * of others; windows that go; errors.
 */
#include "LightTransportTesting.h"
#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLAtlasTexture.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"
#include "vtkTextureObject.h"

#ifdef TEST_WITH_MESHING
#include "vtkFloatingPointExceptions.h"
#include "vtkPLYReader.h"
#include "vtkSurfaceAtlas.h"
#include "vtkTable.h"
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace
{
using namespace LightTransportTesting;

constexpr int Resolution = 512;
constexpr int TopLevel = 9;

/// What single precision may change in nine sums of four, relative to the value.
constexpr double Rounding = 1e-6;
/// Of samples between texels, values between 0 and 1: GPUs weigh in 1/256, software in single
/// precision.
double GetFilterTolerance()
{
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  std::string reason;
  Check(window->Open(reason), reason);
  return window->IsHardware() ? 2.0 / 256.0 : 2.5e-5;
}

std::mt19937 Engine(5);

double Draw(double low, double high)
{
  return low + (high - low) * (Engine() / 4294967296.0);
}

struct Block
{
  int X;
  int Y;
  int Size;
};

/// A random quadtree, its leaves at most 256 texels a side and of every size.
std::vector<Block> MakeBlocks()
{
  std::vector<Block> blocks;
  std::vector<Block> open = { { 0, 0, Resolution } };
  bool forced[TopLevel] = {};
  while (!open.empty())
  {
    const Block block = open.back();
    open.pop_back();
    const int half = block.Size / 2;
    const int level = static_cast<int>(std::log2(block.Size));
    const bool first = level < TopLevel && !forced[level];
    if (block.Size == 1 || (level < TopLevel && !first && Draw(0.0, 1.0) < 0.75))
    {
      blocks.push_back(block);
      continue;
    }
    if (level < TopLevel)
    {
      forced[level] = true;
    }
    for (int child = 0; child < 4; ++child)
    {
      open.push_back({ block.X + half * (child % 2), block.Y + half * (child / 2), half });
    }
  }
  return blocks;
}

/// Texel maps: values of 1 or 3 components and areas, in double precision.
struct Maps
{
  vtkNew<vtkImageData> Image;
  vtkNew<vtkDoubleArray> Values;
  vtkNew<vtkDoubleArray> Areas;

  explicit Maps(int components, int side = Resolution)
  {
    this->Image->SetDimensions(side, side, 1);
    this->Values->SetName("Value");
    this->Values->SetNumberOfComponents(components);
    this->Values->SetNumberOfTuples(static_cast<vtkIdType>(side) * side);
    this->Values->Fill(1.0);
    this->Areas->SetName("Area");
    this->Areas->SetNumberOfTuples(static_cast<vtkIdType>(side) * side);
    this->Areas->Fill(1.0);
    this->Image->GetPointData()->AddArray(this->Values);
    this->Image->GetPointData()->AddArray(this->Areas);
  }

  /// Between 1e-3 / range and 1e-3 x range.
  void SetRandomAreas(double range)
  {
    for (vtkIdType texel = 0; texel < this->Areas->GetNumberOfTuples(); ++texel)
    {
      this->Areas->SetValue(texel, 1e-3 * std::pow(range, Draw(-1.0, 1.0)));
    }
  }

  void SetRandomValues()
  {
    for (vtkIdType k = 0; k < this->Values->GetNumberOfValues(); ++k)
    {
      this->Values->SetValue(k, Draw(0.0, 1.0));
    }
  }
};

/// Points to sample at; what a chart's points must give is looked up by the number of the chart.
struct Points
{
  vtkNew<vtkDoubleArray> Coordinates;
  vtkNew<vtkDoubleArray> Blocks;
  vtkNew<vtkDoubleArray> Levels;
  std::vector<int> Charts;

  Points()
  {
    this->Coordinates->SetNumberOfComponents(2);
    this->Blocks->SetNumberOfComponents(3);
  }

  void Add(int chart, const Block& block, double x, double y, double level)
  {
    this->Coordinates->InsertNextTuple2(x / Resolution, y / Resolution);
    this->Blocks->InsertNextTuple3(block.X, block.Y, block.Size);
    this->Levels->InsertNextValue(level);
    this->Charts.push_back(chart);
  }
};

//------------------------------------------------------------------------------
// The border of each block, and places in it, at whole levels and between them, and beyond the
// chart's single texel.
void AddPointsOfChart(Points& points, int chart, const Block& block)
{
  std::vector<std::array<double, 2>> places;
  for (double u : { 0.0, 0.5, 1.0 })
  {
    for (double v : { 0.0, 0.5, 1.0 })
    {
      places.push_back({ u, v });
    }
  }
  for (int k = 0; k < 4; ++k)
  {
    places.push_back({ Draw(0.0, 1.0), Draw(0.0, 1.0) });
    places.push_back({ k % 2 == 0 ? 0.0 : 1.0, Draw(0.0, 1.0) });
    places.push_back({ Draw(0.0, 1.0), k % 2 == 0 ? 0.0 : 1.0 });
  }
  const double highest = std::log2(block.Size);
  for (double level = 0.0; level <= highest + 1.0; level += 0.5)
  {
    for (const auto& place : places)
    {
      const double x = block.X + place[0] * block.Size;
      const double y = block.Y + place[1] * block.Size;
      points.Add(chart, block, x, y, level);
      points.Add(chart, block, x, y, std::floor(level) + Draw(0.0, 1.0));
    }
  }
}

//------------------------------------------------------------------------------
// Samples that differ from the colour of their chart, and the largest difference.
int CountMixtures(const Points& points, const std::vector<std::array<double, 3>>& colours,
  vtkDoubleArray* values, double& largest)
{
  int mixtures = 0;
  largest = 0.0;
  if (values->GetNumberOfTuples() != static_cast<vtkIdType>(points.Charts.size()))
  {
    return -1;
  }
  for (std::size_t k = 0; k < points.Charts.size(); ++k)
  {
    double off = 0.0;
    for (int component = 0; component < 3; ++component)
    {
      off = std::max(off,
        std::abs(values->GetComponent(static_cast<vtkIdType>(k), component) -
          colours[points.Charts[k]][component]));
    }
    mixtures += off > Rounding ? 1 : 0;
    largest = std::max(largest, off);
  }
  return mixtures;
}

//------------------------------------------------------------------------------
// A colour for each chart, on texels with these areas (random ones without).
void TestBleeding(vtkOpenGLAtlasTexture* texture, const std::vector<Block>& blocks,
  vtkDataArray* areas)
{
  Maps maps(3);
  maps.SetRandomAreas(10.0);
  if (areas)
  {
    maps.Areas->DeepCopy(areas);
  }
  std::vector<std::array<double, 3>> colours;
  Points points;
  for (std::size_t chart = 0; chart < blocks.size(); ++chart)
  {
    const Block& block = blocks[chart];
    // Neighbours differ in the first component by much more than rounding.
    colours.push_back({ ((chart * 7) % 11 + 1) / 11.0, Draw(0.0, 1.0), Draw(0.0, 1.0) });
    for (int y = block.Y; y < block.Y + block.Size; ++y)
    {
      for (int x = block.X; x < block.X + block.Size; ++x)
      {
        maps.Values->SetTuple(static_cast<vtkIdType>(y) * Resolution + x, colours.back().data());
      }
    }
    AddPointsOfChart(points, static_cast<int>(chart), block);
  }
  Check(texture->Build(maps.Image, "Value"), "the charts' texture");
  vtkNew<vtkDoubleArray> values;
  double largest = 0.0;
  Check(texture->Sample(points.Coordinates, points.Blocks, points.Levels, values), "sampling");
  Check(CountMixtures(points, colours, values, largest) == 0,
    "no mixtures; the largest difference is " + std::to_string(largest));
  std::cout << blocks.size() << " charts, " << points.Charts.size()
            << " samples, largest difference " << largest << "\n";

  // The block of the whole atlas keeps nothing apart.
  for (vtkIdType point = 0; point < points.Blocks->GetNumberOfTuples(); ++point)
  {
    points.Blocks->SetTuple3(point, 0.0, 0.0, Resolution);
  }
  Check(texture->Sample(points.Coordinates, points.Blocks, points.Levels, values), "sampling");
  const int mixtures = CountMixtures(points, colours, values, largest);
  Check(mixtures > static_cast<int>(points.Charts.size() / 2) && largest > 0.1,
    "without the blocks most samples are mixtures, not " + std::to_string(mixtures));
}

//------------------------------------------------------------------------------
void TestRandomCharts(vtkOpenGLAtlasTexture* texture)
{
  const std::vector<Block> blocks = MakeBlocks();
  std::set<int> sizes;
  for (const Block& block : blocks)
  {
    sizes.insert(block.Size);
  }
  Check(sizes.size() == TopLevel, "there are charts of all sizes");
  TestBleeding(texture, blocks, nullptr);
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
// A texel of a node's level has the area of the node: all of the way up.
void CheckNodes(vtkOpenGLAtlasTexture* texture, vtkTable* charts, double meanArea)
{
  vtkNew<vtkFloatArray> texels;
  double off = 0.0;
  for (vtkIdType row = 0; row < charts->GetNumberOfRows(); ++row)
  {
    const int level = charts->GetValueByName(row, "Level").ToInt();
    const int size = charts->GetValueByName(row, "Size").ToInt();
    Check(size == 1 << level && texture->ReadLevel(level, texels), "the level of a node");
    const vtkIdType x = charts->GetValueByName(row, "X").ToInt() / size;
    const vtkIdType y = charts->GetValueByName(row, "Y").ToInt() / size;
    const double share = texels->GetComponent(y * (Resolution / size) + x, 3);
    const double area = share * meanArea * size * size;
    off =
      std::max(off, std::abs(area / charts->GetValueByName(row, "SurfaceArea").ToDouble() - 1.0));
  }
  Check(off < 1e-5, "texels have the area of their node: " + std::to_string(off));
  std::cout << charts->GetNumberOfRows() << " nodes, largest difference of areas " << off << "\n";
}

//------------------------------------------------------------------------------
void TestSurface(vtkOpenGLAtlasTexture* texture)
{
  vtkFloatingPointExceptions::Disable(); // CGAL's predicates raise some on purpose
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputConnection(reader->GetOutputPort());
  atlas->SetResolution(Resolution);
  atlas->Update();
  vtkTable* charts = atlas->GetCharts();
  vtkDataArray* areas = atlas->GetMaps()->GetPointData()->GetArray("Area");
  if (!Check(areas && charts->GetNumberOfRows() > 1, "the atlas of a bunny"))
  {
    return;
  }
  std::vector<Block> blocks;
  double mean = 0.0;
  for (vtkIdType row = 0; row < charts->GetNumberOfRows(); ++row)
  {
    if (charts->GetValueByName(row, "Chart").ToInt() >= 0)
    {
      blocks.push_back({ charts->GetValueByName(row, "X").ToInt(),
        charts->GetValueByName(row, "Y").ToInt(), charts->GetValueByName(row, "Size").ToInt() });
    }
  }
  for (vtkIdType texel = 0; texel < areas->GetNumberOfTuples(); ++texel)
  {
    mean += areas->GetComponent(texel, 0) / static_cast<double>(areas->GetNumberOfTuples());
  }
  TestBleeding(texture, blocks, areas);
  CheckNodes(texture, charts, mean);
}
#endif

/// Value x area and area of all levels in double precision, four numbers a texel.
using Pyramid = std::vector<std::vector<double>>;

//------------------------------------------------------------------------------
Pyramid MakePyramid(const Maps& maps)
{
  const vtkIdType texels = maps.Areas->GetNumberOfTuples();
  double mean = 0.0;
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    mean += maps.Areas->GetValue(texel) / static_cast<double>(texels);
  }
  Pyramid pyramid(1);
  const int last = maps.Values->GetNumberOfComponents() - 1;
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    const double area = maps.Areas->GetValue(texel) / mean;
    for (int k = 0; k < 3; ++k)
    {
      pyramid[0].push_back(area * maps.Values->GetComponent(texel, std::min(k, last)));
    }
    pyramid[0].push_back(area);
  }
  for (int side = Resolution / 2; side > 0; side /= 2)
  {
    const std::vector<double>& finer = pyramid.back();
    std::vector<double> level;
    for (int k = 0; k < 4 * side * side; ++k)
    {
      const int x = k / 4 % side;
      const int y = k / 4 / side;
      const auto at = [&](int i, int j)
      { return finer[4 * ((2 * y + j) * 2 * side + 2 * x + i) + k % 4]; };
      level.push_back(0.25 * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)));
    }
    pyramid.push_back(level);
  }
  return pyramid;
}

//------------------------------------------------------------------------------
void CheckLevels(vtkOpenGLAtlasTexture* texture, const Pyramid& pyramid)
{
  Check(texture->GetNumberOfLevels() == TopLevel + 1, "levels down to one texel");
  vtkNew<vtkFloatArray> finer;
  vtkNew<vtkFloatArray> level;
  for (int index = 0; index < texture->GetNumberOfLevels(); ++index)
  {
    const int side = Resolution >> index;
    Check(texture->ReadLevel(index, level) && level->GetNumberOfValues() == 4 * side * side,
      "reading a level");
    double offMean = 0.0;
    double offChildren = 0.0;
    for (vtkIdType k = 0; k < level->GetNumberOfValues(); ++k)
    {
      const double value = level->GetValue(k);
      const std::vector<double>& exact = pyramid[index];
      // Means, not products: what users see.
      const double mean = value / level->GetValue(k / 4 * 4 + 3);
      offMean = std::max(offMean, std::abs(mean * exact[k / 4 * 4 + 3] / exact[k] - 1.0));
      if (index > 0)
      {
        const vtkIdType corner = 2 * (k / 4 / side) * 2 * side + 2 * (k / 4 % side);
        double sum = 0.0;
        for (vtkIdType child : { corner, corner + 1, corner + 2 * side, corner + 2 * side + 1 })
        {
          sum += 0.25 * finer->GetValue(4 * child + k % 4);
        }
        offChildren = std::max(offChildren, std::abs(value / sum - 1.0));
      }
    }
    const std::string where = " of level " + std::to_string(index);
    Check(offMean < Rounding, "area-weighted means" + where + ": " + std::to_string(offMean));
    Check(offChildren < Rounding, "means of four" + where + ": " + std::to_string(offChildren));
    finer->DeepCopy(level);
  }
}

//------------------------------------------------------------------------------
// Bilinear filtering of one level within a block.
std::array<double, 4> Filter(const Pyramid& pyramid, const Block& block, double x, double y,
  int level)
{
  const double size = 1 << level;
  const int side = Resolution >> level;
  const auto place = [size](double at, double first, double extent) {
    return std::min(std::max(at / size, first / size + 0.5), (first + extent) / size - 0.5) - 0.5;
  };
  const double u = place(x, block.X, block.Size);
  const double v = place(y, block.Y, block.Size);
  std::array<double, 4> sum = {};
  for (int corner = 0; corner < 4; ++corner)
  {
    const int i = static_cast<int>(u) + corner % 2;
    const int j = static_cast<int>(v) + corner / 2;
    const double weight =
      std::max(0.0, 1.0 - std::abs(u - i)) * std::max(0.0, 1.0 - std::abs(v - j));
    for (int k = 0; k < 4 && weight > 0.0; ++k)
    {
      sum[k] += weight * pyramid[level][4 * (j * side + i) + k];
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
// Means that samples of random charts, places and levels must have.
std::vector<double> MakeSamples(const Pyramid& pyramid, Points& points)
{
  std::vector<double> expected;
  const std::vector<Block> blocks = MakeBlocks();
  for (int count = 0; count < 20000; ++count)
  {
    const int chart = static_cast<int>(Engine() % blocks.size());
    const Block& block = blocks[chart];
    const double highest = std::log2(block.Size);
    const double level = Draw(-0.5, highest + 1.0);
    const double x = block.X + Draw(0.0, 1.0) * block.Size;
    const double y = block.Y + Draw(0.0, 1.0) * block.Size;
    points.Add(chart, block, x, y, level);
    const double within = std::min(std::max(level, 0.0), highest);
    const int finer = static_cast<int>(within);
    const int coarser = std::min(finer + 1, static_cast<int>(highest));
    const auto low = Filter(pyramid, block, x, y, finer);
    const auto high = Filter(pyramid, block, x, y, coarser);
    const double t = within - finer;
    const double area = (1.0 - t) * low[3] + t * high[3];
    for (int k = 0; k < 3; ++k)
    {
      expected.push_back(((1.0 - t) * low[k] + t * high[k]) / area);
    }
  }
  return expected;
}

//------------------------------------------------------------------------------
void TestMeans(vtkOpenGLAtlasTexture* texture, int components)
{
  Maps maps(components);
  maps.SetRandomAreas(2.0);
  maps.SetRandomValues();
  const Pyramid pyramid = MakePyramid(maps);
  Check(texture->Build(maps.Image, "Value", "Area"), "a texture of random values");
  Check(texture->GetNumberOfComponents() == components && texture->GetResolution() == Resolution,
    "size and components");
  CheckLevels(texture, pyramid);

  Points points;
  const std::vector<double> expected = MakeSamples(pyramid, points);
  vtkNew<vtkDoubleArray> values;
  Check(texture->Sample(points.Coordinates, points.Blocks, points.Levels, values) &&
      values->GetNumberOfComponents() == components,
    "sampling");
  double largest = 0.0;
  double squares = 0.0;
  for (vtkIdType k = 0; k < values->GetNumberOfValues(); ++k)
  {
    const double off = values->GetValue(k) - expected[3 * (k / components) + k % components];
    largest = std::max(largest, std::abs(off));
    squares += off * off;
  }
  // Areas of neighbours differ up to fourfold, and multiply what the filter's weights lack.
  const double rms = std::sqrt(squares / static_cast<double>(values->GetNumberOfValues()));
  const double tolerance = GetFilterTolerance();
  Check(rms < tolerance && largest < 4.0 * tolerance,
    "samples as in double precision: " + std::to_string(rms) + ", at most " +
      std::to_string(largest));
  std::cout << components << " components, samples against double precision: RMS " << rms
            << ", largest " << largest << "\n";
}

//------------------------------------------------------------------------------
// More points than are sampled at once; constant in, constant out; no points.
void TestManyPoints(vtkOpenGLAtlasTexture* texture)
{
  Maps maps(1, 4);
  maps.SetRandomAreas(2.0);
  maps.Values->Fill(0.7);
  Check(texture->Build(maps.Image, "Value"), "a small texture");
  Points points;
  const int count = (1 << 20) + 777;
  for (int k = 0; k < count; ++k)
  {
    points.Add(0, { 2, 0, 2 }, k % 999, k % 77, 0.01 * (k % 100));
  }
  vtkNew<vtkDoubleArray> values;
  Check(texture->Sample(points.Coordinates, points.Blocks, points.Levels, values) &&
      values->GetNumberOfTuples() == count,
    "sampling at many points");
  double range[2];
  values->GetRange(range);
  CheckClose(range[0], 0.7, Rounding, "constant in, constant out");
  CheckClose(range[1], 0.7, Rounding, "constant in, constant out");
  const Points none;
  Check(texture->Sample(none.Coordinates, none.Blocks, none.Levels, values) &&
      values->GetNumberOfTuples() == 0,
    "no points");
}

//------------------------------------------------------------------------------
// As a render pass does: a program of its own in a window of its own.
void TestShader()
{
  Maps maps(3, 4);
  for (vtkIdType texel = 0; texel < 16; ++texel)
  {
    maps.Values->SetTuple3(texel, texel % 4 < 2 ? 0.0 : 1.0, texel / 8, 0.25);
  }
  auto window = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  vtkNew<vtkOpenGLAtlasTexture> texture;
  vtkNew<vtkTest::ErrorObserver> observer;
  texture->AddObserver(vtkCommand::ErrorEvent, observer);
  Check(!texture->Build(maps.Image, "Value", "Area", window) &&
      observer->CheckErrorMessage("render once") == 0,
    "a window without a context");
  std::string reason;
  Check(window->Open(reason), reason);
  Check(texture->Build(maps.Image, "Value", "Area", window), "a texture of a window");
  window->MakeCurrent();
  {
    const std::string source = "//VTK::System::Dec\n//VTK::Output::Dec\nin vec2 texCoord;\n" +
      vtkOpenGLAtlasTexture::GetShaderCode() +
      "uniform sampler2D map;\nvoid main()\n{\n"
      "  gl_FragData[0] = SampleAtlas(map, texCoord, vec3(2.0, 2.0, 2.0), 0.5);\n}\n";
    vtkOpenGLQuadHelper quad(window, nullptr, source.c_str(), nullptr);
    vtkNew<vtkTextureObject> target;
    target->SetContext(window);
    target->Allocate2D(8, 8, 4, VTK_FLOAT);
    vtkNew<vtkOpenGLFramebufferObject> framebuffer;
    framebuffer->SetContext(window);
    window->GetState()->PushFramebufferBindings();
    framebuffer->Bind();
    framebuffer->AddColorAttachment(0, target);
    framebuffer->ActivateDrawBuffer(0);
    framebuffer->Start(8, 8);
    window->GetShaderCache()->ReadyShaderProgram(quad.Program);
    Check(texture->Activate(quad.Program, "map"), "the texture in a program");
    quad.Render();
    texture->Deactivate();
    window->GetState()->PopFramebufferBindings();
    auto pixels = vtkSmartPointer<vtkPixelBufferObject>::Take(target->Download());
    std::vector<float> colours(4 * 64);
    unsigned int size[2] = { 8, 8 };
    vtkIdType increments[2] = { 0, 0 };
    Check(pixels->Download2D(VTK_FLOAT, colours.data(), size, 4, increments), "reading pixels");
    for (int pixel = 0; pixel < 64; ++pixel)
    {
      const std::vector<float> colour(&colours[4 * pixel], &colours[4 * pixel] + 4);
      Check(colour == std::vector<float>({ 1.0f, 1.0f, 0.25f, 1.0f }), "the chart's colour");
    }
  }
  window->Finalize();
  vtkNew<vtkFloatArray> level;
  Check(!texture->ReadLevel(0, level) && observer->CheckErrorMessage("Build()") == 0,
    "no texture without a context");
  window = nullptr;
  Check(!texture->Activate(nullptr, "map"), "no program");
  Check(texture->Build(maps.Image, "Value") && texture->ReadLevel(0, level), "built again");
}

//------------------------------------------------------------------------------
void TestErrors(vtkOpenGLAtlasTexture* texture)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  texture->AddObserver(vtkCommand::ErrorEvent, observer);
  const auto refuses =
    [&](vtkImageData* image, const char* value, const char* area, const char* message)
  {
    Check(!texture->Build(image, value, area) && observer->CheckErrorMessage(message) == 0 &&
        texture->GetResolution() == 0 && texture->GetNumberOfLevels() == 0,
      std::string("refused: ") + message);
  };
  Maps maps(3, 8);
  refuses(nullptr, "Value", "Area", "no image");
  refuses(maps.Image, nullptr, "Area", "no name");
  refuses(maps.Image, "None", "Area", "\"None\" with 1 or 3 components");
  refuses(maps.Image, "Value", "None", "\"None\" with 1 component");
  refuses(maps.Image, "Value", "Value", "\"Value\" with 1 component");
  Maps two(2, 8);
  refuses(two.Image, "Value", "Area", "1 or 3 components");
  Maps odd(1, 12);
  refuses(odd.Image, "Value", "Area", "12 x 12 x 1 texels");
  maps.Areas->SetValue(3, -1.0);
  refuses(maps.Image, "Value", "Area", "not negative");
  maps.Areas->SetValue(3, std::nan(""));
  refuses(maps.Image, "Value", "Area", "finite");
  maps.Areas->Fill(0.0);
  refuses(maps.Image, "Value", "Area", "not all 0");
  maps.Areas->Fill(1e-30);
  maps.Values->SetValue(5, 1e39);
  refuses(maps.Image, "Value", "Area", "not finite in single precision");
  maps.Values->SetValue(5, 0.5);

  vtkNew<vtkFloatArray> level;
  Check(!texture->ReadLevel(0, level) && observer->CheckErrorMessage("Build()") == 0, "no texture");
  Check(texture->Build(maps.Image, "Value"), "tiny areas");
  Check(!texture->ReadLevel(4, level) && observer->CheckErrorMessage("no level 4") == 0, "levels");
  vtkNew<vtkDoubleArray> values;
  const auto refusesPoint = [&](const Block& block, const char* message)
  {
    Points points;
    points.Add(0, { 0, 0, 8 }, 0.0, 0.0, 0.0);
    points.Add(0, block, 0.0, 0.0, 0.0);
    Check(!texture->Sample(points.Coordinates, points.Blocks, points.Levels, values) &&
        observer->CheckErrorMessage(message) == 0,
      message);
  };
  refusesPoint({ 0, 0, 3 }, "size 3, of point 1 is no node");
  refusesPoint({ 2, 0, 4 }, "no node");
  refusesPoint({ 0, 8, 4 }, "no node");
  refusesPoint({ 0, 0, 16 }, "no node");
  refusesPoint({ 0, 0, 0 }, "no node");
  Points points;
  points.Add(0, { 0, 0, 8 }, 0.0, 0.0, 0.0);
  points.Levels->InsertNextValue(0.0);
  Check(!texture->Sample(points.Coordinates, points.Blocks, points.Levels, values) &&
      observer->CheckErrorMessage("1 level") == 0,
    "arrays of different lengths");
  texture->ReleaseGraphicsResources();
  Check(!texture->ReadLevel(0, level) && observer->CheckErrorMessage("Build()") == 0, "released");
}
} // namespace

//------------------------------------------------------------------------------
int TestAtlasMipmaps(int, char*[])
{
  vtkNew<vtkOpenGLAtlasTexture> texture;
  TestRandomCharts(texture);
#ifdef TEST_WITH_MESHING
  TestSurface(texture);
#endif
  TestMeans(texture, 3);
  TestMeans(texture, 1);
  TestManyPoints(texture);
  TestShader();
  TestErrors(texture);
  return Result();
}
