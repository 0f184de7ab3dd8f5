// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLTransmittedMap.h"

#include "Atlas/AtlasTexture.h"
#include "Device/DeviceSession.h"
#include "Maps/AtlasDrawing.h"
#include "Maps/EnvironmentLight.h"
#include "Maps/LightDrawing.h"
#include "Maps/SceneLights.h"
#include "Maps/ShadowMap.h"
#include "Maps/SurfaceBumps.h"
#include "Maps/SurfaceValues.h"
#include "Shared/ArrayNames.h"
#include "Shared/Attempt.h"
#include "Shared/BitHash.h"
#include "Shared/Fresnel.h"
#include "Shared/SphericalHarmonics.h"
#include "vtkOpenGLAtlasTexture.h"
#include "vtkSurfaceLighting.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRadianceTransfer.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLTransmittedMap);

namespace
{
constexpr Advice WithoutMemory = { "use smaller maps, or a surface of fewer triangles",
  "OpenGL gave up", "try a newer driver" };
/// Of the scene: nothing nearer casts a shadow.
constexpr double ShadowBias = 1e-5;
/// Of harmonics that are computed from normals alone.
constexpr int SmoothDegree = 2;
/// What may make a matrix other than a turn and one scale.
constexpr double TurnTolerance = 1e-5;

//------------------------------------------------------------------------------
/// By its place among the actors of a renderer.
std::string Describe(vtkActor* actor, vtkRenderer* renderer)
{
  vtkActorCollection* actors = renderer->GetActors();
  const int place = actors->IsItemPresent(actor);
  return place > 0 ? "Actor " + std::to_string(place) + " of " +
      std::to_string(actors->GetNumberOfItems()) + " of the renderer: "
                   : "An actor in an assembly, or a block of composite data: ";
}

//------------------------------------------------------------------------------
/// The turn in a matrix that may scale evenly, too, after another turn.
Outcome Turn(const double outer[9], const std::array<double, 16>& matrix,
  SphericalHarmonics::Matrix& turn)
{
  double inner[3][3];
  double product[3][3];
  for (std::size_t k = 0; k < 9; ++k)
  {
    inner[k / 3][k % 3] = matrix[4 * (k / 3) + k % 3];
  }
  const double scale = std::cbrt(vtkMath::Determinant3x3(inner));
  vtkMath::Transpose3x3(inner, product);
  vtkMath::Multiply3x3(product, inner, product);
  for (std::size_t k = 0; k < 9; ++k)
  {
    const double expected = k / 3 == k % 3 ? scale * scale : 0.0;
    if (!(scale > 0.0) ||
      !(std::abs(product[k / 3][k % 3] - expected) <= TurnTolerance * scale * scale))
    {
      return Outcome::Failed("Radiance transfer needs an actor that is moved, turned and scaled "
                             "evenly alone: move its points instead.");
    }
    turn[k] = 0.0;
    for (std::size_t step = 0; step < 3; ++step)
    {
      turn[k] += outer[3 * (k / 3) + step] * inner[step][k % 3] / scale;
    }
  }
  return Outcome::Done();
}
} // namespace

/// All that the map depends on.
struct vtkOpenGLTransmittedMap::State
{
  vtkActor* Actor = nullptr;
  vtkRenderer* Renderer = nullptr;
  vtkPolyData* Surface = nullptr;
  std::uint64_t SurfaceStamp = 0;
  std::uint64_t ArrayStamp = 0; ///< of light in arrays
  std::uint64_t BumpStamp = 0;  ///< 0 without
  bool HasShadows = false;
  std::uint64_t ShadowStamp = 0; ///< of what casts them
  vtkMTimeType OwnTime = 0;
  vtkMTimeType LightingTime = 0;
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
    const auto tie = [](const State& state)
    {
      return std::tie(state.Surface, state.SurfaceStamp, state.ArrayStamp, state.BumpStamp,
        state.HasShadows, state.ShadowStamp, state.OwnTime, state.LightingTime, state.Matrix,
        state.Bounds, state.Lights);
    };
    return tie(*this) == tie(other);
  }
};

