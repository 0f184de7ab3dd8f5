// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Remeshes a surface to the edge lengths or the number of patches that vtkPatchMesher is asked
/// for.
#ifndef RemeshToTarget_h
#define RemeshToTarget_h

#include "Mesher/IsotropicRemesher.h"
#include "Mesher/PatchTarget.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

namespace LightTransport
{
namespace RemeshToTarget
{
/**
 * For a remesher that was built from the soup. `length` becomes the one that was used: the target
 * edge length, or that of as many equal triangles for an array, times what leads to the number of
 * patches if one was asked for. Fails when a length makes no sense or too many triangles would come
 * out.
 */
Outcome Run(IsotropicRemesher& remesher, const TriangleSoup& soup, const PatchTarget& target,
  const Monitor& monitor, double& length);
} // namespace RemeshToTarget
} // namespace LightTransport

#endif
