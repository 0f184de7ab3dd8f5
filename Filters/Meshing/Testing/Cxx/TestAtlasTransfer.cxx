// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Arrays go from a surface to the texels of its atlas and back: integrals stay, constants stay
// exactly, coarse texels are means of fine ones, nothing comes from another chart. On atlases built
// by hand and on those of vtkSurfaceAtlas.
#include "AtlasTestTools.h"

#include "vtkAtlasToSurface.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <limits>

namespace
{
using meshTest::Checker;
using Surface = vtkSmartPointer<vtkPolyData>;
using Image = vtkSmartPointer<vtkImageData>;

//------------------------------------------------------------------------------
Image ToAtlas(vtkPolyData* surface, int resolution)
{
  vtkNew<vtkSurfaceToAtlas> filter;
  filter->SetInputData(surface);
  filter->SetResolution(resolution);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
Surface ToSurface(vtkPolyData* surface, vtkImageData* image)
{
  vtkNew<vtkAtlasToSurface> filter;
  filter->SetInputData(0, surface);
  filter->SetInputData(1, image);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
vtkDataArray* GetTexels(vtkImageData* image, const char* name)
{
  return image->GetPointData()->GetArray(name);
}

//------------------------------------------------------------------------------
void AddRandom(vtkDataSetAttributes* data, const char* name, int components, vtkIdType size)
{
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> random(-1.0, 3.0);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(size);
  for (vtkIdType i = 0; i < size * components; ++i)
  {
    array->SetValue(i, random(engine));
  }
  data->AddArray(array);
}

//------------------------------------------------------------------------------
template <typename Data>
void AddConstant(Data* data, const char* name, double value, vtkIdType size)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(size);
  array->Fill(value);
  data->AddArray(array);
}

//------------------------------------------------------------------------------
template <typename Function>
void AddFunction(vtkPolyData* surface, const char* name, Function&& function)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    array->InsertNextValue(function(meshTest::GetPoint(surface, i)));
  }
  surface->GetPointData()->AddArray(array);
}

//------------------------------------------------------------------------------
// More digits than the filters have, since a sum of many equal numbers loses some.
double IntegrateTexels(vtkImageData* image, const char* name, int component)
{
  vtkDataArray* areas = GetTexels(image, "Area");
  vtkDataArray* values = GetTexels(image, name);
  long double sum = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    sum += values->GetComponent(i, component) * areas->GetTuple1(i);
  }
  return static_cast<double>(sum);
}

//------------------------------------------------------------------------------
double IntegrateCells(vtkPolyData* surface, const char* name, int component)
{
  const std::vector<double> areas = atlasTest::GetCellAreas(surface);
  long double sum = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    sum += areas[i] *
      surface->GetCellData()->GetArray(name)->GetComponent(static_cast<vtkIdType>(i), component);
  }
  return static_cast<double>(sum);
}

//------------------------------------------------------------------------------
double IntegratePoints(vtkPolyData* surface, const char* name, int component)
{
  const std::vector<double> areas = atlasTest::GetCellAreas(surface);
  long double sum = 0.0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    surface->GetCellPoints(cell, size, ids);
    for (int i = 0; i < 3; ++i)
    {
      sum += areas[cell] / 3.0 *
        surface->GetPointData()->GetArray(name)->GetComponent(ids[i], component);
    }
  }
  return static_cast<double>(sum);
}

//------------------------------------------------------------------------------
void CheckAll(vtkDataArray* array, double value, const std::string& what, Checker& check)
{
  vtkIdType wrong = array ? 0 : 1;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    wrong += array->GetTuple1(i) != value;
  }
  check.Equal(static_cast<double>(wrong), 0, 0, "values that are not the constant, " + what);
}

//------------------------------------------------------------------------------
// The constant on the surface, 0 where there is none.
void CheckTexels(vtkImageData* image, const char* name, double value, const std::string& what,
  Checker& check)
{
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const bool used = GetTexels(image, "ChartId")->GetTuple1(i) >= 0;
    wrong += GetTexels(image, name)->GetTuple1(i) != (used ? value : 0.0);
    wrong += (GetTexels(image, "Area")->GetTuple1(i) > 0.0) != used;
  }
  check.Equal(static_cast<double>(wrong), 0, 0, "texels that are not the constant, " + what);
}

