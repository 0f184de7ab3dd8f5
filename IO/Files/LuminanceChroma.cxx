// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/LuminanceChroma.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace LightTransport
{
namespace
{
constexpr int FilterWidth = Imf::RgbaYca::N;
constexpr int HalfFilter = Imf::RgbaYca::N2;

//------------------------------------------------------------------------------
// What red, green and blue add to the luminance.
Imath::V3f FindWeights(const Imf::Header& header)
{
  const Imath::V3f weights = Imf::RgbaYca::computeYw(
    Imf::hasChromaticities(header) ? Imf::chromaticities(header) : Imf::Chromaticities());
  if (!std::isfinite(weights.x) || !std::isfinite(weights.y) || !std::isfinite(weights.z) ||
    weights.y == 0.0f)
  {
    throw Iex::InputExc("its chromaticities are no colours, so that luminance and chroma cannot be "
                        "converted; save it with valid ones or as R, G, B");
  }
  return weights;
}
} // namespace

//------------------------------------------------------------------------------
LuminanceChroma::LuminanceChroma(const Imf::Header& header, const ChannelGroup& group,
  const Imath::Box2i& window, Imf::FrameBuffer& target)
  : Weights(FindWeights(header)), Width(window.max.x - window.min.x + 1),
    Height(window.max.y - window.min.y + 1), Components(static_cast<int>(group.Channels.size()))
{
  const Imf::ChannelList& channels = header.channels();
  this->IsSubsampled = channels.findChannel(group.Channels[0])->xSampling > 1;
  this->MayExceedHalf = channels.findChannel(group.Channels[1])->type == Imf::FLOAT;
  this->Pixels.assign(static_cast<std::size_t>(this->Width) *
      static_cast<std::size_t>(this->Height),
    Imf::Rgba(0.0f, 0.0f, 0.0f, 1.0f));
  Imf::Rgba& first = this->Pixels.front();
  const std::array<half*, 4> components = { &first.r, &first.g, &first.b, &first.a };
  for (int i = 0; i < this->Components; ++i)
  {
    const Imf::Channel& channel = *channels.findChannel(group.Channels[i]);
    const std::size_t step = BytesPerPixel * channel.xSampling;
    const std::size_t rowStep = BytesPerPixel * this->Width * channel.ySampling;
    target.insert(group.Channels[i],
      Imf::Slice::Make(Imf::HALF, components[i], window, step, rowStep, channel.xSampling,
        channel.ySampling));
  }
}

//------------------------------------------------------------------------------
// Beyond the image the nearest row that has chroma, the even ones.
const Imf::Rgba* LuminanceChroma::GetRow(int row) const
{
  const int inside = row < 0 ? 0 : (row < this->Height ? row : this->Height - 2);
  return this->Pixels.data() + static_cast<std::size_t>(inside) * this->Width;
}

//------------------------------------------------------------------------------
// Chroma between that of the even rows.
void LuminanceChroma::SpreadAlongRows()
{
  std::vector<Imf::Rgba> padded(static_cast<std::size_t>(this->Width) + FilterWidth - 1);
  for (int row = 0; row < this->Height; row += 2)
  {
    Imf::Rgba* pixels = this->Pixels.data() + static_cast<std::size_t>(row) * this->Width;
    std::fill_n(padded.begin(), HalfFilter, pixels[0]);
    std::copy_n(pixels, this->Width, padded.begin() + HalfFilter);
    std::fill_n(padded.begin() + HalfFilter + this->Width, HalfFilter, pixels[this->Width - 2]);
    Imf::RgbaYca::reconstructChromaHoriz(this->Width, padded.data(), pixels);
  }
}

//------------------------------------------------------------------------------
// The colours of a row, or of the one before the first or behind the last.
std::vector<Imf::Rgba> LuminanceChroma::MakeColors(int row) const
{
  std::vector<Imf::Rgba> colors(this->Width);
  if (!this->IsSubsampled || row % 2 == 0)
  {
    Imf::RgbaYca::YCAtoRGBA(this->Weights, this->Width, this->GetRow(row), colors.data());
    return colors;
  }
  std::array<const Imf::Rgba*, FilterWidth> rows;
  for (int i = 0; i < FilterWidth; ++i)
  {
    rows[i] = this->GetRow(row - HalfFilter + i);
  }
  Imf::RgbaYca::reconstructChromaVert(this->Width, rows.data(), colors.data());
  Imf::RgbaYca::YCAtoRGBA(this->Weights, this->Width, colors.data(), colors.data());
  return colors;
}

//------------------------------------------------------------------------------
void LuminanceChroma::Convert(float* colors)
{
  if (this->MayExceedHalf &&
    std::any_of(this->Pixels.begin(), this->Pixels.end(),
      [](const Imf::Rgba& pixel) { return !pixel.g.isFinite(); }))
  {
    throw Iex::InputExc("its luminance has values above 65504 or not finite, which are not "
                        "converted; save the image as R, G, B");
  }
  if (this->IsSubsampled)
  {
    this->SpreadAlongRows();
  }
  std::array<std::vector<Imf::Rgba>, 3> rows;
  std::vector<Imf::Rgba> fixed(this->Width);
  for (int row = 0; row < this->Height; ++row)
  {
    if (this->IsSubsampled)
    {
      for (int i = 0; i < 3; ++i)
      {
        rows[i] = row > 0 && i < 2 ? std::move(rows[i + 1]) : this->MakeColors(row + i - 1);
      }
      const std::array<const Imf::Rgba*, 3> three = { rows[0].data(), rows[1].data(),
        rows[2].data() };
      Imf::RgbaYca::fixSaturation(this->Weights, this->Width, three.data(), fixed.data());
    }
    else
    {
      fixed = this->MakeColors(row);
    }
    for (const Imf::Rgba& color : fixed)
    {
      const std::array<float, 4> values = { color.r, color.g, color.b, color.a };
      colors = std::copy_n(values.begin(), this->Components, colors);
    }
  }
}
} // namespace LightTransport
