// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// An environment as light: spherical harmonics, or a few directions. Both turn without being made
/// again.
#ifndef EnvironmentLight_h
#define EnvironmentLight_h

#include "Maps/SceneLights.h"
#include "Shared/EnvironmentPicture.h"
#include "Shared/SphericalHarmonics.h"

#include <vector>

class vtkImageData;

namespace LightTransport
{
class EnvironmentLight
{
public:
  static constexpr int Bands = EnvironmentPicture::Bands;

  /// Take over a picture: harmonics up to a degree, and at most so many directions (0: none).
  Outcome Read(vtkImageData* picture, int degree, int directions);

  /// Coefficients of radiance up to a degree, at most that of Read, seen along turn * direction.
  std::vector<double> GetHarmonics(int degree, const SphericalHarmonics::Matrix& turn) const;

  /// A distant light for each direction, in a scene that the picture sees along turn * direction.
  std::vector<SceneLight> GetDirections(const SphericalHarmonics::Matrix& turn) const;

private:
  std::vector<double> Harmonics;
  std::vector<SceneLight> Directions;
};
} // namespace LightTransport

#endif