//------------------------------------------------------------------------------
void TestToAtlas(vtkPolyData* surface, int resolution, const std::string& what, Checker& check)
{
  const double constant = 0.1;
  AddRandom(surface->GetCellData(), "Cells", 2, surface->GetNumberOfCells());
  AddRandom(surface->GetPointData(), "Points", 3, surface->GetNumberOfPoints());
  AddConstant(surface->GetCellData(), "ConstantCells", constant, surface->GetNumberOfCells());
  AddConstant(surface->GetPointData(), "ConstantPoints", constant, surface->GetNumberOfPoints());
  Image image = ToAtlas(surface, resolution);
  CheckTexels(image, "ConstantCells", constant, "cells, " + what, check);
  CheckTexels(image, "ConstantPoints", constant, "points, " + what, check);
  const double area = meshTest::GetArea(surface);
  check.Equal(IntegrateTexels(image, "ConstantCells", 0) / constant / area, 1.0, 1e-12,
    "area of all texels, " + what);
  check.Equal(GetTexels(image, "Cells")->GetNumberOfComponents(), 2, 0, "components, " + what);
  for (int i = 0; i < 2; ++i)
  {
    check.Equal(IntegrateTexels(image, "Cells", i) / area,
      IntegrateCells(surface, "Cells", i) / area, 1e-12, "mean of cells, " + what);
  }
  for (int i = 0; i < 3; ++i)
  {
    check.Equal(IntegrateTexels(image, "Points", i) / area,
      IntegratePoints(surface, "Points", i) / area, 1e-12, "mean of points, " + what);
  }
}

//------------------------------------------------------------------------------
void TestToSurface(vtkPolyData* surface, int resolution, const std::string& what, Checker& check)
{
  const double constant = 0.1;
  Image image = ToAtlas(surface, resolution);
  AddRandom(image->GetPointData(), "Texels", 3, image->GetNumberOfPoints());
  AddConstant(image->GetPointData(), "Constant", constant, image->GetNumberOfPoints());
  Surface result = ToSurface(surface, image);
  CheckAll(result->GetCellData()->GetArray("Constant"), constant, "texels to cells, " + what,
    check);
  CheckAll(result->GetPointData()->GetArray("Constant"), constant, "texels to points, " + what,
    check);
  check.True(!result->GetPointData()->HasArray("Area") && !result->GetCellData()->HasArray("Area"),
    "texel maps stay behind, " + what);
  const double area = meshTest::GetArea(surface);
  for (int i = 0; i < 3; ++i)
  {
    const double expected = IntegrateTexels(image, "Texels", i) / area;
    check.Equal(IntegrateCells(result, "Texels", i) / area, expected, 1e-12,
      "mean of texels in cells, " + what);
    check.Equal(IntegratePoints(result, "Texels", i) / area, expected, 1e-12,
      "mean of texels in points, " + what);
  }
}