/// What lights a surface, as it is drawn.
struct vtkOpenGLTransmittedMap::Sum
{
  std::vector<SceneLight> Lights;
  std::vector<double> Harmonics; ///< up to SmoothDegree, what of them enters; empty for none
  std::vector<LightDrawing::Values> Values;
};

struct vtkOpenGLTransmittedMap::Parts
{
  vtkSmartPointer<vtkSurfaceLighting> Lighting = vtkSmartPointer<vtkSurfaceLighting>::New();
  std::unique_ptr<AtlasDrawing> Drawing; ///< there where the texture is open
  std::shared_ptr<ShadowMap> Shadow = std::make_shared<ShadowMap>();
  SurfaceValues Irradiance;
  SurfaceValues Transfer;
  SurfaceBumps Bumps;
  State Drawn; ///< what the last drawing, or attempt, was made for
  bool HasFailed = false;
  std::string Problem; ///< of the last attempt
  ///@{ Refractive indices that a warning has told of: of an array, and of the material.
  double ToldOf = 0.0;
  double ToldFor = 0.0;
  ///@}
  vtkTimeStamp RunTime;
  std::uint64_t Shape = 0; ///< that was last taken; stays when the device's memory goes
  vtkTimeStamp SurfaceTime;

  /// Forgets what is on the device.
  void Clear()
  {
    this->Drawing.reset();
    this->Shadow->Clear();
    this->Irradiance = SurfaceValues();
    this->Transfer = SurfaceValues();
    this->Bumps = SurfaceBumps();
  }
};

