// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/HemisphereItems.h"

#include "Context/OpenGLContextGuard.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "vtkLightTransportShootingItemsFS.h"
#include "vtkLightTransportShootingItemsVS.h"
#include "vtkLightTransportShootingScatterFS.h"
#include "vtkLightTransportShootingScatterVS.h"
#include "vtkLightTransportTexturesCommonFS.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
/// Heights over a plane, and distances, that single precision cannot tell (the scene is 1 large).
constexpr float SinglePrecision = 1e-6f;
constexpr int ClipPlanes = 3;

//------------------------------------------------------------------------------
/// The weights of all pixels of an eye point, as vtkLightTransportShootingScatterVS has them.
double SumWeights(int resolution)
{
  double sum = 0.0;
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = resolution - row; column < resolution; ++column)
    {
      const double x = 3.0 * (column + 0.5) / resolution - 2.0;
      const double y = 3.0 * (row + 0.5) / resolution - 2.0;
      const double square = 1.0 + x * x + y * y;
      sum += (1.0 + x + y) / (square * square);
    }
  }
  return 3.0 * sum;
}

//------------------------------------------------------------------------------
void SetEyes(vtkShaderProgram* program, const std::vector<HemisphereItems::Eye>& eyes)
{
  std::vector<float> values;
  const auto add = [&values](const float* vector, float last)
  {
    values.insert(values.end(), vector, vector + 3);
    values.push_back(last);
  };
  for (const HemisphereItems::Eye& eye : eyes)
  {
    add(eye.Position, eye.Rounding + SinglePrecision);
    add(eye.Axes[0], eye.Slope);
    add(eye.Axes[1], 0.0f);
    add(eye.Axes[2], 0.0f);
  }
  program->SetUniform4fv("eyes", static_cast<int>(values.size() / 4), values.data());
  program->SetUniformi("numberOfEyes", static_cast<int>(eyes.size()));
}
} // namespace

//------------------------------------------------------------------------------
HemisphereItems::HemisphereItems(FloatTextures* engine) : Engine(engine) {}

