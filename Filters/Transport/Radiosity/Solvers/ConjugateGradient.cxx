// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients.
#include "Radiosity/ConjugateGradients.h"
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverEntry.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// Keeps the logarithm of what errors fall by in a step away from 0.
constexpr double MostFactor = 1.0 - 1e-12;

//------------------------------------------------------------------------------
void Iterate(RadiosityIteration& state)
{
  ConjugateGradients gradients(state);
  state.Ok = state.Ok && gradients.Begin();
  while (state.Ok && state.Continue(true))
  {
    state.Ok = gradients.Step();
    ++state.Count;
    if (gradients.IsIndefinite())
    {
      state.Status = state.IsNearRounding() ? SolverStatus::Stagnated : SolverStatus::Diverged;
      return;
    }
  }
}

//------------------------------------------------------------------------------
// Errors are at most 2 q^k after k steps; the first product comes before the first step.
double EstimateProducts(double radius, double tolerance)
{
  if (radius <= 0.0)
  {
    return 1.0;
  }
  const double q = radius / (1.0 + std::sqrt(std::max(0.0, 1.0 - radius * radius)));
  return 1.0 + std::ceil(std::log(0.5 * tolerance) / std::log(std::min(q, MostFactor)));
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry ConjugateGradient = { vtkRadiosity::SOLVER_CONJUGATE_GRADIENT,
  "ConjugateGradient", SolverEntry::Order::AllAtOnce, SolverEntry::Links::AnyForm, Iterate,
  EstimateProducts };
} // namespace Solvers
} // namespace LightTransport
