// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Henyey and Greenstein's phase function: how often light is scattered by which angle.
#ifndef HenyeyGreenstein_h
#define HenyeyGreenstein_h

#include "vtkMath.h"

#include <cmath>

namespace LightTransport
{
namespace HenyeyGreenstein
{
/// The cosine of an angle, for a number evenly spread in (0, 1); `anisotropy` is the mean of it.
inline double GetCosine(double anisotropy, double u)
{
  const double g = anisotropy;
  if (g == 0.0)
  {
    return 2.0 * u - 1.0;
  }
  const double part = (1.0 - g * g) / (1.0 + g * (2.0 * u - 1.0));
  return (1.0 + g * g - part * part) / (2.0 * g);
}

/// Per solid angle.
inline double GetDensity(double anisotropy, double cosine)
{
  const double g = anisotropy;
  const double square = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * vtkMath::Pi() * square * std::sqrt(square));
}
} // namespace HenyeyGreenstein
} // namespace LightTransport

#endif
