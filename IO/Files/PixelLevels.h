// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The pixels that are written: an image's channels at one mip level after the other.
#ifndef PixelLevels_h
#define PixelLevels_h

#include "Files/WrittenChannels.h"

#include "vtkType.h"

#include <vector>

#include <ImathBox.h>
#include <ImfFrameBuffer.h>
#include <half.h>

namespace LightTransport
{
class PixelLevels
{
public:
  struct Size
  {
    vtkIdType Width = 0;
    vtkIdType Height = 0;

    Size GetHalf() const;
  };

  /// The first level has this size; `weights` may be null.
  PixelLevels(std::vector<WrittenChannel> channels, vtkDataArray* weights, const Size& size);

  /// The level's pixels, placed in `window`; valid until the next call. With `further` the next
  /// call gives the next level.
  Imf::FrameBuffer Take(const Imath::Box2i& window, bool further);

private:
  /// A channel's values as the file has them: its type, its order of rows.
  struct StoredChannel
  {
    std::vector<half> Halves;
    std::vector<float> Floats;
    std::vector<unsigned int> Integers;
  };
  static const void* Store(const std::vector<double>& values, const Size& size, Imf::PixelType type,
    StoredChannel& target);

  std::vector<WrittenChannel> Channels;
  std::vector<std::vector<double>> Coarser;
  std::vector<StoredChannel> Stored;
  std::vector<double> Weights;
  Size LevelSize;
};
} // namespace LightTransport

#endif
