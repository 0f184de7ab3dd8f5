// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The radiative exchange G = A_a F_ab = A_b F_ba between two planar convex polygons with nothing
 * between them, in double precision:
 *
 *   G = 1/pi * integral over a, integral over b of  max(0, cos a) max(0, cos b) / r^2.
 *
 * Near pairs: Stokes' theorem on both areas turns it into 1/(2 pi) * sum over pairs of edges of
 * (u.v) * the double integral of ln r (Sparrow, J. Heat Transfer 85, 1963). Edges that share a
 * corner have a closed form; of the others the inner integral has one, the outer one is a Kronrod
 * rule on parts that are cut by bounds of its error known beforehand. Pairs further apart
 * (OpenExchange): a product of Gauss rules, one for each side.
 */
#ifndef PolygonExchange_h
#define PolygonExchange_h

#include "Scene/PatchScene.h"

#include <Eigen/Core>

#include <array>

namespace LightTransport
{
namespace PolygonExchange
{
using Vector = Eigen::Vector3d;

/// Corners that a patch may have; clipping with one plane adds one.
constexpr int MaximumCorners = PatchScene::MaximumCorners;

struct Polygon
{
  std::array<Vector, MaximumCorners + 2> Corners;
  int Count = 0;
  Vector Normal;
};

void MakePolygon(const PatchScene& scene, vtkIdType patch, Polygon& polygon);

/// Quadrature points of a polygon; the weights sum to the area.
struct RulePoints
{
  int Count;
  const Vector* Points;
  const double* Weights;
};

/// Number of rules, of degrees 1, 2, 4, 5 and 8.
constexpr int NumberOfRules = 5;

struct Estimate
{
  double Value = 0.0;
  double Error = 0.0; ///< absolute
};

/**
 * Cut away what lies behind the plane through `origin` with `normal`. Corners closer to it than
 * rounding count as on it. Returns false when nothing with an area is left.
 */
bool Clip(Polygon& polygon, const Vector& origin, const Vector& normal);

/// Two patches of a scene, each cut at the plane of the other.
void MakeClippedPair(const PatchScene& scene, vtkIdType i, vtkIdType j, Polygon& a, Polygon& b);

double GetArea(const Polygon& polygon);
/// The mean of the corners.
Vector GetMiddle(const Polygon& polygon);

/// Points of a rule on one triangle; a polygon has as many for each triangle of its fan (corners -
/// 2).
int GetNumberOfRulePoints(int rule);
constexpr int MaximumRulePoints = 16 * MaximumCorners;

void MakeRule(const Polygon& polygon, int rule, Vector* points, double* weights);

/// The same degree with fewer points for quadrilaterals: Gauss points in both of its parameters.
/// Rule 0, the centroid, is one point for all: callers that know it need not ask.
int GetNumberOfRulePoints(int rule, int corners);
/// Most points of a triangle or a quadrilateral.
constexpr int MaximumCompactPoints = 25;
void MakeCompactRule(const Polygon& polygon, int rule, Vector* points, double* weights);

/// The exchange by two rules.
double IntegrateRules(const RulePoints& a, const Vector& normalA, const RulePoints& b,
  const Vector& normalB);

/**
 * The exchange by the contour integral; both polygons must lie in front of (or on) the plane of the
 * other: clip them first. `tolerance` is absolute, in units of area.
 */
Estimate IntegrateContours(const Polygon& a, const Polygon& b, double tolerance);

/**
 * The exchange by a rule of degree 8 on triangles of the smaller polygon, cut until it settles, and
 * the closed form for each of its points: its rounding is relative to the smaller polygon, where
 * that of the contour integral grows with the ratio of the sizes. Clip the polygons first.
 */
Estimate IntegratePoints(const Polygon& a, const Polygon& b, double tolerance);

/// The contour integral, or, where it misses the tolerance, the better of the two.
Estimate Integrate(const Polygon& a, const Polygon& b, double tolerance);
} // namespace PolygonExchange
} // namespace LightTransport

#endif
