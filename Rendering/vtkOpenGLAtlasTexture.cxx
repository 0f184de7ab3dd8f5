// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLAtlasTexture.h"

#include "Atlas/AtlasTexels.h"
#include "Atlas/AtlasTexture.h"
#include "Device/DeviceSession.h"
#include "Shared/ArrayNames.h"
#include "Shared/Attempt.h"
#include "Shared/ZeroedArray.h"
#include "vtkLightTransportAtlasSampleFS.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"

#include <cmath>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLAtlasTexture);

namespace
{
constexpr Advice WithoutMemory = { "use an atlas of lower resolution, or fewer points",
  "OpenGL gave up", "try a newer driver" };

//------------------------------------------------------------------------------
// A square of a power of two texels a side whose place is a multiple of it.
bool IsBlock(const double block[3], int resolution)
{
  const double size = block[2];
  bool good = size >= 1.0 && size <= resolution && std::exp2(std::round(std::log2(size))) == size;
  for (int axis = 0; axis < 2; ++axis)
  {
    good = good && block[axis] >= 0.0 && block[axis] < resolution &&
      std::floor(block[axis] / size) * size == block[axis];
  }
  return good;
}
} // namespace

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture::vtkOpenGLAtlasTexture() : Texture(new AtlasTexture) {}

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture::~vtkOpenGLAtlasTexture() = default;