//------------------------------------------------------------------------------
// Each coarse texel is the mean of its four, weighted by area, down to one texel per chart.
void TestLevels(vtkPolyData* surface, int finest, int coarsest, Checker& check)
{
  Image fine = ToAtlas(surface, finest);
  for (int resolution = finest / 2; resolution >= coarsest; resolution /= 2)
  {
    Image coarse = ToAtlas(surface, resolution);
    double worst = 0.0;
    int mixed = 0;
    for (vtkIdType texel = 0; texel < coarse->GetNumberOfPoints(); ++texel)
    {
      const vtkIdType corner = 2 * (texel % resolution) + 4 * resolution * (texel / resolution);
      const vtkIdType children[4] = { corner, corner + 1, corner + 2 * resolution,
        corner + 2 * resolution + 1 };
      for (const char* name : { "Position", "Cells", "Points" })
      {
        for (int i = 0; i < GetTexels(coarse, name)->GetNumberOfComponents(); ++i)
        {
          double area = 0.0;
          double sum = 0.0;
          for (const vtkIdType child : children)
          {
            area += GetTexels(fine, "Area")->GetTuple1(child);
            sum += GetTexels(fine, "Area")->GetTuple1(child) *
              GetTexels(fine, name)->GetComponent(child, i);
          }
          const double own = GetTexels(coarse, "Area")->GetTuple1(texel);
          worst = std::max(worst, std::abs(own - area));
          worst =
            std::max(worst, std::abs(own * GetTexels(coarse, name)->GetComponent(texel, i) - sum));
        }
      }
      for (const vtkIdType child : children)
      {
        mixed += GetTexels(fine, "ChartId")->GetTuple1(child) !=
          GetTexels(coarse, "ChartId")->GetTuple1(texel);
      }
    }
    check.Equal(worst, 0.0, 1e-11, "difference to the mean of four finer texels");
    check.Equal(mixed, 0, 0, "texels whose chart is not that of the finer ones");
    fine = coarse;
  }
}

//------------------------------------------------------------------------------
// In a plane, the mean of a linear function is its value at the center.
void TestPlane(Checker& check)
{
  Surface square = atlasTest::MakeSquare(13, 0.2);
  const auto linear = [](const meshTest::Vector& p) { return 0.3 + 2.0 * p[0] - 5.0 * p[1]; };
  AddFunction(square, "Linear", linear);
  const int resolution = 16;
  Image image = ToAtlas(square, resolution);
  double worst = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    meshTest::Vector center;
    image->GetPoint(i, center.data());
    // The square is 2 x 2 large.
    center = { 2.0 * center[0], 2.0 * center[1], 0.0 };
    meshTest::Vector place;
    GetTexels(image, "Position")->GetTuple(i, place.data());
    meshTest::Vector normal;
    GetTexels(image, "Normal")->GetTuple(i, normal.data());
    for (int j = 0; j < 3; ++j)
    {
      worst = std::max(worst, std::abs(place[j] - center[j]));
      worst = std::max(worst, std::abs(normal[j] - (j == 2 ? 1.0 : 0.0)));
    }
    worst = std::max(worst, std::abs(GetTexels(image, "Linear")->GetTuple1(i) - linear(center)));
    const double area = 4.0 / (resolution * resolution);
    worst = std::max(worst, std::abs(GetTexels(image, "Area")->GetTuple1(i) / area - 1.0));
  }
  check.Equal(worst, 0.0, 1e-13, "largest error in a plane");
}

//------------------------------------------------------------------------------
// Two triangles, of whose four texels the one at the origin holds 1, the others 0. In the unit
// square the hat function of the origin is 1 - max(x, y): it has 1/6 in the texel of 1/3 in all;
// that of (1, 0) is max(x - y, 0): 1/48 of 1/6; that of (1, 1) is min(x, y): 1/24 of 1/3.
void TestHatFunctions(Checker& check)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  AddConstant(image->GetPointData(), "Texel", 0.0, 4);
  GetTexels(image, "Texel")->SetComponent(0, 0, 1.0);
  Surface result = ToSurface(atlasTest::MakeSquare(1, 0.0), image);
  const double expected[4] = { 1.0 / 2.0, 1.0 / 8.0, 1.0 / 8.0, 1.0 / 8.0 };
  for (int i = 0; i < 4; ++i)
  {
    check.Equal(result->GetPointData()->GetArray("Texel")->GetTuple1(i), expected[i], 1e-15,
      "mean of point " + std::to_string(i));
  }
  for (int i = 0; i < 2; ++i)
  {
    check.Equal(result->GetCellData()->GetArray("Texel")->GetTuple1(i), 0.25, 1e-15,
      "mean of triangle " + std::to_string(i));
  }
}

