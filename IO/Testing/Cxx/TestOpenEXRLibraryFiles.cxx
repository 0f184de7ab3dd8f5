// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Tiled files and files in parts that the OpenEXR library writes and vtkOpenEXRWriter never would:
// ripmaps, levels rounded up, tiles that do not divide the image, any order of lines and tiles.
#include "OpenEXRTestTools.h"

#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkTestErrorObserver.h"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <ImfTiledOutputPart.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
// Neither begin at 0 nor have a side that is a power of two or divided by the tiles; a ripmap has
// more levels in x of one, in y of the other.
const Imath::Box2i Wide({ -5, 12 }, { 21, 24 });
const Imath::Box2i Tall({ -5, 12 }, { 7, 38 });
Imath::Box2i Data = Wide;
const Imath::Box2i Display({ 0, 0 }, { 63, 47 });

//------------------------------------------------------------------------------
// Small integers, different for each level and pixel, which all types hold.
float GetPixel(int x, int y, int xLevel, int yLevel)
{
  return static_cast<float>(1000 * xLevel + 100 * yLevel + 17 * (x + 5) + 3 * (y - 12));
}

//------------------------------------------------------------------------------
std::vector<float> MakePixels(const Imath::Box2i& window, int xLevel, int yLevel)
{
  std::vector<float> pixels;
  for (int y = window.min.y; y <= window.max.y; ++y)
  {
    for (int x = window.min.x; x <= window.max.x; ++x)
    {
      pixels.push_back(GetPixel(x, y, xLevel, yLevel));
    }
  }
  return pixels;
}

//------------------------------------------------------------------------------
Imf::Header MakeHeader(Imf::LevelMode mode, Imf::LevelRoundingMode rounding, Imf::LineOrder order)
{
  Imf::Header header(Display, Data);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.lineOrder() = order;
  header.setTileDescription(Imf::TileDescription(8, 5, mode, rounding));
  return header;
}

//------------------------------------------------------------------------------
// In RANDOM_Y the tiles come in an order of their own, in the others the library sorts them.
template <typename File>
void WriteLevels(File& file)
{
  for (int yLevel = file.numYLevels() - 1; yLevel >= 0; --yLevel)
  {
    for (int xLevel = 0; xLevel < file.numXLevels(); ++xLevel)
    {
      if (!file.isValidLevel(xLevel, yLevel))
      {
        continue;
      }
      const Imath::Box2i window = file.dataWindowForLevel(xLevel, yLevel);
      const std::vector<float> pixels = MakePixels(window, xLevel, yLevel);
      Imf::FrameBuffer source;
      source.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), window));
      file.setFrameBuffer(source);
      const int across = file.numXTiles(xLevel);
      const int count = across * file.numYTiles(yLevel);
      for (int i = 0; i < count; ++i)
      {
        const int tile = (i * 7 + 3) % count;
        const int shuffled = count % 7 == 0 ? i : tile;
        file.writeTile(shuffled % across, shuffled / across, xLevel, yLevel);
      }
    }
  }
}

//------------------------------------------------------------------------------
int GetLevelSize(int size, int level, bool up)
{
  return std::max(up ? (size + (1 << level) - 1) >> level : size >> level, 1);
}

//------------------------------------------------------------------------------
bool CheckLevel(const std::string& path, int level, int xLevel, int yLevel, bool up)
{
  const vtkSmartPointer<vtkImageData> image = ReadFile(path, level);
  const int width = GetLevelSize(Data.max.x - Data.min.x + 1, xLevel, up);
  const int height = GetLevelSize(Data.max.y - Data.min.y + 1, yLevel, up);
  if (!image ||
    !Check(
      HasExtent(image, { Data.min.x, Data.min.x + width - 1, Data.min.y, Data.min.y + height - 1 }),
      "the extent of level " + std::to_string(level) + " of " + path))
  {
    return false;
  }
  bool good = true;
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      good &= pixels->GetComponent(row * width + column, 0) ==
        GetPixel(Data.min.x + column, Data.min.y + height - 1 - row, xLevel, yLevel);
    }
  }
  // The window's borders, as the file has them from the top, y turned round in the display window.
  const double bottom = image->GetOrigin()[1] + (Data.min.y - 0.5) * image->GetSpacing()[1];
  good &= Check(std::abs(bottom - (Display.max.y - Data.max.y + Display.min.y - 0.5)) < 1e-9,
    "the place of the lowest border");
  const double right = image->GetOrigin()[0] + (Data.min.x + width - 0.5) * image->GetSpacing()[0];
  good &= Check(std::abs(right - (Data.max.x + 0.5)) < 1e-9, "the place of the right border");
  return Check(good, "the pixels of level " + std::to_string(level));
}

