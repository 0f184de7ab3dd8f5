// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Every compression with every pixel type, in lines, tiles and mip levels: what loses nothing is
// the same to the bit, what loses stays within the error that its method allows.
#include "OpenEXRTestTools.h"

#include "vtkDataArray.h"
#include "vtkOpenEXRWriter.h"
#include "vtkUnsignedIntArray.h"

#include <half.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
constexpr int Width = 64;
constexpr int Height = 32;
enum class Storage
{
  Lines,
  Tiles,
  MipLevels
};

//------------------------------------------------------------------------------
// Smooth colours, as lossy methods are made for those; noise and large integers for what is
// lossless.
vtkSmartPointer<vtkImageData> MakeInput()
{
  const int extent[6] = { -7, Width - 8, 100, Height + 99, 0, 0 };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(const_cast<int*>(extent));
  const vtkIdType count = image->GetNumberOfPoints();
  vtkNew<vtkFloatArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(4);
  vtkNew<vtkUnsignedIntArray> ids;
  ids->SetName("Ids");
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double x = static_cast<double>(i % Width) / Width;
    const double y = static_cast<double>(i) / count;
    const double color[4] = { 0.2 + 0.7 * x * y, std::exp(3.0 * x), 0.5 + 0.4 * std::sin(5.0 * y),
      i % 5 == 0 ? 0.0 : 1.0 };
    colors->InsertNextTuple(color);
    ids->InsertNextValue(4294967295u - static_cast<unsigned int>(i * i));
  }
  image->GetPointData()->SetScalars(colors);
  image->GetPointData()->AddArray(ids);
  const vtkSmartPointer<vtkFloatArray> noise = MakeValues("Noise", 2, count);
  noise->SetValue(0, std::numeric_limits<float>::infinity());
  noise->SetValue(1, std::numeric_limits<float>::quiet_NaN());
  noise->SetValue(2, -0.0f);
  noise->SetValue(3, 3e-7f);
  image->GetPointData()->AddArray(noise);
  return image;
}

//------------------------------------------------------------------------------
bool Write(vtkImageData* image, const std::string& path, int compression, int type, Storage storage)
{
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->SetCompression(compression);
  writer->SetPixelType(type);
  writer->SetTiled(storage == Storage::Tiles);
  writer->SetMipLevels(storage == Storage::MipLevels);
  writer->SetTileSize(24);
  return Check(writer->Write() == 1, "an image is written");
}

//------------------------------------------------------------------------------
bool IsSame(vtkDataArray* expected, vtkDataArray* found)
{
  return expected->GetDataType() == found->GetDataType() &&
    expected->GetNumberOfValues() == found->GetNumberOfValues() &&
    std::memcmp(expected->GetVoidPointer(0), found->GetVoidPointer(0),
      4 * static_cast<std::size_t>(expected->GetNumberOfValues())) == 0;
}

//------------------------------------------------------------------------------
// Half values in an order in which neighbours differ by 1.
int GetOrder(double value)
{
  const std::uint16_t bits = half(static_cast<float>(value)).bits();
  return bits & 0x8000 ? 0x8000 - bits : bits;
}

//------------------------------------------------------------------------------
// B44 keeps the 15 differences between the 16 values of a block with 6 bits each, of a unit that is
// the smallest power of two which they fit in: it is below 1/15 of the largest difference, half of
// it is lost. Blocks start at the topmost row; Width, Height and the tiles are multiples of 4.
bool IsWithinB44(vtkDataArray* expected, vtkDataArray* found, int width, int height)
{
  bool good = true;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int k = 0; k < expected->GetNumberOfComponents(); ++k)
      {
        int lowest = 1 << 16;
        int highest = -(1 << 16);
        const int top = (height - 1 - y) / 4 * 4;
        for (int row = top; row < std::min(top + 4, height); ++row)
        {
          for (int column = x / 4 * 4; column < std::min(x / 4 * 4 + 4, width); ++column)
          {
            const int order =
              GetOrder(expected->GetComponent((height - 1 - row) * width + column, k));
            lowest = std::min(lowest, order);
            highest = std::max(highest, order);
          }
        }
        const int difference = std::abs(GetOrder(expected->GetComponent(y * width + x, k)) -
          GetOrder(found->GetComponent(y * width + x, k)));
        good &= difference <= (highest - lowest) / 30 + 1;
      }
    }
  }
  return good;
}