//------------------------------------------------------------------------------
// Texels that hold the number of their chart: no cell and no point gets a mixture.
void TestSeams(vtkPolyData* surface, int resolution, Checker& check)
{
  Image image = ToAtlas(surface, resolution);
  vtkNew<vtkDoubleArray> colors;
  colors->DeepCopy(GetTexels(image, "ChartId"));
  colors->SetName("Color");
  image->GetPointData()->AddArray(colors);
  Surface result = ToSurface(surface, image);
  int mixed = 0;
  for (vtkIdType cell = 0; cell < result->GetNumberOfCells(); ++cell)
  {
    const double chart = result->GetCellData()->GetArray("ChartId")->GetTuple1(cell);
    mixed += result->GetCellData()->GetArray("Color")->GetTuple1(cell) != chart;
    vtkIdType size;
    const vtkIdType* ids;
    result->GetCellPoints(cell, size, ids);
    for (int i = 0; i < 3; ++i)
    {
      mixed += result->GetPointData()->GetArray("Color")->GetTuple1(ids[i]) != chart;
    }
  }
  check.Equal(mixed, 0, 0, "cells and corners with a color that is not their chart's");
}

//------------------------------------------------------------------------------
double Wave(const meshTest::Vector& p)
{
  return std::sin(2.0 * p[0] + 0.3) * std::cos(3.0 * p[1]) + 0.5 * p[2] * p[2];
}

