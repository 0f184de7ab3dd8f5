// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Files of every kind cut at every length, with every byte of their header and table of offsets
// overwritten, and files that promise far more than they hold: each is read as a sound image or
// gives one error, and none needs much memory.
#include "OpenEXRTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkOpenEXRWriter.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedIntArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#define OPENEXR_TEST_MEMORY_LIMIT 0
#elif defined(__linux__)
#include <sys/resource.h>
#define OPENEXR_TEST_MEMORY_LIMIT 1
#else
#define OPENEXR_TEST_MEMORY_LIMIT 0
#endif

using namespace OpenEXRTestTools;

namespace
{
//------------------------------------------------------------------------------
// Lets the process take this much more than it has; what needs more then says so in its error.
void LimitMemory(std::size_t more)
{
#if OPENEXR_TEST_MEMORY_LIMIT
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr std::size_t pageSize = 4096;
  const rlim_t limit = pages * pageSize + more;
  const rlimit limits{ limit, limit };
  setrlimit(RLIMIT_AS, &limits);
#else
  static_cast<void>(more);
#endif
}

//------------------------------------------------------------------------------
// A reader of one file name, which counts its errors.
class Probe
{
public:
  explicit Probe(const std::string& path)
  {
    vtkNew<vtkCallbackCommand> counter;
    counter->SetClientData(this);
    counter->SetCallback(
      [](vtkObject*, unsigned long, void* probe, void* text)
      {
        static_cast<Probe*>(probe)->Errors += 1;
        static_cast<Probe*>(probe)->Text = static_cast<const char*>(text);
      });
    this->Reader->AddObserver(vtkCommand::ErrorEvent, counter);
    vtkNew<vtkTest::ErrorObserver> executiveObserver;
    this->Reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executiveObserver);
    this->Reader->SetFileName(path.c_str());
  }

  /// Whether the file gives one error, or all arrays of an image, and memory sufficed.
  bool Read(bool mustFail = false)
  {
    this->Errors = 0;
    this->Text.clear();
    this->Reader->Modified();
    this->Reader->Update();
    vtkImageData* image = this->Reader->GetOutput();
    if (this->Errors > 0)
    {
      return this->Errors == 1 && image->GetNumberOfPoints() == 0 &&
        this->Text.find("alloc") == std::string::npos &&
        this->Text.find("memory") == std::string::npos;
    }
    bool good = !mustFail && image->GetNumberOfPoints() > 0;
    for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
    {
      good &= image->GetPointData()->GetArray(i)->GetNumberOfTuples() == image->GetNumberOfPoints();
    }
    return good;
  }

  const std::string& GetText() const { return this->Text; }
  void SetMemoryLimit(int limit) { this->Reader->SetMemoryLimit(limit); }

private:
  vtkNew<vtkOpenEXRReader> Reader;
  int Errors = 0;
  std::string Text;
};

