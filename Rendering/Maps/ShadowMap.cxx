// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/ShadowMap.h"

#include "Context/OpenGLContextGuard.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceMemory.h"
#include "Maps/SceneUniforms.h"
#include "vtkLightTransportMapsLightView.h"
#include "vtkLightTransportMapsShadowFS.h"
#include "vtkLightTransportMapsShadowVS.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <string>
#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
ShadowMap::ShadowMap() = default;

//------------------------------------------------------------------------------
ShadowMap::~ShadowMap()
{
  this->Clear();
}

//------------------------------------------------------------------------------
void ShadowMap::Clear()
{
  for (Upload& upload : this->Uploads)
  {
    upload = Upload();
  }
  if (this->IsOpen())
  {
    const OpenGLContextGuard guard(this->Engine->GetWindow());
    this->Framebuffer->ReleaseGraphicsResources(this->Engine->GetWindow());
    this->Depth = nullptr;
  }
  this->Depth = nullptr;
  this->Framebuffer = nullptr;
  this->Engine.reset();
}

//------------------------------------------------------------------------------
void ShadowMap::Open(vtkOpenGLRenderWindow* window)
{
  if (!this->IsOpen() || this->Engine->GetWindow() != window)
  {
    this->Clear();
    this->Engine = std::make_unique<FloatTextures>(window);
    this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  }
}

//------------------------------------------------------------------------------
Outcome ShadowMap::SetSize(int size)
{
  if (this->Depth && this->Size == size)
  {
    return Outcome::Done();
  }
  if (size > this->Engine->GetMaximumTextureSize())
  {
    return Outcome::Failed("too many texels a side");
  }
  // Drivers may end the process where memory is refused.
  const double available = GetAvailableDeviceBytes(this->Engine->GetWindow());
  if (available >= 0.0 && sizeof(float) * static_cast<double>(size) * size > available)
  {
    return Outcome::Failed("too little memory");
  }
  this->Size = size;
  this->Depth = vtkSmartPointer<vtkTextureObject>::New();
  this->Depth->SetContext(this->Engine->GetWindow());
  const auto side = static_cast<unsigned int>(size);
  this->Depth->AllocateDepth(side, side, vtkTextureObject::Float32);
  if (Outcome allocated = DeviceErrors::Check(); !allocated)
  {
    this->Depth = nullptr;
    return allocated;
  }
  this->Framebuffer->SetContext(this->Engine->GetWindow());
  this->Framebuffer->Bind();
  this->Framebuffer->AddDepthAttachment(this->Depth);
  this->Framebuffer->DeactivateDrawBuffers();
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
// What is on the device already stays there.
void ShadowMap::Find(vtkRenderer* renderer)
{
  const std::vector<ShadowCasters::Caster> before = this->Casters.Get();
  std::vector<Upload> known(std::move(this->Uploads));
  this->Casters.Find(renderer);
  this->Uploads.clear();
  for (const ShadowCasters::Caster& caster : this->Casters.Get())
  {
    this->Uploads.emplace_back();
    for (std::size_t k = 0; k < before.size(); ++k)
    {
      if (known[k].IsThere && before[k].HasShapeOf(caster))
      {
        this->Uploads.back() = std::move(known[k]);
        known[k].IsThere = false;
        break;
      }
    }
  }
}

//------------------------------------------------------------------------------
Outcome ShadowMap::Fill(Upload& upload, const ShadowCasters::Caster& caster) const
{
  std::vector<float> corners;
  caster.VisitTriangles(
    [&](const std::array<Vector3, 3>& triangle)
    {
      upload.Center = corners.empty() ? triangle[0] : upload.Center;
      for (const Vector3& corner : triangle)
      {
        for (std::size_t k = 0; k < corner.size(); ++k)
        {
          corners.push_back(static_cast<float>(corner[k] - upload.Center[k]));
        }
      }
    });
  upload.Triangles = std::make_unique<TriangleBuffer>(*this->Engine);
  const Outcome uploaded = corners.empty() ? Outcome::Done() : upload.Triangles->Upload(corners, 3);
  upload.IsThere = static_cast<bool>(uploaded);
  return uploaded;
}

//------------------------------------------------------------------------------
Outcome ShadowMap::Draw(const LightView& view, const Vector3& origin)
{
  vtkOpenGLState* state = this->Engine->GetWindow()->GetState();
  const vtkOpenGLState::ScopedglDepthFunc function(state);
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglEnableDisable test(state, GL_DEPTH_TEST);
  std::string vertices = vtkLightTransportMapsShadowVS;
  vtkShaderProgram::Substitute(vertices, "//VTK::LightTransport::View",
    vtkLightTransportMapsLightView);
  Outcome drawn = Outcome::Done();
  for (std::size_t k = 0; k < this->Uploads.size(); ++k)
  {
    Upload& upload = this->Uploads[k];
    drawn = drawn && !upload.IsThere ? this->Fill(upload, this->Casters.Get()[k]) : drawn;
  }
  if (!drawn)
  {
    return drawn;
  }
  vtkShaderProgram* program = this->Engine->GetWindow()->GetShaderCache()->ReadyShaderProgram(
    vertices.c_str(), vtkLightTransportMapsShadowFS, "");
  if (Outcome compiled = FloatTextures::CheckProgram(program); !compiled)
  {
    return compiled;
  }
  this->Framebuffer->Bind();
  this->Framebuffer->DeactivateDrawBuffers();
  state->vtkglViewport(0, 0, this->Size, this->Size);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  const float farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  SceneUniforms::SetView(program, view, origin);
  for (std::size_t k = 0; k < this->Uploads.size(); ++k)
  {
    const Upload& upload = this->Uploads[k];
    auto move =
      SceneUniforms::MakeMove(this->Casters.Get()[k].Matrix.data(), upload.Center, origin);
    program->SetUniformMatrix4x4("toScene", move.data());
    drawn = drawn ? upload.Triangles->Draw(program, { { "position", 0, 3 } }) : drawn;
  }
  return drawn;
}
} // namespace LightTransport
