// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces of long triangles.
#ifndef LongTriangles_h
#define LongTriangles_h

#include "MeshTestTools.h"

#include <array>
#include <cmath>
#include <vector>

namespace meshTest
{
//------------------------------------------------------------------------------
/// As CAD exports it: its sides are two triangles each, its ends fans.
inline vtkSmartPointer<vtkPolyData> MakeRod(int sides, double length)
{
  std::vector<Vector> points{ { 0, 0, 0 }, { 0, 0, length } };
  std::vector<std::array<vtkIdType, 3>> triangles;
  for (vtkIdType i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / sides;
    points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    points.push_back({ std::cos(angle), std::sin(angle), length });
    const vtkIdType a = 2 * i + 2;
    const vtkIdType b = 2 * ((i + 1) % sides) + 2;
    triangles.insert(triangles.end(),
      { { a, b, b + 1 }, { a, b + 1, a + 1 }, { 0, b, a }, { 1, a + 1, b + 1 } });
  }
  return MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
/// A disc of triangles around one point.
inline vtkSmartPointer<vtkPolyData> MakeFan(int sides)
{
  std::vector<Vector> points{ { 0, 0, 0 } };
  std::vector<std::array<vtkIdType, 3>> triangles;
  for (vtkIdType i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / sides;
    points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    triangles.push_back({ 0, i + 1, (i + 1) % sides + 1 });
  }
  return MakeSurface(points, triangles);
}
} // namespace meshTest

#endif