//------------------------------------------------------------------------------
std::string Load(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

//------------------------------------------------------------------------------
void Save(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

//------------------------------------------------------------------------------
void WriteSmall(const std::string& path, int compression, bool tiled, bool levels)
{
  const int extent[6] = { -1, 6, 2, 5, 0, 0 };
  const vtkSmartPointer<vtkImageData> image = MakeImage(extent, 3);
  vtkNew<vtkUnsignedIntArray> ids;
  ids->SetName("Ids");
  ids->SetNumberOfTuples(32);
  ids->Fill(3);
  image->GetPointData()->AddArray(ids);
  vtkNew<vtkOpenEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->SetCompression(compression);
  writer->SetPixelType(
    tiled ? vtkOpenEXRWriter::PIXEL_TYPE_FLOAT : vtkOpenEXRWriter::PIXEL_TYPE_HALF);
  writer->SetTiled(tiled);
  writer->SetMipLevels(levels);
  writer->SetTileSize(4);
  writer->Write();
}

//------------------------------------------------------------------------------
void WriteRipmap(const std::string& path)
{
  Imf::Header header(6, 4);
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  header.setTileDescription(Imf::TileDescription(4, 4, Imf::RIPMAP_LEVELS, Imf::ROUND_UP));
  const std::vector<float> pixels(24, 2.0f);
  Imf::FrameBuffer source;
  source.insert("Y", Imf::Slice::Make(Imf::HALF, pixels.data(), header.dataWindow(), 2, 8));
  Imf::TiledOutputFile file(path.c_str(), header);
  file.setFrameBuffer(source);
  for (int y = 0; y < file.numYLevels(); ++y)
  {
    for (int x = 0; x < file.numXLevels(); ++x)
    {
      file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
    }
  }
}

//------------------------------------------------------------------------------
void WriteParts(const std::string& path)
{
  std::vector<Imf::Header> headers(2, Imf::Header(4, 3));
  headers[0].setName("one");
  headers[1].setName("two");
  const std::vector<float> pixels(12, 2.0f);
  for (Imf::Header& header : headers)
  {
    header.setType(Imf::SCANLINEIMAGE);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
  for (int i = 0; i < 2; ++i)
  {
    Imf::OutputPart part(file, i);
    Imf::FrameBuffer source;
    source.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), headers[i].dataWindow()));
    part.setFrameBuffer(source);
    part.writePixels(3);
  }
}

//------------------------------------------------------------------------------
// Where the header ends: with the last attribute's value and a zero.
std::size_t FindHeaderEnd(const std::string& file)
{
  const std::string lastAttribute("screenWindowWidth\0float\0", 24);
  return file.find(lastAttribute) + lastAttribute.size() + 4 + 4 + 1;
}

//------------------------------------------------------------------------------
// Shorter and shorter: a file of one part without its last byte is no longer whole.
bool TestLengths(const std::string& path, Probe& probe, const std::string& what,
  std::size_t shortest, bool mustFail)
{
  bool good = true;
  for (std::size_t length = std::filesystem::file_size(path); length-- > shortest;)
  {
    std::filesystem::resize_file(path, length);
    good &= Check(probe.Read(mustFail),
      what + " cut to " + std::to_string(length) + ": " + probe.GetText());
  }
  return good;
}

