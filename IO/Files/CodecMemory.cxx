// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/CodecMemory.h"

#include "Shared/TransportMemory.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfThreading.h>
#include <ImfTileDescription.h>

#include <algorithm>

namespace LightTransport
{
namespace
{
/// Room for a block of pixels as floats, so many times: coefficients, planes, packed data, and what
/// may come out.
constexpr double CopiesOfBlock = 8.0;

//------------------------------------------------------------------------------
double CountBlockPixels(const Imf::Header& header)
{
  if (header.hasTileDescription())
  {
    const Imf::TileDescription& tiles = header.tileDescription();
    return static_cast<double>(tiles.xSize) * tiles.ySize;
  }
  constexpr double linesOfA = 32.0;
  constexpr double linesOfB = 256.0;
  const Imath::V2i size = header.dataWindow().size();
  return (size.x + 1.0) *
    std::min(size.y + 1.0, header.compression() == Imf::DWAA_COMPRESSION ? linesOfA : linesOfB);
}
} // namespace

//------------------------------------------------------------------------------
void CodecMemory::Require(const Imf::Header& header)
{
  if (header.compression() != Imf::DWAA_COMPRESSION &&
    header.compression() != Imf::DWAB_COMPRESSION)
  {
    return;
  }
  int channels = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
  {
    ++channels;
  }
  const int blocks = std::max(1, 2 * Imf::globalThreadCount());
  TransportMemory::Require(
    CopiesOfBlock * sizeof(float) * channels * blocks * CountBlockPixels(header));
}
} // namespace LightTransport
