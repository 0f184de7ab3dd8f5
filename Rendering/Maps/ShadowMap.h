// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the surfaces of a scene are from a light; for all bodies that are lit, one after
/// another. SetSize and Draw within a DeviceSession.
#ifndef ShadowMap_h
#define ShadowMap_h

#include "Maps/SceneLights.h"
#include "Maps/ShadowCasters.h"
#include "Maps/TriangleBuffer.h"
#include "Textures/FloatTextures.h"

#include <memory>
#include <vector>

class vtkOpenGLFramebufferObject;
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

  /// Look for the surfaces that cast shadows; they go to the device when they are drawn.
  void Find(vtkRenderer* renderer);
  const ShadowCasters& GetCasters() const { return this->Casters; }

  /// Texels a side, of the next drawing.
  Outcome SetSize(int size);

  /// Relative to `origin`, as all that shaders get.
  Outcome Draw(const LightView& view, const Vector3& origin);

  vtkTextureObject* GetTexture() const { return this->Depth; }

private:
  /// A caster on the device.
  struct Upload
  {
    Vector3 Center = {};
    std::unique_ptr<TriangleBuffer> Triangles;
    bool IsThere = false;
  };

  bool IsOpen() const { return this->Engine && this->Engine->IsAlive(); }
  Outcome Fill(Upload& upload, const ShadowCasters::Caster& caster) const;

  std::unique_ptr<FloatTextures> Engine;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Depth;
  int Size = 0;
  ShadowCasters Casters;
  std::vector<Upload> Uploads; ///< one for each caster
};
} // namespace LightTransport

#endif
