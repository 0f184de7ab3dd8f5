// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkOpenEXRWriter writes, vtkOpenEXRReader reads: exactly in float, to half precision in
// half; and the writer's errors.
#include "OpenEXRTestTools.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkOpenEXRWriter.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace OpenEXRTestTools;

namespace
{
constexpr int Extent[6] = { -3, 33, 7, 71, 0, 0 };

//------------------------------------------------------------------------------
// The largest difference in units of max(|value|, smallest normal half); -1 where the arrays do not
// match at all.
double Compare(vtkDataArray* expected, vtkDataArray* found)
{
  if (!expected || !found || expected->GetNumberOfTuples() != found->GetNumberOfTuples() ||
    expected->GetNumberOfComponents() != found->GetNumberOfComponents())
  {
    return -1.0;
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < expected->GetNumberOfComponents(); ++k)
    {
      const double value = expected->GetComponent(i, k);
      const double difference = std::abs(value - found->GetComponent(i, k));
      largest = std::max(largest, difference / std::max(std::abs(value), 6.103515625e-5));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
bool TestCompression(const std::string& path, int compression, int components)
{
  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, components);
  bool good = true;
  for (const int type : { vtkOpenEXRWriter::PIXEL_TYPE_HALF, vtkOpenEXRWriter::PIXEL_TYPE_FLOAT })
  {
    vtkNew<vtkOpenEXRWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(path.c_str());
    writer->SetPixelType(type);
    writer->SetCompression(compression);
    vtkNew<vtkOpenEXRReader> reader;
    reader->SetFileName(path.c_str());
    good &= Check(writer->Write() == 1, "the writer returns 1");
    reader->Update();
    const double error = Compare(image->GetPointData()->GetScalars(),
      reader->GetOutput()->GetPointData()->GetScalars());
    // Rounding to 11 significant bits.
    const double allowed = type == vtkOpenEXRWriter::PIXEL_TYPE_HALF ? 1.0 / 2048.0 : 0.0;
    good &= Check(error >= 0.0 && error <= allowed,
      "values survive compression " + std::to_string(compression) + " with " +
        std::to_string(components) + " components, pixel type " + std::to_string(type) +
        ": difference " + std::to_string(error));
    good &= Check(std::equal(Extent, Extent + 6, reader->GetOutput()->GetExtent()), "the extent");
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestNamedChannels(const std::string& path)
{
  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, 4);
  vtkPointData* points = image->GetPointData();
  const vtkIdType count = image->GetNumberOfPoints();
  for (const int components : { 1, 2, 3, 4, 12 })
  {
    points->AddArray(MakeValues(("Layer" + std::to_string(components)).c_str(), components, count));
  }
  vtkNew<vtkUnsignedIntArray> ids;
  ids->SetName("PatchId");
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids->InsertNextValue(4294967295u - static_cast<unsigned int>(i));
  }
  points->AddArray(ids);
  vtkNew<vtkIntArray> window;
  window->SetName("DisplayWindow");
  window->SetNumberOfComponents(4);
  const int corners[4] = { -10, 100, -20, 200 };
  window->InsertNextTypedTuple(corners);
  image->GetFieldData()->AddArray(window);

  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  bool good = Check(writer->Write() == 1, "an image with many arrays is written");
  reader->Update();
  vtkImageData* result = reader->GetOutput();
  good &= Check(result->GetPointData()->GetNumberOfArrays() == points->GetNumberOfArrays(),
    "as many arrays come back as were written");
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    const std::string name = points->GetArrayName(i);
    vtkDataArray* found =
      result->GetPointData()->GetArray(name == "Scalars" ? "RGBA" : name.c_str());
    good &= Check(Compare(points->GetArray(i), found) == 0.0, "array " + name + " is the same");
  }
  good &= Check(result->GetPointData()->GetArray("PatchId")->GetDataType() == VTK_UNSIGNED_INT,
    "integers stay integers");
  vtkDataArray* windowBack = result->GetFieldData()->GetArray("DisplayWindow");
  good &= Check(Compare(window, windowBack) == 0.0, "the display window is the same");
  return good;
}

//------------------------------------------------------------------------------
bool ExpectError(vtkOpenEXRWriter* writer, const std::string& message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  bool good = Check(writer->Write() == 0, "the writer returns 0: " + message);
  good &= Check(observer->CheckErrorMessage(message) == 0, "the error says: " + message);
  writer->RemoveObserver(observer);
  return good;
}

//------------------------------------------------------------------------------
bool TestErrors(const std::string& path)
{
  std::filesystem::remove(path);
  vtkNew<vtkOpenEXRWriter> writer;
  vtkNew<vtkImageData> empty;
  writer->SetInputData(empty);
  bool good = ExpectError(writer, "no file name is set");
  writer->SetFileName(path.c_str());
  good &= ExpectError(writer, "the image is empty");

  const vtkSmartPointer<vtkImageData> image = MakeImage(Extent, 1);
  writer->SetInputData(image);
  image->GetPointData()->GetScalars()->SetComponent(5, 0, 70000.0);
  writer->SetPixelTypeToHalf();
  good &= ExpectError(writer, "values above 65504");
  writer->SetPixelTypeToFloat();

  image->GetPointData()->AddArray(MakeValues("Y", 1, image->GetNumberOfPoints()));
  good &= ExpectError(writer, "two arrays would both be written as channel \"Y\"");

  vtkNew<vtkImageData> bare;
  bare->SetDimensions(4, 4, 1);
  writer->SetInputData(bare);
  good &= ExpectError(writer, "no numeric point array");

  const int volume[6] = { 0, 3, 0, 3, 0, 3 };
  writer->SetInputData(MakeImage(volume, 1));
  good &= ExpectError(writer, "several slices");
  good &= Check(!std::filesystem::exists(path), "a failed writer leaves no file");

  writer->SetInputData(MakeImage(Extent, 3));
  writer->SetFileName((path + "/no/such/directory.exr").c_str());
  good &= ExpectError(writer, "Cannot write the OpenEXR file");
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRWriter(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRWriter.exr");
  bool good = true;
  // PXR24, B44 and DWA lose bits by design, so that they say nothing here.
  for (int compression = vtkOpenEXRWriter::COMPRESSION_NONE;
       compression <= vtkOpenEXRWriter::COMPRESSION_PIZ; ++compression)
  {
    for (const int components : { 1, 2, 3, 4 })
    {
      if (components != 2 || compression == vtkOpenEXRWriter::COMPRESSION_ZIP)
      {
        good &= TestCompression(path, compression, components);
      }
    }
  }
  good &= TestNamedChannels(path);
  good &= TestErrors(GetPath(argc, argv, "TestOpenEXRWriterErrors.exr"));
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
