// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Texels of an atlas as patches of vtkSubsurfaceScattering: their shapes; flat ones against the
// same patches of a surface; several images, and ranks that have all, parts or nothing of one; a
// sphere against the surface's own result while texels get smaller; what is refused, and why.
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "Scene/TexelShape.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkRadiosity.h"
#include "vtkStringArray.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTestErrorObserver.h"

#ifdef TEST_WITH_MESHING
#include "vtkAtlasToSurface.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#endif

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
constexpr const char* Scattered = "ScatteredIrradiance";
constexpr int Side = 12;

//------------------------------------------------------------------------------
template <typename Array = vtkDoubleArray>
Array* AddTexels(vtkImageData* image, const char* name, int components)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->Fill(0.0);
  image->GetPointData()->AddArray(array);
  return array;
}

//------------------------------------------------------------------------------
/// Where the centre of a texel of the sheet is: a parallelogram from `origin`, which bends away by
/// `bend` in its second half of columns.
Point GetPlace(const Point& origin, int i, int j, double bend)
{
  const double along = i + 0.5 + 0.25 * j;
  const double over = std::max(i + 0.5 - 0.5 * Side, 0.0);
  return { origin[0] + along, origin[1] + j + 0.5, origin[2] - bend * over };
}

//------------------------------------------------------------------------------
/// Columns [first, last] of the texels of a sheet, which has two charts of half the columns each.
/// The light differs from texel to texel.
vtkSmartPointer<vtkImageData> MakeSheet(const Point& origin, double bend = 0.0, int first = 0,
  int last = Side - 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(first, last, 0, Side - 1, 0, 0);
  auto* positions = AddTexels(image, "Position", 3);
  auto* normals = AddTexels(image, "Normal", 3);
  auto* areas = AddTexels(image, "Area", 1);
  auto* charts = AddTexels<vtkIntArray>(image, "ChartId", 1);
  auto* light = AddTexels(image, "Irradiance", 1);
  vtkIdType texel = 0;
  for (int j = 0; j < Side; ++j)
  {
    for (int i = first; i <= last; ++i, ++texel)
    {
      const bool isBent = i >= Side / 2;
      const double length = isBent ? std::hypot(1.0, bend, 0.25 * bend) : 1.0;
      positions->SetTuple(texel, GetPlace(origin, i, j, bend).data());
      normals->SetTuple3(texel, isBent ? bend / length : 0.0, isBent ? -0.25 * bend / length : 0.0,
        1.0 / length);
      areas->SetValue(texel, length);
      charts->SetValue(texel, isBent ? 1 : 0);
      light->SetValue(texel, 1.0 + i % 3 + 2.0 * (j % 2));
    }
  }
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkSubsurfaceScattering> MakeFilter(vtkDataObject* data)
{
  auto filter = vtkSmartPointer<vtkSubsurfaceScattering>::New();
  filter->SetInputDataObject(data);
  filter->SetMaterialToMarble();
  filter->SetModelToDipole();
  filter->SetDeviceToCPU();
  filter->SetLinkMethodToDense();
  return filter;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> Scatter(vtkImageData* image)
{
  auto filter = MakeFilter(image);
  filter->Update();
  return filter->GetImageDataOutput();
}

//------------------------------------------------------------------------------
std::vector<double> GetFound(vtkDataArray* array)
{
  Check(array != nullptr, "there is a result");
  return GetValues(array);
}

//------------------------------------------------------------------------------
std::vector<double> GetScattered(vtkImageData* image)
{
  Check(image != nullptr, "the output is an image");
  return GetFound(image ? image->GetPointData()->GetArray(Scattered) : nullptr);
}

//------------------------------------------------------------------------------
void CheckEqual(const std::vector<double>& values, const std::vector<double>& expected,
  double tolerance, const std::string& what)
{
  Check(!values.empty() && values.size() == expected.size(), what + ": as many values");
  double worst = 0.0;
  for (std::size_t k = 0; k < std::min(values.size(), expected.size()); ++k)
  {
    worst = std::max(worst, std::abs(values[k] - expected[k]) / std::abs(expected[k]));
  }
  Check(worst <= tolerance, what + ": differs by " + std::to_string(worst));
}

//------------------------------------------------------------------------------
void TestShape(const std::string& what, const TexelShape::Vector& normal,
  const TexelShape::Vector& row, const TexelShape::Vector& column, double aspect)
{
  using Vector = TexelShape::Vector;
  const Vector position(1.0, 2.0, 3.0);
  const Vector steps[2] = { row, column };
  const TexelShape shape(position, normal, 6.0, steps);
  const Vector sides[2] = { shape.GetCorner(1) - shape.GetCorner(0),
    shape.GetCorner(3) - shape.GetCorner(0) };
  const Vector front = sides[0].cross(sides[1]);
  CheckClose(front.norm(), 6.0, 1e-12, what + ": its area");
  CheckClose(sides[0].norm() / sides[1].norm(), aspect, 1e-12, what + ": its aspect");
  CheckClose((shape.GetCorner(0) + shape.GetCorner(2) - 2.0 * position).norm(), 0.0, 1e-12,
    what + ": its centre");
  CheckClose((shape.GetCorner(1) + shape.GetCorner(3) - 2.0 * position).norm(), 0.0, 1e-12,
    what + ": its centre");
  if (!normal.isZero())
  {
    CheckClose(front.dot(normal) / (front.norm() * normal.norm()), 1.0, 1e-12, what + ": front");
  }
}

//------------------------------------------------------------------------------
void TestShapes()
{
  using Vector = TexelShape::Vector;
  const Vector zero = Vector::Zero();
  const Vector up(0.0, 0.0, 2.0);
  TestShape("a sheared texel", up, { 3.0, 0.0, 0.0 }, { 1.0, 1.0, 0.0 }, 3.0 / std::sqrt(2.0));
  TestShape("steps out of the plane", up, { 3.0, 0.0, 1.0 }, { 0.0, 1.0, -7.0 }, 3.0);
  TestShape("no column", up, { 3.0, 0.0, 0.0 }, zero, 1.0);
  TestShape("no row", up, zero, { 3.0, 1.0, 0.0 }, 1.0);
  TestShape("no neighbours", { 1.0, 1.0, 1.0 }, zero, zero, 1.0);
  TestShape("steps of one direction", up, { 3.0, 0.0, 0.0 }, { 2.0, 0.01, 0.0 }, 1.0);
  TestShape("steps that are turned over", up, { 0.0, 1.0, 0.0 }, { 1.0, 0.0, 0.0 }, 1.0);
  TestShape("normals that cancel", zero, { 2.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 2.0);
  TestShape("nothing known", zero, zero, zero, 1.0);
  TestShape("a huge texel", up, { 3e200, 0.0, 0.0 }, { 0.0, 1e200, 0.0 }, 3.0);
}

//------------------------------------------------------------------------------
// A bent sheet of parallelograms, whose texels are its patches exactly.
void TestSheet()
{
  constexpr double bend = 0.7;
  Surface surface;
  const int half = Side / 2;
  // Up to the bend and from there on; columns go up by 0.25 each.
  surface.AddGrid({ 0, 0, 0 }, { half, 0, 0 }, { 0.25 * Side, Side, 0 }, half, Side);
  surface.AddGrid({ half, 0, 0 }, { half, 0, -bend * half }, { 0.25 * Side, Side, 0 }, half, Side);
  auto patches = surface.Get();
  auto image = MakeSheet({ 0.125, 0, 0 }, bend);
  // The grid goes column by column.
  const auto getTexel = [](vtkIdType cell) { return cell % Side * Side + cell / Side; };
  auto* light = AddArray(patches, "Irradiance", { 0.0 });
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    light->SetValue(cell,
      image->GetPointData()->GetArray("Irradiance")->GetComponent(getTexel(cell), 0));
  }
  auto filter = MakeFilter(patches);
  filter->Update();
  vtkPolyData* output = filter->GetPolyDataOutput();
  vtkDataArray* expected = output->GetCellData()->GetArray(Scattered);
  auto texels = Scatter(image);
  vtkDataArray* found = texels->GetPointData()->GetArray(Scattered);
  Check(found && found->GetNumberOfComponents() == 3, "three bands");
  for (vtkIdType cell = 0; found && cell < patches->GetNumberOfCells(); ++cell)
  {
    for (int band = 0; band < 3; ++band)
    {
      CheckClose(found->GetComponent(getTexel(cell), band), expected->GetComponent(cell, band),
        1e-4, "texels are as patches of a surface");
    }
  }
  for (const char* name : { "EnteringFlux", "LeavingFlux" })
  {
    CheckClose(GetSummary(texels, name), GetSummary(output, name), 1e-5, name);
  }
  Check(texels->GetPointData()->HasArray("Position") && texels->GetPointData()->HasArray("Area"),
    "the input's arrays stay");
}

//------------------------------------------------------------------------------
// Texels without surface are none; single precision, and a map offset.
void TestGaps()
{
  auto image = MakeSheet({ 0, 0, 0 });
  auto* areas = image->GetPointData()->GetArray("Area");
  auto* charts = image->GetPointData()->GetArray("ChartId");
  charts->SetComponent(7, 0, -1.0);
  image->GetPointData()->GetArray("Position")->SetComponent(7, 0, vtkMath::Nan());
  areas->SetComponent(9, 0, 0.0);
  const std::vector<double> values = GetScattered(Scatter(image));
  for (int k = 0; k < 30; ++k)
  {
    const bool isNone = k / 3 == 7 || k / 3 == 9;
    Check(isNone ? values[k] == 0.0 : values[k] > 0.0, "results are where surface is");
  }
  const std::vector<double> whole = GetScattered(Scatter(MakeSheet({ 0, 0, 0 }, 0.7)));
  CheckEqual(GetScattered(Scatter(MakeSheet({ 6e5, 6e6, 0 }, 0.7))), whole, 1e-5, "a map offset");
  auto single = MakeSheet({ 0, 0, 0 }, 0.7);
  vtkNew<vtkFloatArray> positions;
  positions->DeepCopy(single->GetPointData()->GetArray("Position"));
  single->GetPointData()->AddArray(positions);
  CheckEqual(GetScattered(Scatter(single)), whole, 1e-5, "single precision");
}

//------------------------------------------------------------------------------
// The blocks of a quadtree are nodes of the tree, and the fingerprint knows the texels.
void TestTree()
{
  PatchScene scene;
  auto image = MakeSheet({ 0, 0, 0 });
  CheckDone(scene.Build(image, Ranks(), PatchScene::Order::Atlas, 1, true), "scene");
  Check(scene.IsOfTexels() && scene.GetNumberOfPatches() == Side * Side, "texels are patches");
  Check(PolygonGathering::HasAtlas(image, Ranks()), "texels have an atlas");
  // Texels (0 to 7) x (0 to 7) of the 16 x 16 around the sheet come first.
  const auto& nodes = scene.GetTree().GetNodes();
  Check(std::any_of(nodes.begin(), nodes.end(),
          [](const PatchTree::Node& node) { return node.First == 0 && node.Last == 64; }),
    "a block of the quadtree is a node");
  for (vtkIdType patch = 0; patch < 64; ++patch)
  {
    const vtkIdType texel = scene.GetPolygon(patch);
    Check(texel % Side < 8 && texel / Side < 8, "the order is that of the quadtree");
  }
  PatchScene other;
  CheckDone(other.Build(MakeSheet({ 0, 0, 0 }, 0.1), Ranks(), PatchScene::Order::Atlas, 1, true),
    "scene");
  Check(scene.GetFingerprint() != other.GetFingerprint(), "texels that move are other texels");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(vtkDataObject* first, vtkDataObject* second)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, first);
  blocks->SetBlock(2, second);
  return blocks;
}

//------------------------------------------------------------------------------
std::vector<double> GetScattered(vtkMultiBlockDataSet* blocks)
{
  std::vector<double> values;
  for (const int block : { 0, 2 })
  {
    const std::vector<double> part =
      GetScattered(vtkImageData::SafeDownCast(blocks->GetBlock(block)));
    values.insert(values.end(), part.begin(), part.end());
  }
  return values;
}

//------------------------------------------------------------------------------
std::vector<double> ScatterBlocks(vtkDataObject* first, vtkDataObject* second)
{
  auto filter = MakeFilter(MakeBlocks(first, second));
  filter->Update();
  return GetScattered(vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0)));
}

