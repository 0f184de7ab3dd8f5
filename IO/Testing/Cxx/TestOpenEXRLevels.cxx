// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Mip levels as vtkOpenEXRWriter computes them, against means of level 0 computed here.
#include "OpenEXRTestTools.h"

#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkOpenEXRWriter.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedIntArray.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
// What a texel over these points of an array should be.
using BlockValue = std::function<double(vtkDataArray*, const std::vector<vtkIdType>&, int)>;

//------------------------------------------------------------------------------
// The points of level 0 below point (x, y) of the level, counted from the lower left, which is
// first.
std::vector<vtkIdType> ListPoints(vtkImageData* whole, vtkImageData* level, int x, int y)
{
  const int* fine = whole->GetDimensions();
  const int* coarse = level->GetDimensions();
  const int width = fine[0] / coarse[0];
  const int height = fine[1] / coarse[1];
  std::vector<vtkIdType> points;
  for (int j = y * height; j < (y + 1) * height; ++j)
  {
    for (int i = x * width; i < (x + 1) * width; ++i)
    {
      points.push_back(static_cast<vtkIdType>(j) * fine[0] + i);
    }
  }
  return points;
}

//------------------------------------------------------------------------------
// The largest relative difference between a level's array and what `expect` makes of level 0's.
double CompareLevel(vtkImageData* whole, vtkImageData* level, const char* source, const char* name,
  const BlockValue& expect)
{
  vtkDataArray* fine = whole->GetPointData()->GetArray(source);
  vtkDataArray* coarse = level->GetPointData()->GetArray(name);
  if (!coarse || coarse->GetNumberOfComponents() != fine->GetNumberOfComponents())
  {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  const int* dimensions = level->GetDimensions();
  for (vtkIdType i = 0; i < coarse->GetNumberOfTuples(); ++i)
  {
    const std::vector<vtkIdType> points = ListPoints(whole, level,
      static_cast<int>(i % dimensions[0]), static_cast<int>(i / dimensions[0]));
    for (int k = 0; k < coarse->GetNumberOfComponents(); ++k)
    {
      const double expected = expect(fine, points, k);
      const double difference = std::abs(coarse->GetComponent(i, k) - expected);
      largest = std::max(largest, difference / std::max(std::abs(expected), 1e-3));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
double GetMean(vtkDataArray* array, const std::vector<vtkIdType>& points, int component)
{
  double sum = 0.0;
  for (const vtkIdType point : points)
  {
    sum += array->GetComponent(point, component);
  }
  return sum / static_cast<double>(points.size());
}

//------------------------------------------------------------------------------
double GetFirst(vtkDataArray* array, const std::vector<vtkIdType>& points, int component)
{
  return array->GetComponent(points.front(), component);
}

//------------------------------------------------------------------------------
BlockValue MakeWeightedMean(vtkDataArray* weights)
{
  return [weights](vtkDataArray* array, const std::vector<vtkIdType>& points, int component)
  {
    double sum = 0.0;
    double weight = 0.0;
    for (const vtkIdType point : points)
    {
      const double w = weights->GetComponent(point, 0);
      sum += w > 0.0 ? w * array->GetComponent(point, component) : 0.0;
      weight += w;
    }
    return weight > 0.0 ? sum / weight : GetMean(array, points, component);
  };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeAtlas(int width, int height)
{
  const int extent[6] = { -4, width - 5, 9, height + 8, 0, 0 };
  const vtkSmartPointer<vtkImageData> image = MakeImage(extent, 3);
  vtkPointData* points = image->GetPointData();
  const vtkIdType count = image->GetNumberOfPoints();
  points->AddArray(MakeValues("Heat", 1, count));
  vtkNew<vtkIntArray> charts;
  charts->SetName("ChartId");
  vtkNew<vtkUnsignedIntArray> patches;
  patches->SetName("PatchId");
  vtkNew<vtkDoubleArray> area;
  area->SetName("Area");
  for (vtkIdType i = 0; i < count; ++i)
  {
    charts->InsertNextValue(static_cast<int>(i * 31 % 1000));
    patches->InsertNextValue(4000000000u + static_cast<unsigned int>(i));
    area->InsertNextValue(1e-6 * static_cast<double>(1 + i * 37 % 101));
  }
  // Values where there is no surface may be anything.
  for (const vtkIdType i : { vtkIdType(0), vtkIdType(1), vtkIdType(width), vtkIdType(width + 1) })
  {
    area->SetValue(i, 0.0);
  }
  area->SetValue(width / 2, 0.0);
  points->GetArray("Heat")->SetComponent(width / 2, 0, std::nan(""));
  points->AddArray(charts);
  points->AddArray(patches);
  points->AddArray(area);
  return image;
}

//------------------------------------------------------------------------------
// A level lies over level 0: same borders of the outermost texels.
bool HasSameBorder(vtkImageData* whole, vtkImageData* level)
{
  bool good = true;
  for (int axis = 0; axis < 2; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      const auto border = [&](vtkImageData* image)
      {
        return image->GetOrigin()[axis] +
          (image->GetExtent()[2 * axis + side] + side - 0.5) * image->GetSpacing()[axis];
      };
      good &= std::abs(border(whole) - border(level)) < 1e-9;
    }
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestLevels(const std::string& path, int width, int height, bool weighted, bool half)
{
  const vtkSmartPointer<vtkImageData> atlas = MakeAtlas(width, height);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(atlas);
  writer->SetFileName(path.c_str());
  writer->MipLevelsOn();
  writer->SetTileSize(5);
  writer->SetPixelType(
    half ? vtkOpenEXRWriter::PIXEL_TYPE_HALF : vtkOpenEXRWriter::PIXEL_TYPE_FLOAT);
  writer->SetWeightArray(weighted ? "Area" : nullptr);
  bool good = Check(writer->Write() == 1, "mip levels are written");
  const int levels = CountLevels(path);
  good &= Check(levels == 1 + std::lround(std::log2(std::max(width, height))), "so many levels");
  const vtkSmartPointer<vtkImageData> whole = ReadFile(path);
  const BlockValue mean =
    weighted ? MakeWeightedMean(atlas->GetPointData()->GetArray("Area")) : BlockValue(GetMean);
  // Two roundings: of level 0's values to float before they came here, of the means to the file.
  const double allowed = half ? 1.0 / 2048.0 : 1e-7;
  for (int level = 0; level < levels; ++level)
  {
    const vtkSmartPointer<vtkImageData> image = ReadFile(path, level);
    const std::string what = std::to_string(width) + " x " + std::to_string(height) + ", level " +
      std::to_string(level) + (weighted ? ", weighted: " : ": ");
    const int w = std::max(width >> level, 1);
    const int h = std::max(height >> level, 1);
    good &= Check(HasExtent(image, { -4, w - 5, 9, h + 8 }), what + "extent");
    good &= Check(HasSameBorder(whole, image), what + "place");
    good &= Check(image->GetFieldData()->GetArray("Level")->GetComponent(0, 0) == level &&
        image->GetFieldData()->GetArray("NumberOfLevels")->GetComponent(0, 0) == levels,
      what + "field data");
    good &=
      Check(CompareLevel(atlas, image, "Scalars", "Scalars", mean) <= allowed, what + "colours");
    good &= Check(CompareLevel(atlas, image, "ChartId", "ChartId", GetFirst) == 0.0, what + "ids");
    good &=
      Check(CompareLevel(atlas, image, "PatchId", "PatchId", GetFirst) == 0.0, what + "uint ids");
    if (weighted)
    {
      good &= Check(CompareLevel(atlas, image, "Heat", "Heat", mean) <= allowed, what + "heat");
    }
    if (!half)
    {
      good &= Check(CompareLevel(atlas, image, "Area", "Area", GetMean) <= allowed, what + "area");
    }
  }
  return good;
}

//------------------------------------------------------------------------------
// What a map says of the whole surface is the same at all levels.
bool TestIntegral(const std::string& path)
{
  const vtkSmartPointer<vtkImageData> atlas = MakeAtlas(64, 64);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(atlas);
  writer->SetFileName(path.c_str());
  writer->MipLevelsOn();
  writer->SetWeightArray("Area");
  bool good = Check(writer->Write() == 1, "the atlas is written");
  double first = 0.0;
  for (int level = 0; level < 7; ++level)
  {
    const vtkSmartPointer<vtkImageData> image = ReadFile(path, level);
    vtkDataArray* colors = image->GetPointData()->GetArray("Scalars");
    vtkDataArray* area = image->GetPointData()->GetArray("Area");
    double integral = 0.0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      integral += std::pow(4.0, level) * area->GetComponent(i, 0) * colors->GetComponent(i, 1);
    }
    first = level == 0 ? integral : first;
    good &= Check(std::abs(integral / first - 1.0) < 1e-6, "the integral at each level");
  }
  return good;
}

//------------------------------------------------------------------------------
bool ExpectError(vtkAlgorithm* algorithm, const std::function<void()>& run,
  const std::string& message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  algorithm->AddObserver(vtkCommand::ErrorEvent, observer);
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  run();
  algorithm->RemoveObserver(observer);
  return Check(observer->GetError() && observer->CheckErrorMessage(message) == 0,
    "the error says: " + message);
}

//------------------------------------------------------------------------------
bool TestErrors(const std::string& path)
{
  std::filesystem::remove(path);
  vtkNew<vtkOpenEXRWriter> writer;
  const auto write = [&]() { writer->Write(); };
  writer->SetFileName(path.c_str());
  writer->MipLevelsOn();
  writer->SetInputData(MakeAtlas(24, 16));
  bool good = ExpectError(writer, write, "powers of two, not 24 x 16");
  const vtkSmartPointer<vtkImageData> atlas = MakeAtlas(16, 16);
  writer->SetInputData(atlas);
  for (const char* name : { "Missing", "Scalars", "ChartId" })
  {
    writer->SetWeightArray(name);
    good &= ExpectError(writer, write, "must be a float or double point array of one component");
  }
  writer->SetWeightArray("Heat");
  good &= ExpectError(writer, write, "negative or not finite");
  good &= Check(!std::filesystem::exists(path), "no file after an error");

  writer->SetWeightArray("Area");
  good &= Check(writer->Write() == 1, "16 x 16 texels are written");
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetLevel(5);
  good &= ExpectError(
    reader, [&]() { reader->Update(); }, "level 5 is wanted, but the last one is level 4");
  good &= Check(reader->GetOutput()->GetNumberOfPoints() == 0, "no output for a missing level");
  reader->SetLevel(4);
  reader->Update();
  good &= Check(reader->GetOutput()->GetNumberOfPoints() == 1, "the last level after that");
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRLevels(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRLevels.exr");
  bool good = true;
  for (const bool weighted : { false, true })
  {
    good &= TestLevels(path, 32, 32, weighted, false);
    good &= TestLevels(path, 32, 32, weighted, true);
    good &= TestLevels(path, 16, 64, weighted, false);
    good &= TestLevels(path, 64, 2, weighted, false);
  }
  good &= TestIntegral(path);
  good &= TestErrors(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