//------------------------------------------------------------------------------
// All bytes of header and offsets, or all after the header.
bool TestBytes(const std::string& path, Probe& probe, const std::string& what, std::size_t first)
{
  const std::string whole = Load(path);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t place, char value)
  {
    file.seekp(static_cast<std::streamoff>(place));
    file.put(value);
    file.flush();
  };
  bool good = true;
  constexpr std::size_t sampled = 900;
  for (std::size_t i = first; i < whole.size(); i += i < sampled ? 1 : 5)
  {
    for (const char value : { '\0', '\xff', static_cast<char>(whole[i] ^ '\x80') })
    {
      put(i, value);
      good &= Check(probe.Read(), what + ", byte " + std::to_string(i) + ": " + probe.GetText());
    }
    put(i, whole[i]);
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestKind(const std::string& path, const std::string& what, bool newHeader, bool wholeNeeded)
{
  Probe probe(path);
  const std::size_t first = newHeader ? 0 : FindHeaderEnd(Load(path));
  bool good = Check(probe.Read() && probe.GetText().empty(), what + " as it was written");
  good &= TestBytes(path, probe, what, first);
  good &= Check(probe.Read() && probe.GetText().empty(), what + " after repair");
  good &= TestLengths(path, probe, what, first, wholeNeeded);
  return good;
}

//------------------------------------------------------------------------------
// Overwrites the value of an attribute of a file.
std::string Patch(std::string file, const std::string& attribute, std::size_t skip,
  const std::vector<int>& values)
{
  const std::size_t place = file.find(attribute) + skip;
  std::memcpy(&file[place], values.data(), values.size() * sizeof(int));
  return file;
}

//------------------------------------------------------------------------------
// 30,000 x 30,000 pixels of three half and one integer channel, in a file that is a byte too short
// for them at its compression's best, and in one that is long enough but has no pixels.
bool TestPromises(const std::string& path)
{
  struct Limit
  {
    int Compression;
    double Ratio;
    double Lines;
  };
  bool good = true;
  for (const Limit& limit : { Limit{ vtkOpenEXRWriter::COMPRESSION_NONE, 1.0, 1.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_RLE, 64.0, 1.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_ZIPS, 1032.0, 1.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_ZIP, 1032.0, 16.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_PIZ, 454.0, 32.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_PXR24, 1376.0, 16.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_B44A, 11.0, 32.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_DWAA, 66048.0, 32.0 },
         Limit{ vtkOpenEXRWriter::COMPRESSION_DWAB, 66048.0, 256.0 } })
  {
    WriteSmall(path, limit.Compression, false, false);
    const std::size_t toWindow = std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    const std::string file = Patch(Load(path), "dataWindow", toWindow, { 0, 0, 29999, 29999 });
    const std::size_t header = FindHeaderEnd(file);
    const double chunks = std::ceil(30000.0 / limit.Lines);
    const double data =
      std::max(std::ceil(30000.0 * 30000.0 * 10.0 / limit.Ratio), chunks) + chunks * 16.0;
    Save(path, file.substr(0, header));
    const std::size_t length = header + static_cast<std::size_t>(data);
    const std::string what = "a promise with compression " + std::to_string(limit.Compression);
    Probe probe(path);
    std::filesystem::resize_file(path, length - 1);
    good &= Check(probe.Read(true) &&
        probe.GetText().find("too short for the image") != std::string::npos,
      what + ", one byte too short: " + probe.GetText());
    std::filesystem::resize_file(path, length);
    good &= Check(probe.Read(true) && probe.GetText().find("incomplete") != std::string::npos,
      what + ", without offsets: " + probe.GetText());
  }
  std::filesystem::remove(path);
  return good;
}

//------------------------------------------------------------------------------
// 45,000 x 45,000 pixels of which all chunks are the same few bytes: long enough for what DWAB can
// do, and more memory than is wanted, or than there is.
bool TestBomb(const std::string& path)
{
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_DWAB, false, false);
  const std::size_t toWindow = std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
  const std::string file = Patch(Load(path), "dataWindow", toWindow, { 0, 0, 44999, 44999 });
  std::string bomb = file.substr(0, FindHeaderEnd(file));
  constexpr std::uint64_t chunks = (45000 + 255) / 256;
  const std::uint64_t offset = bomb.size() + 8 * chunks;
  for (std::uint64_t i = 0; i < chunks; ++i)
  {
    bomb.append(reinterpret_cast<const char*>(&offset), sizeof(offset));
  }
  const int chunk[2] = { 0, 40 };
  bomb.append(reinterpret_cast<const char*>(chunk), sizeof(chunk));
  Save(path, bomb + std::string(400000, '\0'));
  Probe probe(path);
  bool good = true;
  probe.Read(true);
  good &= Check(probe.GetText().find("more than MemoryLimit") != std::string::npos,
    "a bomb: " + probe.GetText());
  probe.SetMemoryLimit(std::numeric_limits<int>::max());
  probe.Read(true);
  good &= Check(!probe.GetText().empty() &&
      probe.GetText().find("more than MemoryLimit") == std::string::npos,
    "a bomb without a limit: " + probe.GetText());
  return good;
}

