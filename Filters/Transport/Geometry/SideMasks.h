// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * On which sides of each other's planes a wall and up to 16 patches are, a bit for each patch. What
 * decides is PatchPlane::GetCertainHeight; where the distance does not matter to it, many patches
 * are compared at once.
 */
#ifndef SideMasks_h
#define SideMasks_h

#include "Scene/PatchGeometry.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

namespace LightTransport
{
/// Bits: of patches.
struct SideMasks
{
  std::uint16_t Front = 0; ///< the wall is in front of the patch, in part at least
  std::uint16_t Cut = 0;   ///< and in part on its plane or behind it
  std::uint16_t Above = 0; ///< the patch is over the wall's plane, in part at least
  std::uint16_t Below = 0; ///< and under it
};

/// Of one patch, 1 for its bit.
SideMasks FindSides(const PatchGeometry& walls, vtkIdType wall, const PatchGeometry& patches,
  vtkIdType patch);

/// A range of patches that many walls are compared with.
class SideFinder
{
public:
  static constexpr int MaximumPatches = 16;

  /// Both must outlive this.
  SideFinder(const PatchGeometry& walls, const PatchGeometry& patches)
    : Walls(walls), Patches(patches)
  {
  }

  /// At most MaximumPatches.
  void SetPatches(vtkIdType first, vtkIdType last);

  SideMasks Find(vtkIdType wall) const;

private:
  using Lanes = std::array<double, MaximumPatches>;

  const PatchGeometry& Walls;
  const PatchGeometry& Patches;
  vtkIdType First = 0;
  int Count = 0;
  Lanes Normal[3], Offset, Rounding, Limit;
  std::vector<std::array<Lanes, 3>>
    Corners; ///< of all patches; the last one again where one has fewer
};
} // namespace LightTransport

#endif
