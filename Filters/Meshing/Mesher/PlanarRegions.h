// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The parts of a surface that are planar, and how wide they are.
#ifndef PlanarRegions_h
#define PlanarRegions_h

#include "Mesher/SourceSurface.h"

#include <vector>

namespace LightTransport
{
namespace PlanarRegions
{
/**
 * The planar region that each triangle belongs to, or SourceSurface::None: connected triangles,
 * without edges to keep between them, within 1e-6 of the region's size of one plane, and at least
 * as large as a few patches of the length that their points have.
 */
std::vector<std::size_t> Find(const SourceSurface& surface, const std::vector<double>& lengths);

/**
 * How wide the region of each triangle is there: the smallest height of the triangle over a side at
 * the region's border, when its opposite corner is at the border too. VTK_DOUBLE_MAX elsewhere.
 */
std::vector<double> GetWidths(const SourceSurface& surface,
  const std::vector<std::size_t>& regions);
} // namespace PlanarRegions
} // namespace LightTransport

#endif