//------------------------------------------------------------------------------
// Several images are one body: the halves of a sheet are the sheet, but for steps at their border.
void TestBlocks()
{
  const int half = Side / 2;
  const std::vector<double> halves = ScatterBlocks(MakeSheet({ 0, 0, 0 }, 0.7, 0, half - 1),
    MakeSheet({ 0, 0, 0 }, 0.7, half, Side - 1));
  const std::vector<double> whole = GetScattered(Scatter(MakeSheet({ 0, 0, 0 }, 0.7)));
  std::vector<double> parts(whole.size());
  for (std::size_t k = 0; k < whole.size() && k < halves.size(); ++k)
  {
    const std::size_t part = k / (3 * half * Side);
    const std::size_t texel = k / 3 % (half * Side);
    parts[3 * (texel / half * Side + part * half + texel % half) + k % 3] = halves[k];
  }
  CheckEqual(parts, whole, 1e-12, "two images");
}

//------------------------------------------------------------------------------
/// What each of three ranks gets.
std::array<std::vector<double>, 3> ScatterOnRanks(const std::vector<vtkImageData*>& pieces)
{
  std::array<std::vector<double>, 3> results;
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto filter = MakeFilter(pieces[rank]);
      filter->SetController(controller);
      filter->Update();
      vtkImageData* output = filter->GetImageDataOutput();
      if (output && output->GetNumberOfPoints() > 0)
      {
        results[rank] = GetScattered(output);
      }
    });
  return results;
}

