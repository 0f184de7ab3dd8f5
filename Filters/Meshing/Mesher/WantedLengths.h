// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The edge lengths that vtkPatchMesher is asked for, at each point of a surface.
#ifndef WantedLengths_h
#define WantedLengths_h

#include "Mesher/IsotropicRemesher.h"
#include "Mesher/PatchTarget.h"
#include "Shared/Outcome.h"

#include <vector>

class vtkDataArray;

namespace LightTransport
{
namespace WantedLengths
{
/**
 * The lengths of an array, one per tuple. Fails when it has several components. Whether its values
 * make sense is seen in Find(), for the points in use.
 */
Outcome Read(vtkDataArray* array, std::vector<double>& lengths);

/**
 * The lengths at the points of `surface`, that of a remesher that was built from the soup. Fails
 * when a length makes no sense.
 */
Outcome Find(const IsotropicRemesher& remesher, const SourceSurface& surface,
  const TriangleSoup& soup, const PatchTarget& target, std::vector<double>& lengths);

/**
 * Let planar regions have long edges: as long as elsewhere, if the curvature at their borders would
 * shorten those within; or as long as the regions are wide, if they stay coarse.
 */
void FreePlanarRegions(IsotropicRemesher& remesher, const SourceSurface& surface,
  const PatchTarget& target, double diagonal, std::vector<double>& lengths);
} // namespace WantedLengths
} // namespace LightTransport

#endif
