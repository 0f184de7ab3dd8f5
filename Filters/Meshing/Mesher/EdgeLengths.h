// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How long the edges of patches are to be: from the curvature, with growth in bounds, and how many
/// triangles they lead to. One length per point of a surface.
#ifndef EdgeLengths_h
#define EdgeLengths_h

#include "Mesher/SourceSurface.h"
#include "Shared/Monitor.h"

#include <vector>

namespace LightTransport
{
namespace EdgeLengths
{
/**
 * The edge length of triangles that deviate by `error` from a surface of this curvature, between
 * `shortest` and `longest` (Dunyach et al., "Adaptive remeshing for real-time mesh deformation",
 * 2013).
 */
double GetLengthForCurvature(double curvature, double error, double shortest, double longest);

/**
 * Shorten the lengths so that along every path on the surface they grow by at most `grading` per
 * unit of distance: a sweep from the shortest length on, like Dijkstra's, through triangles
 * instead of along edges (as in fast marching). Throws Heartbeat::Stopped when aborted.
 */
void Grade(const SourceSurface& surface, double grading, std::vector<double>& lengths,
  const Monitor& monitor = Monitor());

/// How many triangles with edges of these lengths cover one triangle of the surface.
double CountTriangles(const SourceSurface& surface, std::size_t triangle,
  const std::vector<double>& lengths);

/// How many triangles with edges of these lengths cover the surface, about.
double EstimateNumberOfTriangles(const SourceSurface& surface, const std::vector<double>& lengths);

/// The length with which as many equal triangles cover the surface as with these lengths.
double GetMeanLength(const SourceSurface& surface, const std::vector<double>& lengths);
} // namespace EdgeLengths
} // namespace LightTransport

#endif