//------------------------------------------------------------------------------
void CheckColumns(const std::vector<double>& part, const std::vector<double>& whole, int first,
  int last, const std::string& what)
{
  std::vector<double> expected;
  for (int j = 0; j < Side; ++j)
  {
    expected.insert(expected.end(), whole.begin() + 3 * (j * Side + first),
      whole.begin() + 3 * (j * Side + last + 1));
  }
  // Links are stored in single precision, here in another order.
  CheckEqual(part, expected, 1e-6, what);
}

//------------------------------------------------------------------------------
// All of the image on each rank, pieces with a column in common, all on one rank; and images that
// have nothing to do with each other.
void TestRanks()
{
  constexpr double bend = 0.7;
  const Point origin = { 0, 0, 0 };
  auto image = MakeSheet(origin, bend);
  const std::vector<double> whole = GetScattered(Scatter(image));
  for (const std::vector<double>& result : ScatterOnRanks({ image, image, image }))
  {
    CheckEqual(result, whole, 1e-9, "all of it on each rank");
  }
  vtkNew<vtkImageData> nothing;
  const auto alone = ScatterOnRanks({ nothing, image, nothing });
  CheckEqual(alone[1], whole, 1e-9, "all on one rank");
  Check(alone[0].empty() && alone[2].empty(), "nothing on the others");
  const int columns[4] = { 0, 4, 8, Side - 1 };
  vtkSmartPointer<vtkImageData> pieces[3];
  for (int rank = 0; rank < 3; ++rank)
  {
    pieces[rank] = MakeSheet(origin, bend, columns[rank], columns[rank + 1]);
  }
  const auto parts = ScatterOnRanks({ pieces[0], pieces[1], pieces[2] });
  for (int rank = 0; rank < 3; ++rank)
  {
    CheckColumns(parts[rank], whole, columns[rank], columns[rank + 1],
      "the piece of rank " + std::to_string(rank));
  }
  auto other = MakeSheet({ 0, 0, 3 });
  const std::vector<double> both = ScatterBlocks(image, other);
  const auto atlases = ScatterOnRanks({ image, other, nothing });
  const auto middle = both.begin() + static_cast<std::ptrdiff_t>(both.size() / 2);
  CheckEqual(atlases[0], { both.begin(), middle }, 1e-9, "the first rank's own atlas");
  CheckEqual(atlases[1], { middle, both.end() }, 1e-9, "the second rank's own atlas");
}

