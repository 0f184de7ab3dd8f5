// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFloatTextures.h"

#include "vtkFloatTexturesCommonFS.h"
#include "vtkFloatTexturesVS.h"
#include "vtkLightTransportOpenGL.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkShaderProgram.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>

//------------------------------------------------------------------------------
vtkFloatTextures::Session::Session(vtkOpenGLRenderWindow* window)
  : Context(window), State(window->GetState()), Viewport(this->State), ColorMask(this->State),
    Blend(this->State, GL_BLEND), CullFace(this->State, GL_CULL_FACE),
    DepthTest(this->State, GL_DEPTH_TEST), ScissorTest(this->State, GL_SCISSOR_TEST),
    StencilTest(this->State, GL_STENCIL_TEST)
{
  std::string ignored;
  vtkFloatTextures::CheckErrors(ignored);
  this->State->PushFramebufferBindings();
  for (unsigned int name :
    { GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_STENCIL_TEST })
  {
    this->State->vtkglDisable(name);
  }
  this->State->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

//------------------------------------------------------------------------------
vtkFloatTextures::Session::~Session()
{
  this->State->PopFramebufferBindings();
}

//------------------------------------------------------------------------------
vtkFloatTextures::vtkFloatTextures(vtkOpenGLRenderWindow* window)
  : Window(window), Framebuffer(vtkSmartPointer<vtkOpenGLFramebufferObject>::New())
{
  const Session session(window);
  this->Framebuffer->SetContext(window);
  const Group witness = this->Allocate(1, 1, 1);
  this->Witness = witness.empty() ? nullptr : witness[0];
}

//------------------------------------------------------------------------------
vtkFloatTextures::~vtkFloatTextures()
{
  if (this->IsAlive())
  {
    const vtkOpenGLContextGuard guard(this->Window);
    this->Framebuffer->ReleaseGraphicsResources(this->Window);
    this->Quads.clear();
    this->Witness = nullptr;
  }
}

//------------------------------------------------------------------------------
bool vtkFloatTextures::IsAlive() const
{
  return this->Window && this->Witness && this->Witness->GetHandle() != 0;
}

//------------------------------------------------------------------------------
std::string vtkFloatTextures::GetDeviceName() const
{
  return this->Window->GetState()->GetRenderer();
}

//------------------------------------------------------------------------------
int vtkFloatTextures::GetMaximumTextureSize() const
{
  return vtkTextureObject::GetMaximumTextureSize(this->Window);
}

//------------------------------------------------------------------------------
int vtkFloatTextures::GetMaximumGroupSize() const
{
  int attachments = 0;
  int buffers = 0;
  glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &attachments);
  glGetIntegerv(GL_MAX_DRAW_BUFFERS, &buffers);
  return std::min(attachments, buffers);
}

//------------------------------------------------------------------------------
double vtkFloatTextures::GetAvailableBytes() const
{
  if (!vtkOpenGLDeviceIsHardware(this->Window->GetState()->GetRenderer()))
  {
    vtksys::SystemInformation system;
    system.RunMemoryCheck();
    return 1048576.0 * static_cast<double>(system.GetAvailablePhysicalMemory());
  }
  // GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, in KiB; an error where the extension is
  // missing.
  GLint kibibytes = -1;
  glGetIntegerv(0x9049, &kibibytes);
  std::string ignored;
  return vtkFloatTextures::CheckErrors(ignored) ? 1024.0 * kibibytes : -1.0;
}

//------------------------------------------------------------------------------
vtkFloatTextures::Group vtkFloatTextures::Allocate(std::size_t count, int width, int height)
{
  Group group;
  for (std::size_t index = 0; index < count; ++index)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(this->Window);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    texture->Allocate2D(static_cast<unsigned int>(width), static_cast<unsigned int>(height), 4,
      VTK_FLOAT);
    std::string ignored;
    if (!vtkFloatTextures::CheckErrors(ignored))
    {
      return {};
    }
    group.push_back(texture);
  }
  return group;
}

//------------------------------------------------------------------------------
void vtkFloatTextures::Upload(vtkTextureObject* texture, const int region[4], int rowLength,
  const float* rgba)
{
  vtkOpenGLState* state = this->Window->GetState();
  texture->Activate();
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, rowLength);
  glTexSubImage2D(GL_TEXTURE_2D, 0, region[0], region[1], region[2], region[3], GL_RGBA, GL_FLOAT,
    rgba);
  state->vtkglPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  texture->Deactivate();
}

//------------------------------------------------------------------------------
void vtkFloatTextures::Attach(const Group& group)
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
void vtkFloatTextures::Clear(const Group& group)
{
  this->Bind(group);
  const float zeros[4] = {};
  for (int index = 0; index < static_cast<int>(group.size()); ++index)
  {
    glClearBufferfv(GL_COLOR, index, zeros);
  }
}

//------------------------------------------------------------------------------
void vtkFloatTextures::Copy(const Group& target, int line, const Group& source, const int region[4])
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
void vtkFloatTextures::Download(const Group& group, std::size_t index, int width, int height,
  float* rgba)
{
  this->Attach(group);
  this->Framebuffer->ActivateReadBuffer(static_cast<unsigned int>(index));
  this->Window->GetState()->vtkglPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba);
  this->Window->GetState()->vtkglPixelStorei(GL_PACK_ALIGNMENT, 1);
}

//------------------------------------------------------------------------------
vtkShaderProgram* vtkFloatTextures::Use(const std::string& name, const char* body,
  const std::string& defines)
{
  auto& quad = this->Quads[name];
  if (!quad)
  {
    std::string source = vtkFloatTexturesCommonFS;
    vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Define", defines);
    source += body;
    quad =
      std::make_unique<vtkOpenGLQuadHelper>(this->Window, vtkFloatTexturesVS, source.c_str(), "");
  }
  this->CurrentQuad = quad.get();
  vtkShaderProgram* program = quad->Program;
  if (program)
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(program);
  }
  return program && program->GetCompiled() ? program : nullptr;
}

//------------------------------------------------------------------------------
void vtkFloatTextures::SetTextures(vtkShaderProgram* program, const char* name, const Group& group)
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
void vtkFloatTextures::Draw(const Group& target, const int region[4])
{
  this->Bind(target);
  this->Window->GetState()->vtkglViewport(region[0], region[1], region[2], region[3]);
  this->CurrentQuad->Render();
  this->ReleaseTextures();
}

//------------------------------------------------------------------------------
void vtkFloatTextures::Bind(const Group& target)
{
  this->Attach(target);
  this->Framebuffer->ActivateDrawBuffers(static_cast<unsigned int>(target.size()));
}

//------------------------------------------------------------------------------
void vtkFloatTextures::ReleaseTextures()
{
  for (vtkTextureObject* texture : this->ActiveTextures)
  {
    texture->Deactivate();
  }
  this->ActiveTextures.clear();
}

//------------------------------------------------------------------------------
bool vtkFloatTextures::CheckErrors(std::string& text)
{
  unsigned int code = glGetError();
  if (code == GL_NO_ERROR)
  {
    return true;
  }
  text = code == GL_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(code);
  // A context that has been lost may report errors for ever.
  for (int count = 0; count < 100 && code != GL_NO_ERROR; ++count)
  {
    code = glGetError();
  }
  return false;
}
