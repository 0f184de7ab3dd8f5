// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PixelLevels.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace LightTransport
{
namespace
{
using Reduction = WrittenChannel::Reduction;
using Size = PixelLevels::Size;

//------------------------------------------------------------------------------
std::vector<double> ReadComponent(vtkDataArray* array, int component)
{
  std::vector<double> values;
  values.reserve(array->GetNumberOfTuples());
  for (const auto tuple : vtk::DataArrayTupleRange(array))
  {
    values.push_back(tuple[component]);
  }
  return values;
}

//------------------------------------------------------------------------------
template <typename T>
const void* StoreRows(const std::vector<double>& values, const Size& size, std::vector<T>& target)
{
  target.reserve(values.size());
  for (vtkIdType row = size.Height - 1; row >= 0; --row)
  {
    const auto first = values.begin() + row * size.Width;
    std::transform(first, first + size.Width, std::back_inserter(target),
      [](double value) { return static_cast<T>(value); });
  }
  return target.data();
}

//------------------------------------------------------------------------------
// One texel over those of `fine` that begin at `first` and span `across` x `down`.
double Reduce(const std::vector<double>& fine, const std::vector<double>& weights, Reduction rule,
  vtkIdType first, vtkIdType width, const Size& span)
{
  if (rule == Reduction::First)
  {
    return fine[first];
  }
  double sum = 0.0;
  double weightedSum = 0.0;
  double weight = 0.0;
  for (vtkIdType row = 0; row < span.Height; ++row)
  {
    for (vtkIdType i = first + row * width; i < first + row * width + span.Width; ++i)
    {
      sum += fine[i];
      if (rule == Reduction::WeightedMean && weights[i] > 0.0)
      {
        weightedSum += weights[i] * fine[i];
        weight += weights[i];
      }
    }
  }
  return weight > 0.0 ? weightedSum / weight : sum / static_cast<double>(span.Width * span.Height);
}

//------------------------------------------------------------------------------
std::vector<double> Halve(const std::vector<double>& fine, const std::vector<double>& weights,
  Reduction rule, const Size& size)
{
  const Size coarse = size.GetHalf();
  const Size span{ size.Width / coarse.Width, size.Height / coarse.Height };
  std::vector<double> values;
  values.reserve(coarse.Width * coarse.Height);
  for (vtkIdType row = 0; row < coarse.Height; ++row)
  {
    for (vtkIdType column = 0; column < coarse.Width; ++column)
    {
      const vtkIdType first = row * span.Height * size.Width + column * span.Width;
      values.push_back(Reduce(fine, weights, rule, first, size.Width, span));
    }
  }
  return values;
}
} // namespace

//------------------------------------------------------------------------------
PixelLevels::Size PixelLevels::Size::GetHalf() const
{
  return { std::max<vtkIdType>(this->Width / 2, 1), std::max<vtkIdType>(this->Height / 2, 1) };
}

//------------------------------------------------------------------------------
PixelLevels::PixelLevels(std::vector<WrittenChannel> channels, vtkDataArray* weights,
  const Size& size)
  : Channels(std::move(channels)), Coarser(this->Channels.size()), LevelSize(size)
{
  if (weights)
  {
    this->Weights = ReadComponent(weights, 0);
  }
}

//------------------------------------------------------------------------------
const void* PixelLevels::Store(const std::vector<double>& values, const Size& size,
  Imf::PixelType type, StoredChannel& target)
{
  switch (type)
  {
    case Imf::HALF:
      return StoreRows(values, size, target.Halves);
    case Imf::UINT:
      return StoreRows(values, size, target.Integers);
    default:
      return StoreRows(values, size, target.Floats);
  }
}

//------------------------------------------------------------------------------
Imf::FrameBuffer PixelLevels::Take(const Imath::Box2i& window, bool further)
{
  this->Stored.clear();
  this->Stored.resize(this->Channels.size());
  Imf::FrameBuffer pixels;
  for (std::size_t i = 0; i < this->Channels.size(); ++i)
  {
    const WrittenChannel& channel = this->Channels[i];
    const std::vector<double> values = this->Coarser[i].empty()
      ? ReadComponent(channel.Source, channel.Component)
      : std::move(this->Coarser[i]);
    const std::size_t step = channel.Type == Imf::HALF ? 2 : 4;
    const void* stored = Store(values, this->LevelSize, channel.Type, this->Stored[i]);
    pixels.insert(channel.Name,
      Imf::Slice::Make(channel.Type, stored, window, step, step * this->LevelSize.Width));
    if (further)
    {
      this->Coarser[i] = Halve(values, this->Weights, channel.Rule, this->LevelSize);
    }
  }
  if (further && !this->Weights.empty())
  {
    this->Weights = Halve(this->Weights, {}, Reduction::Mean, this->LevelSize);
  }
  this->LevelSize = this->LevelSize.GetHalf();
  return pixels;
}
} // namespace LightTransport
