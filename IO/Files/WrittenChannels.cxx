// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WrittenChannels.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace LightTransport
{
namespace
{
constexpr double LargestHalf = 65504.0;
// Beyond these some integers fall between two numbers.
constexpr double LargestHalfInteger = 2048.0;
constexpr double LargestFloatInteger = 16777216.0;

//------------------------------------------------------------------------------
std::string GetSuffix(int component, int components)
{
  if (components == 3 || components == 4)
  {
    return std::string(1, "RGBA"[component]);
  }
  return std::to_string(component);
}

//------------------------------------------------------------------------------
bool HoldsIntegers(vtkDataArray* array)
{
  return array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
}

//------------------------------------------------------------------------------
// The largest finite magnitude.
double GetMagnitude(const WrittenChannel& channel)
{
  double range[2];
  channel.Source->GetFiniteRange(range, channel.Component);
  return range[0] > range[1] ? 0.0 : std::max(std::abs(range[0]), std::abs(range[1]));
}

//------------------------------------------------------------------------------
Imf::PixelType FindType(const WrittenChannel& channel, Imf::PixelType wanted)
{
  if (channel.Source->GetDataType() == VTK_UNSIGNED_INT)
  {
    return Imf::UINT;
  }
  const bool inexact = wanted == Imf::HALF && HoldsIntegers(channel.Source) &&
    GetMagnitude(channel) > LargestHalfInteger;
  return inexact ? Imf::FLOAT : wanted;
}

//------------------------------------------------------------------------------
Outcome CheckValues(const WrittenChannel& channel)
{
  const double magnitude = GetMagnitude(channel);
  const std::string named = "channel \"" + channel.Name + "\" has ";
  if (channel.Type == Imf::HALF && magnitude > LargestHalf)
  {
    return Outcome::Failed(
      named + "values above 65504, which half pixels cannot hold; use float pixels");
  }
  if (channel.Type == Imf::FLOAT && HoldsIntegers(channel.Source) &&
    magnitude > LargestFloatInteger)
  {
    return Outcome::Failed(named +
      "integers above 16777216, which float pixels cannot hold; make it a vtkUnsignedIntArray");
  }
  if (channel.Type == Imf::FLOAT && magnitude > std::numeric_limits<float>::max())
  {
    return Outcome::Failed(
      named + "values above 3.4e38, which float pixels cannot hold; scale them");
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
std::string WrittenChannels::GetName(vtkDataArray* array, int component, bool scalars)
{
  const int components = array->GetNumberOfComponents();
  const bool colors = components == 3 || components == 4;
  if (scalars && (components == 1 || colors))
  {
    return components == 1 ? "Y" : GetSuffix(component, components);
  }
  const std::string name = array->GetName() ? array->GetName() : (scalars ? "Scalars" : "");
  return components == 1 || name.empty() ? name : name + '.' + GetSuffix(component, components);
}

//------------------------------------------------------------------------------
Outcome WrittenChannels::CheckArrays(vtkImageData* image)
{
  vtkPointData* points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = points->GetAbstractArray(i);
    const std::string named =
      std::string("point array \"") + (array->GetName() ? array->GetName() : "") + "\" ";
    if (!vtkDataArray::SafeDownCast(array))
    {
      return Outcome::Failed(named + "holds no numbers, as pixels do; remove it from the image");
    }
    if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      return Outcome::Failed(named + "has " + std::to_string(array->GetNumberOfTuples()) +
        " values for " + std::to_string(image->GetNumberOfPoints()) +
        " points; give it one for each");
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
std::vector<WrittenChannel> WrittenChannels::List(vtkImageData* image, Imf::PixelType type,
  vtkDataArray* weights)
{
  std::vector<WrittenChannel> channels;
  vtkPointData* points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = points->GetArray(i);
    const int components = array ? array->GetNumberOfComponents() : 0;
    for (int component = 0; component < components; ++component)
    {
      WrittenChannel channel;
      channel.Name = GetName(array, component, array == points->GetScalars());
      channel.Source = array;
      channel.Component = component;
      channel.Type = FindType(channel, type);
      const bool weighted = weights && array != weights;
      channel.Rule =
        weighted ? WrittenChannel::Reduction::WeightedMean : WrittenChannel::Reduction::Mean;
      if (HoldsIntegers(array))
      {
        channel.Rule = WrittenChannel::Reduction::First;
      }
      channels.push_back(channel);
    }
  }
  return channels;
}

//------------------------------------------------------------------------------
Outcome WrittenChannels::Check(const std::vector<WrittenChannel>& channels)
{
  if (channels.empty())
  {
    return Outcome::Failed("the image has no numeric point array");
  }
  std::set<std::string> names;
  for (const WrittenChannel& channel : channels)
  {
    if (channel.Name.empty() || channel.Name.size() > 255)
    {
      return Outcome::Failed(
        "a point array's name is missing or longer than 255 characters; rename it");
    }
    if (!names.insert(channel.Name).second)
    {
      return Outcome::Failed(
        "two arrays would both be written as channel \"" + channel.Name + "\"; rename one");
    }
    if (Outcome checked = CheckValues(channel); !checked)
    {
      return checked;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome WrittenChannels::CheckWeights(vtkDataArray* weights, const std::string& name)
{
  if (!weights || weights->GetNumberOfComponents() != 1 || HoldsIntegers(weights))
  {
    return Outcome::Failed(
      "WeightArray \"" + name + "\" must be a float or double point array of one component");
  }
  const auto values = vtk::DataArrayValueRange<1>(weights);
  const bool good = std::all_of(values.begin(), values.end(),
    [](double value) { return std::isfinite(value) && value >= 0.0; });
  return good
    ? Outcome::Done()
    : Outcome::Failed("WeightArray \"" + name + "\" has values that are negative or not finite");
}
} // namespace LightTransport
