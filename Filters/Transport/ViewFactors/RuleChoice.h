// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The cheapest quadrature rules whose error bound keeps a tolerance, for the two sides of a pair of
 * patches or of all pairs of two nodes. Chosen for each pair: everything is inline.
 *
 * A rule on one polygon, the other polygon being a point y with a normal: the integrand is h g /
 * |y - x|^4, where the height h of y over the polygon's plane is the same for all x, and the height
 * g of x over the plane of y changes with the sine s of the angle between the planes. The error is
 * at most
 *
 *   C q^(p + 1) / (1 - q)^3 * (h / D) * (g / D + s) * area / D^2,  q = radius / D < LargestRatio,
 *
 * with D = |y - c| and g for the point c around which the radius is, p the degree.
 */
#ifndef RuleChoice_h
#define RuleChoice_h

#include "Scene/PatchScene.h"
#include "ViewFactors/QuadratureRules.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace LightTransport
{
namespace RuleChoice
{
/// Of q: as far as the experiments below went.
inline constexpr double LargestRatio = 0.7;

/// C of each rule: one and a half times the largest seen in experiments with q from 0.05 to
/// LargestRatio, all orientations (many of them grazing or parallel) and aspect ratios to 100:
/// 20,000 triangles for each q around their centroid; and as many triangles around any point (the
/// fans of clipped polygons), rectangles, parallelograms and quadrilaterals.
using Constants = std::array<double, QuadratureRules::NumberOfRules>;
inline constexpr Constants TriangleConstants = { 1.8, 0.21, 0.13, 0.4, 0.018 };
inline constexpr Constants PolygonConstants = { 3.3, 0.7, 0.4, 0.45, 0.14 };
/// The largest quotient of the two, for triangles whose bound turns out to be that of a fan.
inline constexpr double ClippedFactor = 8.0;

inline constexpr std::array<int, QuadratureRules::NumberOfRules> Degrees = { 1, 2, 4, 5, 8 };

/// One side of a pair (or of all pairs of two nodes).
struct Side
{
  double Radius;
  double Distance; ///< D, at least
  double Height;   ///< h, at most
  double Facing;   ///< g + s D, at most
  bool IsTriangle; ///< otherwise any polygon of at most four corners

  const Constants& GetConstants() const
  {
    return this->IsTriangle ? TriangleConstants : PolygonConstants;
  }
};

/// One pair: what the bounds of the errors need.
struct Pair
{
  Side SideI;
  Side SideJ;
  double Margin; ///< below 0 a horizon may cross
  bool Facing;   ///< false is certain
};

/// The rules of both sides.
struct Rules
{
  int I = -1; ///< -1 where no rule is good enough
  int J = -1;
  double Error = 0.0; ///< at most, where there are rules; times area * area / pi

  bool AreFound() const { return this->I >= 0 && this->J >= 0; }
};

//------------------------------------------------------------------------------
/// The cheapest rule whose error, relative to area * area / (pi D^2), is below `tolerance`, or -1.
inline int Choose(const Side& side, double tolerance, double& error)
{
  if (!(side.Radius < LargestRatio * side.Distance))
  {
    return -1;
  }
  const Constants& constants = side.GetConstants();
  const double ratio = side.Radius / side.Distance;
  const double rest = 1.0 - ratio;
  const double common = std::min(1.0, side.Height / side.Distance) *
    std::min(2.0, side.Facing / side.Distance) / (rest * rest * rest);
  double power = ratio;
  int degree = 0;
  for (int rule = 0; rule < QuadratureRules::NumberOfRules; ++rule)
  {
    for (; degree < Degrees[rule]; ++degree)
    {
      power *= ratio;
    }
    error = constants[rule] * power * common;
    if (error <= tolerance)
    {
      return rule;
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
/// The same for both sides.
inline Rules Choose(const Side& sideI, const Side& sideJ, double tolerance)
{
  double errorI = 0.0;
  double errorJ = 0.0;
  Rules rules;
  rules.I = Choose(sideI, tolerance, errorI);
  rules.J = rules.I < 0 ? -1 : Choose(sideJ, tolerance, errorJ);
  if (rules.AreFound())
  {
    rules.Error =
      errorI / (sideI.Distance * sideI.Distance) + errorJ / (sideJ.Distance * sideJ.Distance);
  }
  return rules;
}

//------------------------------------------------------------------------------
inline Pair MakePair(const PatchScene& scene, vtkIdType i, vtkIdType j, bool isTriangleI,
  bool isTriangleJ)
{
  const PatchScene::Vector between = scene.GetCentroid(j) - scene.GetCentroid(i);
  const PatchScene::Vector& normalI = scene.GetNormal(i);
  const PatchScene::Vector& normalJ = scene.GetNormal(j);
  const double radiusI = scene.GetRadius(i);
  const double radiusJ = scene.GetRadius(j);
  const double heightOfI = -between.dot(normalJ);
  const double heightOfJ = between.dot(normalI);
  const double sine = std::min(1.0, normalI.cross(normalJ).norm());
  const double reachI = radiusI * sine;
  const double reachJ = radiusJ * sine;
  const double distance = between.norm();
  const double distanceI = distance - radiusJ;
  const double distanceJ = distance - radiusI;
  Pair pair;
  pair.SideI = { radiusI, distanceI, std::abs(heightOfJ) + reachJ,
    std::abs(heightOfI) + sine * distanceI, isTriangleI };
  pair.SideJ = { radiusJ, distanceJ, std::abs(heightOfI) + reachI,
    std::abs(heightOfJ) + sine * distanceJ, isTriangleJ };
  pair.Margin = std::min(heightOfI - reachI, heightOfJ - reachJ);
  pair.Facing = heightOfI > -reachI && heightOfJ > -reachJ;
  return pair;
}
} // namespace RuleChoice
} // namespace LightTransport

#endif
