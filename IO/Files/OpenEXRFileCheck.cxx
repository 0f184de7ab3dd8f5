// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OpenEXRFileCheck.h"

#include "Files/OpenEXRInput.h"
#include "Shared/TransportMemory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
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
  std::string Name;
  double NumberOfChannels = 0.0;
  /// In the file; a subsampled channel counts for its share.
  double BytesPerPixel = 0.0;
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
    input.Skip(4);
    const auto xSampling = static_cast<std::int32_t>(input.ReadInt());
    const auto ySampling = static_cast<std::int32_t>(input.ReadInt());
    if (xSampling < 1 || ySampling < 1)
    {
      throw Error{ Fault::Damaged, "channel \"" + name + "\" has a sampling that cannot be" };
    }
    // Luminance and chroma are read beside the colours that they become.
    const bool chroma = name.size() >= 2 && name.compare(name.size() - 2, 2, "RY") == 0;
    part.NumberOfChannels += chroma ? 3.0 : 1.0;
    part.BytesPerPixel += (type == 1 ? 2.0 : 4.0) / xSampling / ySampling;
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
// The sizes of those types that have always the same.
const std::map<std::string, std::int64_t>& GetFixedSizes()
{
  static const std::map<std::string, std::int64_t> sizes = { { "box2f", 16 }, { "box2i", 16 },
    { "chromaticities", 32 }, { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 },
    { "envmap", 1 }, { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 },
    { "m33d", 72 }, { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 },
    { "tiledesc", 9 }, { "timecode", 8 }, { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 },
    { "v3f", 12 }, { "v3i", 12 } };
  return sizes;
}

//------------------------------------------------------------------------------
// Reads as much of a value as says how long the library will find it, at most up to its end: of
// types that ReadValue does not look at.
bool HasSizeOfType(Input& input, const std::string& type, std::int64_t size)
{
  const auto fixed = GetFixedSizes().find(type);
  if (fixed != GetFixedSizes().end())
  {
    return size == fixed->second;
  }
  if (type == "preview")
  {
    constexpr std::int64_t numbers = 8;
    const std::int64_t width = size < numbers ? 0 : input.ReadInt();
    const std::int64_t height = size < numbers ? 0 : input.ReadInt();
    const std::int64_t pixels = (size - numbers) / 4;
    return size >= numbers && size % 4 == 0 &&
      (width == 0 || height == 0 ? pixels == 0 : pixels % width == 0 && pixels / width == height);
  }
  if (type == "stringvector")
  {
    std::int64_t left = size;
    while (left >= 4)
    {
      const std::int64_t length = input.ReadInt();
      left -= 4 + length;
      if (left < 0)
      {
        return false;
      }
      input.Skip(length);
    }
    return left == 0;
  }
  return type != "floatvector" || size % 4 == 0;
}