//------------------------------------------------------------------------------
bool TestTiles(const std::string& path)
{
  bool good = true;
  for (const Imf::LevelMode mode : { Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS })
  {
    for (const Imf::LevelRoundingMode rounding : { Imf::ROUND_DOWN, Imf::ROUND_UP })
    {
      for (const Imf::LineOrder order : { Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y })
      {
        int xLevels = 0;
        int yLevels = 0;
        {
          Imf::TiledOutputFile file(path.c_str(), MakeHeader(mode, rounding, order));
          WriteLevels(file);
          xLevels = file.numXLevels();
          yLevels = file.numYLevels();
        }
        const int levels = std::max(xLevels, yLevels);
        good &= Check(CountLevels(path) == levels, "the number of levels");
        for (int level = 0; level < levels; ++level)
        {
          good &= CheckLevel(path, level, std::min(level, xLevels - 1),
            std::min(level, yLevels - 1), rounding == Imf::ROUND_UP);
        }
      }
    }
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestDecreasingLines(const std::string& path)
{
  {
    Imf::Header header(Display, Data);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.lineOrder() = Imf::DECREASING_Y;
    Imf::OutputFile file(path.c_str(), header);
    const std::vector<float> pixels = MakePixels(Data, 0, 0);
    Imf::FrameBuffer source;
    source.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), Data));
    file.setFrameBuffer(source);
    file.writePixels(Data.max.y - Data.min.y + 1);
  }
  return CheckLevel(path, 0, 0, 0, false);
}

//------------------------------------------------------------------------------
// The first part is read, whatever the others are.
bool TestParts(const std::string& path)
{
  bool good = true;
  for (const bool tilesFirst : { true, false })
  {
    Imf::Header tiles = MakeHeader(Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN, Imf::INCREASING_Y);
    tiles.setName("tiles");
    tiles.setType(Imf::TILEDIMAGE);
    Imf::Header lines(Display, Data);
    lines.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    lines.setName("lines");
    lines.setType(Imf::SCANLINEIMAGE);
    const Imf::Header headers[2] = { tilesFirst ? tiles : lines, tilesFirst ? lines : tiles };
    {
      Imf::MultiPartOutputFile file(path.c_str(), headers, 2);
      Imf::TiledOutputPart tiledPart(file, tilesFirst ? 0 : 1);
      WriteLevels(tiledPart);
      Imf::OutputPart linePart(file, tilesFirst ? 1 : 0);
      const std::vector<float> pixels = MakePixels(Data, 0, 0);
      Imf::FrameBuffer source;
      source.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), Data));
      linePart.setFrameBuffer(source);
      linePart.writePixels(Data.max.y - Data.min.y + 1);
    }
    const int levels = tilesFirst ? 5 : 1;
    good &= Check(CountLevels(path) == levels, "the levels of the first part");
    for (int level = 0; level < levels; ++level)
    {
      good &= CheckLevel(path, level, level, level, false);
    }
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestDeep(const std::string& path)
{
  Imf::Header header(4, 4);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  {
    std::vector<unsigned int> counts(16, 0);
    std::vector<float*> samples(16, nullptr);
    Imf::DeepFrameBuffer source;
    source.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 16));
    source.insert("Z",
      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), 8, 32, 4));
    Imf::DeepScanLineOutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(4);
  }
  vtkNew<vtkOpenEXRReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  reader->SetFileName(path.c_str());
  reader->Update();
  return Check(observer->GetError() &&
      observer->CheckErrorMessage("deep images are not supported") == 0,
    "a deep image is refused");
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRLibraryFiles(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRLibraryFiles.exr");
  bool good = true;
  for (const Imath::Box2i& window : { Wide, Tall })
  {
    Data = window;
    good &= TestTiles(path);
    good &= TestDecreasingLines(path);
    good &= TestParts(path);
  }
  good &= TestDeep(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
