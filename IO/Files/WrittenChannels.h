// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which channels the arrays of an image become in a file: see vtkOpenEXRWriter for the rules.
#ifndef WrittenChannels_h
#define WrittenChannels_h

#include "Shared/Outcome.h"

#include <string>
#include <vector>

#include <ImfPixelType.h>

class vtkDataArray;
class vtkImageData;

namespace LightTransport
{
/// One channel of the file: a component of an array.
struct WrittenChannel
{
  /// How a texel of a mip level comes from those below it.
  enum class Reduction
  {
    Mean,
    WeightedMean,
    First
  };

  std::string Name;
  Imf::PixelType Type = Imf::FLOAT;
  vtkDataArray* Source = nullptr;
  int Component = 0;
  Reduction Rule = Reduction::Mean;
};

namespace WrittenChannels
{
/// The channel that a component of an array becomes.
std::string GetName(vtkDataArray* array, int component, bool scalars);

/// Fails where a point array is not of numbers, or shorter or longer than the points.
Outcome CheckArrays(vtkImageData* image);

/// The channels of an image, of `type` where that can hold them; `weights` may be null.
std::vector<WrittenChannel> List(vtkImageData* image, Imf::PixelType type, vtkDataArray* weights);

/// Fails where names are missing, double or too long, or values do not fit into their type.
Outcome Check(const std::vector<WrittenChannel>& channels);

/// Fails unless an array may be the weights of mip levels. `name` is what the user calls it.
Outcome CheckWeights(vtkDataArray* weights, const std::string& name);
} // namespace WrittenChannels
} // namespace LightTransport

#endif