//------------------------------------------------------------------------------
/// The filter reports exactly this problem, and its output has no result.
template <typename Filter>
void Expect(
  const std::string& part, vtkDataObject* data,
  const std::function<void(Filter*)>& change = [](Filter*) {})
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  vtkNew<Filter> filter;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  filter->SetInputDataObject(data);
  change(filter);
  filter->Update();
  const std::string message = errors->GetErrorMessage() + pipelineErrors->GetErrorMessage();
  Check(message.find(part) != std::string::npos, "\"" + part + "\" in \"" + message + "\"");
  auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  Check(!output || output->GetNumberOfPoints() == 0, "no output after: " + part);
}

//------------------------------------------------------------------------------
void ExpectOfArray(const std::string& part, const std::function<void(vtkPointData*)>& spoil)
{
  auto image = MakeSheet({ 0, 0, 0 });
  spoil(image->GetPointData());
  Expect<vtkSubsurfaceScattering>(part, image);
}

//------------------------------------------------------------------------------
void TestArrayErrors()
{
  for (const char* name : { "Position", "Normal", "Area", "ChartId" })
  {
    const std::string quoted = std::string("point array \"") + name + "\"";
    ExpectOfArray("The image has no " + quoted + ": give a texel image, as vtkSurfaceToAtlas",
      [=](vtkPointData* texels) { texels->RemoveArray(name); });
    ExpectOfArray(quoted + " has a value that is not finite at point 5",
      [=](vtkPointData* texels)
      {
        vtkNew<vtkDoubleArray> copy;
        copy->DeepCopy(texels->GetArray(name));
        copy->SetComponent(5, 0, vtkMath::Nan());
        texels->AddArray(copy);
      });
    ExpectOfArray("The point array \"" + std::string(name) + "\" of the texel image must have ",
      [=](vtkPointData* texels)
      {
        vtkNew<vtkDoubleArray> pairs;
        pairs->SetName(name);
        pairs->SetNumberOfComponents(2);
        pairs->SetNumberOfTuples(Side * Side);
        pairs->Fill(1.0);
        texels->AddArray(pairs);
      });
    ExpectOfArray("the point array \"" + std::string(name) + "\" has 3 tuples",
      [=](vtkPointData* texels)
      {
        auto* shortened = texels->GetArray(name);
        shortened->SetNumberOfTuples(3);
      });
  }
  ExpectOfArray(R"(no point array "Position", "Normal":)",
    [](vtkPointData* texels)
    {
      texels->RemoveArray("Normal");
      texels->RemoveArray("Position");
    });
  ExpectOfArray("\"Area\" has a value that is negative at point 5",
    [](vtkPointData* texels) { texels->GetArray("Area")->SetComponent(5, 0, -1.0); });
  ExpectOfArray("has no texels with surface",
    [](vtkPointData* texels) { texels->GetArray("ChartId")->Fill(-1.0); });
  ExpectOfArray(R"(The input has no point array "Irradiance". There is "Irradiance1")",
    [](vtkPointData* texels) { texels->GetArray("Irradiance")->SetName("Irradiance1"); });
  ExpectOfArray("The point array \"Irradiance\" has a value that is not finite at point 5",
    [](vtkPointData* texels)
    { texels->GetArray("Irradiance")->SetComponent(5, 0, vtkMath::Nan()); });
}

