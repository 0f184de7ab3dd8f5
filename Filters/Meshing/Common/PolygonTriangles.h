// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The triangles of a polygon of any shape, by a constrained Delaunay triangulation in its plane:
 * concave ones, holes that a bridge joins to the border, spikes, corners that repeat or lie on the
 * border elsewhere. What the border goes round once is inside, so a bridge that goes there and back
 * is none.
 *
 * It accepts what the transport filters do (Scene/PolygonCutting): a border may touch itself, and
 * crosses itself only where it does so by more than a millionth of the edges there.
 */
#ifndef PolygonTriangles_h
#define PolygonTriangles_h

#include <array>
#include <cstddef>
#include <vector>

namespace LightTransport
{
namespace PolygonTriangles
{
using Point = std::array<double, 3>;
using Triangle = std::array<std::size_t, 3>;

/// Indices of the corners, in the direction of the polygon; those of a polygon without area have no
/// area either. False where the border crosses itself.
bool Cut(const std::vector<Point>& corners, std::vector<Triangle>& triangles);

/// Whether triangles that ears were cut off for all face where the polygon does.
bool AreRight(const std::vector<Point>& corners, const std::vector<Triangle>& triangles);
} // namespace PolygonTriangles
} // namespace LightTransport

#endif
