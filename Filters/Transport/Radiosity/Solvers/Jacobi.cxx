// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Jacobi's method: B' = B + E - K B, K = I - rho F (Carr, Hall and Hart 2003).
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverEntry.h"
#include "vtkLinkOperator.h"
#include "vtkRadiosity.h"

#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
void Iterate(RadiosityIteration& state)
{
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = state.Links->Combine(RadiosityIteration::SOLUTION, state.Ones.data(),
      RadiosityIteration::SOLUTION, state.Ones.data(), RadiosityIteration::RESIDUAL);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
// Errors fall by the radius in each step.
double EstimateProducts(double radius, double tolerance)
{
  if (radius <= 0.0)
  {
    return 1.0;
  }
  return radius < 1.0 ? std::ceil(std::log(tolerance) / std::log(radius))
                      : std::numeric_limits<double>::infinity();
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry Jacobi = { vtkRadiosity::SOLVER_JACOBI, "Jacobi",
  SolverEntry::Order::AllAtOnce, SolverEntry::Links::AnyForm, Iterate, EstimateProducts };
} // namespace Solvers
} // namespace LightTransport