//------------------------------------------------------------------------------
// Attributes of which the value is longer or shorter than they say: the library would read others
// there, of any size.
bool TestAttributeSizes(const std::string& path)
{
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_ZIP, false, false);
  const std::string whole = Load(path);
  Probe probe(path);
  bool good = true;
  const auto expectError = [&](const std::string& content, const std::string& what)
  {
    Save(path, content);
    const bool refused = probe.Read(true);
    good &=
      Check(refused && probe.GetText().find("another size than its type") != std::string::npos,
        what + ": " + probe.GetText());
  };
  const auto makeAttribute =
    [&](const std::string& type, const std::vector<std::uint32_t>& words, int size)
  {
    std::string attribute = "aaa" + std::string(1, '\0') + type + std::string(1, '\0');
    attribute.append(reinterpret_cast<const char*>(&size), sizeof(size));
    attribute.append(reinterpret_cast<const char*>(words.data()), words.size() * 4);
    return std::string(whole).insert(8, attribute);
  };
  expectError(makeAttribute("float", { 1, 2 }, 8), "a float of 8 bytes");
  expectError(makeAttribute("preview", { 20000, 20000, 0 }, 12), "a preview without pixels");
  expectError(makeAttribute("stringvector", { 2000000000, 0 }, 8), "a huge string in a list");
  expectError(makeAttribute("chlist", { 0, 0 }, 8), "channels with something behind");
  // The pixels of these are no longer where the table of offsets says, which is found later.
  for (const std::string& content : { makeAttribute("stringvector", { 4, 0x61616161 }, 8),
         makeAttribute("preview", { 1, 1, 0 }, 12) })
  {
    Save(path, content);
    probe.Read();
    good &= Check(probe.GetText().find("another size than its type") == std::string::npos,
      "attributes of the right size");
  }
  return good;
}

//------------------------------------------------------------------------------
bool TestTileSizes(const std::string& path)
{
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_ZIP, true, false);
  const std::string whole = Load(path);
  const std::size_t toTiles = std::strlen("tiles") + 1 + std::strlen("tiledesc") + 1 + 4;
  Probe probe(path);
  bool good = true;
  const int largest = std::numeric_limits<int>::max();
  for (const std::vector<int>& size :
    { std::vector<int>{ 65536, 65536 }, { 8, largest }, { largest, largest }, { -1, -1 } })
  {
    Save(path, Patch(whole, "tiles", toTiles, size));
    good &= Check(probe.Read(true), "huge tiles: " + probe.GetText());
  }
  Save(path, Patch(whole, "tiles", toTiles, { 0, 4 }));
  good &= Check(probe.Read(true) && probe.GetText().find("tile size") != std::string::npos,
    "empty tiles: " + probe.GetText());
  return good;
}

//------------------------------------------------------------------------------
// Chunks that should begin within the header or behind the end.
bool TestOffsets(const std::string& path)
{
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_ZIPS, false, false);
  const std::string whole = Load(path);
  Probe probe(path);
  bool good = true;
  for (const int offset : { 8, static_cast<int>(whole.size()) - 7, -1 })
  {
    Save(path, Patch(whole, whole.substr(FindHeaderEnd(whole), 8), 0, { offset, 0 }));
    good &= Check(probe.Read(true) &&
        probe.GetText().find("where the file has none") != std::string::npos,
      "a chunk at " + std::to_string(offset) + ": " + probe.GetText());
  }
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenEXRHostile(int argc, char* argv[])
{
  const std::string path = GetPath(argc, argv, "TestOpenEXRHostile.exr");
  // Beyond what fits in any file: the buffers of one chunk, which the reader allows 64 MiB each.
  LimitMemory(std::size_t(512) << 20);
  bool good = true;
  for (int compression = 0; compression <= vtkOpenEXRWriter::COMPRESSION_DWAB; ++compression)
  {
    WriteSmall(path, compression, false, false);
    good &=
      TestKind(path, "lines, compression " + std::to_string(compression), compression == 0, true);
  }
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_PIZ, true, false);
  good &= TestKind(path, "tiles", true, true);
  WriteSmall(path, vtkOpenEXRWriter::COMPRESSION_DWAA, true, true);
  good &= TestKind(path, "mip levels", true, true);
  WriteRipmap(path);
  good &= TestKind(path, "a ripmap", true, true);
  WriteParts(path);
  good &= TestKind(path, "two parts", true, false);
  good &= TestPromises(path);
  good &= TestBomb(path);
  good &= TestAttributeSizes(path);
  good &= TestTileSizes(path);
  good &= TestOffsets(path);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
