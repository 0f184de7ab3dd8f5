// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of a surface as a texture that shaders look tuples up in. All calls but Pack within a
/// DeviceSession.
#ifndef TupleTable_h
#define TupleTable_h

#include "Textures/FloatTextures.h"

#include "vtkType.h"

#include <vector>

class vtkDataArray;

namespace LightTransport
{
class TupleTable
{
public:
  /// Texels of a line: a power of two.
  static constexpr int WidthBits = 10;

  /// RGBA texels of the tuples [first, first + count) of arrays, side by side, each array from a
  /// new texel on. `isFinite` becomes false where a value is not.
  static std::vector<float> Pack(const std::vector<vtkDataArray*>& arrays, vtkIdType first,
    vtkIdType count, bool& isFinite);

  /// Fails for more than a texture holds.
  Outcome Upload(FloatTextures& engine, std::vector<float> texels);

  vtkTextureObject* Get() const { return this->Texture.empty() ? nullptr : this->Texture[0].Get(); }

private:
  FloatTextures::Group Texture;
};
} // namespace LightTransport

#endif
