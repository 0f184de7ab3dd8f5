// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What other programs put into a file: several parts, luminance and chroma, ids beside numbers; and
// the name of the scalars, which comes back.
#include "OpenEXRTestTools.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkOpenEXRWriter.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedIntArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledOutputPart.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
constexpr int Width = 40;
constexpr int Height = 24;

//------------------------------------------------------------------------------
bool ExpectError(vtkOpenEXRReader* reader, const std::string& message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  reader->Update();
  bool good = Check(observer->CheckErrorMessage(message) == 0, "the error says: " + message);
  good &= Check(reader->GetErrorCode() != vtkErrorCode::NoError, "an error code: " + message);
  good &= Check(reader->GetOutput()->GetNumberOfPoints() == 0, "no output: " + message);
  reader->RemoveObserver(observer);
  reader->GetExecutive()->RemoveObserver(executiveObserver);
  return good;
}

//------------------------------------------------------------------------------
// Lines, tiles, and a deep part that stays empty.
void WriteParts(const std::string& path)
{
  std::vector<Imf::Header> headers(3, Imf::Header(8, 4));
  const char* names[] = { "beauty", "heat", "deep" };
  const std::string types[] = { Imf::SCANLINEIMAGE, Imf::TILEDIMAGE, Imf::DEEPSCANLINE };
  for (int i = 0; i < 3; ++i)
  {
    headers[i].setName(names[i]);
    headers[i].setType(types[i]);
    headers[i].compression() = Imf::ZIPS_COMPRESSION;
    headers[i].channels().insert("Y", Imf::Channel(Imf::FLOAT));
  }
  headers[1].setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 3);
  const auto makeSource = [&](const std::vector<float>& pixels, int i)
  {
    Imf::FrameBuffer source;
    source.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), headers[i].dataWindow()));
    return source;
  };
  const std::vector<float> ones(32, 1.0f);
  Imf::OutputPart lines(file, 0);
  lines.setFrameBuffer(makeSource(ones, 0));
  lines.writePixels(4);
  const std::vector<float> twos(32, 2.0f);
  Imf::TiledOutputPart tiles(file, 1);
  tiles.setFrameBuffer(makeSource(twos, 1));
  tiles.writeTiles(0, 1, 0, 0);
}

//------------------------------------------------------------------------------
bool TestParts(const std::string& path)
{
  WriteParts(path);
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  bool good = true;
  for (int part = 0; part < 2; ++part)
  {
    reader->SetPart(part);
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    vtkDataArray* values = image->GetPointData()->GetScalars();
    good &=
      Check(values && values->GetRange()[0] == part + 1.0 && values->GetRange()[1] == part + 1,
        "the pixels of part " + std::to_string(part));
    vtkFieldData* fields = image->GetFieldData();
    auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("PartNames"));
    good &= Check(reader->GetNumberOfParts() == 3 && reader->GetPartName(1) == "heat" &&
        reader->GetPartName(3).empty() && names && names->GetNumberOfValues() == 3 &&
        names->GetValue(2) == "deep" && fields->GetArray("NumberOfParts")->GetTuple1(0) == 3 &&
        fields->GetArray("Part")->GetTuple1(0) == part,
      "the list of parts");
  }
  reader->SetPart(2);
  good &= ExpectError(reader, "part 2 (\"deep\", deepscanline) is one");
  good &= Check(reader->GetNumberOfParts() == 3, "parts are listed where one cannot be read");
  reader->SetPart(3);
  good &= ExpectError(reader, "part 3 is wanted, but the last one is part 2");
  return good;
}

//------------------------------------------------------------------------------
// The same as OpenEXR's own conversion, digit by digit.
bool TestLuminanceChroma(const std::string& path, bool alpha)
{
  const Imf::RgbaChannels channels = alpha ? Imf::WRITE_YCA : Imf::WRITE_YC;
  std::vector<Imf::Rgba> pixels(std::size_t(Width) * Height);
  for (int i = 0; i < Width * Height; ++i)
  {
    const float x = static_cast<float>(i % Width) / Width;
    const float y = static_cast<float>(i / Width) / Height;
    // An edge of saturated colours beside a gradient.
    pixels[i] = x > 0.7f && y > 0.5f ? Imf::Rgba(9.0f, 0.0f, 0.1f, 0.5f)
                                     : Imf::Rgba(x, y, 0.5f * x * y + 0.1f, 1.0f - x);
  }
  const Imath::Box2i window({ -2, 6 }, { Width - 3, Height + 5 });
  {
    Imf::RgbaOutputFile file(path.c_str(), window, window, channels);
    file.setFrameBuffer(pixels.data() + 2 - 6 * Width, 1, Width);
    file.writePixels(Height);
  }
  {
    Imf::RgbaInputFile file(path.c_str());
    file.setFrameBuffer(pixels.data() + 2 - 6 * Width, 1, Width);
    file.readPixels(window.min.y, window.max.y);
  }
  const vtkSmartPointer<vtkImageData> image = ReadFile(path);
  vtkDataArray* found = image ? image->GetPointData()->GetArray(alpha ? "RGBA" : "RGB") : nullptr;
  bool good = found && found == image->GetPointData()->GetScalars();
  for (int i = 0; good && i < Width * Height; ++i)
  {
    const Imf::Rgba& expected = pixels[i];
    const vtkIdType place = vtkIdType(Height - 1 - i / Width) * Width + i % Width;
    good = found->GetComponent(place, 0) == expected.r &&
      found->GetComponent(place, 1) == expected.g && found->GetComponent(place, 2) == expected.b &&
      (!alpha || found->GetComponent(place, 3) == expected.a);
  }
  return Check(good, alpha ? "luminance, chroma and alpha" : "luminance and chroma");
}

