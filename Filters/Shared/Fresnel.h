// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How a smooth surface divides unpolarised light into a reflected and a transmitted part (Fresnel),
 * for light from outside at an angle given by its cosine, and for diffuse light from either side.
 * `refractiveIndex` is that of the inside relative to the outside; below 1 it counts as 1, where
 * nothing is reflected.
 */
#ifndef Fresnel_h
#define Fresnel_h

#include "Shared/GaussLegendre.h"

#include <cmath>
#include <cstddef>

namespace LightTransport
{
namespace Fresnel
{
//------------------------------------------------------------------------------
/// Of light from outside. All of it for light along the surface or from behind.
inline double GetReflectance(double cosine, double refractiveIndex)
{
  const double n = refractiveIndex;
  if (!(cosine > 0.0))
  {
    return 1.0;
  }
  if (n <= 1.0)
  {
    return 0.0;
  }
  const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  const double parallel = (n * cosine - inside) / (n * cosine + inside);
  const double perpendicular = (cosine - n * inside) / (cosine + n * inside);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

//------------------------------------------------------------------------------
/// What is not reflected, and enters.
inline double GetTransmittance(double cosine, double refractiveIndex)
{
  return 1.0 - GetReflectance(cosine, refractiveIndex);
}

//------------------------------------------------------------------------------
/// Of diffuse light from outside, by quadrature.
inline double GetMeanExternalReflectance(double refractiveIndex)
{
  if (refractiveIndex <= 1.0)
  {
    return 0.0;
  }
  // The reflectance changes fast at grazing angles when the index is near 1: cosine = t^4. Then 64
  // points are exact to rounding for every index.
  const GaussLegendre rule(64);
  double transmitted = 0.0;
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double t = rule.Nodes[k];
    const double cosine = t * t * t * t;
    transmitted +=
      rule.Weights[k] * 2.0 * cosine * GetTransmittance(cosine, refractiveIndex) * 4.0 * t * t * t;
  }
  return 1.0 - transmitted;
}

//------------------------------------------------------------------------------
/// Of diffuse light that meets the surface from inside, F_dr: polynomial of W. G. Egan and
/// T. W. Hilgeman, "Optical Properties of Inhomogeneous Materials", 1979; exactly 0 for an index
/// of 1, where it would give 0.0017.
inline double GetMeanInternalReflectance(double refractiveIndex)
{
  const double n = refractiveIndex;
  return n > 1.0 ? -1.4399 / (n * n) + 0.7099 / n + 0.6681 + 0.0636 * n : 0.0;
}

//------------------------------------------------------------------------------
/// Moments of the reflectance F of light from inside over its cosine c, exact: 2 int F c dc (that
/// of diffuse light, which GetMeanInternalReflectance approximates) and 3 int F c^2 dc.
struct InternalMoments
{
  double First = 0.0;
  double Second = 0.0;
};

//------------------------------------------------------------------------------
/// By quadrature over the cosine outside, as in GetMeanExternalReflectance.
inline InternalMoments GetInternalMoments(double refractiveIndex)
{
  InternalMoments moments;
  if (refractiveIndex <= 1.0)
  {
    return moments;
  }
  const double squared = refractiveIndex * refractiveIndex;
  const GaussLegendre rule(64);
  moments.First = 1.0 - (1.0 - GetMeanExternalReflectance(refractiveIndex)) / squared;
  double transmitted = 0.0;
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    const double t = rule.Nodes[k];
    const double cosine = t * t * t * t;
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / squared);
    transmitted += rule.Weights[k] * 3.0 * cosine * inside / squared *
      GetTransmittance(cosine, refractiveIndex) * 4.0 * t * t * t;
  }
  moments.Second = 1.0 - transmitted;
  return moments;
}
} // namespace Fresnel
} // namespace LightTransport

#endif
