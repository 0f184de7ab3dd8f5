// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/*
 * Southwell by progressive refinement on a device: shots without view factors, until what is left
 * to shoot no longer matters.
 *
 * With unshot radiosity r >= 0, what has been shot is below the solution of the device's own view
 * factors by (I - rho F)^-1 r. Rows of F sum to 1 at most, so neither B nor H of any patch misses
 * more than max r / (1 - rho), with the largest rho: infinite where a patch reflects everything.
 * The error of the view factors is not in it.
 */
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiositySolution.h"
#include "Radiosity/ShotPatches.h"
#include "Radiosity/SolverEntry.h"
#include "Radiosity/SolverSettings.h"
#include "Scene/PatchScene.h"
#include "vtkDeviceShooter.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace LightTransport
{
namespace
{
// Less than this fraction of the largest source does not change sums of single precision.
constexpr double SinglePrecision = 1e-7;
// Shots between two reports.
constexpr vtkIdType ShotsPerReport = 16;

//------------------------------------------------------------------------------
// Largest magnitudes of each band.
std::vector<double> FindLargest(const std::vector<double>& values, int bands)
{
  std::vector<double> largest(static_cast<std::size_t>(bands), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    largest[k % bands] = std::max(largest[k % bands], std::abs(values[k]));
  }
  return largest;
}

//------------------------------------------------------------------------------
// The error bound from what is unshot, and whether that is all there is to do. B is nowhere below
// its source, so the tolerance is met for B where it is met for the source.
bool IsOver(const std::vector<double>& unshot, const std::vector<double>& reflectances,
  const std::vector<double>& sources, const SolverSettings& settings, RadiositySolution& solution)
{
  bool converged = true;
  bool exhausted = true;
  solution.ErrorBound = 0.0;
  for (std::size_t band = 0; band < unshot.size(); ++band)
  {
    const double rho = reflectances[band];
    const double gain = rho < 1.0 ? 1.0 / (1.0 - rho) : std::numeric_limits<double>::infinity();
    // Written so that a NaN does not pass for an answer.
    const double bound = unshot[band] == 0.0 ? 0.0 : gain * unshot[band];
    solution.ErrorBound = bound <= solution.ErrorBound ? solution.ErrorBound : bound;
    converged = converged && bound <= settings.Tolerance * sources[band];
    exhausted = exhausted && unshot[band] <= SinglePrecision * sources[band];
  }
  const double residual = *std::max_element(unshot.begin(), unshot.end());
  const bool aborted = !settings.Report(solution.NumberOfIterations, residual, solution.ErrorBound);
  solution.Status = aborted ? SolverStatus::Aborted
    : converged             ? SolverStatus::Converged
    : exhausted             ? SolverStatus::Stagnated
                            : SolverStatus::IterationsUsedUp;
  return aborted || converged || exhausted ||
    solution.NumberOfIterations >= settings.MaximumNumberOfIterations;
}

//------------------------------------------------------------------------------
void Warn(const SolverSettings& settings, RadiositySolution& solution)
{
  if (solution.HasConverged() || solution.Status == SolverStatus::Aborted)
  {
    return;
  }
  std::ostringstream text;
  text << "Southwell stopped after " << solution.NumberOfIterations
       << " shots with an error bound of " << solution.ErrorBound << ": "
       << (solution.Status == SolverStatus::Stagnated
              ? "what is left is nothing to single precision. Raise Tolerance above "
              : "raise MaximumNumberOfIterations, or Tolerance above ")
       << settings.Tolerance << ", or use ConjugateGradient.";
  solution.Warning = text.str();
}

//------------------------------------------------------------------------------
Outcome Shoot(vtkDeviceShooter* shooter, const PatchScene& scene, const RadiosityEquation& equation,
  const SolverSettings& settings, RadiositySolution& solution)
{
  solution = RadiositySolution();
  solution.Solver = vtkRadiosity::SOLVER_SOUTHWELL;
  solution.Explanation = "Southwell: asked for, by item buffers without view factors";
  const int bands = equation.NumberOfBands;
  const std::vector<double> reflectances = FindLargest(equation.Reflectance, bands);
  const std::vector<double> sources = FindLargest(equation.Emission, bands);
  std::vector<double> unshot = sources;
  bool good = shooter->Initialize(DescribePatches(scene), bands, equation.Emission.data(),
    equation.Reflectance.data());
  while (good && !IsOver(unshot, reflectances, sources, settings, solution))
  {
    const vtkIdType left = settings.MaximumNumberOfIterations - solution.NumberOfIterations;
    const vtkIdType shots = shooter->Shoot(std::min(ShotsPerReport, left));
    good = shots >= 0 && shooter->GetLargestUnshot(unshot.data());
    solution.NumberOfIterations += static_cast<int>(shots);
    if (shots == 0)
    {
      // What is left has no power that single precision could tell.
      solution.Status = SolverStatus::Stagnated;
      break;
    }
  }
  std::vector<double>& irradiance = solution.Irradiance;
  irradiance.resize(equation.Emission.size());
  solution.Radiosity = equation.Emission;
  if (!good || !shooter->GetIrradiance(irradiance.data()))
  {
    return Outcome::Failed("The device could not shoot (see the message before this one).");
  }
  Warn(settings, solution);
  for (std::size_t k = 0; k < irradiance.size(); ++k)
  {
    solution.Radiosity[k] += equation.Reflectance[k] * irradiance[k];
  }
  return Outcome::DoneUnlessAborted(solution.Status != SolverStatus::Aborted);
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry SouthwellOnDevice = { vtkRadiosity::SOLVER_SOUTHWELL, "Southwell",
  SolverEntry::Order::PatchToPatch, SolverEntry::Links::FoundOnDevice, nullptr, nullptr, Shoot };
} // namespace Solvers
} // namespace LightTransport
