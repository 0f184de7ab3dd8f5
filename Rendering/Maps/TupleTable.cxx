// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/TupleTable.h"

#include "vtkDataArray.h"

#include <cmath>
#include <utility>

namespace LightTransport
{
namespace
{
/// Of a texel.
constexpr int Lanes = 4;
} // namespace

//------------------------------------------------------------------------------
std::vector<float> TupleTable::Pack(const std::vector<vtkDataArray*>& arrays, vtkIdType first,
  vtkIdType count, bool& isFinite)
{
  std::vector<float> texels;
  isFinite = true;
  for (vtkIdType tuple = first; tuple < first + count; ++tuple)
  {
    for (vtkDataArray* array : arrays)
    {
      const int components = array->GetNumberOfComponents();
      for (int component = 0; component < Lanes * FloatTextures::DivideUp(components, Lanes);
           ++component)
      {
        const double value = component < components ? array->GetComponent(tuple, component) : 0.0;
        isFinite = isFinite && std::isfinite(value);
        texels.push_back(static_cast<float>(value));
      }
    }
  }
  return texels;
}

//------------------------------------------------------------------------------
Outcome TupleTable::Upload(FloatTextures& engine, std::vector<float> texels)
{
  const int width = 1 << WidthBits;
  const int height = FloatTextures::DivideUp(static_cast<vtkIdType>(texels.size() / Lanes), width);
  if (height > engine.GetMaximumTextureSize())
  {
    return Outcome::Failed(
      "The surface has too many points or triangles for a texture: use fewer.");
  }
  texels.resize(static_cast<std::size_t>(Lanes) * width * height, 0.0f);
  Outcome allocated = engine.Allocate(this->Texture, 1, width, height);
  if (allocated)
  {
    engine.UploadTable(this->Texture, texels);
  }
  return allocated;
}
} // namespace LightTransport
