// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a scene's links will take, by a short look at some of its pairs of patches: how many face
 * each other, and of how many something is between. The same on all ranks.
 */
#ifndef SceneLook_h
#define SceneLook_h

#include "Shared/Outcome.h"

namespace LightTransport
{
class PatchScene;

struct SceneLook
{
  double Patches = 0.0;
  double Pairs = 0.0;       ///< each counted once
  double FacingPairs = 0.0; ///< about so many
  double HiddenShare = 0.0; ///< of these, about, by rays between their centroids

  /// Fails where rays cannot be cast.
  Outcome Take(const PatchScene& scene);
};
} // namespace LightTransport

#endif
