// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Radiosity by progressive refinement on a device: shots without view factors, until what is left
 * to shoot no longer matters.
 *
 * With unshot radiosity r >= 0, what has been shot is below the solution of the device's own view
 * factors by (I - rho F)^-1 r. Rows of F sum to 1 at most, so neither B nor H of any patch misses
 * more than max r / (1 - rho), with the largest rho: infinite where a patch reflects everything.
 * The error of the view factors is not in it.
 */
#ifndef ProgressiveRadiosity_h
#define ProgressiveRadiosity_h

#include "Radiosity/RadiositySolution.h"
#include "vtkType.h"

class vtkDeviceShooter;

namespace LightTransport
{
class PatchScene;
struct RadiosityEquation;
struct SolverSettings;

namespace ProgressiveRadiosity
{
/// Shots between two reports.
constexpr vtkIdType ShotsPerReport = 16;

/**
 * Solve with a shooter that has been opened. Of the equation nothing that belongs to links is used;
 * an iteration is one shot. `irradiance` (patches x bands) is what
 * shots have brought.
 */
RadiositySolution Solve(vtkDeviceShooter* shooter, const PatchScene& scene,
  const RadiosityEquation& equation, const SolverSettings& settings,
  std::vector<double>& irradiance);
} // namespace ProgressiveRadiosity
} // namespace LightTransport

#endif