//------------------------------------------------------------------------------
// Largest difference of a smooth function, brought to texels and back, to itself at points inside
// the charts; with two cells to a texel's side, stars of triangles are symmetric.
double GetRoundTripError(int resolution)
{
  const int cells = 2 * resolution;
  Surface surface =
    atlasTest::MakeAtlas({ { 0, 0, 1, cells, cells, atlasTest::Flat(2, 2) } }, 0, 0);
  AddFunction(surface, "Wave", Wave);
  Surface result = ToSurface(surface, ToAtlas(surface, resolution));
  double worst = 0.0;
  for (int row = 2; row < cells - 1; row += 2)
  {
    for (int column = 2; column < cells - 1; column += 2)
    {
      const vtkIdType id = column + static_cast<vtkIdType>(row) * (cells + 1);
      const double value = result->GetPointData()->GetArray("Wave")->GetTuple1(id);
      worst = std::max(worst, std::abs(value - Wave(meshTest::GetPoint(surface, id))));
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
// Largest difference of a texel to the function's value at its position, on a cylinder.
double GetTexelError(int resolution)
{
  Surface surface = atlasTest::MakeCylinder(resolution);
  AddFunction(surface, "Wave", Wave);
  Image image = ToAtlas(surface, resolution);
  double worst = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    meshTest::Vector place;
    GetTexels(image, "Position")->GetTuple(i, place.data());
    worst = std::max(worst, std::abs(GetTexels(image, "Wave")->GetTuple1(i) - Wave(place)));
  }
  return worst;
}

//------------------------------------------------------------------------------
void TestConvergence(Checker& check)
{
  for (const auto& error : { GetRoundTripError, GetTexelError })
  {
    const double coarse = error(32);
    const double fine = error(128);
    std::cout << (error == GetTexelError ? "Texels" : "Round trip") << ": error " << coarse
              << " with 32 texels a side, " << fine << " with 128\n";
    check.True(fine < coarse / 14.0,
      "the error is of second order: a quarter of the size has 1/16");
    check.True(fine > coarse / 18.0, "and not more");
  }
}

//------------------------------------------------------------------------------
void TestChoiceOfArrays(Checker& check)
{
  Surface square = atlasTest::MakeSquare(4, 0.0);
  const vtkIdType cells = square->GetNumberOfCells();
  const vtkIdType points = square->GetNumberOfPoints();
  AddConstant(square->GetCellData(), "Both", 1.0, cells);
  AddConstant(square->GetPointData(), "Both", 2.0, points);
  for (const char* name : { "OriginalCellIds", "vtkGhostType", "Area" })
  {
    AddConstant(square->GetCellData(), name, 7.0, cells);
  }
  AddRandom(square->GetCellData(), "Normals", 3, cells);
  square->GetCellData()->SetActiveAttribute("Normals", vtkDataSetAttributes::NORMALS);
  for (const char* name : { "OriginalPointIds", "Ids", "Heat" })
  {
    AddConstant(square->GetPointData(), name, 3.0, points);
  }
  square->GetPointData()->SetActiveAttribute("Ids", vtkDataSetAttributes::PEDIGREEIDS);
  square->GetPointData()->SetActiveScalars("Heat");
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->SetNumberOfTuples(cells);
  square->GetCellData()->AddArray(words);
  square->GetCellData()->GetArray("Both")->SetComponentName(0, "Red");
  Image image = ToAtlas(square, 4);
  check.Equal(image->GetPointData()->GetNumberOfArrays(), 6, 0, "texel maps and two arrays");
  CheckAll(GetTexels(image, "Both"), 1.0, "the cells' array wins", check);
  CheckAll(GetTexels(image, "Heat"), 3.0, "active scalars", check);
  check.Equal(GetTexels(image, "Area")->GetTuple1(0), 0.25, 1e-15, "the map, not the array");
  const char* red = GetTexels(image, "Both")->GetComponentName(0);
  check.True(red && std::string(red) == "Red", "names of components");
}

//------------------------------------------------------------------------------
void ExpectError(vtkAlgorithm* filter, const std::string& expected, Checker& check)
{
  vtkNew<vtkTest::ErrorObserver> executive;
  vtkNew<vtkTest::ErrorObserver> observer;
  filter->AddObserver(vtkCommand::ErrorEvent, observer);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  filter->Update();
  const std::string found = observer->GetError()
    ? observer->GetErrorMessage()
    : (executive->GetError() ? executive->GetErrorMessage() : "none");
  check.True(found.find(expected) != std::string::npos,
    "the error \"" + found + "\" says \"" + expected + "\"");
  vtkDataSet* output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  check.Equal(output->GetNumberOfPoints(), 0, 0, "points after \"" + expected + "\"");
}

//------------------------------------------------------------------------------
// The same on the charts of a real surface, from the finest texels to one per chart.
void TestBunny(int argc, char* argv[], Checker& check)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(meshTest::GetDataFile(argc, argv, "bunny.ply").c_str());
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputConnection(mesher->GetOutputPort());
  const int finest = 256;
  atlas->SetResolution(finest);
  atlas->Update();
  Surface surface = atlas->GetOutput();
  const int coarsest =
    finest >> static_cast<int>(meshTest::GetSummary(surface, "DeepestLeakFreeLevel"));
  check.True(coarsest > 1, "the bunny has several charts");
  for (const int resolution : { finest, coarsest })
  {
    const std::string what = "bunny at resolution " + std::to_string(resolution);
    TestToAtlas(surface, resolution, what, check);
    TestToSurface(surface, resolution, what, check);
    TestSeams(surface, resolution, check);
  }
  TestLevels(surface, finest, coarsest, check);
  vtkNew<vtkSurfaceToAtlas> tooCoarse;
  tooCoarse->SetInputData(surface);
  tooCoarse->SetResolution(coarsest / 2);
  const std::string size = std::to_string(coarsest);
  ExpectError(tooCoarse, "at least " + size + " x " + size, check);

  Image image = ToAtlas(surface, finest);
  for (const char* name : { "Position", "Normal", "Area", "ChartId" })
  {
    vtkDataArray* expected = GetTexels(atlas->GetMaps(), name);
    vtkIdType different = 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      for (int j = 0; j < expected->GetNumberOfComponents(); ++j)
      {
        different += GetTexels(image, name)->GetComponent(i, j) != expected->GetComponent(i, j);
      }
    }
    check.Equal(static_cast<double>(different), 0, 0,
      std::string("differences to the map that comes with the atlas, ") + name);
  }
}

