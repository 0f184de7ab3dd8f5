// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityIteration.h"

#include "Radiosity/ErrorBound.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/SolverSettings.h"
#include "vtkLinkOperator.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
// Iterations without a smaller residual after which none is expected any more. Residuals of
// conjugate gradients may rise for a while; near what rounding allows there is nothing to wait for.
constexpr int Patience = 50;
constexpr int PatienceNearRounding = 5;
constexpr double NearlyRounding = 100.0;
// There a residual falls only where it falls to this fraction: rounding alone moves it by less.
constexpr double WorthCounting = 0.9;
// Residuals so many times larger than the first error bound never come back: even a method that
// sends more than there is (Southwell with overshooting) has no reason to go beyond that bound.
constexpr double Growth = 100.0;
} // namespace

//------------------------------------------------------------------------------
// What one look at the residual tells, over all bands.
struct RadiosityIteration::Look
{
  double Residual = 0.0;
  double ErrorBound = 0.0;
  bool Reached = true;
  bool IsFalling = false;
  bool IsNearRounding = true; // all bands that have not reached the tolerance
  bool IsAtRounding = true;
  bool HasGrown = false;     // beyond recovery
  bool IsAboveFirst = false; // larger than at the beginning
};

//------------------------------------------------------------------------------
RadiosityIteration::RadiosityIteration(const RadiosityEquation& equation,
  const SolverSettings& settings, const ErrorBound& bound, vtkLinkOperator* links,
  const double* source)
  : RadiosityVectors(equation, links, source), Settings(settings), Bound(bound), Scales(Zeros),
    Largest(Zeros)
{
  this->Ok = this->Ok && links->SetVector(BOUND_WEIGHT, bound.Inverse.data());
}

//------------------------------------------------------------------------------
bool RadiosityIteration::Measure(bool isRecurrence, Look& look)
{
  const int bands = this->Equation.NumberOfBands;
  Bands residuals(bands), weighted(bands), sizes(bands);
  if (!this->Links->MaxNorm(RESIDUAL, residuals.data()) ||
    !this->Links->Scale(SCRATCH, RESIDUAL, BOUND_WEIGHT) ||
    !this->Links->MaxNorm(SCRATCH, weighted.data()) ||
    !this->Links->MaxNorm(SOLUTION, sizes.data()))
  {
    return false;
  }
  const bool isFirst = this->First.empty();
  if (isFirst)
  {
    this->First = residuals;
    this->Smallest = residuals;
    this->FirstBounds = this->Zeros;
  }
  const int steps = isRecurrence ? this->Count : 0;
  for (int band = 0; band < bands; ++band)
  {
    const double residual = residuals[band];
    this->Largest[band] = std::max(this->Largest[band], sizes[band]);
    const double rounding =
      GetRounding(this->Links->IsSinglePrecision(), this->Largest[band], steps);
    const double bound = this->Bound.Get(band, weighted[band], rounding);
    this->FirstBounds[band] = std::max(this->FirstBounds[band], isFirst ? bound : 0.0);
    // Written so that a NaN does not pass for an answer.
    look.HasGrown = look.HasGrown || !(residual <= Growth * this->FirstBounds[band]);
    look.Residual = std::max(look.Residual, residual);
    look.ErrorBound = bound >= look.ErrorBound ? bound : look.ErrorBound;
    if (bound <= this->Settings.Tolerance * std::max(sizes[band], this->Scales[band]))
    {
      continue;
    }
    // Bands apart: one that is done, or as far as it goes, does not end the others.
    look.Reached = false;
    const bool isNear = residual <= NearlyRounding * rounding;
    look.IsNearRounding = look.IsNearRounding && isNear;
    look.IsAtRounding = look.IsAtRounding && residual <= rounding;
    look.IsAboveFirst = look.IsAboveFirst || residual > this->First[band];
    const double goal = (isNear ? WorthCounting : 1.0) * this->Smallest[band];
    look.IsFalling = look.IsFalling || residual < goal;
    this->Smallest[band] = std::min(this->Smallest[band], residual);
  }
  return true;
}

//------------------------------------------------------------------------------
bool RadiosityIteration::Continue(bool isRecurrence)
{
  Look look;
  this->Ok = this->Ok && this->Measure(isRecurrence, look);
  if (!this->Ok)
  {
    return false;
  }
  bool aborted = false;
  if (this->Count > this->LastReport)
  {
    aborted = !this->Settings.Report(this->Count, look.Residual, look.ErrorBound);
    this->LastReport = this->Count;
  }
  this->NearRounding = look.IsNearRounding;
  this->SinceSmallest = look.IsFalling ? 0 : this->SinceSmallest + 1;
  const int patience = look.IsNearRounding ? PatienceNearRounding : Patience;
  if (aborted)
  {
    this->Status = SolverStatus::Aborted;
  }
  else if (look.HasGrown)
  {
    this->Status = SolverStatus::Diverged;
  }
  else if (look.Reached)
  {
    this->Status = SolverStatus::Converged;
  }
  else if (look.IsAtRounding || this->SinceSmallest > patience)
  {
    this->Status = look.IsAboveFirst ? SolverStatus::Diverged : SolverStatus::Stagnated;
  }
  else
  {
    this->Status = SolverStatus::IterationsUsedUp;
    return this->Count < this->Settings.MaximumNumberOfIterations;
  }
  return false;
}
} // namespace LightTransport
