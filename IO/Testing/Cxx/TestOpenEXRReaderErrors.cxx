// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Truncated, damaged, hostile and missing files: an error by name each, an empty output, no crash,
// no huge allocation.
#include "OpenEXRTestTools.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkOpenEXRReader.h"
#include "vtkOpenEXRWriter.h"
#include "vtkTestErrorObserver.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

using namespace OpenEXRTestTools;

namespace
{
//------------------------------------------------------------------------------
void Save(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

//------------------------------------------------------------------------------
// Reads, and wants the output empty after an error whose text holds `message`.
bool ExpectError(const char* path, const std::string& message, const std::string& what)
{
  vtkNew<vtkOpenEXRReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> executiveObserver;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
  reader->SetFileName(path);
  reader->Update();
  bool good = Check(observer->GetError(), "an error for " + what);
  good &= Check(observer->CheckErrorMessage(message) == 0, what + " says: " + message);
  good &= Check(reader->GetOutput()->GetNumberOfPoints() == 0, "no output for " + what);
  good &= Check(reader->GetErrorCode() != vtkErrorCode::NoError, "an error code for " + what);
  return good;
}

//------------------------------------------------------------------------------
std::string MakeFile(const std::string& path, int compression)
{
  const int extent[6] = { 0, 63, 0, 99, 0, 0 };
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(MakeImage(extent, 3));
  writer->SetFileName(path.c_str());
  writer->SetCompression(compression);
  writer->Write();
  std::ifstream stream(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

//------------------------------------------------------------------------------
bool TestTruncated(const std::string& path)
{
  bool good = true;
  for (const int compression : { vtkOpenEXRWriter::COMPRESSION_NONE,
         vtkOpenEXRWriter::COMPRESSION_ZIP, vtkOpenEXRWriter::COMPRESSION_PIZ })
  {
    const std::string whole = MakeFile(path, compression);
    std::vector<std::size_t> lengths = { 4, 8, whole.size() - 1 };
    for (std::size_t tenth = 1; tenth < 10; ++tenth)
    {
      lengths.push_back(whole.size() * tenth / 10);
    }
    for (const std::size_t length : lengths)
    {
      Save(path, whole.substr(0, length));
      good &= ExpectError(path.c_str(), "Cannot read the OpenEXR file",
        "compression " + std::to_string(compression) + " cut at " + std::to_string(length));
    }
  }
  return good;
}

//------------------------------------------------------------------------------
// Replaces the value of an attribute of a good file.
std::string Patch(std::string file, const std::string& attribute, std::size_t skip,
  const std::vector<int>& values)
{
  const std::size_t place = file.find(attribute) + skip;
  std::memcpy(&file[place], values.data(), values.size() * sizeof(int));
  return file;
}

//------------------------------------------------------------------------------
bool TestHostile(const std::string& path)
{
  const std::string whole = MakeFile(path, vtkOpenEXRWriter::COMPRESSION_ZIP);
  bool good = true;
  // The value follows the name, its zero, the type, its zero, and the size.
  const std::size_t toWindow = std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
  Save(path, Patch(whole, "dataWindow", toWindow, { 0, 0, 99999999, 19 }));
  good &= ExpectError(path.c_str(), "too short for the image", "a huge width");
  Save(path, Patch(whole, "dataWindow", toWindow, { 0, 0, 63, 2000000000 }));
  good &= ExpectError(path.c_str(), "too short for the image", "a huge height");
  Save(path, Patch(whole, "dataWindow", toWindow, { 63, 99, 0, 0 }));
  good &= ExpectError(path.c_str(), "the data window is empty", "a reversed window");
  Save(path,
    Patch(whole, "dataWindow", toWindow, { -2147483647 - 1, -2147483647 - 1, 2147483647, 0 }));
  good &= ExpectError(path.c_str(), "the data window is empty or larger", "the largest window");
  Save(path, Patch(whole, "dataWindow", toWindow - 4, { 2000000000 }));
  good &= ExpectError(path.c_str(), "ends within its header", "a huge attribute");
  Save(path, Patch(whole, "dataWindow", toWindow - 4, { -1 }));
  good &= ExpectError(path.c_str(), "negative size", "a negative size");
  Save(path, Patch(whole, "channels", std::strlen("channels") + 8 + 4 + 2, { 77 }));
  good &= ExpectError(path.c_str(), "unknown pixel type", "an unknown pixel type");
  Save(path, Patch(whole, "\x02", 0, { 0x802 }));
  good &= ExpectError(path.c_str(), "deep images are not supported", "a deep image");
  return good;
}

//------------------------------------------------------------------------------
// Single damaged bytes: whatever is read, nothing may crash. Errors are neither wanted nor
// unwanted.
void TestDamaged(const std::string& path)
{
  const std::string whole = MakeFile(path, vtkOpenEXRWriter::COMPRESSION_PIZ);
  for (std::size_t i = 0; i < 400; ++i)
  {
    std::string damaged = whole;
    damaged[i * 997 % (i % 2 ? whole.size() : 400)] ^= static_cast<char>(1 + i * 37 % 255);
    Save(path, damaged);
    vtkNew<vtkOpenEXRReader> reader;
    vtkNew<vtkTest::ErrorObserver> observer;
    reader->AddObserver(vtkCommand::ErrorEvent, observer);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
    reader->SetFileName(path.c_str());
    reader->Update();
  }
}

//------------------------------------------------------------------------------
bool TestSubsampled(const std::string& path)
{
  Imf::Header header(4, 4);
  header.channels().insert("RY", Imf::Channel(Imf::FLOAT, 2, 2));
  const std::vector<float> values(16, 1.0f);
  Imf::FrameBuffer source;
  source.insert("RY", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 8, 2, 2));
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(4);
  }
  return ExpectError(path.c_str(), "\"RY\" is subsampled", "a subsampled channel");
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRReaderErrors(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRReaderErrors.exr");
  bool good = ExpectError(nullptr, "no file name is set", "no file name");
  good &= ExpectError((path + ".missing").c_str(), "does not exist", "a missing file");
  Save(path, "");
  good &= ExpectError(path.c_str(), "not an OpenEXR file", "an empty file");
  Save(path, std::string(5000, 'x'));
  good &= ExpectError(path.c_str(), "not an OpenEXR file", "garbage");
  Save(path, std::string("\x76\x2f\x31\x01\x02\0\0\0", 8) + std::string(5000, 'x'));
  good &= ExpectError(path.c_str(), "name of more than 255 characters", "a name without end");
  good &= TestTruncated(path);
  good &= TestHostile(path);
  good &= TestSubsampled(path);
  TestDamaged(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