//------------------------------------------------------------------------------
void vtkOpenGLAtlasTexture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->GetResolution() << "\n";
  os << indent << "NumberOfComponents: " << this->GetNumberOfComponents() << "\n";
  os << indent << "NumberOfLevels: " << this->GetNumberOfLevels() << "\n";
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetResolution()
{
  return this->Texture->GetResolution();
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetNumberOfComponents()
{
  return this->Texture->GetNumberOfComponents();
}

//------------------------------------------------------------------------------
int vtkOpenGLAtlasTexture::GetNumberOfLevels()
{
  return this->Texture->GetNumberOfLevels();
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::CheckMaps(vtkImageData* maps, const char* valueName,
  const char* areaName)
{
  if (!maps || !valueName || !areaName)
  {
    vtkErrorMacro("There is no image, or no name of an array: give the texel maps of an atlas.");
    return false;
  }
  int size[3];
  maps->GetDimensions(size);
  if (size[0] < 1 || size[0] != size[1] || size[2] != 1 || (size[0] & (size[0] - 1)) != 0)
  {
    vtkErrorMacro("The image has " << size[0] << " x " << size[1] << " x " << size[2]
                                   << " texels: an atlas is square with a power of two a side.");
    return false;
  }
  vtkDataArray* values = maps->GetPointData()->GetArray(valueName);
  vtkDataArray* areas = maps->GetPointData()->GetArray(areaName);
  if (!values || (values->GetNumberOfComponents() != 1 && values->GetNumberOfComponents() != 3))
  {
    vtkErrorMacro("The image needs a point array \"" << valueName << "\" with 1 or 3 components.");
    return false;
  }
  if (!areas || areas->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The image needs a point array \""
      << areaName << "\" with 1 component, the area of surface in each texel.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Build(vtkImageData* maps, const char* valueName, const char* areaName,
  vtkRenderWindow* window)
{
  if (this->IsDrawnInto)
  {
    vtkErrorMacro("This texture is drawn by a map: build one of your own.");
    return false;
  }
  this->Texture->Clear();
  if (!this->CheckMaps(maps, valueName, areaName))
  {
    return false;
  }
  vtkDataArray* values = maps->GetPointData()->GetArray(valueName);
  std::vector<float> texels;
  const auto make = [&]()
  { return MakeAtlasTexels(texels, values, maps->GetPointData()->GetArray(areaName)); };
  if (Outcome made = Attempt(make, WithoutMemory); !made)
  {
    vtkErrorMacro(<< made.GetMessage());
    return false;
  }
  if (Outcome open = this->Texture->Open(window); !open)
  {
    this->Texture->Clear();
    vtkErrorMacro("No OpenGL context to sample the atlas in: " << open.GetMessage());
    return false;
  }
  FloatTextures& engine = this->Texture->GetEngine();
  const DeviceSession session(engine.GetWindow());
  const int resolution = maps->GetDimensions()[0];
  if (!this->Texture->Upload(texels, resolution, values->GetNumberOfComponents()))
  {
    vtkErrorMacro("An atlas of " << resolution << " x " << resolution
                                 << " texels does not fit into " << engine.GetDeviceName()
                                 << ": choose a lower resolution.");
    this->Texture->ClearTexture();
    return false;
  }
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::IsReady()
{
  if (!this->Texture->IsThere())
  {
    vtkErrorMacro("There is no texture, or its window has gone: call Build() first.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::ReadLevel(int level, vtkFloatArray* texels)
{
  if (!this->IsReady())
  {
    return false;
  }
  if (level < 0 || level >= this->GetNumberOfLevels())
  {
    vtkErrorMacro("There is no level " << level << ": the atlas has levels 0 to "
                                       << this->GetNumberOfLevels() - 1 << ".");
    return false;
  }
  const DeviceSession session(this->Texture->GetEngine().GetWindow());
  const auto readLevel = [&]() { return this->Texture->ReadLevel(level, texels); };
  if (Outcome read = Attempt(readLevel, WithoutMemory); !read)
  {
    vtkErrorMacro("OpenGL failed in reading a level with " << read.GetMessage() << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::ReadImage(vtkImageData* image, const char* valueName)
{
  vtkNew<vtkFloatArray> texels;
  if (!this->ReadLevel(0, texels))
  {
    return false;
  }
  const int side = this->GetResolution();
  const double step = 1.0 / side;
  image->Initialize();
  image->SetDimensions(side, side, 1);
  image->SetSpacing(step, step, 1.0);
  image->SetOrigin(0.5 * step, 0.5 * step, 0.0);
  const int components = this->GetNumberOfComponents();
  vtkNew<vtkFloatArray> values;
  vtkNew<vtkFloatArray> areas;
  values->SetName(valueName);
  values->SetNumberOfComponents(components);
  areas->SetName(ArrayNames::TexelArea);
  ZeroedArray::Fill(values, texels->GetNumberOfTuples());
  ZeroedArray::Fill(areas, texels->GetNumberOfTuples());
  for (vtkIdType texel = 0; texel < texels->GetNumberOfTuples(); ++texel)
  {
    const float area = texels->GetTypedComponent(texel, 3);
    areas->SetValue(texel, area);
    for (int k = 0; k < components && area > 0.0f; ++k)
    {
      values->SetTypedComponent(texel, k, texels->GetTypedComponent(texel, k) / area);
    }
  }
  image->GetPointData()->AddArray(values);
  image->GetPointData()->AddArray(areas);
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::CheckPoints(vtkDataArray* coordinates, vtkDataArray* blocks,
  vtkDataArray* levels, vtkDoubleArray* values)
{
  if (!coordinates || !blocks || !levels || !values || coordinates->GetNumberOfComponents() != 2 ||
    blocks->GetNumberOfComponents() != 3 || levels->GetNumberOfComponents() != 1 ||
    blocks->GetNumberOfTuples() != coordinates->GetNumberOfTuples() ||
    levels->GetNumberOfTuples() != coordinates->GetNumberOfTuples())
  {
    vtkErrorMacro("Each point needs 2 coordinates, the 3 numbers of a block and 1 level.");
    return false;
  }
  for (vtkIdType point = 0; point < blocks->GetNumberOfTuples(); ++point)
  {
    double block[3];
    blocks->GetTuple(point, block);
    if (!IsBlock(block, this->GetResolution()))
    {
      vtkErrorMacro("The block (" << block[0] << ", " << block[1] << "), size " << block[2]
                                  << ", of point " << point << " is no node of a quadtree of "
                                  << this->GetResolution() << " texels a side.");
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Sample(vtkDataArray* coordinates, vtkDataArray* blocks,
  vtkDataArray* levels, vtkDoubleArray* values)
{
  if (!this->IsReady() || !this->CheckPoints(coordinates, blocks, levels, values))
  {
    return false;
  }
  FloatTextures& engine = this->Texture->GetEngine();
  const DeviceSession session(engine.GetWindow());
  const auto sample = [&]() { return this->Texture->Sample(coordinates, blocks, levels, values); };
  if (Outcome sampled = Attempt(sample, WithoutMemory); !sampled)
  {
    vtkErrorMacro("OpenGL failed in sampling an atlas with " << sampled.GetMessage() << " on "
                                                             << engine.GetDeviceName() << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
std::string vtkOpenGLAtlasTexture::GetShaderCode()
{
  return vtkLightTransportAtlasSampleFS;
}

//------------------------------------------------------------------------------
bool vtkOpenGLAtlasTexture::Activate(vtkShaderProgram* program, const char* name)
{
  if (!program || !name || !this->IsReady())
  {
    return false;
  }
  this->Texture->Get()->Activate();
  return program->SetUniformi(name, this->Texture->Get()->GetTextureUnit());
}

//------------------------------------------------------------------------------
void vtkOpenGLAtlasTexture::Deactivate()
{
  if (vtkTextureObject* texture = this->Texture->Get())
  {
    texture->Deactivate();
  }
}

//------------------------------------------------------------------------------
// What a map keeps beside it lives as long as the map says.
void vtkOpenGLAtlasTexture::ReleaseGraphicsResources()
{
  if (this->IsDrawnInto)
  {
    this->Texture->ClearTexture();
  }
  else
  {
    this->Texture->Clear();
  }
}
