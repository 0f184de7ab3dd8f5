// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/TexelImage.h"

#include "Device/DeviceErrors.h"
#include "Shared/ArrayNames.h"
#include "Shared/ZeroedArray.h"
#include "vtkLightTransportMapsTexelsFS.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"

#include <cmath>

namespace LightTransport
{
namespace
{
/// In each direction: links are made once for a shape, and wrong areas stay in them.
constexpr int Samples = 4;

//------------------------------------------------------------------------------
template <typename Array>
void AddArray(vtkImageData* image, Array* array, const char* name, int components)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  ZeroedArray::Fill(array, image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}

//------------------------------------------------------------------------------
/// `values`: of both textures, one after the other.
void FillImage(const ChartedSurface& surface, const std::vector<float>& values, vtkImageData* image)
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> areas;
  vtkNew<vtkIntArray> charts;
  AddArray(image, positions.Get(), ArrayNames::TexelPosition, 3);
  AddArray(image, normals.Get(), ArrayNames::TexelNormal, 3);
  AddArray(image, areas.Get(), ArrayNames::TexelArea, 1);
  AddArray(image, charts.Get(), ArrayNames::ChartId, 1);
  const vtkIdType texels = image->GetNumberOfPoints();
  for (vtkIdType texel = 0; texel < texels; ++texel)
  {
    const float* first = &values[static_cast<std::size_t>(4 * texel)];
    const float* second = &values[static_cast<std::size_t>(4 * (texels + texel))];
    const double area = first[3];
    double normal[3] = { second[0], second[1], second[2] };
    const bool isThere = area > 0.0 && vtkMath::Normalize(normal) > 0.0;
    charts->SetValue(texel, isThere ? static_cast<int>(std::lround(second[3] / area)) : -1);
    if (!isThere)
    {
      continue;
    }
    areas->SetValue(texel, area * surface.Area / static_cast<double>(texels));
    for (int k = 0; k < 3; ++k)
    {
      positions->SetTypedComponent(texel, k, surface.Center[k] + first[k] / area);
      normals->SetTypedComponent(texel, k, normal[k]);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
Outcome MakeTexelImage(AtlasDrawing& drawing, FloatTextures& engine, int size, vtkImageData* image)
{
  FloatTextures::Group target;
  vtkShaderProgram* program = nullptr;
  Outcome made = engine.Allocate(target, 2, size, size);
  if (made)
  {
    engine.Clear(target);
    made = drawing.Use(program, vtkLightTransportMapsTexelsFS, 2, {});
  }
  made = made ? drawing.AddSamples(program, target, Samples) : made;
  if (!made)
  {
    return made;
  }
  const std::size_t count = static_cast<std::size_t>(4) * size * size;
  std::vector<float> values(2 * count);
  for (std::size_t texture = 0; texture < 2; ++texture)
  {
    engine.Download(target, texture, size, size, &values[texture * count]);
  }
  image->Initialize();
  image->SetDimensions(size, size, 1);
  image->SetSpacing(1.0 / size, 1.0 / size, 1.0);
  image->SetOrigin(0.5 / size, 0.5 / size, 0.0);
  FillImage(drawing.GetSurface(), values, image);
  return DeviceErrors::Check();
}
} // namespace LightTransport
