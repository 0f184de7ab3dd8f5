// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Luminance and chroma (Y, RY = (R - Y) / Y, BY = (B - Y) / Y, mostly stored for every second pixel
 * of every second line) as red, green and blue, with the filter of OpenEXR's own RgbaInputFile,
 * which reads no part but the first. In half precision, as that.
 */
#ifndef LuminanceChroma_h
#define LuminanceChroma_h

#include "Files/ChannelGroups.h"

#include <cstddef>
#include <vector>

#include <ImathBox.h>
#include <ImathVec.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfRgba.h>

namespace LightTransport
{
class LuminanceChroma
{
public:
  static constexpr std::size_t BytesPerPixel = sizeof(Imf::Rgba);

  /// Has the pixels of `window` read.
  LuminanceChroma(const Imf::Header& header, const ChannelGroup& group, const Imath::Box2i& window,
    Imf::FrameBuffer& target);

  /// To be called once, when they have been read. Throws where half precision was not enough.
  void Convert(float* colors);

private:
  const Imf::Rgba* GetRow(int row) const;
  void SpreadAlongRows();
  std::vector<Imf::Rgba> MakeColors(int row) const;

  std::vector<Imf::Rgba> Pixels;
  Imath::V3f Weights;
  int Width;
  int Height;
  int Components;
  bool IsSubsampled;
  bool MayExceedHalf;
};
} // namespace LightTransport

#endif
