// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Quadrature rules on polygons, of degrees 1, 2, 4, 5 and 8.
#ifndef QuadratureRules_h
#define QuadratureRules_h

#include "Geometry/Polygon.h"

namespace LightTransport
{
namespace QuadratureRules
{
using Vector = Polygon::Vector;

constexpr int NumberOfRules = 5;

/// Quadrature points of a polygon; the weights sum to the area.
struct Points
{
  int Count;
  const Vector* Places;
  const double* Weights;
};

/// Points of a rule on one triangle; a polygon has as many for each triangle of its fan (corners -
/// 2).
int GetNumberOfPoints(int rule);
constexpr int MaximumTrianglePoints = 16;
constexpr int MaximumPoints = MaximumTrianglePoints * Polygon::MaximumCorners;
void Make(const Polygon& polygon, int rule, Vector* points, double* weights);

/// The same degree with fewer points for quadrilaterals: Gauss points in both of its parameters.
/// Rule 0, the centroid, is one point for all: callers that know it need not ask.
int GetNumberOfPoints(int rule, int corners);
/// Most points of a triangle or a quadrilateral.
constexpr int MaximumCompactPoints = 25;
void MakeCompact(const Polygon& polygon, int rule, Vector* points, double* weights);
} // namespace QuadratureRules
} // namespace LightTransport

#endif