//------------------------------------------------------------------------------
// Chroma for each pixel, in single precision: R = (RY + 1) Y, B = (BY + 1) Y, and Y is their sum.
bool TestFullChroma(const std::string& path, float luminance)
{
  Imf::Header header(4, 4);
  const std::vector<float> y(16, luminance);
  const std::vector<float> ry(16, 0.5f);
  const std::vector<float> by(16, -0.25f);
  Imf::FrameBuffer source;
  const auto add = [&](const char* name, const std::vector<float>& values)
  {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    source.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
  };
  add("Y", y);
  add("RY", ry);
  add("BY", by);
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(4);
  }
  if (luminance > 65504.0f)
  {
    vtkNew<vtkOpenEXRReader> reader;
    reader->SetFileName(path.c_str());
    return ExpectError(reader, "its luminance has values above 65504");
  }
  const vtkSmartPointer<vtkImageData> image = ReadFile(path);
  vtkDataArray* rgb = image ? image->GetPointData()->GetArray("RGB") : nullptr;
  // Of Rec. 709, OpenEXR's default.
  const double green = (1.0 - 0.2126 * 1.5 - 0.0722 * 0.75) / 0.7152;
  return Check(rgb && std::abs(rgb->GetComponent(5, 0) - 1.5 * luminance) < 1e-3 * luminance &&
      std::abs(rgb->GetComponent(5, 1) - green * luminance) < 2e-3 * luminance &&
      std::abs(rgb->GetComponent(5, 2) - 0.75 * luminance) < 1e-3 * luminance,
    "chroma of full size");
}

//------------------------------------------------------------------------------
// Ids that float would round stay what they are, whatever their channels' names.
bool TestIds(const std::string& path)
{
  Imf::Header header(2, 1);
  const std::vector<float> numbers(2, 0.5f);
  const std::vector<unsigned int> ids = { 4294967295u, 16777217u };
  Imf::FrameBuffer source;
  for (const char* name : { "R", "G", "B", "layer.0", "layer.2" })
  {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    source.insert(name, Imf::Slice::Make(Imf::FLOAT, numbers.data(), header.dataWindow()));
  }
  for (const char* name : { "A", "layer.1" })
  {
    header.channels().insert(name, Imf::Channel(Imf::UINT));
    source.insert(name, Imf::Slice::Make(Imf::UINT, ids.data(), header.dataWindow()));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(1);
  }
  const vtkSmartPointer<vtkImageData> image = ReadFile(path);
  bool good = Check(image && image->GetPointData()->GetArray("RGB"), "colours without the ids");
  for (const char* name : { "A", "layer.1" })
  {
    auto* found =
      image ? vtkUnsignedIntArray::SafeDownCast(image->GetPointData()->GetArray(name)) : nullptr;
    good &= Check(found && found->GetNumberOfComponents() == 1 && found->GetValue(0) == ids[0] &&
        found->GetValue(1) == ids[1],
      std::string("ids of channel ") + name);
  }
  return good;
}

//------------------------------------------------------------------------------
// The active array comes back with its name, whatever else looks like it.
bool TestScalarsName(const std::string& path, int components)
{
  const int extent[6] = { 0, 3, 0, 1, 0, 0 };
  const vtkSmartPointer<vtkImageData> image = MakeImage(extent, components);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars->SetName("Radiosity");
  image->GetPointData()->AddArray(MakeValues("RGB", 3, 8));
  image->GetPointData()->AddArray(MakeValues("RGBA", 4, 8));
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  const bool written = writer->Write() == 1;
  const vtkSmartPointer<vtkImageData> result = ReadFile(path);
  vtkDataArray* found = result ? result->GetPointData()->GetScalars() : nullptr;
  bool good = written && found && std::strcmp(found->GetName(), "Radiosity") == 0 &&
    found->GetNumberOfComponents() == components;
  for (vtkIdType i = 0; good && i < 8; ++i)
  {
    good = found->GetComponent(i, components - 1) == scalars->GetComponent(i, components - 1);
  }
  return Check(good, "the name of scalars of components " + std::to_string(components));
}

//------------------------------------------------------------------------------
bool TestMemoryLimit(const std::string& path)
{
  const int extent[6] = { 0, 1023, 0, 511, 0, 0 };
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(extent, 3));
  writer->SetFileName(path.c_str());
  bool good = Check(writer->Write() == 1, "an image of 6 MiB");
  vtkNew<vtkOpenEXRReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetMemoryLimit(6);
  good &= ExpectError(reader, "more than MemoryLimit");
  reader->SetMemoryLimit(7);
  reader->Update();
  return good &&
    Check(reader->GetOutput()->GetNumberOfPoints() == 1024 * 512, "with a higher limit it is read");
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRParts(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRParts.exr");
  bool good = TestParts(path);
  good &= TestLuminanceChroma(path, false);
  good &= TestLuminanceChroma(path, true);
  good &= TestFullChroma(path, 3.0f);
  good &= TestFullChroma(path, 1e5f);
  good &= TestIds(path);
  for (const int components : { 1, 2, 3, 4, 5 })
  {
    good &= TestScalarsName(path, components);
  }
  good &= TestMemoryLimit(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
