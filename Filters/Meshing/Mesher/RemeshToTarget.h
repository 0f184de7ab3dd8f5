// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Remeshes a surface to the edge lengths or the number of patches that vtkPatchMesher is asked
/// for, and looks at what came out.
#ifndef RemeshToTarget_h
#define RemeshToTarget_h

#include "Mesher/IsotropicRemesher.h"
#include "Mesher/PatchTarget.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace RemeshToTarget
{
struct Result
{
  IsotropicRemesher::Result Patches;
  /// The one that was used: the target edge length, or that of as many equal triangles for an
  /// array, times what led to the number of patches if one was asked for.
  double Length = 0.0;
  /// Pairs of patches of one component that cross, and of two components.
  std::vector<std::pair<std::size_t, std::size_t>> CrossingsWithin;
  std::vector<std::pair<std::size_t, std::size_t>> CrossingsBetween;
  /// What a user should know, and can mend: sentences.
  std::vector<std::string> Warnings;
};

/**
 * For a remesher that was built from the soup. Where patches cross though the surface does not, and
 * where a default length is too long for a small component, once more with shorter lengths there;
 * at last with patches in the triangles of the surface.
 *
 * Fails when a length makes no sense, too many triangles would come out, or patches still cross.
 */
Outcome Run(IsotropicRemesher& remesher, const TriangleSoup& soup, const PatchTarget& target,
  const Monitor& monitor, Result& result);
} // namespace RemeshToTarget
} // namespace LightTransport

#endif
