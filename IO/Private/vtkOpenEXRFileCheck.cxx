// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRFileCheck.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

namespace vtkOpenEXRFileCheck
{
namespace
{
constexpr std::uint32_t MagicNumber = 20000630;
constexpr std::uint32_t TiledFlag = 0x200;
constexpr std::uint32_t DeepFlag = 0x800;
constexpr std::uint32_t MultiPartFlag = 0x1000;
constexpr std::size_t LongestName = 255;

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

  std::int64_t GetRemaining() { return this->Length - static_cast<std::int64_t>(this->Position); }

  void Skip(std::int64_t count)
  {
    this->Need(count);
    this->Position += count;
    this->Stream.seekg(this->Position);
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

private:
  void Need(std::int64_t count)
  {
    if (count > this->GetRemaining())
    {
      throw Error{ Fault::Truncated, "the file is truncated: it ends within its header" };
    }
  }

  std::ifstream Stream;
  std::int64_t Length = 0;
  std::int64_t Position = 0;
};

//------------------------------------------------------------------------------
// What one header (one part of the file) promises.
struct Part
{
  bool HasChannels = false;
  bool HasWindow = false;
  bool HasTiles = false;
  std::int64_t BytesPerPixel = 0;
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t TileWidth = 0;
  std::int64_t TileHeight = 0;
  int Compression = 0;
};

// Lines in one chunk, and how much smaller than its pixels a chunk may at most be (with a margin),
// by OpenEXR's compression number.
struct CompressionLimits
{
  int Lines;
  double Ratio;
};
constexpr std::array<CompressionLimits, 10> Limits = { { { 1, 1 }, { 1, 128 }, { 1, 2048 },
  { 16, 2048 }, { 32, 2048 }, { 16, 2048 }, { 32, 64 }, { 32, 64 }, { 32, 262144 },
  { 256, 262144 } } };

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
      throw Error{ Fault::Unsupported,
        "channel \"" + name + "\" is subsampled; save the image with full-size channels" };
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
  input.Skip(1);
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
void CheckPart(const Part& part, bool tiled, std::int64_t remaining)
{
  if (!part.HasChannels || !part.HasWindow || part.BytesPerPixel == 0)
  {
    throw Error{ Fault::Damaged, "the header has no channels or no data window" };
  }
  if (part.Compression >= static_cast<int>(Limits.size()))
  {
    throw Error{ Fault::Unsupported, "the compression method is unknown" };
  }
  const CompressionLimits& limits = Limits[part.Compression];
  const bool useTiles = tiled || part.HasTiles;
  const std::int64_t chunkWidth = useTiles ? part.TileWidth : part.Width;
  const std::int64_t chunkHeight = useTiles ? part.TileHeight : limits.Lines;
  if (chunkWidth < 1 || chunkHeight < 1)
  {
    throw Error{ Fault::Damaged, "the header has no valid tile size" };
  }
  const double across = static_cast<double>((part.Width - 1) / chunkWidth + 1);
  const double down = static_cast<double>((part.Height - 1) / chunkHeight + 1);
  // At least an offset, a line number, a size and one byte of data for each chunk.
  const double leastLength = across * down * (8 + 8 + 1);
  // Whole chunks count: OpenEXR's buffers hold one even where the image is smaller.
  const double bytes = across * static_cast<double>(chunkWidth) * down *
    static_cast<double>(chunkHeight) * static_cast<double>(part.BytesPerPixel);
  constexpr double alwaysAllowed = 1 << 20;
  const double available = static_cast<double>(remaining);
  if (leastLength > available || (bytes > alwaysAllowed && bytes > limits.Ratio * available))
  {
    throw Error{ Fault::Truncated,
      "the file is truncated or damaged: it is too short for the image its header describes" };
  }
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
  if (version & DeepFlag)
  {
    throw Error{ Fault::Unsupported, "deep images are not supported; flatten the image first" };
  }
  Part part;
  while (ReadHeader(input, part))
  {
    CheckPart(part, (version & TiledFlag) != 0, input.GetRemaining());
    part = Part();
    if (!(version & MultiPartFlag))
    {
      return;
    }
  }
  if (!(version & MultiPartFlag))
  {
    throw Error{ Fault::Damaged, "the header is empty" };
  }
}
} // namespace

//------------------------------------------------------------------------------
Fault Find(const std::string& fileName, std::string& problem)
{
  try
  {
    CheckAll(fileName);
  }
  catch (const Error& error)
  {
    problem = error.Problem;
    return error.Kind;
  }
  return Fault::None;
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
} // namespace vtkOpenEXRFileCheck
