// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solves B = E + (rho / A) G B, all bands in lockstep, with any of the methods of
 * RadiosityMethods. A solution comes with its error bound (ErrorBound), how it ended, and
 * messages that name problem, place and remedy.
 */
#ifndef RadiositySolver_h
#define RadiositySolver_h

#include "Radiosity/RadiositySolution.h"

namespace LightTransport
{
struct RadiosityEquation;
struct SolverSettings;

namespace RadiositySolver
{
/**
 * Solve, look at the residual in double precision, and where it is not yet small enough (single
 * precision devices, the drift of a recurrence) solve again for the correction. Auto takes the
 * method that needs the fewest products with the links.
 */
RadiositySolution Solve(const RadiosityEquation& equation, const SolverSettings& settings);
} // namespace RadiositySolver
} // namespace LightTransport

#endif