//------------------------------------------------------------------------------
// The largest difference, over the value.
double GetRelativeError(vtkDataArray* expected, vtkDataArray* found)
{
  double largest = 0.0;
  for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < expected->GetNumberOfComponents(); ++k)
    {
      const double value = expected->GetComponent(i, k);
      const double difference = std::abs(found->GetComponent(i, k) - value);
      largest = value == 0.0 ? std::max(largest, difference)
                             : std::max(largest, difference / std::abs(value));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
bool CompareColors(vtkImageData* expected, vtkImageData* found, int compression, bool half)
{
  vtkDataArray* one = expected->GetPointData()->GetArray("Colors");
  vtkDataArray* other = found->GetPointData()->GetArray("Colors");
  switch (compression)
  {
    case vtkOpenEXRWriter::COMPRESSION_PXR24:
      return half ? IsSame(one, other) : GetRelativeError(one, other) <= 1.0 / 65536.0;
    case vtkOpenEXRWriter::COMPRESSION_B44:
    case vtkOpenEXRWriter::COMPRESSION_B44A:
      return half
        ? IsWithinB44(one, other, expected->GetDimensions()[0], expected->GetDimensions()[1])
        : IsSame(one, other);
    case vtkOpenEXRWriter::COMPRESSION_DWAA:
    case vtkOpenEXRWriter::COMPRESSION_DWAB:
      // DWA promises nothing but looks; its default level keeps this gradient over two decades so.
      return GetRelativeError(one, other) <= 0.025;
    default:
      return IsSame(one, other);
  }
}

//------------------------------------------------------------------------------
// DWA loses in colours alone, B44 in half alone, PXR24 in float alone.
bool CompareNoise(vtkImageData* expected, vtkImageData* found, int compression, bool half)
{
  const bool lossy = (compression == vtkOpenEXRWriter::COMPRESSION_PXR24 && !half) ||
    ((compression == vtkOpenEXRWriter::COMPRESSION_B44 ||
       compression == vtkOpenEXRWriter::COMPRESSION_B44A) &&
      half);
  vtkDataArray* one = expected->GetPointData()->GetArray("Noise");
  vtkDataArray* other = found->GetPointData()->GetArray("Noise");
  return lossy || IsSame(one, other);
}

//------------------------------------------------------------------------------
bool TestStorage(const std::string& path, vtkImageData* input, int type, Storage storage)
{
  const bool half = type == vtkOpenEXRWriter::PIXEL_TYPE_HALF;
  bool good = Write(input, path, vtkOpenEXRWriter::COMPRESSION_NONE, type, storage);
  const int levels = CountLevels(path);
  good &= Check(levels == (storage == Storage::MipLevels ? 7 : 1), "the number of levels");
  std::vector<vtkSmartPointer<vtkImageData>> expected;
  for (int level = 0; level < levels; ++level)
  {
    expected.push_back(ReadFile(path, level));
  }
  if (!half)
  {
    for (const char* name : { "Colors", "Noise", "Ids" })
    {
      good &= Check(
        IsSame(input->GetPointData()->GetArray(name), expected[0]->GetPointData()->GetArray(name)),
        std::string("no compression: ") + name);
    }
  }
  for (int compression = 0; compression <= vtkOpenEXRWriter::COMPRESSION_DWAB; ++compression)
  {
    good &= Write(input, path, compression, type, storage);
    for (int level = 0; level < levels; ++level)
    {
      const std::string what = "compression " + std::to_string(compression) + ", pixel type " +
        std::to_string(type) + ", storage " + std::to_string(static_cast<int>(storage)) +
        ", level " + std::to_string(level) + ": ";
      const vtkSmartPointer<vtkImageData> found = ReadFile(path, level);
      const int* extent = expected[level]->GetExtent();
      good &=
        Check(HasExtent(found, { extent[0], extent[1], extent[2], extent[3] }), what + "extent");
      good &= Check(IsSame(expected[level]->GetPointData()->GetArray("Ids"),
                      found->GetPointData()->GetArray("Ids")),
        what + "integers");
      good &= Check(CompareColors(expected[level], found, compression, half), what + "colours");
      good &= Check(CompareNoise(expected[level], found, compression, half), what + "noise");
    }
  }
  return good;
}

//------------------------------------------------------------------------------
// What compresses best is far smaller than its pixels, and still a good file.
bool TestConstant(const std::string& path)
{
  const int extent[6] = { 0, 511, 0, 511, 0, 0 };
  bool good = true;
  for (const float value : { 0.0f, 1.0f })
  {
    const vtkSmartPointer<vtkImageData> image = MakeImage(extent, 4);
    image->GetPointData()->GetScalars()->Fill(value);
    for (int compression = 0; compression <= vtkOpenEXRWriter::COMPRESSION_DWAB; ++compression)
    {
      for (const int type :
        { vtkOpenEXRWriter::PIXEL_TYPE_HALF, vtkOpenEXRWriter::PIXEL_TYPE_FLOAT })
      {
        good &= Write(image, path, compression, type, Storage::Lines);
        const vtkSmartPointer<vtkImageData> found = ReadFile(path);
        double range[2] = { 0.0, -1.0 };
        if (found)
        {
          found->GetPointData()->GetScalars()->GetRange(range, 3);
        }
        good &= Check(range[0] == value && range[1] == value,
          "a constant image, compression " + std::to_string(compression) + ", " +
            std::to_string(std::filesystem::file_size(path)) + " bytes");
      }
    }
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestNames(const std::string& path)
{
  const int extent[6] = { 0, 2, 0, 1, 0, 0 };
  const vtkSmartPointer<vtkImageData> image = MakeImage(extent, 1);
  std::vector<std::string> names = { "left.diffuse.indirect", ".hidden", "trailing.", "..", " ",
    "flux W/m\xc2\xb2", "\xe5\x85\x89.\xcf\x80", std::string(255, 'x'), "Y.0", "A" };
  for (int i = 0; i < 1200; ++i)
  {
    names.push_back("band" + std::to_string(i));
  }
  for (const std::string& name : names)
  {
    image->GetPointData()->AddArray(MakeValues(name.c_str(), 1, 6));
    image->GetPointData()->GetArray(name.c_str())->SetComponent(0, 0, names.size());
  }
  image->GetPointData()->AddArray(MakeValues("\xce\xbb.spectral", 50, 6));
  bool good = true;
  for (const Storage storage : { Storage::Lines, Storage::Tiles })
  {
    good &= Write(image, path, vtkOpenEXRWriter::COMPRESSION_ZIP, 1, storage);
    const vtkSmartPointer<vtkImageData> found = ReadFile(path);
    good &= Check(found->GetPointData()->GetNumberOfArrays() == static_cast<int>(names.size()) + 2,
      "as many arrays as were written");
    for (const std::string& name : names)
    {
      vtkDataArray* array = found->GetPointData()->GetArray(name.c_str());
      good &= Check(array && IsSame(image->GetPointData()->GetArray(name.c_str()), array),
        "the channel named \"" + name + '"');
    }
    vtkDataArray* bands = found->GetPointData()->GetArray("\xce\xbb.spectral");
    good &= Check(bands && IsSame(image->GetPointData()->GetArray("\xce\xbb.spectral"), bands),
      "fifty bands");
  }
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRStorage(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRStorage.exr");
  const vtkSmartPointer<vtkImageData> input = MakeInput();
  bool good = true;
  for (const Storage storage : { Storage::Lines, Storage::Tiles, Storage::MipLevels })
  {
    for (const int type : { vtkOpenEXRWriter::PIXEL_TYPE_HALF, vtkOpenEXRWriter::PIXEL_TYPE_FLOAT })
    {
      good &= TestStorage(path, input, type, storage);
    }
  }
  good &= TestConstant(path);
  good &= TestNames(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
