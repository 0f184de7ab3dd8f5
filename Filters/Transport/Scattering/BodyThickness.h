// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How thick a body is under each of its patches: the way from the patch's centroid along the inward
 * normal to the first patch of whatever side. Profiles stand for a medium without end, which a body
 * is not where this is a few diffusion lengths or less.
 */
#ifndef BodyThickness_h
#define BodyThickness_h

#include "Scattering/ScatteringMedium.h"
#include "Shared/Outcome.h"

#include <vector>

namespace LightTransport
{
class PatchScene;

namespace BodyThickness
{
/// Of each patch, in scene units; the diagonal of the scene, 1, where the surface is open and
/// nothing is met. Fails where rays cannot be cast (no memory).
Outcome Measure(const PatchScene& scene, std::vector<double>& thickness);

/// 1 / diffusion length, per mm, by diffusion theory; 0 without absorption.
double GetTransportCoefficient(const ScatteringMedium& medium);
} // namespace BodyThickness
} // namespace LightTransport

#endif
