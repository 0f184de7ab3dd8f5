// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How strongly a surface is curved: one number per point.
#ifndef SurfaceCurvature_h
#define SurfaceCurvature_h

#include "Mesher/SourceSurface.h"

#include <vector>

namespace LightTransport
{
namespace SurfaceCurvature
{
/**
 * The largest absolute normal curvature at each point, from the angles at the edges around it
 * (Cohen-Steiner and Morvan, "Restricted Delaunay triangulations and normal cycle", 2003). Edges to
 * keep do not count, and at a point where they meet the part with the largest curvature does.
 */
std::vector<double> Find(const SourceSurface& surface);
} // namespace SurfaceCurvature
} // namespace LightTransport

#endif
