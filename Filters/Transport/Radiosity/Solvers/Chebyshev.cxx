// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Chebyshev's method (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 12.1).
#include "Radiosity/ErrorBound.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverEntry.h"
#include "vtkLinkOperator.h"
#include "vtkRadiosity.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
void Iterate(RadiosityIteration& state)
{
  vtkLinkOperator* links = state.Links;
  const int bands = state.Equation.NumberOfBands;
  // The spectrum of I - rho F lies in [1 - radius, 1 + radius].
  const RadiosityIteration::Bands& radii = state.Bound.SpectralRadii;
  RadiosityIteration::Bands ratios = radii; // rho_k of the recurrence: 1 / sigma at first
  state.Ok = state.Ok && state.ComputeResidual() &&
    links->Combine(RadiosityIteration::DIRECTION, state.Ones.data(), RadiosityIteration::RESIDUAL,
      state.Zeros.data(), RadiosityIteration::RESIDUAL);
  while (state.Ok && state.Continue())
  {
    state.Ok = links->Combine(RadiosityIteration::SOLUTION, state.Ones.data(),
                 RadiosityIteration::SOLUTION, state.Ones.data(), RadiosityIteration::DIRECTION) &&
      state.ComputeResidual();
    RadiosityIteration::Bands previous(bands), residual(bands);
    for (int band = 0; band < bands; ++band)
    {
      const double radius = radii[band];
      const double next = radius / (2.0 - radius * ratios[band]);
      previous[band] = next * ratios[band];
      residual[band] = radius > 0.0 ? 2.0 * next / radius : 1.0;
      ratios[band] = next;
    }
    state.Ok = state.Ok &&
      links->Combine(RadiosityIteration::DIRECTION, previous.data(), RadiosityIteration::DIRECTION,
        residual.data(), RadiosityIteration::RESIDUAL);
    ++state.Count;
  }
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry Chebyshev = { vtkRadiosity::SOLVER_CHEBYSHEV, "Chebyshev",
  SolverEntry::Order::AllAtOnce, SolverEntry::Links::AnyForm, Iterate };
} // namespace Solvers
} // namespace LightTransport
