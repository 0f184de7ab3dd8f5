// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The lights of a renderer as numbers, and how shadow maps look from them.
#ifndef SceneLights_h
#define SceneLights_h

#include "Shared/Outcome.h"

#include <array>
#include <vector>

class vtkRenderer;

namespace LightTransport
{
using Vector3 = std::array<double, 3>;

/// A light in world coordinates; its irradiance at normal incidence is Color / attenuation.
struct SceneLight
{
  bool IsPositional = false;
  Vector3 Position = {};
  Vector3 Axis = {}; ///< where it shines to, of length 1
  Vector3 Color = {};
  Vector3 Attenuation = {};
  double ConeCosine = 0.0; ///< 0 where there is no cone
  double Exponent = 0.0;

  /// The same bits: a number that is none is itself.
  bool operator==(const SceneLight& other) const;
  /// Whether it is known where its light comes from, whatever that is.
  bool IsSomewhere() const;
};

/// A camera in a light.
struct LightView
{
  Vector3 Origin = {};              ///< in world coordinates
  std::array<Vector3, 3> Axes = {}; ///< to the right, up and ahead
  bool IsPerspective = false;
  std::array<double, 2> Middle = {}; ///< of what is seen, of distant lights
  std::array<double, 2> Half = {};   ///< half its size; of others at distance 1
  double Near = 0.0;
  double Far = 1.0;
  int Face = -1; ///< of a cube around the light, which divides its directions; -1 for all of them
};

namespace SceneLights
{
/// All that are on, with the numbers that they have, in VTK's shaders, too. Where the renderer
/// would make one, it does. Headlights and camera lights are where the camera has them now.
std::vector<SceneLight> Find(vtkRenderer* renderer);

/// The same, of which none may be left out; fails for numbers that are none.
Outcome Read(vtkRenderer* renderer, std::vector<SceneLight>& lights);

/// One view of what is lit, or six around a light that has it all about. `receivers` and `scene`:
/// bounds (xmin, xmax, ...) of what is lit, and of what casts shadows as well; maps have `size`
/// texels a side.
std::vector<LightView> MakeViews(const SceneLight& light, const double receivers[6],
  const double scene[6], int size);
} // namespace SceneLights
} // namespace LightTransport

#endif
