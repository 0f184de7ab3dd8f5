// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderPass.h"

#include "Context/OpenGLFunctions.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <vector>

namespace
{
// Each attribute gives a coordinate: the helper reports those that are not used.
constexpr const char* VertexShader =
  "//VTK::System::Dec\nin vec4 ndCoordIn;\nin vec2 texCoordIn;\nvoid main()\n{\n"
  "  gl_Position = vec4(ndCoordIn.x, 2.0 * texCoordIn.y - 1.0, 0.0, 1.0);\n}\n";
constexpr const char* Head = "//VTK::System::Dec\n//VTK::Output::Dec\n";
} // namespace

//------------------------------------------------------------------------------
ShaderPass::ShaderPass(vtkOpenGLRenderWindow* window, const std::string& fragmentShader)
  : Window(window)
{
  this->Framebuffer->SetContext(window);
  this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window, VertexShader,
    (Head + fragmentShader).c_str(), "");
}

//------------------------------------------------------------------------------
ShaderPass::~ShaderPass()
{
  this->Quad.reset();
  this->Framebuffer->ReleaseGraphicsResources(this->Window);
}

//------------------------------------------------------------------------------
void ShaderPass::Begin(vtkTextureObject* target)
{
  vtkOpenGLState* state = this->Window->GetState();
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  this->Framebuffer->AddColorAttachment(0, target);
  this->Framebuffer->ActivateDrawBuffers(1);
  this->Framebuffer->ActivateReadBuffer(0);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_BLEND);
}

//------------------------------------------------------------------------------
void ShaderPass::End(bool waits)
{
  this->Window->GetState()->PopFramebufferBindings();
  if (waits)
  {
    glFinish();
  }
}

//------------------------------------------------------------------------------
void ShaderPass::Draw(std::initializer_list<Input> inputs, int x, int width, int height,
  const Uniforms& setUniforms)
{
  vtkShaderProgram* program = this->Quad->Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  for (const Input& input : inputs)
  {
    input.Texture->Activate();
    program->SetUniformi(input.Name, input.Texture->GetTextureUnit());
  }
  setUniforms(program);
  this->Window->GetState()->vtkglViewport(x, 0, width, height);
  this->Window->GetState()->vtkglScissor(x, 0, width, height);
  this->Quad->Render();
  for (const Input& input : inputs)
  {
    input.Texture->Deactivate();
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTextureObject> ShaderPass::MakeTexture(vtkOpenGLRenderWindow* window, int width,
  int height, int components, const float* values)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->Allocate2D(width, height, components, VTK_FLOAT);
  const std::vector<float> zeros(values ? 0 : static_cast<std::size_t>(width) * height * components,
    0.0f);
  texture->Activate();
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, components == 1 ? GL_RED : GL_RGBA,
    GL_FLOAT, values ? values : zeros.data());
  texture->Deactivate();
  return texture;
}
