// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered exactly once in a body, for each fragment of its surface: the refracted
 * way of what the eye sees is marched through the medium up to where it leaves the body, and from
 * each place on it a straight way goes to each light, through the scene's triangles. With index n,
 * cosines mu outside and mu' inside, transmittance T and irradiance E at normal incidence
 *
 *   L = T(mu_o) / n^2 integral of sigma_s exp(-sigma_t s) p T(mu_i) mu_i / mu_i' E
 *       exp(-sigma_t d') ds,   d' = d mu_i / mu_i'
 *
 * over the length s of the way, d of the straight one inside: exact for an index of 1, and for
 * distant lights on flat surfaces; elsewhere light is not focused (H. W. Jensen and others, A
 * practical model for subsurface light transport, 2001, eq. 9 and 10, with the solid angles that
 * refraction changes). Reflections inside are not followed.
 */
#ifndef MarchedScattering_h
#define MarchedScattering_h

#include "Maps/SceneLights.h"
#include "Shared/Outcome.h"

#include <string>
#include <vector>

class vtkMatrix4x4;
class vtkRenderer;
class vtkShaderProgram;
class vtkSubsurfaceScattering;

namespace LightTransport
{
class SceneTree;

class MarchedScattering
{
public:
  /// In lengths of the scene.
  struct Medium
  {
    Vector3 Scattering = {}; ///< not the reduced coefficient
    Vector3 Extinction = {};
    Vector3 Anisotropy = {};
    double RefractiveIndex = 1.0;
  };

  /// Of a surface that a matrix moves. Fails for numbers that are out of range.
  static Outcome MakeMedium(vtkSubsurfaceScattering* material, vtkMatrix4x4* matrix,
    Medium& medium);

  /// For the next frame of a renderer, whose tree is up to date. Fails for lights that are none;
  /// there are none then.
  Outcome Update(vtkRenderer* renderer, const SceneTree& tree);
  int GetNumberOfLights() const { return static_cast<int>(this->Lights.size() / FloatsOfLight); }

  /// Into a shader that draws radiance (RadianceShader), when the mapper has written its code.
  void Write(std::string& fragmentShader) const;

  /// For such a program, in which the tree is active; `body` is the tree's number.
  void SetUniforms(vtkShaderProgram* program, const Medium& medium, int body, int steps) const;

private:
  static constexpr int FloatsOfLight = 16;

  std::vector<float> Lights;
};
} // namespace LightTransport

#endif
