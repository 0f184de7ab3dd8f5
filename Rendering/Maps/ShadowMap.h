// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the surfaces of a scene are from a light. All calls but the constructor and the
/// destructor within a DeviceSession.
#ifndef ShadowMap_h
#define ShadowMap_h

#include "Maps/SceneLights.h"
#include "Maps/TriangleBuffer.h"
#include "Textures/FloatTextures.h"
#include "vtkWeakPointer.h"

#include <array>
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
  /// `engine` must outlive this.
  explicit ShadowMap(FloatTextures& engine);
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  void operator=(const ShadowMap&) = delete;

  /// Texels a side, of the next drawing.
  Outcome SetSize(int size);

  /// Look for the surfaces that cast shadows: of all visible actors, wherever the camera looks.
  /// `areOthers` becomes true where they are not those of the last call, or elsewhere.
  Outcome Update(vtkRenderer* renderer, bool& areOthers);

  /// xmin, xmax, ... of all of them.
  const double* GetBounds() const { return this->Bounds.data(); }

  /// Relative to `origin`, as all that shaders get.
  Outcome Draw(const LightView& view, const Vector3& origin);

  vtkTextureObject* GetTexture() const { return this->Depth; }

private:
  /// What of an actor casts shadows.
  struct Caster
  {
    vtkWeakPointer<vtkDataObject> Data;
    vtkMTimeType Time = 0;
    std::array<double, 16> Matrix = {};
    Vector3 Center = {};
    std::array<double, 6> Bounds = {};
    std::vector<std::unique_ptr<TriangleBuffer>> Triangles;
  };

  bool Find(vtkRenderer* renderer, std::vector<Caster>& found);
  Outcome Upload(Caster& caster);
  Outcome Upload(Caster& caster, vtkPolyData* data);
  void AddBounds();

  FloatTextures& Engine;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Depth;
  int Size = 0;
  std::vector<Caster> Casters;
  std::array<double, 6> Bounds = {};
};
} // namespace LightTransport

#endif
