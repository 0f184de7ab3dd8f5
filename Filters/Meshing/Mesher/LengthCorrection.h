// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Shortens edge lengths where they turned out to be too long: where patches cross, and in small
/// components that lost area or volume.
#ifndef LengthCorrection_h
#define LengthCorrection_h

#include "Mesher/PatchCheck.h"
#include "Mesher/SourceSurface.h"
#include "Shared/Monitor.h"

#include <vector>

namespace LightTransport
{
namespace LengthCorrection
{
/**
 * The points of `surface`, which has the triangles of the soup that `check` knows, around
 * crossings of patches: those nearby, and the corners of the triangles that the patches lie on.
 * Throws Heartbeat::Stopped when aborted.
 */
std::vector<bool> FindPoints(const SourceSurface& surface, const PatchCheck& check,
  const IsotropicRemesher::Result& patches, const std::vector<TriangleCrossings::Pair>& crossings,
  const Monitor& monitor);

/// All points of the components that such crossings are of.
std::vector<bool> FindPointsOfComponents(const SourceSurface& surface, const PatchCheck& check,
  const IsotropicRemesher::Result& patches, const std::vector<TriangleCrossings::Pair>& crossings);

void Halve(const std::vector<bool>& points, std::vector<double>& lengths);

/**
 * Shorten the lengths of components that lost more than `most` of their area or volume, but not so
 * far that one would get more than a thousand patches or so. Returns whether there were any.
 */
bool ShortenInComponents(const SourceSurface& surface, const PatchCheck& check,
  const std::vector<double>& losses, double most, std::vector<double>& lengths);
} // namespace LengthCorrection
} // namespace LightTransport

#endif
