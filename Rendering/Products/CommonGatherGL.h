// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The sums over the CommonLinks of patches: what their slots send is copied into a buffer, which
 * stays on the device and is the constants of the program; then a fragment for each patch reads its
 * values.
 */
#ifndef CommonGatherGL_h
#define CommonGatherGL_h

#include "Products/HierarchyLayout.h"
#include "Products/ProductGL.h"
#include "Textures/VectorBuffer.h"

namespace LightTransport
{
class CommonGatherGL
{
public:
  using Group = FloatTextures::Group;

  CommonGatherGL(FloatTextures& engine, const FloatVectors::Layout& layout);
  ~CommonGatherGL();
  CommonGatherGL(const CommonGatherGL&) = delete;
  void operator=(const CommonGatherGL&) = delete;

  /// Bytes of the links on the device.
  static double GetNumberOfBytes(const CommonLinks& links, int width);

  /// Takes memory for the tables, and uploads them.
  Outcome Initialize(const HierarchyLayout& tables, int kernels, const ProductGL::Pause& pause);

  /// Into lines of patches of `target` from `firstLine` on, round after round.
  Outcome Draw(const Group& target, int firstLine, const Group& sent);

  int GetNumberOfTextures() const { return static_cast<int>(this->Values.size()); }

private:
  struct Part
  {
    int Round;
    int Line; ///< of all rounds
    int Lines;
    int TexelsOfKernel;
  };

  void Upload(const HierarchyLayout& tables, const ProductGL::Pause& pause);
  Outcome Hear(const Group& sent);
  Outcome Use(vtkShaderProgram*& program, int texelsOfKernel);
  void SetConstants(vtkShaderProgram* program, int round);
  void LetGoOfConstants();

  FloatTextures& Engine;
  const FloatVectors::Layout Vectors;
  int Kernels = 0;
  std::vector<Part> Parts;
  std::vector<Group> Values; ///< of each part
  Group Slots;               ///< of the links of all rounds
  Group Heard;               ///< by these links
  VectorBuffer Constants{ 1 };
};
} // namespace LightTransport

#endif