//------------------------------------------------------------------------------
vtkOpenGLTransmittedMap::vtkOpenGLTransmittedMap() : Device(new Parts)
{
  this->Texture->IsDrawnInto = true;
}

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
  os << indent << "Lighting: " << this->Device->Lighting.Get() << "\n";
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
void vtkOpenGLTransmittedMap::SetLighting(vtkSurfaceLighting* lighting)
{
  if (lighting && this->Device->Lighting != lighting)
  {
    this->Device->Lighting = lighting;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkSurfaceLighting* vtkOpenGLTransmittedMap::GetLighting()
{
  return this->Device->Lighting;
}

//------------------------------------------------------------------------------
void vtkOpenGLTransmittedMap::ShareShadows(vtkOpenGLTransmittedMap* other)
{
  this->Device->Shadow = other->Device->Shadow;
}

//------------------------------------------------------------------------------
void vtkOpenGLTransmittedMap::ReleaseGraphicsResources()
{
  this->Device->Clear();
  this->Device->Drawn = State();
  this->Texture->Texture->Clear();
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
    vtkErrorMacro(<< Describe(actor, renderer) << done.GetMessage());
  }
  return static_cast<bool>(done);
}

//------------------------------------------------------------------------------
// Everything anew where the window is another one, or has lost its context.
Outcome vtkOpenGLTransmittedMap::Open(vtkRenderer* renderer)
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  if (!texture.IsOpen() || texture.GetEngine().GetWindow() != renderer->GetRenderWindow())
  {
    parts.Clear();
    texture.Clear();
    if (!renderer->GetRenderWindow())
    {
      return Outcome::Failed("The renderer has no window: add it to one.");
    }
    if (Outcome open = texture.Open(renderer->GetRenderWindow()); !open)
    {
      return Outcome::Failed("No OpenGL context to draw an atlas in: " + open.GetMessage());
    }
    parts.Drawn = State();
    parts.Drawing = std::make_unique<AtlasDrawing>(texture.GetEngine());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::Look(vtkActor* actor, vtkRenderer* renderer, State& state)
{
  vtkSurfaceLighting* lighting = this->Device->Lighting;
  state.Actor = actor;
  state.Renderer = renderer;
  // Also of an attempt that finds no surface: it is not what was drawn before the first one.
  state.OwnTime = this->GetMTime();
  state.LightingTime = lighting->GetMTime();
  if (Outcome found = AtlasDrawing::FindSurface(actor, state.Surface); !found)
  {
    return found;
  }
  state.SurfaceStamp = ChartedSurface::GetStamp(state.Surface);
  BitHash arrays;
  if (!lighting->IrradianceArray.empty())
  {
    arrays.Add(SurfaceValues::GetStamp(state.Surface, lighting->IrradianceArray));
  }
  if (this->TakesTransfer())
  {
    arrays.Add(SurfaceValues::GetStamp(state.Surface, ArrayNames::RadianceTransfer));
  }
  state.ArrayStamp = arrays.Get();
  state.BumpStamp = lighting->Bumps ? SurfaceBumps::GetStamp(actor, state.Surface) : 0;
  actor->ComputeMatrix();
  std::copy_n(actor->GetMatrix()->GetData(), 16, state.Matrix.begin());
  actor->GetBounds(state.Bounds.data());
  state.HasShadows = this->Shadows &&
    (lighting->RendererLights ||
      (lighting->GetEnvironment() &&
        lighting->EnvironmentMethod == vtkSurfaceLighting::ENVIRONMENT_METHOD_DIRECTIONS));
  if (state.HasShadows)
  {
    this->Device->Shadow->Find(renderer);
    state.ShadowStamp = this->Device->Shadow->GetCasters().GetStamp();
  }
  return lighting->RendererLights ? SceneLights::Read(renderer, state.Lights) : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::Refresh(vtkActor* actor, vtkRenderer* renderer)
{
  Parts& parts = *this->Device;
  State state;
  Outcome done = this->Look(actor, renderer, state);
  done = done ? this->Open(renderer) : done;
  const bool isSame = state == parts.Drawn;
  if (done && isSame && (parts.HasFailed || this->Texture->Texture->IsThere()))
  {
    return parts.HasFailed ? Outcome::FailedAsReported() : Outcome::Done();
  }
  const bool wasThere = static_cast<bool>(done);
  // Also a drawing that runs out of memory is not tried again and again.
  done = done ? Attempt([&]() { return this->Draw(state); }, WithoutMemory) : done;
  parts.Drawn = state;
  // What cannot even begin is tried again each time, and told once.
  const bool isTold = !wasThere && isSame && parts.HasFailed && parts.Problem == done.GetMessage();
  parts.HasFailed = !done;
  parts.Problem = done.GetMessage();
  if (done)
  {
    ++this->NumberOfRuns;
    parts.RunTime.Modified();
  }
  else
  {
    this->Texture->Texture->ClearTexture();
  }
  return isTold ? Outcome::FailedAsReported() : done;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::Draw(const State& state)
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  if (state.HasShadows)
  {
    parts.Shadow->Open(texture.GetEngine().GetWindow());
  }
  const DeviceSession session(texture.GetEngine().GetWindow());
  if (!state.HasSurfaceOf(parts.Drawn) || parts.HasFailed)
  {
    if (Outcome set = parts.Drawing->SetSurface(state.Surface); !set)
    {
      return set;
    }
    const std::uint64_t shape = parts.Drawing->GetSurface().GetHash();
    if (shape != parts.Shape)
    {
      parts.Shape = shape;
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
  if (state.HasShadows && !parts.Shadow->SetSize(this->ShadowMapSize))
  {
    return Outcome::Failed("A shadow map of " + std::to_string(this->ShadowMapSize) +
      " texels a side does not fit into " + texture.GetEngine().GetDeviceName() +
      ": choose a smaller ShadowMapSize.");
  }
  Sum sum;
  if (Outcome read = this->ReadLighting(state, sum); !read)
  {
    return read;
  }
  Outcome drawn = this->AddLights(state, sum);
  drawn = drawn ? texture.MakeLevels() : drawn;
  return drawn ? drawn
               : Outcome::Failed("OpenGL failed in lighting an atlas with " + drawn.GetMessage() +
                   " on " + texture.GetEngine().GetDeviceName() + ".");
}

//------------------------------------------------------------------------------
bool vtkOpenGLTransmittedMap::TakesTransfer()
{
  vtkSurfaceLighting* lighting = this->Device->Lighting;
  return lighting->GetEnvironment() &&
    lighting->EnvironmentMethod == vtkSurfaceLighting::ENVIRONMENT_METHOD_TRANSFER;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::ReadLighting(const State& state, Sum& sum)
{
  Parts& parts = *this->Device;
  FloatTextures& engine = this->Texture->Texture->GetEngine();
  vtkSurfaceLighting* lighting = parts.Lighting;
  sum.Lights = state.Lights;
  Outcome read =
    state.BumpStamp ? parts.Bumps.Update(engine, state.Surface, state.BumpStamp) : Outcome::Done();
  read = read && lighting->GetEnvironment() ? this->ReadEnvironment(state, sum) : read;
  read = read && !lighting->IrradianceArray.empty() ? this->ReadIrradiance(state, sum) : read;
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::ReadEnvironment(const State& state, Sum& sum)
{
  vtkSurfaceLighting* lighting = this->Device->Lighting;
  const EnvironmentLight* light = nullptr;
  double axes[9];
  Outcome read = lighting->ReadEnvironment(light);
  read = read ? lighting->GetTurn(axes) : read;
  if (!read)
  {
    return read;
  }
  if (this->TakesTransfer())
  {
    return this->ReadTransfer(state, *light, axes, sum);
  }
  SphericalHarmonics::Matrix turn;
  std::copy_n(axes, 9, turn.begin());
  if (lighting->EnvironmentMethod == vtkSurfaceLighting::ENVIRONMENT_METHOD_DIRECTIONS)
  {
    const std::vector<SceneLight> directions = light->GetDirections(turn);
    sum.Lights.insert(sum.Lights.end(), directions.begin(), directions.end());
    return read;
  }
  sum.Harmonics = light->GetHarmonics(SmoothDegree, turn);
  const std::vector<double> kernel =
    SphericalHarmonics::GetCosineKernel(SmoothDegree, this->RefractiveIndex);
  for (std::size_t k = 0; k < sum.Harmonics.size(); ++k)
  {
    const std::size_t harmonic = k / EnvironmentLight::Bands;
    sum.Harmonics[k] *= kernel[harmonic < 1 ? 0 : harmonic < 4 ? 1 : 2];
  }
  return read;
}

//------------------------------------------------------------------------------
// In the surface's own coordinates, which its transfer was computed in.
Outcome vtkOpenGLTransmittedMap::ReadTransfer(const State& state, const EnvironmentLight& light,
  const double axes[9], Sum& sum)
{
  SurfaceValues& transfer = this->Device->Transfer;
  Outcome read = transfer.Update(this->Texture->Texture->GetEngine(), state.Surface,
    ArrayNames::RadianceTransfer, "use vtkRadianceTransfer, or another EnvironmentMethod");
  SphericalHarmonics::Matrix turn;
  read = read ? Turn(axes, state.Matrix, turn) : read;
  if (!read)
  {
    return read;
  }
  const int components = transfer.GetNumberOfComponents();
  const int degree = static_cast<int>(std::lround(std::sqrt(components))) - 1;
  if (degree > vtkRadianceTransfer::LargestDegree || (degree + 1) * (degree + 1) != components)
  {
    return Outcome::Failed("The array \"RadianceTransfer\" has " + std::to_string(components) +
      " components, which is no square up to 36: use vtkRadianceTransfer.");
  }
  this->WarnOfIndex(state);
  const std::vector<double> harmonics = light.GetHarmonics(degree, turn);
  sum.Values.push_back({ transfer.GetTable(), transfer.AreOfPoints(),
    std::vector<float>(harmonics.begin(), harmonics.end()) });
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLTransmittedMap::ReadIrradiance(const State& state, Sum& sum)
{
  vtkSurfaceLighting* lighting = this->Device->Lighting;
  SurfaceValues& irradiance = this->Device->Irradiance;
  if (Outcome read = irradiance.Update(this->Texture->Texture->GetEngine(), state.Surface,
        lighting->IrradianceArray, "compute it, or set another IrradianceArray");
      !read)
  {
    return read;
  }
  const int components = irradiance.GetNumberOfComponents();
  if (components != 1 && components != 3)
  {
    return Outcome::Failed("The array \"" + lighting->IrradianceArray + "\" has " +
      std::to_string(components) + " components: IrradianceArray needs 1 or 3.");
  }
  const bool hasEntered = lighting->Incidence == vtkSurfaceLighting::INCIDENCE_TRANSMITTED;
  if (hasEntered)
  {
    this->WarnOfIndex(state);
  }
  const auto share = static_cast<float>(
    hasEntered ? 1.0 : 1.0 - Fresnel::GetMeanExternalReflectance(this->RefractiveIndex));
  // Each band from its component, or all from the only one.
  std::vector<float> weights(static_cast<std::size_t>(3 * components), 0.0f);
  for (std::size_t band = 0; band < 3; ++band)
  {
    weights[components == 1 ? band : 4 * band] = share;
  }
  sum.Values.push_back({ irradiance.GetTable(), irradiance.AreOfPoints(), weights });
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Once: lights may change with each frame.
void vtkOpenGLTransmittedMap::WarnOfIndex(const State& state)
{
  Parts& parts = *this->Device;
  vtkDataArray* recorded = state.Surface->GetFieldData()->GetArray(ArrayNames::RefractiveIndex);
  const double index = recorded && recorded->GetNumberOfValues() > 0 ? recorded->GetComponent(0, 0)
                                                                     : this->RefractiveIndex;
  const bool isTold = parts.ToldOf == index && parts.ToldFor == this->RefractiveIndex;
  if (std::abs(index - this->RefractiveIndex) > 1e-9 && !isTold)
  {
    parts.ToldOf = index;
    parts.ToldFor = this->RefractiveIndex;
    vtkWarningMacro(<< Describe(state.Actor, state.Renderer)
                    << "What enters was computed for a refractive index of " << index
                    << ", but that of the material is " << this->RefractiveIndex
                    << ": compute it again for that.");
  }
}

//------------------------------------------------------------------------------
// Light by light, and view by view, so that one shadow map is enough.
Outcome vtkOpenGLTransmittedMap::AddLights(const State& state, const Sum& sum)
{
  Parts& parts = *this->Device;
  AtlasTexture& texture = *this->Texture->Texture;
  texture.GetEngine().Clear(texture.GetTexels());
  const Box scene = this->GetSceneBounds(state);
  LightDrawing::Setup setup;
  setup.Matrix = state.Matrix.data();
  setup.Origin = state.GetOrigin();
  setup.RefractiveIndex = this->RefractiveIndex;
  setup.ShadowBias =
    ShadowBias * std::max({ scene[1] - scene[0], scene[3] - scene[2], scene[5] - scene[4] });
  setup.Samples = this->Samples;
  setup.IsAtCorners = parts.Lighting->AtCorners;
  if (state.BumpStamp)
  {
    setup.Bumps = parts.Bumps.Activate(state.Actor, state.Renderer);
  }
  LightDrawing drawing(*parts.Drawing, state.HasShadows ? parts.Shadow.get() : nullptr,
    texture.GetTexels(), setup);
  Outcome drawn = Outcome::Done();
  for (const SceneLight& light : sum.Lights)
  {
    for (const LightView& view :
      SceneLights::MakeViews(light, state.Bounds.data(), scene.data(), this->ShadowMapSize))
    {
      drawn = drawn ? drawing.AddLight(light, view) : drawn;
    }
  }
  drawn = drawn && !sum.Harmonics.empty() ? drawing.AddHarmonics(sum.Harmonics) : drawn;
  for (const LightDrawing::Values& values : sum.Values)
  {
    drawn = drawn ? drawing.AddValues(values) : drawn;
  }
  drawn = drawn ? drawing.Finish() : drawn;
  if (state.BumpStamp)
  {
    parts.Bumps.Deactivate(state.Actor, state.Renderer);
  }
  return drawn;
}

//------------------------------------------------------------------------------
// What is lit casts no shadows itself where it is drawn as lines.
vtkOpenGLTransmittedMap::Box vtkOpenGLTransmittedMap::GetSceneBounds(const State& state) const
{
  vtkBoundingBox scene(state.Bounds.data());
  const Box& casters = this->Device->Shadow->GetCasters().GetBounds();
  if (state.HasShadows && vtkMath::AreBoundsInitialized(casters.data()))
  {
    scene.AddBounds(casters.data());
  }
  Box bounds;
  scene.GetBounds(bounds.data());
  return bounds;
}
