// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shadows in what VTK itself shades: for each fragment and light a ray to the light, through the
 * scene's triangles. Written into mappers' shaders, whatever draws them: a fragment of a
 * translucent layer, or of a finer picture that is smoothed later, has its own rays.
 */
#ifndef ExactShadows_h
#define ExactShadows_h

#include "Shared/Outcome.h"
#include "Tracing/SceneTree.h"

#include <array>
#include <string>
#include <vector>

class vtkRenderer;
class vtkShaderProgram;

namespace LightTransport
{
class ExactShadows
{
public:
  /// For the next frame.
  Outcome Update(vtkRenderer* renderer);
  bool AreThere() const { return this->Tree.IsThere(); }
  /// How often the scene was put on the device.
  vtkIdType GetNumberOfRuns() const { return this->Tree.GetNumberOfRuns(); }

  ///@{ Before and after a mapper writes its own code.
  static void MarkPlace(std::string& fragmentShader);
  static void FillPlace(std::string& fragmentShader);
  ///@}

  /// For a program that FillPlace may have written into.
  void SetUniforms(vtkShaderProgram* program);

  /// When the frame is drawn.
  void LetGo();
  void Clear();

private:
  SceneTree Tree;
  std::vector<float> Lights; ///< of each, what is towards it, or its place, and 1
  std::array<float, 16> ToScene = {};
  bool IsActive = false;
};
} // namespace LightTransport

#endif
