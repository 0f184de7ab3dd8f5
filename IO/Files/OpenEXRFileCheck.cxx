// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OpenEXRFileCheck.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <vector>

namespace LightTransport
{
namespace OpenEXRFileCheck
{
namespace
{
constexpr std::uint32_t MagicNumber = 20000630;
constexpr std::uint32_t TiledFlag = 0x200;
constexpr std::uint32_t DeepFlag = 0x800;
constexpr std::uint32_t MultiPartFlag = 0x1000;
constexpr std::size_t LongestName = 255;

// Thrown and caught within this file: every byte that is read may be the one that is missing, and
// returning that through all numbers and names would hide the layout that is walked over.
struct Error
{
  Fault Kind;
  std::string Problem;
};

//------------------------------------------------------------------------------
// Little-endian reading that never goes beyond the end of the file.
class Input
{
public:
  explicit Input(const std::string& fileName) : Stream(fileName, std::ios::binary)
  {
    std::error_code status;
    const std::uintmax_t length = std::filesystem::file_size(fileName, status);
    if (!this->Stream || status)
    {
      throw Error{ Fault::CannotOpen, "the file does not exist or cannot be opened" };
    }
    this->Length = static_cast<std::int64_t>(length);
  }

  std::int64_t GetLength() const { return this->Length; }
  std::int64_t GetPosition() const { return this->Position; }
  std::int64_t GetRemaining() const { return this->Length - this->Position; }

  void Skip(std::int64_t count)
  {
    this->Need(count);
    this->Seek(this->Position + count);
  }

  std::uint8_t ReadByte()
  {
    this->Need(1);
    ++this->Position;
    return static_cast<std::uint8_t>(this->Stream.get());
  }

  std::uint32_t ReadInt()
  {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8)
    {
      value |= static_cast<std::uint32_t>(this->ReadByte()) << shift;
    }
    return value;
  }

  std::int64_t ReadLong()
  {
    const std::uint64_t low = this->ReadInt();
    const std::uint64_t high = this->ReadInt();
    return static_cast<std::int64_t>(high << 32 | low);
  }

  std::string ReadName()
  {
    std::string name;
    for (std::uint8_t c = this->ReadByte(); c != 0; c = this->ReadByte())
    {
      name.push_back(static_cast<char>(c));
      if (name.size() > LongestName)
      {
        throw Error{ Fault::Damaged, "the header holds a name of more than 255 characters" };
      }
    }
    return name;
  }

  std::string ReadText(std::int64_t size)
  {
    this->Need(size);
    std::string text;
    for (std::int64_t i = 0; i < size && text.size() <= LongestName; ++i)
    {
      text.push_back(static_cast<char>(this->ReadByte()));
    }
    return text;
  }

  void Seek(std::int64_t position)
  {
    this->Position = position;
    this->Stream.seekg(position);
  }

private:
  void Need(std::int64_t count)
  {
    if (count > this->GetRemaining())
    {
      throw Error{ Fault::Truncated,
        "the file is truncated: it ends within its header or its table of offsets" };
    }
  }

