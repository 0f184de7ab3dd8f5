// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays through a PatchScene. Embree's single precision finds candidates (patches whose box,
 * enlarged by what single precision loses, is met), double precision decides: a patch is hit where
 * the ray crosses its plane between its ends, neither of them on the plane, and passes all edges on
 * the same side or touches them. What is on a plane, and what touches, is decided by what the
 * coordinates are worth (PatchPlane): neighbors leave no gap between them, and a patch a millionth
 * as large as the scene keeps its shape.
 *
 * So no ray needs an offset to leave the patch where it starts or to arrive where it ends, nor do
 * others in the same place (the other side of a thin wall, however it is meshed) stop it. Origins
 * must be in the bounding box of the scene. Thread-safe after Build.
 */
#ifndef SceneRayCaster_h
#define SceneRayCaster_h

#include "Scene/PatchScene.h"

#include <memory>
#include <string>
#include <vector>

namespace LightTransport
{
class SceneRayCaster
{
public:
  /// Where a segment goes through a patch.
  struct Crossing
  {
    double Fraction; ///< of its length
    double Rounding; ///< of that
    vtkIdType Patch;
  };

  SceneRayCaster();
  ~SceneRayCaster();
  SceneRayCaster(const SceneRayCaster&) = delete;
  void operator=(const SceneRayCaster&) = delete;

  /**
   * Only the patches of `subset` (all where it is nullptr) stop rays. The scene must outlive the
   * caster. Fails when Embree cannot build (no memory, no device).
   */
  Outcome Build(const PatchScene& scene, const std::vector<bool>* subset = nullptr);

  /// True when a patch other than `from` and `to` lies between the two points (scene coordinates).
  /// Both sides of a patch block. `to` is -1 where the target is on no patch.
  bool IsOccluded(const PatchScene::Vector& origin, const PatchScene::Vector& target,
    vtkIdType from, vtkIdType to) const;

  /**
   * The first patch other than `from` along a ray, or -1; `front` tells whether its front was hit.
   * Of two sides in one place the one that faces the ray is first, of two that both do the one with
   * the lower number. `direction` need not be normalised.
   */
  vtkIdType FindHit(const PatchScene::Vector& origin, const PatchScene::Vector& direction,
    vtkIdType from, bool& front) const;

  /// Replace `found` by all patches other than `from` and `to` between two points, in no order.
  void FindCrossings(const PatchScene::Vector& origin, const PatchScene::Vector& target,
    vtkIdType from, vtkIdType to, std::vector<Crossing>& found) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};
} // namespace LightTransport

#endif
