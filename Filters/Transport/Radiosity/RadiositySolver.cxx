// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiositySolver.h"

#include "Radiosity/ErrorBound.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverSettings.h"
#include "Radiosity/SolverTable.h"
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
// One that leaves more than this fraction of the error has come as far as it goes.
constexpr double WorthARound = 0.5;

//------------------------------------------------------------------------------
// The one that needs the fewest products with the links, and why it is that one.
const SolverEntry* FindCheapest(double radius, double tolerance, std::string& explanation)
{
  std::vector<const SolverEntry*> entries = SolverTable::GetAll();
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                  [](const SolverEntry* entry) { return !entry->EstimateProducts; }),
    entries.end());
  const SolverEntry* cheapest = nullptr;
  double least = 0.0;
  std::ostringstream costs;
  for (const SolverEntry* entry : entries)
  {
    const double products = entry->EstimateProducts(radius, tolerance);
    if (!cheapest || products < least)
    {
      cheapest = entry;
      least = products;
    }
    costs << (entry == entries.front()     ? ""
                 : entry == entries.back() ? " and "
                                           : ", ")
          << entry->Name << (entry == entries.front() ? " needs up to " : " up to ") << products
          << (entry == entries.front() ? " products with the links" : "");
  }
  std::ostringstream text;
  text << cheapest->Name << ": at most " << radius
       << " of all light is reflected at a time, for which " << costs.str();
  explanation = text.str();
  return cheapest;
}

//------------------------------------------------------------------------------
const SolverEntry* ChooseSolver(const SolverEntry* asked, const SolverSettings& settings,
  const ErrorBound& bound, RadiositySolution& solution)
{
  const SolverEntry* chosen = asked;
  solution.Explanation = std::string(asked->Name) + ": asked for";
  if (asked->Type == vtkRadiosity::SOLVER_AUTO)
  {
    const auto& radii = bound.SpectralRadii;
    chosen = FindCheapest(*std::max_element(radii.begin(), radii.end()), settings.Tolerance,
      solution.Explanation);
  }
  solution.Solver = chosen->Type;
  return chosen;
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
  Refinement(const RadiosityEquation& equation, const SolverSettings& settings,
    const ErrorBound& bound, const SolverEntry& solver, RadiositySolution& solution)
    : Equation(equation), Settings(settings), Bound(bound), Solver(solver), Solution(solution),
      Links(equation.Operator), Residual(equation.Emission), Sizes(equation.NumberOfBands, 0.0)
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
      const bool isUseless = this->Ending == SolverStatus::Diverged ||
        !(this->Solution.ErrorBound < WorthARound * previous);
      previous = this->Solution.ErrorBound;
      isOver = this->Solution.HasConverged() || this->Ending == SolverStatus::Aborted ||
        this->Ending == SolverStatus::IterationsUsedUp ||
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
    RadiosityIteration state(this->Equation, this->Settings, this->Bound, this->Links,
      this->Residual.data());
    state.Count = this->Solution.NumberOfIterations;
    state.LastReport = this->LastReport;
    state.Scales = this->Sizes;
    if (state.Ok)
    {
      this->Solver.Iterate(state);
    }
    std::vector<double> correction(this->Residual.size());
    std::vector<double>& radiosity = this->Solution.Radiosity;
    if (!state.Ok || !this->Links->GetVector(RadiosityVectors::SOLUTION, correction.data()))
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
    vtkCPULinkOperator* reference = this->Equation.Reference;
    RadiosityVectors vectors(this->Equation, reference, this->Equation.Emission.data());
    if (!vectors.Ok ||
      !reference->SetVector(RadiosityVectors::SOLUTION, this->Solution.Radiosity.data()) ||
      !vectors.ComputeResidual() ||
      !reference->GetVector(RadiosityVectors::RESIDUAL, this->Residual.data()) ||
      !reference->MaxNorm(RadiosityVectors::SOLUTION, this->Sizes.data()))
    {
      return false;
    }
    const int bands = this->Equation.NumberOfBands;
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
      const double rounding = RadiosityVectors::GetRounding(false, this->Sizes[band], 0);
      const double error = this->Bound.Get(band, weighted[band], rounding);
      converged = converged && error <= this->Settings.Tolerance * this->Sizes[band];
      this->Solution.ErrorBound =
        this->Solution.ErrorBound >= error ? this->Solution.ErrorBound : error;
    }
    this->Solution.Status = converged ? SolverStatus::Converged : SolverStatus::Stagnated;
    return true;
  }

  bool GoOnInDouble()
  {
    this->Links = this->Equation.Reference;
    this->Solution.Explanation += "; on the CPU in the end, where single precision did not suffice";
    return this->Check();
  }

  // A solution that has not converged ended as its last run did; several that all stagnated did so.
  void Conclude()
  {
    if (this->Ending == SolverStatus::Aborted ||
      (!this->Solution.HasConverged() && this->Ending != SolverStatus::Converged))
    {
      this->Solution.Status = this->Ending;
    }
  }

  const RadiosityEquation& Equation;
  const SolverSettings& Settings;
  const ErrorBound& Bound;
  const SolverEntry& Solver;
  RadiositySolution& Solution;
  vtkLinkOperator* Links;
  std::vector<double> Residual; // patches x bands
  Bands Sizes;                  // largest |B|
  int LastReport = -1;
  SolverStatus Ending = SolverStatus::IterationsUsedUp;
};

//------------------------------------------------------------------------------
void Warn(const SolverSettings& settings, RadiositySolution& solution)
{
  if (solution.HasConverged())
  {
    return;
  }
  const bool isBest = solution.Solver == vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  std::ostringstream text;
  text << SolverTable::GetName(solution.Solver) << " stopped after " << solution.NumberOfIterations
       << " iterations with an error bound of " << solution.ErrorBound << ": ";
  switch (solution.Status)
  {
    case SolverStatus::IterationsUsedUp:
      text << "raise MaximumNumberOfIterations or Tolerance"
           << (isBest ? "." : ", or use ConjugateGradient.");
      break;
    case SolverStatus::Stagnated:
      text << "rounding does not let it come closer. Raise Tolerance above " << settings.Tolerance
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
Outcome RadiositySolver::Solve(const RadiosityEquation& equation, const SolverSettings& settings,
  RadiositySolution& solution)
{
  solution = RadiositySolution();
  const SolverEntry* asked = SolverTable::Find(settings.Solver, vtkRadiosity::DEVICE_CPU);
  if (!asked)
  {
    return Outcome::Failed(SolverTable::ExplainUnknown(settings.Solver));
  }
  ErrorBound bound;
  Outcome found = ErrorBound::Find(equation, bound);
  solution.Warning = bound.Warning;
  if (!found)
  {
    return found;
  }
  const SolverEntry* solver = ChooseSolver(asked, settings, bound, solution);
  if (!Refinement(equation, settings, bound, *solver, solution).Run())
  {
    return Outcome::Failed("The links could not be applied (see the message before this one).");
  }
  if (solution.Status == SolverStatus::Aborted)
  {
    return Outcome::Aborted();
  }
  Warn(settings, solution);
  const bool isFinite = std::all_of(solution.Radiosity.begin(), solution.Radiosity.end(),
    [](double value) { return std::isfinite(value); });
  return isFinite ? Outcome::Done() : Outcome::Failed(solution.Warning);
}
} // namespace LightTransport
