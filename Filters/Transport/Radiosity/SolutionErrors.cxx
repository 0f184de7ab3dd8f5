// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/SolutionErrors.h"

#include "Radiosity/RadiositySolution.h"
#include "Radiosity/RadiositySolver.h"
#include "Radiosity/SolverSettings.h"
#include "ViewFactors/LinkDoubts.h"
#include "vtkCPULinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace LightTransport
{
namespace
{
constexpr int Groups = LinkDoubts::Groups;
// What is known takes one vector more.
constexpr int Vectors = Groups + 1;
// How well the equation is solved for differences: they are errors themselves.
constexpr double ErrorTolerance = 1e-2;
constexpr int MostIterations = 200;
// Vectors of all at once: of the equation and its solver for each band, of rows for all.
constexpr int VectorsPerBand = 20;
constexpr int VectorsOfRows = 5;

//------------------------------------------------------------------------------
// patches x bands, for each vector the same.
std::vector<double> Repeat(const std::vector<double>& values, int bands)
{
  std::vector<double> repeated;
  repeated.reserve(values.size() * Vectors);
  for (std::size_t patch = 0; patch < values.size() / bands; ++patch)
  {
    for (int vector = 0; vector < Vectors; ++vector)
    {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(patch) * bands;
      repeated.insert(repeated.end(), first, first + bands);
    }
  }
  return repeated;
}

//------------------------------------------------------------------------------
// patches x groups x bands, and after the groups of each patch what is known of it.
std::vector<double> Join(const std::vector<double>& groups, const std::vector<double>& known,
  int bands)
{
  std::vector<double> joined;
  joined.reserve(groups.size() + known.size());
  for (std::size_t patch = 0; patch < known.size() / bands; ++patch)
  {
    const auto first = groups.begin() + static_cast<std::ptrdiff_t>(patch) * Groups * bands;
    joined.insert(joined.end(), first, first + static_cast<std::ptrdiff_t>(Groups) * bands);
    const auto own = known.begin() + static_cast<std::ptrdiff_t>(patch) * bands;
    joined.insert(joined.end(), own, own + bands);
  }
  return joined;
}

//------------------------------------------------------------------------------
// Standard errors of what was joined like that.
std::vector<double> GetDeviations(const LinkDoubts& doubts, const std::vector<double>& joined,
  int bands)
{
  std::vector<double> groups, known;
  const std::size_t all = static_cast<std::size_t>(Vectors) * bands;
  for (std::size_t k = 0; k < joined.size(); ++k)
  {
    const bool isOfGroup = k % all < static_cast<std::size_t>(Groups) * bands;
    (isOfGroup ? groups : known).push_back(joined[k]);
  }
  std::vector<double> deviations = doubts.GetDeviations(groups);
  std::transform(deviations.begin(), deviations.end(), known.begin(), deviations.begin(),
    [](double a, double b) { return std::hypot(a, b); });
  return deviations;
}

//------------------------------------------------------------------------------
// The irradiance of a radiosity.
Outcome Multiply(vtkCPULinkOperator* links, const std::vector<double>& areas,
  const std::vector<double>& radiosity, std::vector<double>& irradiance)
{
  irradiance.resize(radiosity.size());
  if (!links->SetVector(0, radiosity.data()) || !links->Multiply(1, 0) ||
    !links->GetVector(1, irradiance.data()))
  {
    return Outcome::FailedAsReported();
  }
  const std::size_t vectors = radiosity.size() / areas.size();
  for (std::size_t k = 0; k < irradiance.size(); ++k)
  {
    irradiance[k] /= areas[k / vectors];
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
int SolutionErrors::GetNumberOfVectors()
{
  return Vectors;
}

//------------------------------------------------------------------------------
double SolutionErrors::GetEstimatedBytes(vtkIdType numberOfPatches, int bands)
{
  return static_cast<double>(numberOfPatches) * Vectors * sizeof(double) *
    (VectorsOfRows + VectorsPerBand * bands);
}

//------------------------------------------------------------------------------
Outcome SolutionErrors::Find(const LinkDoubts& doubts, const RadiosityEquation& equation,
  vtkCPULinkOperator* links, const std::vector<double>& radiosity,
  const std::vector<double>& irradiance, const std::vector<double>& change,
  const std::vector<double>& background, const Monitor& monitor)
{
  const int bands = equation.NumberOfBands;
  std::vector<double> known, groups;
  Outcome found = Multiply(equation.Reference, *equation.Areas, change, known);
  found = found ? doubts.FindDifferences(radiosity, bands, background, groups, known) : found;
  if (!found)
  {
    return found;
  }
  std::vector<double> differences = Join(groups, known, bands);
  std::vector<double> changes;
  if (Outcome spread = Spread(equation, links, differences, changes, monitor); !spread)
  {
    return spread;
  }
  std::vector<double> fluxes = changes;
  std::transform(fluxes.begin(), fluxes.end(), differences.begin(), fluxes.begin(),
    std::minus<double>());
  this->Radiosity = GetDeviations(doubts, changes, bands);
  this->Irradiance = GetDeviations(doubts, differences, bands);
  this->NetFlux = GetDeviations(doubts, fluxes, bands);
  this->SumUp(equation, irradiance);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// What differences of the irradiance change of the radiosity; what that is reflected to is added to
// them.
Outcome SolutionErrors::Spread(const RadiosityEquation& equation, vtkCPULinkOperator* links,
  std::vector<double>& differences, std::vector<double>& changes, const Monitor& monitor)
{
  const int bands = equation.NumberOfBands;
  RadiosityEquation change = equation;
  change.Operator = links;
  change.Reference = links;
  change.NumberOfBands = bands * Vectors;
  change.Reflectance = Repeat(equation.Reflectance, bands);
  change.Emission = differences;
  std::transform(differences.begin(), differences.end(), change.Reflectance.begin(),
    change.Emission.begin(), std::multiplies<double>());
  changes.assign(differences.size(), 0.0);
  if (std::all_of(change.Emission.begin(), change.Emission.end(),
        [](double value) { return value == 0.0; }))
  {
    return Outcome::Done();
  }
  SolverSettings settings;
  settings.Solver = vtkRadiosity::SOLVER_CONJUGATE_GRADIENT;
  settings.Tolerance = ErrorTolerance;
  settings.MaximumNumberOfIterations = MostIterations;
  settings.Report = [&monitor](int iteration, double, double)
  { return monitor.Report(static_cast<double>(iteration) / MostIterations); };
  RadiositySolution solution;
  if (Outcome solved = RadiositySolver::Solve(change, settings, solution); !solved)
  {
    return solved;
  }
  changes = solution.Radiosity;
  std::vector<double> received;
  Outcome multiplied = Multiply(links, *equation.Areas, changes, received);
  for (std::size_t k = 0; multiplied && k < received.size(); ++k)
  {
    differences[k] += received[k];
  }
  return multiplied;
}

//------------------------------------------------------------------------------
void SolutionErrors::SumUp(const RadiosityEquation& equation, const std::vector<double>& irradiance)
{
  const int bands = equation.NumberOfBands;
  this->Whole = 0.0;
  for (int band = 0; band < bands; ++band)
  {
    double errors = 0.0, whole = 0.0, errorsOfH = 0.0, wholeOfH = 0.0;
    for (std::size_t k = band; k < irradiance.size(); k += bands)
    {
      const double area = (*equation.Areas)[k / bands];
      const double reflected = equation.Reflectance[k] * irradiance[k];
      errors += area * this->Radiosity[k] * this->Radiosity[k];
      whole += area * reflected * reflected;
      errorsOfH += area * this->Irradiance[k] * this->Irradiance[k];
      wholeOfH += area * irradiance[k] * irradiance[k];
    }
    const double error =
      whole > 0.0 ? errors / whole : (wholeOfH > 0.0 ? errorsOfH / wholeOfH : 0.0);
    this->Whole = std::max(this->Whole, std::sqrt(error));
  }
}
} // namespace LightTransport
