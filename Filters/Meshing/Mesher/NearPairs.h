// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The pairs of triangles that are so near that they may meet: those whose boxes overlap.
 *
 * Around a point of many triangles, as the hub of a fan, the boxes of all overlap. There the
 * directions seen from the point tell: two of its triangles that meet anywhere else have a
 * direction in common.
 */
#ifndef NearPairs_h
#define NearPairs_h

#include "Mesher/TriangleCrossings.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace LightTransport
{
namespace NearPairs
{
/// Calls visit(i, j) once for each pair of the triangles in `used`, those with an area.
void ForEach(const TriangleCrossings::Points& points, const TriangleCrossings::Triangles& triangles,
  const std::vector<std::size_t>& used, const std::function<void(std::size_t, std::size_t)>& visit);
} // namespace NearPairs
} // namespace LightTransport

#endif
