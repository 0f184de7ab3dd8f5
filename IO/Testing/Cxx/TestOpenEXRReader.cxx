// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Files written by the OpenEXR library itself: where each pixel, channel and window goes.
#include "OpenEXRTestTools.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <cstdlib>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
constexpr int XMin = 10;
constexpr int XMax = 16;
constexpr int YMin = 20;
constexpr int YMax = 24;
constexpr int Width = XMax - XMin + 1;
constexpr int Height = YMax - YMin + 1;

// Small integers, so that half holds them exactly; a different one for each place and channel.
float GetPixel(int x, int y, std::size_t channel)
{
  return static_cast<float>(1 + x + 40 * y + 7 * static_cast<int>(channel));
}

//------------------------------------------------------------------------------
// Alternately half and float channels, with a display window larger than the data window.
void WriteFile(const std::string& path, const std::vector<std::string>& channels, bool tiled)
{
  const Imath::Box2i data({ XMin, YMin }, { XMax, YMax });
  Imf::Header header(Imath::Box2i({ 0, 0 }, { 99, 49 }), data);
  Imf::FrameBuffer source;
  std::vector<std::vector<half>> halves(channels.size());
  std::vector<std::vector<float>> floats(channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c)
  {
    for (int y = YMin; y <= YMax; ++y)
    {
      for (int x = XMin; x <= XMax; ++x)
      {
        halves[c].push_back(half(GetPixel(x, y, c)));
        floats[c].push_back(GetPixel(x, y, c));
      }
    }
    const bool isHalf = c % 2 == 0;
    const Imf::PixelType type = isHalf ? Imf::HALF : Imf::FLOAT;
    const void* values = isHalf ? static_cast<void*>(halves[c].data()) : floats[c].data();
    header.channels().insert(channels[c], Imf::Channel(type));
    source.insert(channels[c], Imf::Slice::Make(type, values, data));
  }
  if (tiled)
  {
    header.setTileDescription(Imf::TileDescription(4, 3));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    return;
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(source);
  file.writePixels(Height);
}

//------------------------------------------------------------------------------
bool CheckArray(vtkImageData* image, const char* name, const std::vector<std::size_t>& channels)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  bool good = Check(array && array->GetDataType() == VTK_FLOAT &&
      array->GetNumberOfComponents() == static_cast<int>(channels.size()) &&
      array->GetNumberOfTuples() == Width * Height,
    std::string("float array ") + name + " with its components");
  if (!good)
  {
    return false;
  }
  for (int y = YMin; y <= YMax; ++y)
  {
    for (int x = XMin; x <= XMax; ++x)
    {
      // The file counts rows from the top, VTK from the bottom.
      int place[3] = { x, YMin + YMax - y, 0 };
      const vtkIdType point = image->ComputePointId(place);
      for (std::size_t k = 0; k < channels.size(); ++k)
      {
        good &= array->GetComponent(point, static_cast<int>(k)) == GetPixel(x, y, channels[k]);
      }
    }
  }
  return Check(good, std::string("values of array ") + name);
}

//------------------------------------------------------------------------------
bool CheckFile(const std::string& path, bool tiled)
{
  const std::vector<std::string> channels = { "A", "B", "G", "R", "depth", "skin.B", "skin.G",
    "skin.R", "bands.0", "bands.1", "bands.2", "lone.1", "Y" };
  WriteFile(path, channels, tiled);
  vtkNew<vtkOpenEXRReader> reader;
  bool good = Check(reader->CanReadFile(path.c_str()) == 3, "CanReadFile");
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const int expected[6] = { XMin, XMax, YMin, YMax, 0, 0 };
  good &= Check(std::equal(expected, expected + 6, image->GetExtent()), "extent = data window");
  good &= CheckArray(image, "RGBA", { 3, 2, 1, 0 });
  good &= CheckArray(image, "depth", { 4 });
  good &= CheckArray(image, "skin", { 7, 6, 5 });
  good &= CheckArray(image, "bands", { 8, 9, 10 });
  good &= CheckArray(image, "lone.1", { 11 });
  good &= CheckArray(image, "Y", { 12 });
  good &= Check(image->GetPointData()->GetNumberOfArrays() == 6, "no array twice");
  good &= Check(image->GetPointData()->GetScalars() == image->GetPointData()->GetArray("RGBA"),
    "colours are the scalars");
  // The top row, y = 20, lies 29 rows above the display window's bottom, y = 49.
  good &= Check(image->GetOrigin()[1] + YMax == 49 - YMin, "place in the display window");
  vtkDataArray* window = image->GetFieldData()->GetArray("DisplayWindow");
  good &= Check(window && window->GetComponent(0, 1) == 99 && window->GetComponent(0, 3) == 49,
    "the display window is kept");
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRReader(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRReader.exr");
  bool good = CheckFile(path, false);
  good &= CheckFile(path, true);

  vtkNew<vtkOpenEXRReader> reader;
  WriteFile(path, { "B", "G", "R" }, false);
  reader->SetFileName(path.c_str());
  reader->Update();
  good &= CheckArray(reader->GetOutput(), "RGB", { 2, 1, 0 });
  WriteFile(path, { "G", "R", "Y" }, false);
  reader->Modified();
  reader->Update();
  good &= CheckArray(reader->GetOutput(), "G", { 0 });
  good &= Check(std::string(reader->GetOutput()->GetPointData()->GetScalars()->GetName()) == "Y",
    "Y scalars");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
