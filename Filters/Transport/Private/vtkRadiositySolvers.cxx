// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiositySolvers.h"

#include "vtkCPULinkOperator.h"
#include "vtkRadiosity.h"
#include "vtkRadiosityBound.h"
#include "vtkRadiosityIteration.h"
#include "vtkRadiosityMethods.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace
{
using Bands = vtkRadiosityIteration::Bands;

// Corrections of a single precision result; each gains the digits that single precision has.
constexpr int MaximumCorrections = 6;

//------------------------------------------------------------------------------
void ChooseSolver(const vtkRadiosityProblem& problem, const vtkRadiosityBound& bound,
  vtkRadiositySolution& solution)
{
  if (problem.Solver != vtkRadiosity::SOLVER_AUTO)
  {
    solution.Solver = problem.Solver;
    solution.Explanation =
      std::string(vtkRadiositySolvers::GetName(problem.Solver)) + ": asked for";
    return;
  }
  const double radius = *std::max_element(bound.SpectralRadii.begin(), bound.SpectralRadii.end());
  const int jacobi = vtkRadiosity::SOLVER_JACOBI;
  const int gradients = vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  const double slow = vtkRadiosityMethods::EstimateProducts(jacobi, radius, problem.Tolerance);
  const double fast = vtkRadiosityMethods::EstimateProducts(gradients, radius, problem.Tolerance);
  solution.Solver = slow <= fast ? jacobi : gradients;
  std::ostringstream text;
  text << vtkRadiositySolvers::GetName(solution.Solver) << ": at most " << radius
       << " of all light is reflected at a time, for which Jacobi needs up to " << slow
       << " products with the links and ConjugateGradient up to " << fast;
  solution.Explanation = text.str();
}

//------------------------------------------------------------------------------
// Residual, bound and sizes of a solution in double precision. Returns false after an error.
bool Check(const vtkRadiosityProblem& problem, const vtkRadiosityBound& bound,
  vtkRadiositySolution& solution, std::vector<double>& residual, Bands& sizes)
{
  vtkRadiosityIteration state(problem, problem.Reference, problem.Emission.data());
  residual.resize(problem.Emission.size());
  if (!state.Ok ||
    !problem.Reference->SetVector(vtkRadiosityIteration::SOLUTION, solution.Radiosity.data()) ||
    !state.ComputeResidual() ||
    !problem.Reference->GetVector(vtkRadiosityIteration::RESIDUAL, residual.data()) ||
    !problem.Reference->MaxNorm(vtkRadiosityIteration::SOLUTION, sizes.data()))
  {
    return false;
  }
  Bands weighted(problem.NumberOfBands, 0.0);
  for (std::size_t k = 0; k < residual.size(); ++k)
  {
    double& largest = weighted[k % problem.NumberOfBands];
    const double here = std::abs(residual[k]) * bound.Inverse[k];
    largest = largest >= here ? largest : here;
  }
  bool converged = true;
  solution.ErrorBound = 0.0;
  for (int band = 0; band < problem.NumberOfBands; ++band)
  {
    const double rounding = vtkRadiosityIteration::GetRounding(false, sizes[band], 0);
    const double error = bound.Get(band, weighted[band], rounding);
    converged = converged && error <= problem.Tolerance * sizes[band];
    solution.ErrorBound = error >= solution.ErrorBound ? error : solution.ErrorBound;
  }
  solution.Status = converged ? vtkRadiosityStatus::Converged : vtkRadiosityStatus::Stagnated;
  return true;
}

//------------------------------------------------------------------------------
// One run of the solver for the residual, added to the solution. How it ended; `ok` is false after
// an error.
vtkRadiosityStatus Improve(const vtkRadiosityProblem& problem, const vtkRadiosityBound& bound,
  const std::vector<double>& residual, const Bands& sizes, vtkRadiositySolution& solution, bool& ok)
{
  vtkRadiosityIteration state(problem, problem.Operator, residual.data(), &bound);
  state.Count = solution.NumberOfIterations;
  state.LastReport = solution.Radiosity.empty() ? -1 : state.Count;
  state.Scales = sizes;
  if (state.Ok)
  {
    vtkRadiosityMethods::Iterate(solution.Solver, state);
  }
  std::vector<double> correction(residual.size());
  ok = state.Ok && problem.Operator->GetVector(vtkRadiosityIteration::SOLUTION, correction.data());
  solution.Radiosity.resize(residual.size(), 0.0);
  std::transform(solution.Radiosity.begin(), solution.Radiosity.end(), correction.begin(),
    solution.Radiosity.begin(), std::plus<double>());
  solution.NumberOfIterations = state.Count;
  return state.Status;
}

//------------------------------------------------------------------------------
void Warn(const vtkRadiosityProblem& problem, vtkRadiositySolution& solution)
{
  if (solution.HasConverged() || solution.Status == vtkRadiosityStatus::Aborted)
  {
    return;
  }
  const bool isBest = solution.Solver == vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  std::ostringstream text;
  text << vtkRadiositySolvers::GetName(solution.Solver) << " stopped after "
       << solution.NumberOfIterations << " iterations with an error bound of "
       << solution.ErrorBound << ": ";
  switch (solution.Status)
  {
    case vtkRadiosityStatus::IterationsUsedUp:
      text << "raise MaximumNumberOfIterations or Tolerance"
           << (isBest ? "." : ", or use ConjugateGradient.");
      break;
    case vtkRadiosityStatus::Stagnated:
      text << "rounding does not let it come closer. Raise Tolerance above " << problem.Tolerance
           << ", or lower reflectances that are next to 1.";
      break;
    default:
      text << "the residual grows, so view factors sum to more than 1 / reflectance somewhere. "
              "Switch EnforceClosure on or lower the largest reflectance.";
  }
  solution.Warning = text.str() + (solution.Warning.empty() ? "" : " ") + solution.Warning;
}

//------------------------------------------------------------------------------
// False after an error, which is then in the solution.
bool Run(const vtkRadiosityProblem& problem, const vtkRadiosityBound& bound,
  vtkRadiositySolution& solution)
{
  std::vector<double> residual = problem.Emission;
  Bands sizes(problem.NumberOfBands, 0.0);
  double previous = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= MaximumCorrections; ++round)
  {
    bool ok = false;
    const vtkRadiosityStatus status = Improve(problem, bound, residual, sizes, solution, ok);
    if (!ok || !Check(problem, bound, solution, residual, sizes))
    {
      solution.Error = "The links could not be applied (see the message before this one).";
      return false;
    }
    const bool isOver = status == vtkRadiosityStatus::Aborted ||
      status == vtkRadiosityStatus::Diverged || status == vtkRadiosityStatus::IterationsUsedUp;
    if (status == vtkRadiosityStatus::Aborted || (isOver && !solution.HasConverged()))
    {
      solution.Status = status;
    }
    // As far as it goes: a round that gained less than a factor of two.
    if (isOver || solution.HasConverged() || !(solution.ErrorBound < 0.5 * previous))
    {
      break;
    }
    previous = solution.ErrorBound;
  }
  return true;
}
} // namespace