//------------------------------------------------------------------------------
// What is not a number stays where it is; what has no area still has values.
void TestOddValues(Checker& check)
{
  Surface square = atlasTest::MakeSquare(8, 0.0);
  AddConstant(square->GetCellData(), "Hole", 1.0, square->GetNumberOfCells());
  square->GetCellData()->GetArray("Hole")->SetComponent(0, 0, vtkMath::Nan());
  Image image = ToAtlas(square, 8);
  int holes = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    holes += std::isnan(GetTexels(image, "Hole")->GetTuple1(i)) ? 1 : 0;
  }
  check.Equal(holes, 1, 0, "texels of a triangle whose value is NaN");
  Surface back = ToSurface(square, image);
  int cells = 0;
  for (vtkIdType i = 0; i < back->GetNumberOfCells(); ++i)
  {
    cells += std::isnan(back->GetCellData()->GetArray("Hole")->GetTuple1(i)) ? 1 : 0;
  }
  check.Equal(cells, 2, 0, "triangles in a texel that is NaN");

  Surface flat = atlasTest::MakeAtlas({ { 0, 0, 1, 3, 3, atlasTest::Flat(0, 1) } }, 0, 0.2);
  AddConstant(flat->GetPointData(), "Value", 0.1, flat->GetNumberOfPoints());
  flat->GetPoints()->InsertNextPoint(0, 0, 0);
  flat->GetPointData()->GetTCoords()->InsertNextTuple2(0.0, 0.0);
  flat->GetPointData()->GetArray("Value")->InsertNextTuple1(5.0);
  Image texels = ToAtlas(flat, 8);
  CheckAll(GetTexels(texels, "Value"), 0.1, "texels without area", check);
  Surface result = ToSurface(flat, texels);
  vtkDataArray* values = result->GetPointData()->GetArray("Value");
  check.Equal(values->GetTuple1(0), 0.1, 0, "point among triangles without area");
  check.Equal(values->GetTuple1(values->GetNumberOfTuples() - 1), 0, 0, "point without triangles");
}

//------------------------------------------------------------------------------
void TestPipeline(Checker& check)
{
  vtkNew<vtkSurfaceToAtlas> filter;
  filter->SetInputData(atlasTest::MakeCylinder(3));
  filter->UpdateInformation();
  int extent[6];
  filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  check.Equal(extent[1], 31, 0, "last column, known before execution");
  vtkNew<vtkAtlasToSurface> back;
  back->SetInputData(0, filter->GetInput());
  back->SetInputConnection(1, filter->GetOutputPort());
  back->Update();
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 1024, 0, "texels of AtlasResolution");
  filter->SetResolution(4);
  back->Update();
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 16, 0, "texels of Resolution");
  check.Equal(filter->GetOutput()->GetSpacing()[0], 0.25, 0, "spacing");
  check.Equal(filter->GetOutput()->GetOrigin()[1], 0.125, 0, "origin");
  check.True(back->GetOutput()->GetNumberOfCells() > 0, "a surface at the end");

  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  for (vtkAlgorithm* algorithm : std::vector<vtkAlgorithm*>{ filter, back })
  {
    vtkNew<vtkTest::ErrorObserver> errors;
    algorithm->AddObserver(vtkCommand::ProgressEvent, stop);
    algorithm->AddObserver(vtkCommand::ErrorEvent, errors);
    algorithm->Modified();
    algorithm->Update();
    vtkDataSet* output = vtkDataSet::SafeDownCast(algorithm->GetOutputDataObject(0));
    check.Equal(output->GetNumberOfPoints(), 0, 0, "points after an abort");
    check.True(!errors->GetError(), "an abort is no error");
    algorithm->RemoveObserver(stop);
    algorithm->SetAbortExecute(0);
    algorithm->Modified();
    algorithm->Update();
    check.True(output->GetNumberOfPoints() > 0, "points after the abort is over");
  }
}

//------------------------------------------------------------------------------
// Both filters refuse the surface.
void ExpectRefusal(vtkPolyData* surface, const std::string& expected, Checker& check)
{
  vtkNew<vtkSurfaceToAtlas> forth;
  forth->SetInputData(surface);
  forth->SetResolution(8);
  ExpectError(forth, expected, check);
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 8, 1);
  vtkNew<vtkAtlasToSurface> back;
  back->SetInputData(0, surface);
  back->SetInputData(1, image);
  ExpectError(back, expected, check);
}

