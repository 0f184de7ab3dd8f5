// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Gauss-Seidel (Carr, Hall and Hart 2003).
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverEntry.h"
#include "vtkDenseLinkOperator.h"
#include "vtkRadiosity.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
void Iterate(RadiosityIteration& state)
{
  auto* links = vtkDenseLinkOperator::SafeDownCast(state.Links);
  state.Ok = state.Ok && links;
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = links->Sweep(RadiosityIteration::SOLUTION, RadiosityIteration::SOURCE,
      RadiosityIteration::REFLECTION);
    ++state.Count;
  }
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry GaussSeidel = { vtkRadiosity::SOLVER_GAUSS_SEIDEL, "GaussSeidel",
  SolverEntry::Order::PatchToPatch, SolverEntry::Links::EachPair, Iterate };
} // namespace Solvers
} // namespace LightTransport
