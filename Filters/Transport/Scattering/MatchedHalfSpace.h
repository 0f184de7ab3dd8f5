// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact reflectance of a flat, semi-infinite medium that scatters isotropically and has the index
 * of its surroundings: 1 - sqrt(1 - albedo) H, with S. Chandrasekhar's H function ("Radiative
 * Transfer", 1950) by his integral for its logarithm.
 */
#ifndef MatchedHalfSpace_h
#define MatchedHalfSpace_h

#include "Scattering/ScatteringMedium.h"

namespace LightTransport
{
namespace MatchedHalfSpace
{
/// Of light along the normal. The medium's refractive index is not looked at.
double GetNormalReflectance(const ScatteringMedium& medium);

/// Of diffuse light.
double GetDiffuseReflectance(const ScatteringMedium& medium);
} // namespace MatchedHalfSpace
} // namespace LightTransport

#endif
