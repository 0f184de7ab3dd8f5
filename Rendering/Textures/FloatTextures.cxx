// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Textures/FloatTextures.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "Shared/TransportMemory.h"
#include "Textures/VectorBuffer.h"
#include "vtkLightTransportTexturesCommonFS.h"
#include "vtkLightTransportTexturesQuadVS.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace LightTransport
{
namespace
{
/// What drivers need beside a texture, to draw with it.
constexpr double BytesBesideTextures = 67108864.0;

struct Format
{
  int Components;
  unsigned int Internal;
  unsigned int External;
};

//------------------------------------------------------------------------------
Format GetFormat(FloatTextures::Texel texel)
{
  switch (texel)
  {
    case FloatTextures::Texel::Word:
      return { 1, GL_R32UI, GL_RED_INTEGER };
    case FloatTextures::Texel::TwoWords:
      return { 2, GL_RG32UI, GL_RG_INTEGER };
    case FloatTextures::Texel::FourWords:
      return { 4, GL_RGBA32UI, GL_RGBA_INTEGER };
    default:
      return { 4, GL_RGBA32F, GL_RGBA };
  }
}
} // namespace

//------------------------------------------------------------------------------
FloatTextures::FloatTextures(vtkOpenGLRenderWindow* window)
  : Window(window), Framebuffer(vtkSmartPointer<vtkOpenGLFramebufferObject>::New())
{
  const DeviceSession session(window);
  this->Framebuffer->SetContext(window);
  Group witness;
  if (this->Allocate(witness, 1, 1, 1))
  {
    this->Witness = witness[0];
  }
}

//------------------------------------------------------------------------------
FloatTextures::~FloatTextures()
{
  if (this->IsAlive())
  {
    const OpenGLContextGuard guard(this->Window);
    this->Framebuffer->ReleaseGraphicsResources(this->Window);
    this->Quads.clear();
    this->Witness = nullptr;
  }
}

//------------------------------------------------------------------------------
bool FloatTextures::IsAlive() const
{
  return this->Window && this->Witness && this->Witness->GetHandle() != 0;
}

//------------------------------------------------------------------------------
std::string FloatTextures::GetDeviceName() const
{
  return this->Window->GetState()->GetRenderer();
}

//------------------------------------------------------------------------------
int FloatTextures::GetMaximumTextureSize() const
{
  return vtkTextureObject::GetMaximumTextureSize(this->Window);
}

//------------------------------------------------------------------------------
int FloatTextures::GetMaximumGroupSize() const
{
  int attachments = 0;
  int buffers = 0;
  glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &attachments);
  glGetIntegerv(GL_MAX_DRAW_BUFFERS, &buffers);
  return std::min(attachments, buffers);
}

//------------------------------------------------------------------------------
Outcome FloatTextures::Allocate(Group& group, std::size_t count, int width, int height, Texel texel)
{
  group.clear();
  const Format format = GetFormat(texel);
  // Drivers end the process where memory is refused to them.
  const double values = static_cast<double>(count) * width * height * format.Components;
  if (!TransportMemory::IsWithinLimits(sizeof(float) * values + BytesBesideTextures))
  {
    return Outcome::Failed("out of memory");
  }
  for (std::size_t index = 0; index < count; ++index)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(this->Window);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    if (texel != Texel::Floats)
    {
      texture->SetInternalFormat(format.Internal);
      texture->SetFormat(format.External);
    }
    texture->Allocate2D(static_cast<unsigned int>(width), static_cast<unsigned int>(height),
      format.Components, texel == Texel::Floats ? VTK_FLOAT : VTK_UNSIGNED_INT);
    if (Outcome allocated = DeviceErrors::Check(); !allocated)
    {
      group.clear();
      return allocated;
    }
    group.push_back(texture);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void FloatTextures::Upload(vtkTextureObject* texture, const int region[4], int rowLength,
  const float* rgba)
{
  this->Upload(texture, region, rowLength, GL_RGBA, GL_FLOAT, rgba);
}

//------------------------------------------------------------------------------
void FloatTextures::Upload(vtkTextureObject* texture, const int region[4], int rowLength,
  const std::uint32_t* words)
{
  const auto format = texture->GetFormat(VTK_UNSIGNED_INT, texture->GetComponents(), true);
  this->Upload(texture, region, rowLength, format, GL_UNSIGNED_INT, words);
}

//------------------------------------------------------------------------------
void FloatTextures::Upload(vtkTextureObject* texture, const int region[4], int rowLength,
  unsigned int format, unsigned int type, const void* values)
{
  vtkOpenGLState* state = this->Window->GetState();
  texture->Activate();
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, rowLength);
  glTexSubImage2D(GL_TEXTURE_2D, 0, region[0], region[1], region[2], region[3], format, type,
    values);
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  texture->Deactivate();
}