//------------------------------------------------------------------------------
void TestErrors()
{
  using Filter = vtkSubsurfaceScattering;
  TestArrayErrors();
  auto image = MakeSheet({ 0, 0, 0 });
  Expect<Filter>("Model MonteCarlo looks into the body", image,
    [](Filter* filter) { filter->SetModelToMonteCarlo(); });
  Expect<Filter>("ComputeThickness looks into the body", image,
    [](Filter* filter) { filter->ComputeThicknessOn(); });
  Expect<Filter>("DropLinksThroughAir looks into the body", image,
    [](Filter* filter) { filter->DropLinksThroughAirOn(); });
  Expect<vtkRadiosity>("is of type vtkImageData, but a vtkPolyData", image);
  Expect<vtkRadiosity>("A block of the input is no polygonal data", MakeBlocks(image, image));
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  for (const bool imageFirst : { true, false })
  {
    vtkSmartPointer<vtkDataObject> blocks[2] = { image, surface.Get() };
    Expect<Filter>("texel images, and blocks that are none",
      MakeBlocks(blocks[imageFirst ? 0 : 1], blocks[imageFirst ? 1 : 0]));
  }
  vtkNew<vtkImageData> thick;
  thick->SetDimensions(2, 2, 3);
  Expect<Filter>("The image has 2 x 2 x 3 points: a texel image has one layer", thick);
  vtkNew<vtkImageData> nothing;
  Expect<Filter>("has no texels with surface", nothing);
  auto ofCells = MakeSheet({ 0, 0, 0 });
  vtkNew<vtkDoubleArray> light;
  light->SetName("Irradiance");
  light->SetNumberOfTuples(ofCells->GetNumberOfCells());
  light->Fill(1.0);
  ofCells->GetPointData()->RemoveArray("Irradiance");
  ofCells->GetCellData()->AddArray(light);
  Expect<Filter>("\"Irradiance\" is a cell array and a point array is needed", ofCells);
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ToAtlas(vtkPolyData* surface, int resolution)
{
  vtkNew<vtkSurfaceToAtlas> filter;
  filter->SetInputData(surface);
  filter->SetResolution(resolution);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
/// A sphere of 10 mm with an atlas, in light that comes from one side; and constant in blue.
vtkSmartPointer<vtkPolyData> MakeSphere(int resolution)
{
  Surface sphere;
  AddSphere(sphere, 10.0, 3, false);
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputData(sphere.Get());
  atlas->SetResolution(resolution);
  atlas->TexelMapsOff();
  atlas->Update();
  vtkSmartPointer<vtkPolyData> data = atlas->GetOutput();
  auto* light = AddArray(data, "Irradiance", { 0.0, 0.0, 1.0 });
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    data->GetCell(cell)->GetBounds(bounds);
    const double bright = std::max(bounds[0] + bounds[1], 0.0);
    light->SetTuple3(cell, bright, 0.5 * bright, 1.0);
  }
  return data;
}

//------------------------------------------------------------------------------
/// Relative L2 difference of a band on cells or points.
double GetDifference(vtkDataArray* found, vtkDataArray* expected, vtkDataArray* weights, int band)
{
  double difference = 0.0;
  double whole = 0.0;
  for (vtkIdType k = 0; k < expected->GetNumberOfTuples(); ++k)
  {
    const double weight = weights ? weights->GetComponent(k, 0) : 1.0;
    const double right = expected->GetComponent(k, band);
    difference += weight * std::pow(found->GetComponent(k, band) - right, 2.0);
    whole += weight * right * right;
  }
  return std::sqrt(difference / whole);
}

//------------------------------------------------------------------------------
/// The largest difference in constant light between the two sides of a seam, of the mean.
double GetJump(vtkPolyData* surface)
{
  vtkDataArray* values = surface->GetPointData()->GetArray(Scattered);
  std::map<Point, double> known;
  double jump = 0.0;
  double sum = 0.0;
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    Point place;
    surface->GetPoint(point, place.data());
    const double value = values->GetComponent(point, 2);
    sum += value;
    jump = std::max(jump, std::abs(value - known.emplace(place, value).first->second));
  }
  return jump * static_cast<double>(surface->GetNumberOfPoints()) / sum;
}

