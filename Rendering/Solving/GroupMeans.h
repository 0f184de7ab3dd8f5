// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Values at the points of a scene from those of its patches, on the device: of each smooth group
 * the mean of its members, as vtkRadiosity::ShotProblem tells them.
 */
#ifndef GroupMeans_h
#define GroupMeans_h

#include "Textures/FloatTextures.h"

#include <array>
#include <vector>

namespace LightTransport
{
class GroupMeans
{
public:
  explicit GroupMeans(vtkOpenGLRenderWindow* window) : Engine(window) {}
  /// Within the life of the context, or after it.
  ~GroupMeans();
  GroupMeans(const GroupMeans&) = delete;
  void operator=(const GroupMeans&) = delete;

  bool IsAlive() const { return this->Engine.IsAlive(); }

  /// The members of group g are starts[g] to starts[g + 1]; patches lie in lines of `patchWidth`
  /// texels. The message of a failure has no full stop.
  Outcome Upload(const std::vector<vtkIdType>& starts, const std::vector<vtkIdType>& patches,
    const std::vector<double>& parts, int patchWidth);

  /// The mean of each group, times `scales`.
  Outcome Draw(vtkTextureObject* values, const std::array<float, 4>& scales);

  /// A texel for each group, in lines of 1 << WidthBits.
  vtkTextureObject* GetTexture() const { return this->Means.empty() ? nullptr : this->Means[0]; }
  static constexpr int WidthBits = 10;

private:
  FloatTextures Engine;
  FloatTextures::Group Ranges;
  FloatTextures::Group Members;
  FloatTextures::Group Means;
};
} // namespace LightTransport

#endif
