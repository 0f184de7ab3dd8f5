// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Many rays from patches, evenly over each patch and around its normal, sixteen at a time through
 * polygons in single precision. What that cannot decide (hits from behind, near the start, of
 * patches that share their place with others, rays that start at the rim of a patch) SceneRayCaster
 * does: so hits are what they are everywhere, but that rays from the plane of a neighbour do not
 * pass it into nothing. The same rays for the same scene.
 * Thread-safe after Build.
 */
#ifndef PatchRays_h
#define PatchRays_h

#include "Geometry/RayPattern.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>

namespace LightTransport
{
class PatchScene;

class PatchRays
{
public:
  /// What a ray meets: the number of a patch, or Sky, or FromBehind(patch).
  using Hit = std::int32_t;
  static constexpr Hit Sky = -1;
  /// And the other way round.
  static constexpr Hit FromBehind(Hit patch) { return -2 - patch; }

  PatchRays();
  ~PatchRays();
  PatchRays(const PatchRays&) = delete;
  void operator=(const PatchRays&) = delete;

  /// The scene must outlive this. Fails when Embree cannot build (no memory, no device).
  Outcome Build(const PatchScene& scene);
  bool IsBuilt() const;

  /// One ray for each point of the pattern: `hits` in the order of the points.
  void Cast(vtkIdType patch, const RayPattern& pattern, Hit* hits) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};
} // namespace LightTransport

#endif
