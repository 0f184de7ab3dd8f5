// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLTransmittedMap.h"

#include "Atlas/AtlasTexture.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceMemory.h"
#include "Device/DeviceSession.h"
#include "Maps/AtlasDrawing.h"
#include "Maps/SceneLights.h"
#include "Maps/SceneUniforms.h"
#include "Maps/ShadowMap.h"
#include "Shared/Attempt.h"
#include "Shared/TransportMemory.h"
#include "vtkLightTransportMapsIrradianceFS.h"
#include "vtkLightTransportPassesFresnelFS.h"
#include "vtkOpenGLAtlasTexture.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTimeStamp.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLTransmittedMap);

namespace
{
constexpr Advice WithoutMemory = { "use smaller maps, or a surface of fewer triangles",
  "OpenGL gave up", "try a newer driver" };
/// Of the scene: nothing nearer casts a shadow.
constexpr double ShadowBias = 1e-5;

} // namespace

/// All that the map depends on.
struct vtkOpenGLTransmittedMap::State
{
  vtkPolyData* Surface = nullptr;
  std::uint64_t SurfaceStamp = 0;
  vtkMTimeType OwnTime = 0;
  std::array<double, 16> Matrix = {};
  std::array<double, 6> Bounds = {};
  std::vector<SceneLight> Lights;

  Vector3 GetOrigin() const
  {
    return { 0.5 * (this->Bounds[0] + this->Bounds[1]), 0.5 * (this->Bounds[2] + this->Bounds[3]),
      0.5 * (this->Bounds[4] + this->Bounds[5]) };
  }
  bool HasSurfaceOf(const State& other) const
  {
    return this->Surface == other.Surface && this->SurfaceStamp == other.SurfaceStamp;
  }
  bool operator==(const State& other) const
  {
    return this->HasSurfaceOf(other) && this->OwnTime == other.OwnTime &&
      this->Matrix == other.Matrix && this->Bounds == other.Bounds && this->Lights == other.Lights;
  }
};

struct vtkOpenGLTransmittedMap::Parts
{
  ///@{ Both or none are there.
  std::unique_ptr<AtlasDrawing> Drawing;
  std::unique_ptr<ShadowMap> Shadow;
  ///@}
  State Drawn; ///< what the last drawing, or attempt, was made for
  bool HasFailed = false;
  vtkTimeStamp RunTime;
  State Known; ///< whose surface was last taken; stays when the device's memory goes
  vtkTimeStamp SurfaceTime;

  void Clear()
  {
    this->Drawing.reset();
    this->Shadow.reset();
    this->Drawn = State();
  }
};

//------------------------------------------------------------------------------
vtkOpenGLTransmittedMap::vtkOpenGLTransmittedMap() : Device(new Parts) {}

//------------------------------------------------------------------------------
vtkOpenGLTransmittedMap::~vtkOpenGLTransmittedMap()
{
  this->Device->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLTransmittedMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "ShadowMapSize: " << this->ShadowMapSize << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
  os << indent << "NumberOfRuns: " << this->NumberOfRuns << "\n";
}