//------------------------------------------------------------------------------
const char* vtkRadiositySolvers::GetName(int solver)
{
  const char* const names[] = { "Auto", "Jacobi", "GaussSeidel", "Southwell", "Chebyshev",
    "ConjugateGradient" };
  return names[solver];
}

//------------------------------------------------------------------------------
const char* vtkRadiositySolvers::GetName(vtkRadiosityStatus status)
{
  const char* const names[] = { "Converged", "IterationsUsedUp", "Stagnated", "Diverged",
    "Aborted" };
  return names[static_cast<int>(status)];
}

//------------------------------------------------------------------------------
bool vtkRadiositySolvers::IsSequential(int solver)
{
  return solver == vtkRadiosity::SOLVER_GAUSS_SEIDEL || solver == vtkRadiosity::SOLVER_SOUTHWELL;
}

//------------------------------------------------------------------------------
vtkRadiositySolution vtkRadiositySolvers::Solve(const vtkRadiosityProblem& problem)
{
  vtkRadiositySolution solution;
  const vtkRadiosityBound bound = vtkRadiosityBound::Find(problem);
  solution.Error = bound.Error;
  solution.Warning = bound.Warning;
  if (!solution.Error.empty())
  {
    return solution;
  }
  ChooseSolver(problem, bound, solution);
  if (Run(problem, bound, solution))
  {
    Warn(problem, solution);
  }
  if (!std::all_of(solution.Radiosity.begin(), solution.Radiosity.end(),
        [](double value) { return std::isfinite(value); }))
  {
    solution.Error = solution.Warning;
  }
  return solution;
}