//------------------------------------------------------------------------------
void TestSurfaceErrors(Checker& check)
{
  ExpectRefusal(vtkNew<vtkPolyData>(), "has no triangles", check);
  {
    Surface square = atlasTest::MakeSquare(2, 0.0);
    square->GetPointData()->Initialize();
    ExpectRefusal(square, "neither a point array \"AtlasCoordinates\"", check);
  }
  {
    Surface square = atlasTest::MakeSquare(2, 0.0);
    square->GetPolys()->InsertNextCell({ 0, 1, 4, 3 });
    square->GetCellData()->Initialize();
    square->Modified();
    ExpectRefusal(square, "Cell 8 is not a triangle", check);
  }
  {
    Surface square = atlasTest::MakeSquare(2, 0.0);
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell({ 0, 1 });
    square->SetLines(lines);
    square->GetCellData()->Initialize();
    ExpectRefusal(square, "vertices, lines or strips", check);
  }
  for (const double value : { -1e-9, 1.5, std::numeric_limits<double>::quiet_NaN() })
  {
    Surface square = atlasTest::MakeSquare(2, 0.0);
    square->GetPointData()->GetTCoords()->SetComponent(3, 0, value);
    ExpectRefusal(square, "The atlas coordinates of point 3 are (", check);
  }
  for (const double height : { 0.0, 1.0 })
  {
    // The first triangle, with corners (0, 0) and (0.5, 0), ends at point 4: as a line, or on the
    // other side of the line when those two go up.
    Surface square = atlasTest::MakeSquare(2, 0.0);
    square->GetPointData()->GetTCoords()->SetTuple2(1, 0.5, height);
    square->GetPointData()->GetTCoords()->SetTuple2(4, 0.75, 0.0);
    ExpectRefusal(square, "Triangle 0 is turned over", check);
  }
  {
    Surface cylinder = atlasTest::MakeCylinder(3);
    vtkDataArray* coordinates = cylinder->GetPointData()->GetTCoords();
    for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
    {
      coordinates->SetComponent(i, 0, 0.3 * coordinates->GetComponent(i, 0));
    }
    ExpectRefusal(cylinder, "do not end between texels", check);
  }
}

//------------------------------------------------------------------------------
void TestResolutionErrors(Checker& check)
{
  Surface mixture = atlasTest::MakeMixture();
  for (const auto& wrong : std::vector<std::pair<int, std::string>>{ { 100, "100 x 100" },
         { -4, "power of two" }, { std::numeric_limits<int>::min(), "power of two" },
         { std::numeric_limits<int>::max(), "power of two" }, { 65536, "not above 32768" },
         { 2, "at least 4 x 4" } })
  {
    vtkNew<vtkSurfaceToAtlas> filter;
    filter->SetInputData(mixture);
    filter->SetResolution(wrong.first);
    ExpectError(filter, wrong.second, check);
  }
  {
    Surface square = atlasTest::MakeSquare(2, 0.0);
    square->GetFieldData()->Initialize();
    vtkNew<vtkSurfaceToAtlas> filter;
    filter->SetInputData(square);
    ExpectError(filter, "no field data array \"AtlasResolution\"", check);
  }
  const std::vector<std::pair<std::array<int, 3>, std::string>> images = {
    { { 0, 0, 0 }, "The image has no points" }, { { 8, 16, 1 }, "8 x 16 x 1 points" },
    { { 8, 8, 8 }, "must be square and have one layer" }, { { 2, 2, 1 }, "at least 4 x 4" },
    { { 6, 6, 1 }, "power of two" }
  };
  for (const auto& wrong : images)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(wrong.first.data());
    vtkNew<vtkAtlasToSurface> filter;
    filter->SetInputData(0, mixture);
    filter->SetInputData(1, image);
    ExpectError(filter, wrong.second, check);
  }
  vtkNew<vtkAtlasToSurface> filter;
  filter->SetInputData(0, mixture);
  ExpectError(filter, "Input port 1", check);
}