//------------------------------------------------------------------------------
vtkOpenGLAtlasTexture* vtkOpenGLTransmittedMap::GetTexture()
{
  return this->Texture;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkOpenGLTransmittedMap::GetRunTime()
{
  return this->Device->RunTime.GetMTime();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkOpenGLTransmittedMap::GetSurfaceTime()
{
  return this->Device->SurfaceTime.GetMTime();
}

//------------------------------------------------------------------------------
AtlasDrawing* vtkOpenGLTransmittedMap::GetDrawing()
{
  return this->Texture->Texture->IsThere() ? this->Device->Drawing.get() : nullptr;
}

//------------------------------------------------------------------------------
void vtkOpenGLTransmittedMap::ReleaseGraphicsResources()
{
  this->Device->Clear();
  this->Texture->ReleaseGraphicsResources();
}

//------------------------------------------------------------------------------
bool vtkOpenGLTransmittedMap::Update(vtkActor* actor, vtkRenderer* renderer)
{
  if (!actor || !renderer)
  {
    vtkErrorMacro("There is no actor to light, or no renderer with lights.");
    return false;
  }
  const Outcome done = Attempt([&]() { return this->Refresh(actor, renderer); }, WithoutMemory);
  if (done.HasFailed() && !done.GetMessage().empty())
  {
    vtkErrorMacro(<< done.GetMessage());
  }
  return static_cast<bool>(done);
}

//------------------------------------------------------------------------------
// Everything anew where the window is another one, or has lost its context.
Outcome vtkOpenGLTransmittedMap::Open(vtkRenderer* renderer)
{
  AtlasTexture& texture = *this->Texture->Texture;
  if (texture.IsOpen() && texture.GetEngine().GetWindow() == renderer->GetRenderWindow())
  {
    return Outcome::Done();
  }
  this->ReleaseGraphicsResources();
  if (!renderer->GetRenderWindow())
  {
    return Outcome::Failed("The renderer has no window: add it to one.");
  }
  if (Outcome open = texture.Open(renderer->GetRenderWindow()); !open)
  {
    return Outcome::Failed("No OpenGL context to draw an atlas in: " + open.GetMessage());
  }
  this->Device->Drawing = std::make_unique<AtlasDrawing>(texture.GetEngine());
  this->Device->Shadow = std::make_unique<ShadowMap>(texture.GetEngine());
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::Refresh(vtkActor* actor, vtkRenderer* renderer)
{
  State state;
  // Also of an attempt that finds no surface: it is not what was drawn before the first one.
  state.OwnTime = this->GetMTime();
  Outcome found = AtlasDrawing::FindSurface(actor, state.Surface);
  if (found)
  {
    state.SurfaceStamp = ChartedSurface::GetStamp(state.Surface);
    actor->ComputeMatrix();
    std::copy_n(actor->GetMatrix()->GetData(), 16, state.Matrix.begin());
    actor->GetBounds(state.Bounds.data());
    found = SceneLights::Read(renderer, state.Lights);
  }
  found = found ? this->Open(renderer) : found;
  Parts& parts = *this->Device;
  bool areOthers = false;
  if (found && this->Shadows)
  {
    const DeviceSession session(this->Texture->Texture->GetEngine().GetWindow());
    found = parts.Shadow->Update(renderer, areOthers);
  }
  if (state == parts.Drawn && !areOthers)
  {
    return parts.HasFailed ? Outcome::FailedAsReported() : Outcome::Done();
  }
  found = found ? this->Draw(state) : found;
  parts.Drawn = state;
  parts.HasFailed = !found;
  if (found)
  {
    ++this->NumberOfRuns;
    parts.RunTime.Modified();
  }
  else
  {
    this->Texture->Texture->ClearTexture();
  }
  return found;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::Draw(const State& state)
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  const DeviceSession session(texture.GetEngine().GetWindow());
  if (!state.HasSurfaceOf(parts.Drawn) || parts.HasFailed)
  {
    if (Outcome set = parts.Drawing->SetSurface(state.Surface); !set)
    {
      return set;
    }
    if (!state.HasSurfaceOf(parts.Known))
    {
      parts.Known = state;
      parts.SurfaceTime.Modified();
    }
  }
  if (Outcome checked = parts.Drawing->CheckSize(this->Resolution, "IrradianceMapSize"); !checked)
  {
    return checked;
  }
  if (texture.GetResolution() != this->Resolution || !texture.IsThere())
  {
    if (Outcome allocated = texture.AllocateWithinMemory(this->Resolution, "IrradianceMapSize");
        !allocated)
    {
      return allocated;
    }
  }
  if (this->Shadows && !parts.Shadow->SetSize(this->ShadowMapSize))
  {
    return Outcome::Failed("A shadow map of " + std::to_string(this->ShadowMapSize) +
      " texels a side does not fit into " + texture.GetEngine().GetDeviceName() +
      ": choose a smaller ShadowMapSize.");
  }
  Outcome drawn = this->AddLights(state);
  drawn = drawn ? texture.MakeLevels() : drawn;
  return drawn ? drawn
               : Outcome::Failed("OpenGL failed in lighting an atlas with " + drawn.GetMessage() +
                   " on " + texture.GetEngine().GetDeviceName() + ".");
}

//------------------------------------------------------------------------------
// Light by light, and view by view, so that one shadow map is enough.
Outcome vtkOpenGLTransmittedMap::AddLights(const State& state)
{
  AtlasTexture& texture = *this->Texture->Texture;
  texture.GetEngine().Clear(texture.GetTexels());
  std::vector<SceneLight> lights = state.Lights;
  if (lights.empty())
  {
    // Darkness has an area, too.
    lights.emplace_back();
    lights.back().Axis[2] = 1.0;
  }
  const Box scene = this->GetSceneBounds(state);
  bool isFirst = true;
  Outcome drawn = Outcome::Done();
  for (const SceneLight& light : lights)
  {
    for (const LightView& view :
      SceneLights::MakeViews(light, state.Bounds.data(), scene.data(), this->ShadowMapSize))
    {
      drawn = drawn ? this->AddView(state, light, view, isFirst) : drawn;
      isFirst = false;
    }
  }
  return drawn;
}

//------------------------------------------------------------------------------
// What is lit casts no shadows itself where it is drawn as lines.
vtkOpenGLTransmittedMap::Box vtkOpenGLTransmittedMap::GetSceneBounds(const State& state) const
{
  vtkBoundingBox scene(state.Bounds.data());
  if (this->Shadows && vtkMath::AreBoundsInitialized(this->Device->Shadow->GetBounds()))
  {
    scene.AddBounds(this->Device->Shadow->GetBounds());
  }
  Box bounds;
  scene.GetBounds(bounds.data());
  return bounds;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::AddView(const State& state, const SceneLight& light,
  const LightView& view, bool countsArea)
{
  Parts& parts = *this->Device;
  const Vector3 origin = state.GetOrigin();
  const std::string body =
    std::string(vtkLightTransportPassesFresnelFS) + vtkLightTransportMapsIrradianceFS;
  vtkShaderProgram* program = nullptr;
  Outcome drawn = this->Shadows ? parts.Shadow->Draw(view, origin) : Outcome::Done();
  drawn = drawn ? parts.Drawing->Use(program, body.c_str(), 1) : drawn;
  if (!drawn)
  {
    return drawn;
  }
  const Box scene = this->GetSceneBounds(state);
  const double size = std::max({ scene[1] - scene[0], scene[3] - scene[2], scene[5] - scene[4] });
  AtlasDrawing::SetMove(program,
    SceneUniforms::MakeMove(state.Matrix.data(), parts.Drawing->GetSurface().Center, origin));
  SceneUniforms::SetLight(program, light, origin);
  SceneUniforms::SetView(program, view, origin);
  program->SetUniformi("hasShadows", this->Shadows ? 1 : 0);
  program->SetUniformf("bias", static_cast<float>(ShadowBias * size));
  program->SetUniformf("refractiveIndex", static_cast<float>(this->RefractiveIndex));
  program->SetUniformf("countsArea", countsArea ? 1.0f : 0.0f);
  vtkTextureObject* shadows = this->Shadows ? parts.Shadow->GetTexture() : nullptr;
  if (shadows)
  {
    shadows->Activate();
    program->SetUniformi("shadows", shadows->GetTextureUnit());
  }
  drawn = parts.Drawing->AddSamples(program, this->Texture->Texture->GetTexels(), this->Samples);
  if (shadows)
  {
    shadows->Deactivate();
  }
  return drawn;
}
