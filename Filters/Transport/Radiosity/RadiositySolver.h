// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solves the radiosity equation, all bands in lockstep, with any solver of SolverTable that needs
 * links. A solution comes with its error bound (ErrorBound), how it ended, and messages that name
 * problem, place and remedy.
 */
#ifndef RadiositySolver_h
#define RadiositySolver_h

#include "Radiosity/RadiositySolution.h"
#include "Shared/Outcome.h"

namespace LightTransport
{
struct RadiosityEquation;
struct SolverSettings;

namespace RadiositySolver
{
/**
 * Solve, look at the residual in double precision, and where it is not yet small enough (single
 * precision devices, the drift of a recurrence) solve again for the correction. Auto takes the
 * solver that needs the fewest products with the links. Done says that there is a solution,
 * whatever it is worth; one that was aborted is there as far as it came.
 */
Outcome Solve(const RadiosityEquation& equation, const SolverSettings& settings,
  RadiositySolution& solution);
} // namespace RadiositySolver
} // namespace LightTransport

#endif
