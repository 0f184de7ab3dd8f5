// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How long the edges of patches should be, and where: one length per point of a surface.
#ifndef PatchSizing_h
#define PatchSizing_h

#include "Mesher/SourceSurface.h"

#include <vector>

namespace LightTransport
{
namespace PatchSizing
{
/**
 * The largest absolute normal curvature at each point, from the angles at the edges around it
 * (Cohen-Steiner and Morvan, "Restricted Delaunay triangulations and normal cycle", 2003). Edges to
 * keep do not count, and at a point where they meet the part with the largest curvature does.
 */
std::vector<double> GetCurvatures(const SourceSurface& surface);

/**
 * The edge length of triangles that deviate by `error` from a surface of this curvature, between
 * `shortest` and `longest` (Dunyach et al., "Adaptive remeshing for real-time mesh deformation",
 * 2013).
 */
double GetLengthForCurvature(double curvature, double error, double shortest, double longest);

/**
 * The planar region that each triangle belongs to, or SourceSurface::NONE: connected triangles,
 * without edges to keep between them, within 1e-6 of the region's size of one plane, and at least
 * as large as a few patches of the length that their points have.
 */
std::vector<std::size_t> FindPlanarRegions(const SourceSurface& surface,
  const std::vector<double>& lengths);

/**
 * How wide the region of each triangle is there: the smallest height of the triangle over a side at
 * the region's border, when its opposite corner is at the border too. VTK_DOUBLE_MAX elsewhere.
 */
std::vector<double> GetWidths(const SourceSurface& surface,
  const std::vector<std::size_t>& regions);

/**
 * Shorten the lengths so that along every path on the surface they grow by at most `grading` per
 * unit of distance: a sweep from the shortest length on, like Dijkstra's, through triangles
 * instead of along edges (as in fast marching).
 */
void Grade(const SourceSurface& surface, double grading, std::vector<double>& lengths);

/// How many triangles with edges of these lengths cover the surface, about.
double EstimateNumberOfTriangles(const SourceSurface& surface, const std::vector<double>& lengths);

/// The length with which as many equal triangles cover the surface as with these lengths.
double GetMeanLength(const SourceSurface& surface, const std::vector<double>& lengths);
} // namespace PatchSizing
} // namespace LightTransport

#endif
