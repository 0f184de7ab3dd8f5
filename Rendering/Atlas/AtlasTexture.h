// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The texture of an atlas with its levels of detail, and samples of it drawn by a fragment shader.
 * All calls but Open, Clear and the destructor within a DeviceSession.
 */
#ifndef AtlasTexture_h
#define AtlasTexture_h

#include "Textures/FloatTextures.h"

#include <memory>
#include <vector>

class vtkDataArray;
class vtkDoubleArray;
class vtkFloatArray;

namespace LightTransport
{
class AtlasTexture
{
public:
  AtlasTexture() = default;
  ~AtlasTexture() { this->Clear(); }
  AtlasTexture(const AtlasTexture&) = delete;
  void operator=(const AtlasTexture&) = delete;

  /// Work in the context of this window, which has one already, or of the shared one.
  Outcome Open(vtkRenderWindow* window);
  /// False before Open and after the window has gone.
  bool IsOpen() const { return this->Engine && this->Engine->IsAlive(); }
  FloatTextures& GetEngine() { return *this->Engine; }

  /// Makes the texture and its levels of resolution^2 texels (MakeAtlasTexels) that hold values of
  /// so many components.
  Outcome Upload(const std::vector<float>& rgba, int resolution, int components);
  /// Allocate for three components; a failure tells how many bytes that takes, and how many are
  /// there. `name` is the property that is the resolution.
  Outcome AllocateWithinMemory(int resolution, const char* name);
  ///@{ The same in two steps, for texels that are drawn: into level 0, then the others are made.
  Outcome Allocate(int resolution, int components);
  const FloatTextures::Group& GetTexels() const { return this->Atlas; }
  Outcome MakeLevels();
  ///@}
  bool IsThere() const { return this->IsOpen() && !this->Atlas.empty(); }
  /// Drops the texture.
  void ClearTexture();
  /// Drops everything.
  void Clear();

  /// nullptr where there is none.
  vtkTextureObject* Get() { return this->Atlas.empty() ? nullptr : this->Atlas[0].Get(); }

  ///@{ 0 where there is no texture.
  int GetResolution() const { return this->Resolution; }
  int GetNumberOfComponents() const { return this->Components; }
  int GetNumberOfLevels() const;
  ///@}

  ///@{
  /// As in vtkOpenGLAtlasTexture; arguments fit.
  Outcome ReadLevel(int level, vtkFloatArray* texels);
  Outcome Sample(vtkDataArray* coordinates, vtkDataArray* blocks, vtkDataArray* levels,
    vtkDoubleArray* values);
  ///@}

private:
  Outcome DrawPoints(const FloatTextures::Group& target, const FloatTextures::Group& points,
    const FloatTextures::Group& blocks, int height);

  vtkSmartPointer<vtkOpenGLRenderWindow> SharedWindow;
  std::unique_ptr<FloatTextures> Engine;
  FloatTextures::Group Atlas;
  int Resolution = 0;
  int Components = 0;
};
} // namespace LightTransport

#endif
