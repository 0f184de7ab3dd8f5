// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasTexture.h"

#include "Context/OpenGLContextGuard.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceMemory.h"
#include "Device/SharedWindow.h"
#include "Shared/TransportMemory.h"
#include "Shared/ZeroedArray.h"
#include "vtkLightTransportAtlasPointsFS.h"
#include "vtkLightTransportAtlasSampleFS.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <string>

namespace LightTransport
{
namespace
{
/// Points are sampled in textures of this width, and at most this many at a time.
constexpr int WidthBits = 10;
constexpr vtkIdType MostPoints = vtkIdType(1) << 20;

//------------------------------------------------------------------------------
// `components` of each of the tuples [first, first + count), in texels of a texture.
void Pack(vtkDataArray* array, vtkIdType first, vtkIdType count, int lane,
  std::vector<float>& texels)
{
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      texels[static_cast<std::size_t>(4 * k + lane + component)] =
        static_cast<float>(array->GetComponent(first + k, component));
    }
  }
}

//------------------------------------------------------------------------------
void Unpack(const std::vector<float>& texels, vtkIdType first, vtkIdType count,
  vtkDoubleArray* array)
{
  const int components = array->GetNumberOfComponents();
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int component = 0; component < components; ++component)
    {
      array->SetComponent(first + k, component,
        texels[static_cast<std::size_t>(4 * k + component)]);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
Outcome AtlasTexture::Open(vtkRenderWindow* window)
{
  if (!window)
  {
    if (Outcome shared = GetSharedWindow(this->SharedWindow); !shared)
    {
      return shared;
    }
    window = this->SharedWindow;
  }
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!openGL || openGL->GetState()->GetRenderer().empty())
  {
    return Outcome::Failed("the render window has none yet: render once.");
  }
  this->Engine = std::make_unique<FloatTextures>(openGL);
  return this->Engine->IsAlive()
    ? Outcome::Done()
    : Outcome::Failed("this OpenGL cannot make floating-point textures.");
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::Allocate(int resolution, int components)
{
  this->Resolution = resolution;
  this->Components = components;
  if (resolution > this->Engine->GetMaximumTextureSize())
  {
    return Outcome::Failed("too many texels a side");
  }
  if (Outcome allocated = this->Engine->Allocate(this->Atlas, 1, resolution, resolution);
      !allocated)
  {
    return allocated;
  }
  vtkTextureObject* texture = this->Atlas[0];
  // Shaders ask for whole levels: between two of them each needs its own coordinates.
  texture->SetMinificationFilter(vtkTextureObject::LinearMipmapNearest);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
  texture->SetMaxLevel(this->GetNumberOfLevels() - 1);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::AllocateWithinMemory(int resolution, const char* name)
{
  const double texels = static_cast<double>(resolution) * resolution;
  const double bytes = texels * FloatTextures::BytesPerTexel * 4.0 / 3.0;
  const double available = GetAvailableDeviceBytes(this->Engine->GetWindow());
  if ((available < 0.0 || bytes <= available) && this->Allocate(resolution, 3))
  {
    return Outcome::Done();
  }
  this->ClearTexture();
  return Outcome::Failed(std::string(name) + " is " + std::to_string(resolution) +
    ": a map of that takes " + TransportMemory::Format(bytes) + ", which " +
    this->Engine->GetDeviceName() + " does not have" +
    (available < 0.0 ? "" : " (" + TransportMemory::Format(available) + " are free)") +
    ". Choose a smaller one.");
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::Upload(const std::vector<float>& rgba, int resolution, int components)
{
  if (Outcome allocated = this->Allocate(resolution, components); !allocated)
  {
    return allocated;
  }
  this->Engine->UploadTable(this->Atlas, rgba);
  return this->MakeLevels();
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::MakeLevels()
{
  vtkTextureObject* texture = this->Atlas[0];
  // vtkTextureObject makes levels only together with texels.
  texture->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
  texture->Deactivate();
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
void AtlasTexture::ClearTexture()
{
  if (this->IsOpen())
  {
    const OpenGLContextGuard guard(this->Engine->GetWindow());
    this->Atlas.clear();
  }
  this->Atlas.clear();
  this->Resolution = 0;
  this->Components = 0;
}

//------------------------------------------------------------------------------
void AtlasTexture::Clear()
{
  this->ClearTexture();
  this->Engine.reset();
  this->SharedWindow = nullptr;
}

//------------------------------------------------------------------------------
int AtlasTexture::GetNumberOfLevels() const
{
  int levels = 0;
  while ((this->Resolution >> levels) > 0)
  {
    ++levels;
  }
  return levels;
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::ReadLevel(int level, vtkFloatArray* texels)
{
  const vtkIdType side = this->Resolution >> level;
  texels->SetNumberOfComponents(4);
  ZeroedArray::Fill(texels, side * side);
  vtkOpenGLState* state = this->Engine->GetWindow()->GetState();
  this->Atlas[0]->Activate();
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTexImage(GL_TEXTURE_2D, level, GL_RGBA, GL_FLOAT, texels->GetPointer(0));
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 1);
  this->Atlas[0]->Deactivate();
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::DrawPoints(const FloatTextures::Group& target,
  const FloatTextures::Group& points, const FloatTextures::Group& blocks, int height)
{
  const std::string defines = FloatTextures::GetDefines(1, 1, 1 << WidthBits);
  const std::string body =
    std::string(vtkLightTransportAtlasSampleFS) + vtkLightTransportAtlasPointsFS;
  vtkShaderProgram* program = nullptr;
  if (Outcome used = this->Engine->Use(program, "Points", body.c_str(), defines); !used)
  {
    return used;
  }
  this->Engine->SetTextures(program, "atlas", this->Atlas);
  this->Engine->SetTextures(program, "points", points);
  this->Engine->SetTextures(program, "blocks", blocks);
  const int region[4] = { 0, 0, 1 << WidthBits, height };
  this->Engine->Draw(target, region);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome AtlasTexture::Sample(vtkDataArray* coordinates, vtkDataArray* blocks, vtkDataArray* levels,
  vtkDoubleArray* values)
{
  const vtkIdType count = coordinates->GetNumberOfTuples();
  values->SetNumberOfComponents(this->Components);
  ZeroedArray::Fill(values, count);
  if (count == 0)
  {
    return DeviceErrors::Check();
  }
  const int width = 1 << WidthBits;
  const int height = FloatTextures::DivideUp(std::min(count, MostPoints), width);
  FloatTextures::Group textures;
  if (!this->Engine->Allocate(textures, 3, width, height))
  {
    return Outcome::Failed("too little memory");
  }
  std::vector<float> texels(static_cast<std::size_t>(4 * width) * height);
  for (vtkIdType first = 0; first < count; first += MostPoints)
  {
    const vtkIdType part = std::min(count - first, MostPoints);
    const int region[4] = { 0, 0, width, height };
    Pack(coordinates, first, part, 0, texels);
    Pack(levels, first, part, 2, texels);
    this->Engine->Upload(textures[0], region, width, texels.data());
    Pack(blocks, first, part, 0, texels);
    this->Engine->Upload(textures[1], region, width, texels.data());
    if (Outcome drawn = this->DrawPoints({ textures[2] }, { textures[0] }, { textures[1] }, height);
        !drawn)
    {
      return drawn;
    }
    this->Engine->Download({ textures[2] }, 0, width, height, texels.data());
    Unpack(texels, first, part, values);
  }
  return DeviceErrors::Check();
}
} // namespace LightTransport