//------------------------------------------------------------------------------
void TestMemory(Checker& check)
{
  Surface square = atlasTest::MakeSquare(2, 0.0);
  AddRandom(square->GetPointData(), "Many", 10000, square->GetNumberOfPoints());
  vtkNew<vtkSurfaceToAtlas> filter;
  filter->SetInputData(square);
  filter->SetResolution(32768);
  ExpectError(filter, "Maps of 32768 x 32768 texels need", check);
}

//------------------------------------------------------------------------------
// How often a filter reports; with a limit, it is aborted at the last of so many reports.
int CountReports(vtkAlgorithm* filter, int limit, Checker& check)
{
  struct Counter
  {
    int Number;
    int Limit;
  } counter{ 0, limit };
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&counter);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* reports = static_cast<Counter*>(data);
      if (++reports->Number == reports->Limit)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(true);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, command);
  filter->AddObserver(vtkCommand::ErrorEvent, observer);
  filter->Modified();
  filter->Update();
  filter->RemoveObserver(command);
  filter->RemoveObserver(observer);
  auto* output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  check.True(!observer->GetError(), "no error");
  check.True((output->GetNumberOfPoints() == 0) == (limit > 0), "no output where it is aborted");
  return counter.Number;
}

//------------------------------------------------------------------------------
// Both filters report once for so many pieces of texels, however few the triangles are.
void TestReports(Checker& check)
{
  constexpr int resolution = 1024;
  constexpr int mostPieces = 16384;
  Surface square = atlasTest::MakeSquare(1, 0.0);
  Image image = ToAtlas(square, resolution);
  image->GetPointData()->GetArray("Area")->SetName("Values");
  vtkNew<vtkSurfaceToAtlas> toAtlas;
  toAtlas->SetInputData(square);
  toAtlas->SetResolution(resolution);
  vtkNew<vtkAtlasToSurface> toSurface;
  toSurface->SetInputData(0, square);
  toSurface->SetInputData(1, image);
  for (vtkAlgorithm* filter : std::vector<vtkAlgorithm*>{ toAtlas, toSurface })
  {
    check.SetSubject(std::string("reports of ") + filter->GetClassName());
    const int reports = CountReports(filter, 0, check);
    check.True(reports >= resolution * resolution / mostPieces, std::to_string(reports));
    for (const int limit : { 2, 3, reports / 2 })
    {
      check.True(CountReports(filter, limit, check) <= limit + 1, "nothing after an abort");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestAtlasTransfer(int argc, char* argv[])
{
  Checker check;
  for (const int resolution : { 4, 32, 128 })
  {
    const std::string what = " at resolution " + std::to_string(resolution);
    for (const auto& surface : std::map<std::string, Surface>{
           { "square", atlasTest::MakeSquare(10, 0.2) }, { "pair", atlasTest::MakeSquare(1, 0.0) },
           { "cylinder", atlasTest::MakeCylinder(12) }, { "mixture", atlasTest::MakeMixture() } })
    {
      TestToAtlas(surface.second, resolution, surface.first + what, check);
      TestToSurface(surface.second, resolution, surface.first + what, check);
      TestSeams(surface.second, resolution, check);
    }
  }
  Surface mixture = atlasTest::MakeMixture();
  AddRandom(mixture->GetCellData(), "Cells", 1, mixture->GetNumberOfCells());
  AddRandom(mixture->GetPointData(), "Points", 2, mixture->GetNumberOfPoints());
  TestLevels(mixture, 64, 4, check);
  TestBunny(argc, argv, check);
  TestPlane(check);
  TestHatFunctions(check);
  TestConvergence(check);
  TestChoiceOfArrays(check);
  TestOddValues(check);
  TestPipeline(check);
  TestSurfaceErrors(check);
  TestResolutionErrors(check);
  TestMemory(check);
  TestReports(check);
  return check.GetExitCode();
}
