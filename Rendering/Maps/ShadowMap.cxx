// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/ShadowMap.h"

#include "Context/OpenGLContextGuard.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceMemory.h"
#include "Maps/SceneUniforms.h"
#include "Passes/PlainMapper.h"
#include "Shared/BitHash.h"
#include "vtkLightTransportMapsLightView.h"
#include "vtkLightTransportMapsShadowFS.h"
#include "vtkLightTransportMapsShadowVS.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <string>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
bool CastsShadows(vtkActor* actor)
{
  return actor->GetVisibility() && actor->GetMapper() &&
    actor->GetMapper()->GetNumberOfInputConnections(0) > 0 && DrawsItsInput(actor->GetMapper()) &&
    actor->GetProperty()->GetRepresentation() == VTK_SURFACE &&
    actor->GetProperty()->GetOpacity() > 0.0;
}

//------------------------------------------------------------------------------
template <typename Visit>
void VisitSurfaces(vtkDataObject* data, const Visit& visit)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      visit(surface);
    }
    return;
  }
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    if (auto* surface = vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject()))
    {
      visit(surface);
    }
  }
}

//------------------------------------------------------------------------------
// Of the shape alone: arrays come and go.
std::uint64_t GetShapeStamp(vtkDataObject* data)
{
  BitHash hash;
  VisitSurfaces(data,
    [&](vtkPolyData* surface) {
      hash.AddObjects({ surface->GetPoints(), surface->GetPolys(), surface->GetStrips() });
    });
  return hash.Get();
}
} // namespace

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
  for (Caster& caster : this->Casters)
  {
    caster.Triangles.clear();
    caster.IsUploaded = false;
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
void ShadowMap::Find(vtkRenderer* renderer)
{
  std::vector<Caster> found;
  BitHash stamp;
  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator place;
  actors->InitTraversal(place);
  while (vtkActor* actor = actors->GetNextActor(place))
  {
    if (!CastsShadows(actor))
    {
      continue;
    }
    actor->GetMapper()->Update();
    Caster caster;
    caster.Data = actor->GetMapper()->GetInputDataObject(0, 0);
    if (!caster.Data)
    {
      continue;
    }
    caster.Stamp = GetShapeStamp(caster.Data);
    actor->ComputeMatrix();
    std::copy_n(actor->GetMatrix()->GetData(), 16, caster.Matrix.begin());
    actor->GetBounds(caster.Bounds.data());
    stamp.Add(caster.Stamp);
    for (const double number : caster.Matrix)
    {
      stamp.AddNumber(number);
    }
    this->TakeOver(caster);
    found.push_back(std::move(caster));
  }
  this->Casters = std::move(found);
  this->Stamp = stamp.Get();
  this->AddBounds();
}

//------------------------------------------------------------------------------
// What is on the device already.
void ShadowMap::TakeOver(Caster& caster)
{
  const auto known = std::find_if(this->Casters.begin(), this->Casters.end(),
    [&caster](const Caster& other)
    { return other.Data == caster.Data && other.Stamp == caster.Stamp && other.IsUploaded; });
  if (known != this->Casters.end())
  {
    caster.Center = known->Center;
    caster.Triangles = std::move(known->Triangles);
    caster.IsUploaded = true;
    known->IsUploaded = false;
  }
}

//------------------------------------------------------------------------------
void ShadowMap::AddBounds()
{
  vtkMath::UninitializeBounds(this->Bounds.data());
  for (const Caster& caster : this->Casters)
  {
    for (int axis = 0; axis < 3 && vtkMath::AreBoundsInitialized(caster.Bounds.data()); ++axis)
    {
      const bool isFirst = this->Bounds[2 * axis] > this->Bounds[2 * axis + 1];
      double& low = this->Bounds[2 * axis];
      double& high = this->Bounds[2 * axis + 1];
      low = isFirst ? caster.Bounds[2 * axis] : std::min(low, caster.Bounds[2 * axis]);
      high = isFirst ? caster.Bounds[2 * axis + 1] : std::max(high, caster.Bounds[2 * axis + 1]);
    }
  }
}

//------------------------------------------------------------------------------
Outcome ShadowMap::Upload(Caster& caster)
{
  bool isFirst = true;
  Outcome uploaded = Outcome::Done();
  caster.Triangles.clear();
  VisitSurfaces(caster.Data,
    [&](vtkPolyData* surface)
    {
      if (isFirst && surface->GetNumberOfPoints() > 0)
      {
        surface->GetPoint(0, caster.Center.data());
        isFirst = false;
      }
      uploaded = uploaded ? this->Upload(caster, surface) : uploaded;
    });
  caster.IsUploaded = static_cast<bool>(uploaded);
  return uploaded;
}

//------------------------------------------------------------------------------
Outcome ShadowMap::Upload(Caster& caster, vtkPolyData* data)
{
  vtkNew<vtkTriangleFilter> divider;
  divider->PassVertsOff();
  divider->PassLinesOff();
  divider->SetInputData(data);
  divider->Update();
  vtkPolyData* triangles = divider->GetOutput();
  std::vector<float> corners;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType cell = 0; cell < triangles->GetNumberOfPolys(); ++cell)
  {
    triangles->GetPolys()->GetCellAtId(cell, count, ids);
    for (vtkIdType corner = 0; corner < count; ++corner)
    {
      double point[3];
      triangles->GetPoint(ids[corner], point);
      for (int k = 0; k < 3; ++k)
      {
        corners.push_back(static_cast<float>(point[k] - caster.Center[k]));
      }
    }
  }
  if (corners.empty())
  {
    return Outcome::Done();
  }
  caster.Triangles.push_back(std::make_unique<TriangleBuffer>(*this->Engine));
  return caster.Triangles.back()->Upload(corners, 3);
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
  for (Caster& caster : this->Casters)
  {
    drawn = drawn && !caster.IsUploaded ? this->Upload(caster) : drawn;
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
  for (Caster& caster : this->Casters)
  {
    auto move = SceneUniforms::MakeMove(caster.Matrix.data(), caster.Center, origin);
    program->SetUniformMatrix4x4("toScene", move.data());
    for (const auto& triangles : caster.Triangles)
    {
      drawn = drawn ? triangles->Draw(program, { { "position", 0, 3 } }) : drawn;
    }
  }
  return drawn;
}
} // namespace LightTransport
