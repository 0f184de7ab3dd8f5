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
 * (UnoccludedPairs): a product of Gauss rules, one for each side.
 */
#ifndef PairIntegrals_h
#define PairIntegrals_h

#include "Geometry/Polygon.h"
#include "ViewFactors/QuadratureRules.h"

namespace LightTransport
{
namespace PairIntegrals
{
struct Estimate
{
  double Value = 0.0;
  double Error = 0.0; ///< absolute
};

/**
 * The view factor from a point with a normal to a polygon, by Lambert's formula; the polygon must
 * lie in front of (or on) the plane of the point.
 */
double GetPointFactor(const Polygon& polygon, const Polygon::Vector& point,
  const Polygon::Vector& normal);

/// The exchange by two rules.
double IntegrateRules(const QuadratureRules::Points& a, const Polygon::Vector& normalA,
  const QuadratureRules::Points& b, const Polygon::Vector& normalB);

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
} // namespace PairIntegrals
} // namespace LightTransport

#endif
