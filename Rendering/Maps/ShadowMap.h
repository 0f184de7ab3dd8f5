// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the surfaces of a scene are from a light; for all bodies that are lit, one after
/// another. SetSize and Draw within a DeviceSession.
#ifndef ShadowMap_h
#define ShadowMap_h

#include "Maps/SceneLights.h"
#include "Maps/TriangleBuffer.h"
#include "Textures/FloatTextures.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class vtkActor;
class vtkDataObject;
class vtkOpenGLFramebufferObject;
class vtkPolyData;
class vtkRenderer;

namespace LightTransport
{
class ShadowMap
{
public:
  ShadowMap();
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  void operator=(const ShadowMap&) = delete;

  /// Work in the context of this window, which has one already.
  void Open(vtkOpenGLRenderWindow* window);
  /// Drops all that is on the device.
  void Clear();

  /// Look for the surfaces that cast shadows: of all visible actors, wherever the camera looks.
  /// They are brought up to date, and go to the device when they are drawn.
  void Find(vtkRenderer* renderer);

  /// Another number where they, or their places, are others.
  std::uint64_t GetStamp() const { return this->Stamp; }

  /// xmin, xmax, ... of all of them.
  const double* GetBounds() const { return this->Bounds.data(); }

  /// Texels a side, of the next drawing.
  Outcome SetSize(int size);

  /// Relative to `origin`, as all that shaders get.
  Outcome Draw(const LightView& view, const Vector3& origin);

  vtkTextureObject* GetTexture() const { return this->Depth; }

private:
  /// What of an actor casts shadows.
  struct Caster
  {
    vtkWeakPointer<vtkDataObject> Data;
    std::uint64_t Stamp = 0; ///< of its shape
    std::array<double, 16> Matrix = {};
    Vector3 Center = {};
    std::array<double, 6> Bounds = {};
    std::vector<std::unique_ptr<TriangleBuffer>> Triangles;
    bool IsUploaded = false;
  };

  bool IsOpen() const { return this->Engine && this->Engine->IsAlive(); }
  void TakeOver(Caster& caster);
  Outcome Upload(Caster& caster);
  Outcome Upload(Caster& caster, vtkPolyData* data);
  void AddBounds();

  std::unique_ptr<FloatTextures> Engine;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Depth;
  int Size = 0;
  std::vector<Caster> Casters;
  std::uint64_t Stamp = 0;
  std::array<double, 6> Bounds = {};
};
} // namespace LightTransport

#endif