  std::ifstream Stream;
  std::int64_t Length = 0;
  std::int64_t Position = 0;
};

//------------------------------------------------------------------------------
enum class LevelMode
{
  One,
  Mipmap,
  Ripmap
};

// What one header (one part of the file) promises.
struct Part
{
  bool HasChannels = false;
  bool HasWindow = false;
  bool HasTiles = false;
  std::string Type;
  std::string Subsampled;
  std::int64_t BytesPerPixel = 0;
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t TileWidth = 0;
  std::int64_t TileHeight = 0;
  LevelMode Levels = LevelMode::One;
  bool RoundUp = false;
  int Compression = 0;
};

// Lines in one chunk, and how many times larger than a chunk its pixels can be at most, by
// OpenEXR's compression number. A run of RLE turns 2 bytes into 128. Deflate turns 2 bits into 258
// bytes. PIZ's Huffman code turns 9 bits into 255 values of 2 bytes. PXR24 deflates 3 of 4 bytes.
// B44 has 3 bytes for 16 values of 2 bytes. DWA deflates runs, and for 64 values of 4 bytes two of
// 2 bytes.
struct CompressionLimits
{
  int Lines;
  double Ratio;
};
constexpr std::array<CompressionLimits, 10> Limits = { { { 1, 1 }, { 1, 64 }, { 1, 1032 },
  { 16, 1032 }, { 32, 454 }, { 16, 1376 }, { 32, 11 }, { 32, 11 }, { 32, 66048 },
  { 256, 66048 } } };
constexpr double AlwaysAllowedChunk = 1 << 26;
constexpr double AllowedChunkRatio = 4.0;

//------------------------------------------------------------------------------
void ReadChannels(Input& input, Part& part)
{
  for (std::string name = input.ReadName(); !name.empty(); name = input.ReadName())
  {
    const std::uint32_t type = input.ReadInt();
    if (type > 2)
    {
      throw Error{ Fault::Damaged, "channel \"" + name + "\" has an unknown pixel type" };
    }
    part.BytesPerPixel += type == 1 ? 2 : 4;
    input.Skip(4);
    const std::uint32_t xSampling = input.ReadInt();
    const std::uint32_t ySampling = input.ReadInt();
    if (xSampling != 1 || ySampling != 1)
    {
      part.Subsampled = name;
    }
  }
  part.HasChannels = true;
}

//------------------------------------------------------------------------------
void ReadWindow(Input& input, Part& part)
{
  std::array<std::int64_t, 4> corners;
  for (std::int64_t& value : corners)
  {
    value = static_cast<std::int32_t>(input.ReadInt());
  }
  part.Width = corners[2] - corners[0] + 1;
  part.Height = corners[3] - corners[1] + 1;
  constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
  if (part.Width < 1 || part.Height < 1 || part.Width > largest || part.Height > largest)
  {
    throw Error{ Fault::Damaged, "the data window is empty or larger than any image" };
  }
  part.HasWindow = true;
}

//------------------------------------------------------------------------------
void ReadTiles(Input& input, Part& part)
{
  part.TileWidth = input.ReadInt();
  part.TileHeight = input.ReadInt();
  const int mode = input.ReadByte();
  if (mode % 16 > static_cast<int>(LevelMode::Ripmap) || mode / 16 > 1)
  {
    throw Error{ Fault::Damaged, "the header has an unknown mode of levels" };
  }
  part.Levels = static_cast<LevelMode>(mode % 16);
  part.RoundUp = mode / 16 == 1;
  part.HasTiles = true;
}

//------------------------------------------------------------------------------
// Reads attributes up to the empty name that ends a header; false where there was none.
bool ReadHeader(Input& input, Part& part)
{
  bool any = false;
  for (std::string name = input.ReadName(); !name.empty(); name = input.ReadName())
  {
    any = true;
    const std::string type = input.ReadName();
    const std::int64_t size = static_cast<std::int32_t>(input.ReadInt());
    if (size < 0)
    {
      throw Error{ Fault::Damaged, "attribute \"" + name + "\" has a negative size" };
    }
    const std::int64_t end = input.GetRemaining() - size;
    if (name == "channels" && type == "chlist")
    {
      ReadChannels(input, part);
    }
    else if (name == "dataWindow" && type == "box2i")
    {
      ReadWindow(input, part);
    }
    else if (name == "tiles" && type == "tiledesc")
    {
      ReadTiles(input, part);
    }
    else if (name == "compression" && type == "compression")
    {
      part.Compression = input.ReadByte();
    }
    else if (name == "type" && type == "string")
    {
      part.Type = input.ReadText(size);
    }
    const std::int64_t rest = input.GetRemaining() - end;
    if (rest < 0)
    {
      throw Error{ Fault::Damaged, "attribute \"" + name + "\" is longer than its stated size" };
    }
    input.Skip(rest);
  }
  return any;
}

//------------------------------------------------------------------------------
// The tiles in one direction at each level.
std::vector<double> CountTiles(std::int64_t size, std::int64_t levelsFor, std::int64_t tileSize,
  bool roundUp)
{
  std::vector<double> counts;
  std::int64_t divisor = 1;
  for (bool last = false; !last; divisor *= 2)
  {
    const auto divide = [&](std::int64_t value) {
      return std::max<std::int64_t>(roundUp ? (value + divisor - 1) / divisor : value / divisor, 1);
    };
    counts.push_back(static_cast<double>((divide(size) - 1) / tileSize + 1));
    last = divide(levelsFor) == 1;
  }
  return counts;
}

//------------------------------------------------------------------------------
double CountChunks(const Part& part, bool tiled)
{
  if (!tiled)
  {
    const std::int64_t lines = Limits[part.Compression].Lines;
    return static_cast<double>((part.Height - 1) / lines + 1);
  }
  const std::int64_t larger = std::max(part.Width, part.Height);
  const bool ripmap = part.Levels == LevelMode::Ripmap;
  const std::vector<double> across =
    CountTiles(part.Width, ripmap ? part.Width : larger, part.TileWidth, part.RoundUp);
  const std::vector<double> down =
    CountTiles(part.Height, ripmap ? part.Height : larger, part.TileHeight, part.RoundUp);
  switch (part.Levels)
  {
    case LevelMode::One:
      return across.front() * down.front();
    case LevelMode::Mipmap:
      return std::inner_product(across.begin(), across.end(), down.begin(), 0.0);
    default:
      return std::accumulate(across.begin(), across.end(), 0.0) *
        std::accumulate(down.begin(), down.end(), 0.0);
  }
}

//------------------------------------------------------------------------------
// Whether the header is one at all, before anything is computed from it.
void CheckHeader(const Part& part, bool tiled)
{
  if (!part.HasChannels || !part.HasWindow || part.BytesPerPixel == 0)
  {
    throw Error{ Fault::Damaged, "the header has no channels or no data window" };
  }
  if (part.Compression >= static_cast<int>(Limits.size()))
  {
    throw Error{ Fault::Unsupported, "the compression method is unknown" };
  }
  if (tiled && (!part.HasTiles || part.TileWidth < 1 || part.TileHeight < 1))
  {
    throw Error{ Fault::Damaged, "the header has no valid tile size" };
  }
}

//------------------------------------------------------------------------------
void CheckSizes(const Part& part, bool tiled, double chunks, std::int64_t remaining)
{
  const Error tooShort{ Fault::Truncated,
    "the file is truncated or damaged: it is too short for the image its header describes" };
  // Each chunk has an offset, a place, a size and at least one byte of data.
  const double data = static_cast<double>(remaining) - chunks * (8 + 8);
  const CompressionLimits& limits = Limits[part.Compression];
  const double bytesPerPixel = static_cast<double>(part.BytesPerPixel);
  const double pixels =
    static_cast<double>(part.Width) * static_cast<double>(part.Height) * bytesPerPixel;
  if (data < chunks || pixels > limits.Ratio * data)
  {
    throw tooShort;
  }
  // OpenEXR's buffers hold a whole chunk even where the image is smaller.
  const std::int64_t chunkWidth = tiled ? part.TileWidth : part.Width;
  const std::int64_t chunkHeight = tiled ? part.TileHeight : limits.Lines;
  const double chunk =
    static_cast<double>(chunkWidth) * static_cast<double>(chunkHeight) * bytesPerPixel;
  if (chunk > std::max(AlwaysAllowedChunk, AllowedChunkRatio * pixels))
  {
    throw Error{ Fault::Unsupported,
      "its tiles or blocks of lines are far larger than the image; save it with smaller tiles or "
      "another compression" };
  }
}

//------------------------------------------------------------------------------
// All chunks must begin after the tables and within the file, the last one must end there too.
void CheckOffsets(Input& input, double chunks, double chunksOfAllParts, int chunkHeader)
{
  const std::int64_t tablesEnd =
    input.GetPosition() + static_cast<std::int64_t>(chunksOfAllParts) * 8;
  std::int64_t last = 0;
  for (auto i = static_cast<std::int64_t>(chunks); i > 0; --i)
  {
    const std::int64_t offset = input.ReadLong();
    if (offset == 0)
    {
      throw Error{ Fault::Truncated,
        "the file is incomplete: the program that wrote it did not finish" };
    }
    if (offset < tablesEnd || offset > input.GetLength() - chunkHeader)
    {
      throw Error{ Fault::Truncated,
        "the file is truncated or damaged: pixels should lie where the file has none" };
    }
    last = std::max(last, offset);
  }
  input.Seek(last + chunkHeader - 4);
  const std::int64_t size = static_cast<std::int32_t>(input.ReadInt());
  if (size < 0 || size > input.GetRemaining())
  {
    throw Error{ Fault::Truncated, "the file is truncated: it ends within its pixels" };
  }
}

//------------------------------------------------------------------------------
// The first part is read, so that it must be sound; OpenEXR allocates tables for all.
void CheckParts(Input& input, const std::vector<Part>& parts, std::uint32_t version)
{
  const bool multiPart = (version & MultiPartFlag) != 0;
  const auto isTiled = [&](const Part& part)
  {
    return multiPart ? (part.Type == "tiledimage" || part.Type == "deeptile")
                     : (version & TiledFlag) != 0;
  };
  double chunksOfAllParts = 0.0;
  for (const Part& part : parts)
  {
    CheckHeader(part, isTiled(part));
    chunksOfAllParts += CountChunks(part, isTiled(part));
  }
  const Part& first = parts.front();
  if (first.Type.rfind("deep", 0) == 0 || (!multiPart && (version & DeepFlag)))
  {
    throw Error{ Fault::Unsupported, "deep images are not supported; flatten the image first" };
  }
  if (!first.Subsampled.empty())
  {
    throw Error{ Fault::Unsupported,
      "channel \"" + first.Subsampled +
        "\" is subsampled; save the image with full-size channels" };
  }
  const bool tiled = isTiled(first);
  const double chunks = CountChunks(first, tiled);
  const std::int64_t remaining = input.GetRemaining();
  if (chunksOfAllParts * 8 > static_cast<double>(remaining))
  {
    throw Error{ Fault::Truncated,
      "the file is truncated or damaged: it is too short for the image its header describes" };
  }
  CheckSizes(first, tiled, chunks, remaining);
  CheckOffsets(input, chunks, chunksOfAllParts, (multiPart ? 4 : 0) + (tiled ? 20 : 8));
}

//------------------------------------------------------------------------------
void CheckAll(const std::string& fileName)
{
  Input input(fileName);
  if (input.GetRemaining() < 8 || input.ReadInt() != MagicNumber)
  {
    throw Error{ Fault::NotOpenEXR, "it is not an OpenEXR file" };
  }
  const std::uint32_t version = input.ReadInt();
  std::vector<Part> parts;
  Part part;
  while (ReadHeader(input, part))
  {
    parts.push_back(part);
    part = Part();
    if (!(version & MultiPartFlag))
    {
      break;
    }
  }
  if (parts.empty())
  {
    throw Error{ Fault::Damaged, "the header is empty" };
  }
  CheckParts(input, parts, version);
}
} // namespace

//------------------------------------------------------------------------------
Outcome Check(const std::string& fileName, Fault& fault)
{
  fault = Fault::None;
  try
  {
    CheckAll(fileName);
  }
  catch (const Error& error)
  {
    fault = error.Kind;
    return Outcome::Failed(error.Problem);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool HasMagicNumber(const std::string& fileName)
{
  try
  {
    Input input(fileName);
    return input.GetRemaining() >= 8 && input.ReadInt() == MagicNumber;
  }
  catch (const Error&)
  {
    return false;
  }
}
} // namespace OpenEXRFileCheck
} // namespace LightTransport
