// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Adds what enters a surface to a texture of its atlas: light by light, each a drawing. Within a
/// DeviceSession.
#ifndef LightDrawing_h
#define LightDrawing_h

#include "Maps/AtlasDrawing.h"
#include "Maps/SceneLights.h"
#include "Textures/FloatTextures.h"

#include <array>
#include <string>
#include <vector>

class vtkShaderProgram;
class vtkTextureObject;

namespace LightTransport
{
class ShadowMap;

class LightDrawing
{
public:
  /// Normals in tangent space, and where they are on the surface.
  struct BumpMap
  {
    int TextureUnit = -1; ///< of the normals, which are active; -1 where there are none
    double Scale = 1.0;
    vtkTextureObject* Tangents = nullptr; ///< two texels for each point
  };
  struct Setup
  {
    const double* Matrix = nullptr; ///< of the surface, row by row
    Vector3 Origin = {};            ///< of what shaders get
    double RefractiveIndex = 1.0;
    double ShadowBias = 0.0;
    int Samples = 1; ///< of a texel in each direction
    bool IsAtCorners = false;
    BumpMap Bumps;
  };

  /// `shadows` may be nullptr. All must outlive this.
  LightDrawing(AtlasDrawing& drawing, ShadowMap* shadows, const FloatTextures::Group& target,
    const Setup& setup)
    : Drawing(drawing), Shadows(shadows), Target(target), With(setup)
  {
  }

  /// The part of a light that is in a view of it.
  Outcome AddLight(const SceneLight& light, const LightView& view);

  /// Spherical harmonics up to degree 2: what of each enters, three bands side by side.
  Outcome AddHarmonics(const std::vector<double>& entering);

  /// The product of tuples of the surface with weights, three for each component.
  struct Values
  {
    vtkTextureObject* Table = nullptr; ///< of points or triangles
    bool AreOfPoints = false;
    std::vector<float> Weights;
  };
  Outcome AddValues(const Values& values);

  /// The area of the surface, which the first drawing adds; where there was none, one of darkness.
  Outcome Finish();

private:
  Outcome Begin(vtkShaderProgram*& program, const AtlasDrawing::Light& light);
  void SetBumps(vtkShaderProgram* program, const AtlasDrawing::Light& code,
    std::vector<vtkTextureObject*>& active) const;
  Outcome Draw(vtkShaderProgram* program, const std::vector<vtkTextureObject*>& active);

  AtlasDrawing& Drawing;
  ShadowMap* Shadows;
  const FloatTextures::Group& Target;
  const Setup With;
  bool IsFirst = true;
};
} // namespace LightTransport

#endif