//------------------------------------------------------------------------------
HemisphereItems::~HemisphereItems()
{
  if (!this->Engine->IsAlive() || !this->Scene)
  {
    return;
  }
  const OpenGLContextGuard guard(this->Engine->GetWindow());
  this->ItemBuffer->ReleaseGraphicsResources(this->Engine->GetWindow());
  this->Scene->ReleaseGraphicsResources();
  this->Nothing->ReleaseGraphicsResources();
  this->Points->ReleaseGraphicsResources();
  this->Triangles->ReleaseGraphicsResources();
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::Allocate(const std::vector<float>& points,
  const std::vector<unsigned int>& triangles, const std::vector<int>& patches, int resolution,
  double rounding)
{
  this->Resolution = resolution;
  this->BackRounding = 2.0f * (static_cast<float>(rounding) + SinglePrecision);
  this->WeightOfAllPixels = SumWeights(resolution);
  const Outcome allocated = this->AllocateItems();
  return allocated ? this->AllocateScene(points, triangles, patches) : allocated;
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::AllocateItems()
{
  const auto width = static_cast<unsigned int>(3 * this->Resolution);
  const auto height = static_cast<unsigned int>(MostEyes * this->Resolution);
  vtkOpenGLRenderWindow* window = this->Engine->GetWindow();
  this->Items = vtkSmartPointer<vtkTextureObject>::New();
  this->Depth = vtkSmartPointer<vtkTextureObject>::New();
  this->Items->SetContext(window);
  this->Depth->SetContext(window);
  this->Items->Allocate2D(width, height, 1, VTK_FLOAT);
  this->Depth->AllocateDepth(width, height, vtkTextureObject::Float32);
  if (Outcome allocated = DeviceErrors::Check(); !allocated)
  {
    return allocated;
  }
  this->ItemBuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->ItemBuffer->SetContext(window);
  this->ItemBuffer->Bind();
  this->ItemBuffer->AddColorAttachment(0, this->Items);
  this->ItemBuffer->AddDepthAttachment(this->Depth);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::AllocateScene(const std::vector<float>& points,
  const std::vector<unsigned int>& triangles, const std::vector<int>& patches)
{
  this->NumberOfIndices = static_cast<int>(triangles.size());
  this->Points = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  this->Triangles = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  this->Scene = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  this->Nothing = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  this->Points->Upload(points, vtkOpenGLBufferObject::ArrayBuffer);

  const int count = static_cast<int>(patches.size());
  this->TriangleWidth = std::min(count, this->Engine->GetMaximumTextureSize());
  if (Outcome allocated = this->Engine->Allocate(this->TrianglePatches, 1, this->TriangleWidth,
        FloatTextures::DivideUp(count, this->TriangleWidth));
      !allocated)
  {
    return allocated;
  }
  this->UploadPatches(patches);

  vtkShaderProgram* program = nullptr;
  if (Outcome used =
        this->Use(program, vtkLightTransportShootingItemsVS, vtkLightTransportShootingItemsFS);
      !used)
  {
    return used;
  }
  // The buffer of indices belongs to the vertex array that is bound while it is.
  this->Scene->Bind();
  const bool added = this->Scene->AddAttributeArray(program, this->Points, "position", 0,
    3 * sizeof(float), VTK_FLOAT, 3, false);
  this->Triangles->Upload(triangles, vtkOpenGLBufferObject::ElementArrayBuffer);
  this->Scene->Release();
  return added ? DeviceErrors::Check() : Outcome::Failed("positions that a shader does not take");
}

//------------------------------------------------------------------------------
// Numbers from 1 on: 0 is nobody.
void HemisphereItems::UploadPatches(const std::vector<int>& patches)
{
  const int height = static_cast<int>(this->TrianglePatches[0]->GetHeight());
  std::vector<float> texels(static_cast<std::size_t>(4) * this->TriangleWidth * height, 0.0f);
  for (std::size_t triangle = 0; triangle < patches.size(); ++triangle)
  {
    texels[4 * triangle] = static_cast<float>(patches[triangle] + 1);
  }
  const int region[4] = { 0, 0, this->TriangleWidth, height };
  this->Engine->Upload(this->TrianglePatches[0], region, this->TriangleWidth, texels.data());
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::Use(vtkShaderProgram*& program, const char* vertexShader,
  const std::string& fragmentShader)
{
  std::string source = vertexShader;
  vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Define",
    "#define MOST_EYES " + std::to_string(MostEyes));
  program = this->Engine->GetWindow()->GetShaderCache()->ReadyShaderProgram(source.c_str(),
    fragmentShader.c_str(), "");
  return FloatTextures::CheckProgram(program);
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::Shoot(const std::vector<Eye>& eyes, const FloatVectors::Layout& layout,
  const FloatTextures::Group& unshot, const FloatTextures::Group& received)
{
  const Outcome drawn = this->DrawItems(eyes);
  return drawn ? this->DrawPoints(eyes, layout, unshot, received) : drawn;
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::DrawItems(const std::vector<Eye>& eyes)
{
  vtkOpenGLState* state = this->Engine->GetWindow()->GetState();
  const vtkOpenGLState::ScopedglDepthFunc function(state);
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  vtkShaderProgram* program = nullptr;
  if (Outcome used =
        this->Use(program, vtkLightTransportShootingItemsVS, vtkLightTransportShootingItemsFS);
      !used)
  {
    return used;
  }
  const int width = 3 * this->Resolution;
  const int height = static_cast<int>(eyes.size()) * this->Resolution;
  this->ItemBuffer->Bind();
  this->ItemBuffer->ActivateDrawBuffers(1);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglScissor(0, 0, width, height);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  const float nobody[4] = {};
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 0, nobody);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  state->vtkglDisable(GL_SCISSOR_TEST);

  this->TrianglePatches[0]->Activate();
  program->SetUniformi("patches", this->TrianglePatches[0]->GetTextureUnit());
  program->SetUniformi("width", this->TriangleWidth);
  program->SetUniformf("backRounding", this->BackRounding);
  SetEyes(program, eyes);
  for (unsigned int plane = 0; plane < ClipPlanes; ++plane)
  {
    glEnable(GL_CLIP_DISTANCE0 + plane);
  }
  this->Scene->Bind();
  glDrawElementsInstanced(GL_TRIANGLES, this->NumberOfIndices, GL_UNSIGNED_INT, nullptr,
    static_cast<int>(3 * eyes.size()));
  this->Scene->Release();
  for (unsigned int plane = 0; plane < ClipPlanes; ++plane)
  {
    glDisable(GL_CLIP_DISTANCE0 + plane);
  }
  this->TrianglePatches[0]->Deactivate();
  state->vtkglDisable(GL_DEPTH_TEST);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome HemisphereItems::DrawPoints(const std::vector<Eye>& eyes,
  const FloatVectors::Layout& layout, const FloatTextures::Group& unshot,
  const FloatTextures::Group& received)
{
  vtkOpenGLState* state = this->Engine->GetWindow()->GetState();
  const vtkOpenGLState::ScopedglBlendFuncSeparate blending(state);
  std::string fragmentShader = vtkLightTransportTexturesCommonFS;
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::LightTransport::Define",
    layout.GetDefines(layout.Groups));
  fragmentShader += vtkLightTransportShootingScatterFS;
  vtkShaderProgram* program = nullptr;
  if (Outcome used = this->Use(program, vtkLightTransportShootingScatterVS, fragmentShader); !used)
  {
    return used;
  }
  const int size[2] = { layout.Width, layout.Height };
  this->Engine->Bind(received);
  state->vtkglViewport(0, 0, size[0], size[1]);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  state->vtkglPointSize(1.0f);

  std::vector<float> shooters;
  for (const Eye& eye : eyes)
  {
    shooters.push_back(static_cast<float>(eye.Shooter % size[0]));
    shooters.push_back(static_cast<float>(eye.Shooter / size[0]));
    shooters.push_back(static_cast<float>(eye.Power / this->WeightOfAllPixels));
    shooters.push_back(0.0f);
  }
  this->Items->Activate();
  program->SetUniformi("items", this->Items->GetTextureUnit());
  this->Engine->SetTextures(program, "unshot", unshot);
  program->SetUniform4fv("shooters", static_cast<int>(eyes.size()), shooters.data());
  program->SetUniformi("resolution", this->Resolution);
  program->SetUniform2i("size", size);
  this->Nothing->Bind();
  glDrawArrays(GL_POINTS, 0,
    static_cast<int>(3 * eyes.size()) * (this->Resolution / 2) * (this->Resolution - 1));
  this->Nothing->Release();
  this->Items->Deactivate();
  this->Engine->ReleaseTextures();
  state->vtkglDisable(GL_BLEND);
  // A bunch of work at a time: a GPU may draw a screen as well.
  glFlush();
  return Outcome::Done();
}
} // namespace LightTransport