//------------------------------------------------------------------------------
void FloatTextures::Attach(const Group& group)
{
  this->Framebuffer->Bind();
  const auto before = static_cast<unsigned int>(this->Framebuffer->GetNumberOfColorAttachments());
  for (unsigned int index = static_cast<unsigned int>(group.size()); index < before; ++index)
  {
    this->Framebuffer->RemoveColorAttachment(index);
  }
  for (unsigned int index = 0; index < group.size(); ++index)
  {
    this->Framebuffer->AddColorAttachment(index, group[index]);
  }
}

//------------------------------------------------------------------------------
void FloatTextures::Clear(const Group& group)
{
  this->Bind(group);
  const float zeros[4] = {};
  for (int index = 0; index < static_cast<int>(group.size()); ++index)
  {
    glClearBufferfv(GL_COLOR, index, zeros);
  }
}

//------------------------------------------------------------------------------
void FloatTextures::Copy(const Group& target, int line, const Group& source, const int region[4])
{
  this->Attach(source);
  for (std::size_t index = 0; index < source.size(); ++index)
  {
    this->Framebuffer->ActivateReadBuffer(static_cast<unsigned int>(index));
    // vtkTextureObject::CopyFromFrameBuffer makes another texture, of 8 bits a value.
    target[index]->Activate();
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, region[0], line, region[0], region[1], region[2],
      region[3]);
    target[index]->Deactivate();
  }
}

//------------------------------------------------------------------------------
void FloatTextures::Copy(const VectorBuffer& target, const Group& source)
{
  const int width = static_cast<int>(source[0]->GetWidth());
  const int height = static_cast<int>(source[0]->GetHeight());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, target.GetHandle());
  for (std::size_t index = 0; index < source.size(); ++index)
  {
    // Where a buffer is bound, an address is where to begin in it.
    const std::uintptr_t begin = index * width * height * BytesPerTexel;
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    this->Download(source, index, width, height, reinterpret_cast<float*>(begin));
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

//------------------------------------------------------------------------------
void FloatTextures::Download(const Group& group, std::size_t index, int width, int height,
  float* rgba)
{
  this->Attach(group);
  this->Framebuffer->ActivateReadBuffer(static_cast<unsigned int>(index));
  this->Window->GetState()->vtkglPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba);
  this->Window->GetState()->vtkglPixelStorei(GL_PACK_ALIGNMENT, 1);
}

//------------------------------------------------------------------------------
std::string FloatTextures::GetDefines(int groups, int outputs, int width)
{
  int bits = 0;
  while ((1 << bits) < width)
  {
    ++bits;
  }
  return "#define GROUPS " + std::to_string(groups) + "\n#define OUTPUTS " +
    std::to_string(outputs) + "\n#define WIDTH_BITS " + std::to_string(bits) + "\n";
}

//------------------------------------------------------------------------------
Outcome FloatTextures::Use(vtkShaderProgram*& program, const std::string& name, const char* body,
  const std::string& defines)
{
  auto& quad = this->Quads[name];
  if (!quad)
  {
    std::string source = vtkLightTransportTexturesCommonFS;
    vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Define", defines);
    source += body;
    quad = std::make_unique<vtkOpenGLQuadHelper>(this->Window, vtkLightTransportTexturesQuadVS,
      source.c_str(), "");
  }
  this->CurrentQuad = quad.get();
  program = quad->Program;
  if (program)
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(program);
  }
  return FloatTextures::CheckProgram(program);
}

//------------------------------------------------------------------------------
Outcome FloatTextures::CheckProgram(vtkShaderProgram* program)
{
  return program && program->GetCompiled() ? Outcome::Done()
                                           : Outcome::Failed("a shader that does not compile");
}

//------------------------------------------------------------------------------
void FloatTextures::SetTextures(vtkShaderProgram* program, const char* name, const Group& group)
{
  std::vector<int> units;
  for (vtkTextureObject* texture : group)
  {
    texture->Activate();
    this->ActiveTextures.push_back(texture);
    units.push_back(texture->GetTextureUnit());
  }
  program->SetUniform1iv(name, static_cast<int>(units.size()), units.data());
}

//------------------------------------------------------------------------------
void FloatTextures::Draw(const Group& target, const int region[4])
{
  this->Bind(target);
  this->Window->GetState()->vtkglViewport(region[0], region[1], region[2], region[3]);
  this->CurrentQuad->Render();
  this->ReleaseTextures();
}

//------------------------------------------------------------------------------
void FloatTextures::Bind(const Group& target)
{
  this->Attach(target);
  this->Framebuffer->ActivateDrawBuffers(static_cast<unsigned int>(target.size()));
  // VTK takes as many as before for granted where the first is the same.
  std::vector<unsigned int> buffers(target.size());
  std::iota(buffers.begin(), buffers.end(), GL_COLOR_ATTACHMENT0);
  glDrawBuffers(static_cast<int>(buffers.size()), buffers.data());
}

//------------------------------------------------------------------------------
void FloatTextures::ReleaseTextures()
{
  for (vtkTextureObject* texture : this->ActiveTextures)
  {
    texture->Deactivate();
  }
  this->ActiveTextures.clear();
}
} // namespace LightTransport
