// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The choice of the next shooters: a reduction on the device that ends at a few candidates, each
 * the best of its share of the patches. Their numbers and powers are all that is read back.
 */
#ifndef BrightestPatches_h
#define BrightestPatches_h

#include "Textures/FloatVectors.h"

#include <vector>

namespace LightTransport
{
class BrightestPatches
{
public:
  struct Patch
  {
    float Power;
    int Index;
  };

  explicit BrightestPatches(FloatTextures& engine) : Engine(engine) {}

  Outcome Allocate(const FloatVectors::Layout& vectors);

  /// Patches with the most of radiosity times area, summed over the bands, the greatest first; none
  /// where all is dark. `areas`: one texture with a patch's area in each texel.
  Outcome Find(std::vector<Patch>& patches, const FloatTextures::Group& radiosity,
    const FloatTextures::Group& areas);

  /// Bytes that Find has taken from the device.
  vtkTypeInt64 GetNumberOfBytesRead() const { return this->NumberOfBytesRead; }

private:
  Outcome DrawFirstStep(const FloatTextures::Group& radiosity, const FloatTextures::Group& areas);
  Outcome DrawNextStep(std::size_t step);
  Outcome Use(vtkShaderProgram*& program, bool first);
  void DrawStep(vtkShaderProgram* program, const FloatTextures::Group& source,
    const FloatTextures::Group& target);
  void Read(std::vector<Patch>& patches);

  FloatTextures& Engine;
  FloatVectors::Layout Vectors;
  std::vector<FloatTextures::Group> Steps;
  vtkTypeInt64 NumberOfBytesRead = 0;
};
} // namespace LightTransport

#endif