//------------------------------------------------------------------------------
// Against the surface's own result: back on its cells, in constant light, across seams and in sum.
void TestRefinement()
{
  double last[3] = { 1.0, 1.0, 1.0 };
  for (const int resolution : { 16, 32 })
  {
    const std::string side = std::to_string(resolution) + " texels a side";
    auto surface = MakeSphere(resolution);
    auto filter = MakeFilter(surface);
    filter->Update();
    vtkPolyData* expected = filter->GetPolyDataOutput();
    auto texels = Scatter(ToAtlas(surface, resolution));
    vtkNew<vtkAtlasToSurface> back;
    back->SetInputData(0, surface);
    back->SetInputData(1, texels);
    back->Update();
    const double differences[3] = { GetDifference(
                                      back->GetOutput()->GetCellData()->GetArray(Scattered),
                                      expected->GetCellData()->GetArray(Scattered), nullptr, 0),
      GetDifference(texels->GetPointData()->GetArray(Scattered),
        ToAtlas(expected, resolution)->GetPointData()->GetArray(Scattered),
        texels->GetPointData()->GetArray("Area"), 2),
      GetJump(back->GetOutput()) };
    std::cout << side << ": on cells " << differences[0] << ", in constant light " << differences[1]
              << ", across seams " << differences[2] << std::endl;
    const double factors[3] = { 0.4, 0.6, 0.8 };
    for (int k = 0; k < 3; ++k)
    {
      Check(differences[k] < (resolution > 16 ? factors[k] * last[k] : 0.08),
        side + " are nearer to the surface: " + std::to_string(differences[k]));
      last[k] = differences[k];
    }
    CheckClose(GetSummary(texels, "EnteringFlux"), GetSummary(expected, "EnteringFlux"), 1e-9,
      side + ": what enters");
    CheckClose(GetSummary(texels, "LeavingFlux"), GetSummary(expected, "LeavingFlux"), 1e-3,
      side + ": what leaves");
  }
}
#endif
} // namespace

//------------------------------------------------------------------------------
int TestTexelScattering(int, char*[])
{
  TestShapes();
  TestSheet();
  TestGaps();
  TestTree();
  TestBlocks();
  TestErrors();
#ifdef TEST_WITH_MESHING
  TestRefinement();
#endif
  // The last: from there on there is one thread.
  TestRanks();
  return Result();
}
