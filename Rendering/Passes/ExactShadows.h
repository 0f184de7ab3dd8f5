// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shadows in what VTK itself shades: for each fragment and light a ray to the light, through the
 * scene's triangles. Written into mappers' shaders, whatever draws them: a fragment of a
 * translucent layer, or of a finer picture that is smoothed later, has its own rays.
 */
#ifndef ExactShadows_h
#define ExactShadows_h

#include "Maps/SceneLights.h"
#include "Shared/Outcome.h"

#include <string>
#include <vector>

class vtkActor;
class vtkRenderer;
class vtkShaderProgram;

namespace LightTransport
{
class SceneTree;

class ExactShadows
{
public:
  /// For the next frame of a renderer, whose tree is up to date. Fails for lights that are nowhere,
  /// which cast no shadows; the others do.
  Outcome Update(vtkRenderer* renderer, const SceneTree& tree);

  ///@{ Before and after a mapper writes its own code. False where nothing was there to be filled:
  /// the code has no light by the names that VTK has for it.
  static void MarkPlace(std::string& fragmentShader);
  static bool FillPlace(std::string& fragmentShader);
  ///@}

  /// Whether VTK shades what it draws of an actor, so that there is a place to be filled.
  bool IsShaded(vtkActor* actor) const;

  /// For a program that FillPlace has written into, in which the tree is active.
  void SetUniforms(vtkShaderProgram* program) const;
  static bool IsUsedBy(vtkShaderProgram* program);

private:
  std::vector<float> Lights; ///< of each, what is towards it, or its place, and 1; nowhere: -1
};
} // namespace LightTransport

#endif