//------------------------------------------------------------------------------
// The values that the sizes follow from.
void ReadValue(Input& input, const std::string& name, const std::string& type, std::int64_t size,
  Part& part)
{
  if (type == "chlist")
  {
    Part other;
    ReadChannels(input, name == "channels" ? part : other);
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
  else if (name == "name" && type == "string")
  {
    part.Name = input.ReadText(size);
  }
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
    input.Need(size);
    const std::int64_t end = input.GetPosition() + size;
    bool good = HasSizeOfType(input, type, size);
    if (good)
    {
      ReadValue(input, name, type, size, part);
      good = input.GetPosition() <= end && (type != "chlist" || input.GetPosition() == end);
    }
    if (!good)
    {
      std::string problem = "attribute \"" + name + "\" has another size than its type \"";
      problem += type + '"';
      throw Error{ Fault::Damaged, problem };
    }
    input.Skip(end - input.GetPosition());
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
  if (!part.HasChannels || !part.HasWindow || part.BytesPerPixel == 0.0)
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
double CountPixels(const Part& part)
{
  return static_cast<double>(part.Width) * static_cast<double>(part.Height);
}

//------------------------------------------------------------------------------
// OpenEXR's buffers hold a whole chunk even where the image is smaller.
double CountChunkBytes(const Part& part, bool tiled)
{
  const std::int64_t width = tiled ? part.TileWidth : part.Width;
  const std::int64_t height = tiled ? part.TileHeight : Limits[part.Compression].Lines;
  return static_cast<double>(width) * static_cast<double>(height) * part.BytesPerPixel;
}

//------------------------------------------------------------------------------
void CheckSizes(const Part& part, bool tiled, double chunks, std::int64_t remaining)
{
  const Error tooShort{ Fault::Truncated,
    "the file is truncated or damaged: it is too short for the image its header describes" };
  // Each chunk has an offset, a place, a size and at least one byte of data.
  const double data = static_cast<double>(remaining) - chunks * (8 + 8);
  const CompressionLimits& limits = Limits[part.Compression];
  const double pixels = CountPixels(part) * part.BytesPerPixel;
  if (data < chunks || pixels > limits.Ratio * data)
  {
    throw tooShort;
  }
  const double chunk = CountChunkBytes(part, tiled);
  if (chunk > std::max(AlwaysAllowedChunk, AllowedChunkRatio * pixels))
  {
    throw Error{ Fault::Unsupported,
      "its tiles or blocks of lines are far larger than the image; save it with smaller tiles or "
      "another compression" };
  }
}

//------------------------------------------------------------------------------
// All chunks must begin after the tables and within the file, the last one must end there too.
void CheckOffsets(Input& input, double chunks, std::int64_t tablesEnd, int chunkHeader)
{
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
// Each value becomes one of 4 bytes.
void CheckMemory(const Part& part, bool tiled, const Wish& wish)
{
  const double shrinkage = tiled ? std::ldexp(1.0, -2 * std::min(wish.Level, 31)) : 1.0;
  const double needed =
    4.0 * part.NumberOfChannels * CountPixels(part) * shrinkage + CountChunkBytes(part, tiled);
  const std::string need = "it needs " + TransportMemory::Format(needed) + " of memory, ";
  if (needed > wish.MemoryLimit)
  {
    throw Error{ Fault::TooLarge,
      need + "more than MemoryLimit (" + TransportMemory::Format(wish.MemoryLimit) +
        ") lets it; raise that if there is the memory" };
  }
  const double available =
    needed > AlwaysAllowedChunk ? TransportMemory::GetAvailableBytes() : needed;
  if (needed > available)
  {
    throw Error{ Fault::TooLarge,
      need + "and " + TransportMemory::Format(available) +
        " are free; read it on a machine with more memory" };
  }
}

//------------------------------------------------------------------------------
// Which kinds of parts there are is said by their types, or where there is but one, by flags.
bool IsTiled(const Part& part, std::uint32_t version)
{
  return (version & MultiPartFlag) != 0 ? part.Type == "tiledimage" || part.Type == "deeptile"
                                        : (version & TiledFlag) != 0;
}

//------------------------------------------------------------------------------
void CheckType(const Part& part, std::uint32_t version, const Wish& wish)
{
  if ((version & MultiPartFlag) == 0 && (version & DeepFlag) != 0)
  {
    throw Error{ Fault::Unsupported, "deep images are not supported; flatten the image first" };
  }
  if (part.Type.rfind("deep", 0) == 0)
  {
    throw Error{ Fault::Unsupported,
      "deep images are not supported, and part " + std::to_string(wish.Part) + " (\"" + part.Name +
        "\", " + part.Type + ") is one; flatten it first, or choose another part" };
  }
}

//------------------------------------------------------------------------------
// The part that is read must be sound; OpenEXR allocates tables for all.
void CheckParts(Input& input, const std::vector<Part>& parts, std::uint32_t version,
  const Wish& wish)
{
  const bool multiPart = (version & MultiPartFlag) != 0;
  double chunksBefore = 0.0;
  double chunksOfAllParts = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const Part& part = parts[i];
    // Of an unknown type, OpenEXR would believe the number of chunks that it names.
    if (multiPart && part.Type != "scanlineimage" && part.Type != "tiledimage" &&
      part.Type != "deepscanline" && part.Type != "deeptile")
    {
      throw Error{ Fault::Unsupported,
        "part " + std::to_string(i) + " is of the unknown type \"" + part.Type + "\"" };
    }
    CheckHeader(part, IsTiled(part, version));
    const double chunks = CountChunks(part, IsTiled(part, version));
    chunksBefore += i < static_cast<std::size_t>(wish.Part) ? chunks : 0.0;
    chunksOfAllParts += chunks;
  }
  if (static_cast<std::size_t>(wish.Part) >= parts.size())
  {
    throw Error{ Fault::NoSuchPart,
      "part " + std::to_string(wish.Part) + " is wanted, but the last one is part " +
        std::to_string(parts.size() - 1) };
  }
  const Part& part = parts[wish.Part];
  CheckType(part, version, wish);
  const bool tiled = IsTiled(part, version);
  const double chunks = CountChunks(part, tiled);
  const std::int64_t remaining = input.GetRemaining();
  if (chunksOfAllParts * 8 > static_cast<double>(remaining))
  {
    throw Error{ Fault::Truncated,
      "the file is truncated or damaged: it is too short for the image its header describes" };
  }
  CheckSizes(part, tiled, chunks, remaining);
  const std::int64_t tables = input.GetPosition();
  input.Skip(static_cast<std::int64_t>(chunksBefore) * 8);
  CheckOffsets(input, chunks, tables + static_cast<std::int64_t>(chunksOfAllParts) * 8,
    (multiPart ? 4 : 0) + (tiled ? 20 : 8));
  CheckMemory(part, tiled, wish);
}

//------------------------------------------------------------------------------
void CheckAll(const std::string& fileName, const Wish& wish, Findings& findings)
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
  for (const Part& found : parts)
  {
    findings.PartNames.push_back(found.Name);
  }
  CheckParts(input, parts, version, wish);
}
} // namespace

//------------------------------------------------------------------------------
Outcome Check(const std::string& fileName, const Wish& wish, Findings& findings)
{
  findings = {};
  try
  {
    CheckAll(fileName, wish, findings);
  }
  catch (const Error& error)
  {
    findings.Kind = error.Kind;
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
