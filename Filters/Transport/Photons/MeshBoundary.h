// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The patches of a scene as the surface of a body, whose inside is behind them. Embree's single
 * precision finds where a path meets them, double precision says where exactly: on the plane of the
 * patch. Coordinates are worth a margin, a millionth of the scene: paths start that much before
 * their origin, so that none slips through an edge next to which rounding has put it outside, and
 * patches whose plane the origin is on stop them only where they can be met from the side on which
 * the photon is. Of two patches in one place, where bodies touch, the one that is left comes before
 * the one that is entered.
 *
 * The balls of GetBall are found when they are first asked for, one for each cell of a grid.
 */
#ifndef MeshBoundary_h
#define MeshBoundary_h

#include "Photons/PhotonBoundary.h"
#include "Scene/PatchScene.h"
#include "Shared/Outcome.h"

#include <memory>

namespace LightTransport
{
class MeshBoundary : public PhotonBoundary
{
public:
  MeshBoundary();
  ~MeshBoundary() override;
  MeshBoundary(const MeshBoundary&) = delete;
  void operator=(const MeshBoundary&) = delete;

  /// Lengths in scene units; balls need not be larger than `largestBall`. The scene must outlive
  /// this. Fails where Embree cannot build.
  Outcome Build(const PatchScene& scene, double largestBall);

  bool FindCrossing(const Path& path, PhotonCrossing& crossing) const override;
  PhotonBall GetBall(const Vector& position) const override;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};
} // namespace LightTransport

#endif
