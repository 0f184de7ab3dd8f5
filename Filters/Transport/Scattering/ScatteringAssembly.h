// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Fills a vtkExchangeMatrix with subsurface scattering: G_ij = R_d(|x - y|) integrated over x in
 * patch i and y in patch j, in mm^2, one kernel per band, for all pairs.
 *
 * The errors of the links of one patch may sum up to a tolerance, relative to what the patch can
 * receive at all. Part of it is granted in proportion to the links' values, part in proportion to
 * the areas, part to close neighbours. Pairs so far apart that even the profile's value at their
 * smallest distance is below the part by area are left out and counted.
 */
#ifndef ScatteringAssembly_h
#define ScatteringAssembly_h

#include "Links/LinksThroughAir.h"
#include "Scattering/ScatteringProfile.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <vector>

class vtkExchangeMatrix;

namespace LightTransport
{
class AirGaps;
class PatchScene;

namespace ScatteringAssembly
{
/// What a part of the matrix (one rank's tiles) came to.
struct Summary
{
  /// Pairs of different patches, each counted once.
  vtkIdType Links = 0;
  vtkIdType LeftOut = 0;
  /// Per patch: estimated error of the links over the profile's total, the left-out ones included,
  /// in mm^2.
  std::vector<double> Errors;
  LinksThroughAir ThroughAir; ///< in mm^2
};

/// What becomes of links through air: a sample of them is looked for, or all of them, which are
/// left out.
struct AirLinks
{
  const AirGaps& Gaps;
  bool AreDropped;
};

/**
 * Fill the tiles of `exchange`, which has been allocated with the areas in mm^2. `profiles` has one
 * profile per kernel (three). The monitor hears equally often on every rank, from the calling
 * thread.
 */
Outcome Fill(const PatchScene& scene, double millimetersPerSceneUnit,
  const ScatteringProfiles& profiles, double tolerance, const AirLinks& air,
  vtkExchangeMatrix* exchange, const Monitor& monitor, Summary& summary);
} // namespace ScatteringAssembly
} // namespace LightTransport

#endif
