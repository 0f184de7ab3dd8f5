// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What patches see that is no front of another patch: the sky, where a ray leaves the scene, and
 * back faces. Sampled by rays around the normal, the same ones for the same scene.
 */
#ifndef Openings_h
#define Openings_h

#include "vtkType.h"

namespace LightTransport
{
class PatchScene;
class SceneRayCaster;
struct Links;

class Openings
{
public:
  /// `caster` holds the same scene. Both must outlive this.
  Openings(const PatchScene& scene, const SceneRayCaster& caster) : Scene(scene), Caster(caster) {}

  /// Whether the scene has any, by 128 rays from up to some 2,000 patches.
  bool Exist() const;

  ///@{
  /**
   * Set the sky and back face fractions of `links`. Divide takes what a row misses for known, more
   * exactly than by rays, and divides it by 128 rays; a row that misses no more than its error
   * misses nothing. Sample takes the share of 512 rays, or none where 128 find no opening. Both add
   * the summary "RaysCast".
   */
  void Divide(Links& links) const;
  void Sample(Links& links) const;
  ///@}

  /// No row sees an opening.
  static void Clear(Links& links);

private:
  template <typename LookOut>
  void CastRays(Links& links, const LookOut& lookOut) const;

  const PatchScene& Scene;
  const SceneRayCaster& Caster;
};
} // namespace LightTransport

#endif
