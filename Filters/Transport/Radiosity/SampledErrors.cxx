// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/SampledErrors.h"

#include "Radiosity/RadiositySolution.h"
#include "Radiosity/RadiositySolver.h"
#include "Radiosity/SolverSettings.h"
#include "ViewFactors/RayErrors.h"
#include "vtkCPULinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace LightTransport
{
namespace
{
constexpr int Groups = RayErrors::Groups;
// How well the equation is solved for differences: they are errors themselves.
constexpr double ErrorTolerance = 1e-2;
constexpr int MostIterations = 200;
// Vectors of all groups at once: of the equation and its solver for each band, of rows for all.
constexpr int VectorsPerBand = 20;
constexpr int VectorsOfRows = 5;

//------------------------------------------------------------------------------
// patches x bands, each group with the same.
std::vector<double> RepeatForGroups(const std::vector<double>& values, int bands)
{
  std::vector<double> repeated;
  repeated.reserve(values.size() * Groups);
  for (std::size_t patch = 0; patch < values.size() / bands; ++patch)
  {
    for (int group = 0; group < Groups; ++group)
    {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(patch) * bands;
      repeated.insert(repeated.end(), first, first + bands);
    }
  }
  return repeated;
}
} // namespace

//------------------------------------------------------------------------------
double SampledErrors::GetEstimatedBytes(vtkIdType numberOfPatches, int bands)
{
  return static_cast<double>(numberOfPatches) * Groups * sizeof(double) *
    (VectorsOfRows + VectorsPerBand * bands);
}

//------------------------------------------------------------------------------
Outcome SampledErrors::Find(const RayErrors& rays, const RadiosityEquation& equation,
  vtkCPULinkOperator* links, const std::vector<double>& radiosity,
  const std::vector<double>& irradiance, const std::vector<double>& background,
  const Monitor& monitor)
{
  const int bands = equation.NumberOfBands;
  std::vector<double> differences;
  if (Outcome found = rays.FindDifferences(radiosity, bands, background, differences); !found)
  {
    return found;
  }
  RadiosityEquation change = equation;
  change.Operator = links;
  change.Reference = links;
  change.NumberOfBands = bands * Groups;
  change.Reflectance = RepeatForGroups(equation.Reflectance, bands);
  change.Emission = differences;
  std::transform(differences.begin(), differences.end(), change.Reflectance.begin(),
    change.Emission.begin(), std::multiplies<double>());
  std::vector<double> changes(differences.size(), 0.0);
  const bool isReflected = std::any_of(change.Emission.begin(), change.Emission.end(),
    [](double value) { return value != 0.0; });
  if (isReflected)
  {
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
    // What differs of H in all is what groups differ by and what that is reflected to.
    std::vector<double> received(changes.size());
    if (!links->SetVector(0, changes.data()) || !links->Multiply(1, 0) ||
      !links->GetVector(1, received.data()))
    {
      return Outcome::FailedAsReported();
    }
    for (std::size_t k = 0; k < received.size(); ++k)
    {
      differences[k] +=
        received[k] / (*equation.Areas)[k / (static_cast<std::size_t>(bands) * Groups)];
    }
  }
  std::vector<double> fluxes = changes;
  std::transform(fluxes.begin(), fluxes.end(), differences.begin(), fluxes.begin(),
    std::minus<double>());
  this->Radiosity = rays.GetDeviations(changes);
  this->Irradiance = rays.GetDeviations(differences);
  this->NetFlux = rays.GetDeviations(fluxes);
  this->SumUp(equation, irradiance);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void SampledErrors::SumUp(const RadiosityEquation& equation, const std::vector<double>& irradiance)
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
