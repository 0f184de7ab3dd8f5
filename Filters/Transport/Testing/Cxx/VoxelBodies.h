// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Closed bodies of unit cubes, with concavities, and bowls.
#ifndef VoxelBodies_h
#define VoxelBodies_h

#include "LightTransportTesting.h"

#include <set>

namespace LightTransportTesting
{
using Cubes = std::set<std::array<int, 3>>;

/// A horseshoe with its opening up, 3 wide, 3 high.
inline Cubes MakeHorseshoe()
{
  return { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 0, 1 }, { 2, 0, 1 }, { 0, 0, 2 },
    { 2, 0, 2 } };
}

/// The surface of all cubes together, each face cut into n x n, the cubes of lower numbers first.
inline void AddCubes(Surface& surface, const Cubes& cubes, int n, const Point& origin = {})
{
  for (const auto& cube : cubes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int side = 0; side < 2; ++side)
      {
        std::array<int, 3> neighbor = cube;
        neighbor[axis] += side == 1 ? 1 : -1;
        if (cubes.count(neighbor) > 0)
        {
          continue;
        }
        Point corner;
        for (int k = 0; k < 3; ++k)
        {
          corner[k] = origin[k] + cube[k] + (k == axis ? side : 0);
        }
        Point u = {}, v = {};
        u[(axis + 1) % 3] = 1.0;
        v[(axis + 2) % 3] = 1.0;
        surface.AddGrid(corner, side == 1 ? u : v, side == 1 ? v : u, n, n);
      }
    }
  }
}

inline vtkSmartPointer<vtkPolyData> MakeCubes(const Cubes& cubes, int n, bool isSingle = false,
  const Point& origin = {})
{
  Surface surface(isSingle);
  AddCubes(surface, cubes, n, origin);
  return surface.Get();
}

/// Half a hollow sphere, open above, with two radii: its wall is closed.
inline vtkSmartPointer<vtkPolyData> MakeBowl(int n, double inner, double outer)
{
  Surface surface;
  const int around = 4 * n;
  const auto at = [=](double radius, int ring, int turn)
  {
    const double height = ring == n ? 0.0 : -std::cos(0.5 * vtkMath::Pi() * ring / n);
    const double width = ring == 0 ? 0.0 : std::sin(0.5 * vtkMath::Pi() * ring / n);
    const double angle = 2.0 * vtkMath::Pi() * (turn % around) / around;
    return Point{ radius * width * std::cos(angle), radius * width * std::sin(angle),
      radius * height };
  };
  for (int turn = 0; turn < around; ++turn)
  {
    for (int ring = 0; ring < n; ++ring)
    {
      for (const double radius : { inner, outer })
      {
        const Point a = at(radius, ring, turn), b = at(radius, ring, turn + 1);
        const Point c = at(radius, ring + 1, turn + 1), d = at(radius, ring + 1, turn);
        const bool isOut = radius == outer;
        isOut ? surface.AddPolygon({ a, c, d }) : surface.AddPolygon({ a, d, c });
        if (ring > 0)
        {
          isOut ? surface.AddPolygon({ a, b, c }) : surface.AddPolygon({ a, c, b });
        }
      }
    }
    const Point a = at(inner, n, turn), b = at(outer, n, turn);
    const Point c = at(outer, n, turn + 1), d = at(inner, n, turn + 1);
    surface.AddPolygon({ a, b, c });
    surface.AddPolygon({ a, c, d });
  }
  return surface.Get();
}
} // namespace LightTransportTesting

#endif
