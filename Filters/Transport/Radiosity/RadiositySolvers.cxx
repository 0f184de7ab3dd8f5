// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiositySolvers.h"

#include "Radiosity/RadiosityBound.h"
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/RadiosityMethods.h"
#include "vtkCPULinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace LightTransport
{
namespace
{
using Bands = RadiosityIteration::Bands;

// Corrections of a single precision result; each gains the digits that single precision has.
constexpr int MaximumCorrections = 6;

//------------------------------------------------------------------------------
void ChooseSolver(const RadiosityProblem& problem, const RadiosityBound& bound,
  RadiositySolution& solution)
{
  if (problem.Solver != vtkRadiosity::SOLVER_AUTO)
  {
    solution.Solver = problem.Solver;
    solution.Explanation = std::string(RadiositySolvers::GetName(problem.Solver)) + ": asked for";
    return;
  }
  const double radius = *std::max_element(bound.SpectralRadii.begin(), bound.SpectralRadii.end());
  const int jacobi = vtkRadiosity::SOLVER_JACOBI;
  const int gradients = vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  const double slow = RadiosityMethods::EstimateProducts(jacobi, radius, problem.Tolerance);
  const double fast = RadiosityMethods::EstimateProducts(gradients, radius, problem.Tolerance);
  solution.Solver = slow <= fast ? jacobi : gradients;
  std::ostringstream text;
  text << RadiositySolvers::GetName(solution.Solver) << ": at most " << radius
       << " of all light is reflected at a time, for which Jacobi needs up to " << slow
       << " products with the links and ConjugateGradient up to " << fast;
  solution.Explanation = text.str();
}

//------------------------------------------------------------------------------
/*
 * Runs the solver for the residual again and again, which each time is computed in double
 * precision. On a device in single precision as long as that helps: reflectances within 1e-6 of 1
 * it may not tell from more than 1.
 */
class Refinement
{
public:
  Refinement(const RadiosityProblem& problem, const RadiosityBound& bound,
    RadiositySolution& solution)
    : Problem(problem), Bound(bound), Solution(solution), Links(problem.Operator),
      Residual(problem.Emission), Sizes(problem.NumberOfBands, 0.0)
  {
    solution.Radiosity.assign(this->Residual.size(), 0.0);
  }

  // False after an error of a link operator.
  bool Run()
  {
    double previous = std::numeric_limits<double>::infinity();
    bool isOver = false;
    for (int round = 0; round <= MaximumCorrections && !isOver; ++round)
    {
      const std::vector<double> before = this->Solution.Radiosity;
      if (!this->Improve() || !this->Check())
      {
        return false;
      }
      // A round that gains less than a factor of two has come as far as it goes.
      const bool isUseless =
        this->Ending == RadiosityStatus::Diverged || !(this->Solution.ErrorBound < 0.5 * previous);
      previous = this->Solution.ErrorBound;
      isOver = this->Solution.HasConverged() || this->Ending == RadiosityStatus::Aborted ||
        this->Ending == RadiosityStatus::IterationsUsedUp ||
        (isUseless && !this->Links->IsSinglePrecision());
      if (!isOver && isUseless)
      {
        this->Solution.Radiosity = before;
        previous = std::numeric_limits<double>::infinity();
        if (!this->GoOnInDouble())
        {
          return false;
        }
      }
    }
    this->Conclude();
    return true;
  }

private:
  // One run of the solver, added to the solution.
  bool Improve()
  {
    RadiosityIteration state(this->Problem, this->Links, this->Residual.data(), &this->Bound);
    state.Count = this->Solution.NumberOfIterations;
    state.LastReport = this->LastReport;
    state.Scales = this->Sizes;
    if (state.Ok)
    {
      RadiosityMethods::Iterate(this->Solution.Solver, state);
    }
    std::vector<double> correction(this->Residual.size());
    std::vector<double>& radiosity = this->Solution.Radiosity;
    if (!state.Ok || !this->Links->GetVector(RadiosityIteration::SOLUTION, correction.data()))
    {
      return false;
    }
    std::transform(radiosity.begin(), radiosity.end(), correction.begin(), radiosity.begin(),
      std::plus<double>());
    this->Solution.NumberOfIterations = state.Count;
    this->LastReport = state.LastReport;
    this->Ending = state.Status;
    return true;
  }

  // Residual, bound and sizes of the solution in double precision.
  bool Check()
  {
    vtkCPULinkOperator* reference = this->Problem.Reference;
    RadiosityIteration state(this->Problem, reference, this->Problem.Emission.data());
    if (!state.Ok ||
      !reference->SetVector(RadiosityIteration::SOLUTION, this->Solution.Radiosity.data()) ||
      !state.ComputeResidual() ||
      !reference->GetVector(RadiosityIteration::RESIDUAL, this->Residual.data()) ||
      !reference->MaxNorm(RadiosityIteration::SOLUTION, this->Sizes.data()))
    {
      return false;
    }
    const int bands = this->Problem.NumberOfBands;
    Bands weighted(bands, 0.0);
    for (std::size_t k = 0; k < this->Residual.size(); ++k)
    {
      double& largest = weighted[k % bands];
      const double here = std::abs(this->Residual[k]) * this->Bound.Inverse[k];
      // Written so that a NaN stays.
      largest = largest >= here ? largest : here;
    }
    bool converged = true;
    this->Solution.ErrorBound = 0.0;
    for (int band = 0; band < bands; ++band)
    {
      const double rounding = RadiosityIteration::GetRounding(false, this->Sizes[band], 0);
      const double error = this->Bound.Get(band, weighted[band], rounding);
      converged = converged && error <= this->Problem.Tolerance * this->Sizes[band];
      this->Solution.ErrorBound =
        this->Solution.ErrorBound >= error ? this->Solution.ErrorBound : error;
    }
    this->Solution.Status = converged ? RadiosityStatus::Converged : RadiosityStatus::Stagnated;
    return true;
  }

  bool GoOnInDouble()
  {
    this->Links = this->Problem.Reference;
    this->Solution.Explanation += "; on the CPU in the end, where single precision did not suffice";
    return this->Check();
  }

  // A solution that has not converged ended as its last run did; several that all stagnated did so.
  void Conclude()
  {
    if (this->Ending == RadiosityStatus::Aborted ||
      (!this->Solution.HasConverged() && this->Ending != RadiosityStatus::Converged))
    {
      this->Solution.Status = this->Ending;
    }
  }

  const RadiosityProblem& Problem;
  const RadiosityBound& Bound;
  RadiositySolution& Solution;
  vtkLinkOperator* Links;
  std::vector<double> Residual; // patches x bands
  Bands Sizes;                  // largest |B|
  int LastReport = -1;
  RadiosityStatus Ending = RadiosityStatus::IterationsUsedUp;
};

//------------------------------------------------------------------------------
void Warn(const RadiosityProblem& problem, RadiositySolution& solution)
{
  if (solution.HasConverged() || solution.Status == RadiosityStatus::Aborted)
  {
    return;
  }
  const bool isBest = solution.Solver == vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  std::ostringstream text;
  text << RadiositySolvers::GetName(solution.Solver) << " stopped after "
       << solution.NumberOfIterations << " iterations with an error bound of "
       << solution.ErrorBound << ": ";
  switch (solution.Status)
  {
    case RadiosityStatus::IterationsUsedUp:
      text << "raise MaximumNumberOfIterations or Tolerance"
           << (isBest ? "." : ", or use ConjugateGradient.");
      break;
    case RadiosityStatus::Stagnated:
      text << "rounding does not let it come closer. Raise Tolerance above " << problem.Tolerance
           << ", or lower reflectances that are next to 1.";
      break;
    default:
      text << "the residual grows, so view factors sum to more than 1 / reflectance somewhere. "
              "Switch EnforceClosure on or lower the largest reflectance.";
  }
  solution.Warning = text.str() + (solution.Warning.empty() ? "" : " ") + solution.Warning;
}
} // namespace

//------------------------------------------------------------------------------
const char* RadiositySolvers::GetName(int solver)
{
  const char* const names[] = { "Auto", "Jacobi", "GaussSeidel", "Southwell", "Chebyshev",
    "ConjugateGradient" };
  return names[solver];
}

//------------------------------------------------------------------------------
const char* RadiositySolvers::GetName(RadiosityStatus status)
{
  const char* const names[] = { "Converged", "IterationsUsedUp", "Stagnated", "Diverged",
    "Aborted" };
  return names[static_cast<int>(status)];
}

//------------------------------------------------------------------------------
bool RadiositySolvers::IsSequential(int solver)
{
  return solver == vtkRadiosity::SOLVER_GAUSS_SEIDEL || solver == vtkRadiosity::SOLVER_SOUTHWELL;
}

//------------------------------------------------------------------------------
RadiositySolution RadiositySolvers::Solve(const RadiosityProblem& problem)
{
  RadiositySolution solution;
  const RadiosityBound bound = RadiosityBound::Find(problem);
  solution.Error = bound.Error;
  solution.Warning = bound.Warning;
  if (!solution.Error.empty())
  {
    return solution;
  }
  ChooseSolver(problem, bound, solution);
  if (!Refinement(problem, bound, solution).Run())
  {
    solution.Error = "The links could not be applied (see the message before this one).";
    return solution;
  }
  Warn(problem, solution);
  if (!std::all_of(solution.Radiosity.begin(), solution.Radiosity.end(),
        [](double value) { return std::isfinite(value); }))
  {
    solution.Error = solution.Warning;
  }
  return solution;
}
} // namespace LightTransport
