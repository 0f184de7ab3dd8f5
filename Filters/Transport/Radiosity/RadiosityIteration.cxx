// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityIteration.h"

#include "Radiosity/RadiosityBound.h"
#include "vtkLinkOperator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// Iterations without a smaller residual after which none is expected any more. Residuals of
// conjugate gradients may rise for a while; near what rounding allows there is nothing to wait for.
constexpr int Patience = 50;
constexpr int PatienceNearRounding = 5;
constexpr double NearlyRounding = 100.0;
// Residuals so many times larger than the first error bound never come back: even a method that
// sends more than there is (Southwell with overshooting) has no reason to go beyond that bound.
constexpr double Growth = 100.0;
// Roundings of one residual: the product, the scaling and two sums.
constexpr int RoundingsOfResidual = 4;
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
RadiosityIteration::RadiosityIteration(const RadiosityProblem& problem, vtkLinkOperator* links,
  const double* source, const RadiosityBound* bound)
  : Problem(problem), Links(links), Bound(bound), Ones(problem.NumberOfBands, 1.0),
    MinusOnes(problem.NumberOfBands, -1.0), Zeros(problem.NumberOfBands, 0.0), Scales(Zeros),
    Largest(Zeros)
{
  const std::size_t size = problem.Reflectance.size();
  std::vector<double> reflection(size), symmetric(size);
  for (std::size_t k = 0; k < size; ++k)
  {
    reflection[k] = problem.Reflectance[k] / (*problem.Areas)[k / problem.NumberOfBands];
    symmetric[k] = std::sqrt(reflection[k]);
  }
  this->Ok = links->SetVector(SOURCE, source) && links->SetVector(SOLUTION, source) &&
    links->SetVector(REFLECTION, reflection.data()) &&
    links->SetVector(SYMMETRIC, symmetric.data()) &&
    (!bound || links->SetVector(BOUND_WEIGHT, bound->Inverse.data()));
}

//------------------------------------------------------------------------------
bool RadiosityIteration::ComputeResidual()
{
  return this->Links->Multiply(RESIDUAL, SOLUTION) &&
    this->Links->Scale(RESIDUAL, REFLECTION, RESIDUAL) &&
    this->Links->Combine(RESIDUAL, this->Ones.data(), RESIDUAL, this->MinusOnes.data(), SOLUTION) &&
    this->Links->Combine(RESIDUAL, this->Ones.data(), RESIDUAL, this->Ones.data(), SOURCE);
}

//------------------------------------------------------------------------------
double RadiosityIteration::GetRounding(bool isSinglePrecision, double size, int steps)
{
  const double epsilon = isSinglePrecision ? std::numeric_limits<float>::epsilon()
                                           : std::numeric_limits<double>::epsilon();
  return epsilon * (RoundingsOfResidual + steps) * size;
}

//------------------------------------------------------------------------------
bool RadiosityIteration::Measure(bool isRecurrence, Look& look)
{
  const int bands = this->Problem.NumberOfBands;
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
    const double bound = this->Bound->Get(band, weighted[band], rounding);
    this->FirstBounds[band] = std::max(this->FirstBounds[band], isFirst ? bound : 0.0);
    // Written so that a NaN does not pass for an answer.
    look.HasGrown = look.HasGrown || !(residual <= Growth * this->FirstBounds[band]);
    look.Residual = std::max(look.Residual, residual);
    look.ErrorBound = bound >= look.ErrorBound ? bound : look.ErrorBound;
    if (bound <= this->Problem.Tolerance * std::max(sizes[band], this->Scales[band]))
    {
      continue;
    }
    // Bands apart: one that is done, or as far as it goes, does not end the others.
    look.Reached = false;
    const bool isNear = residual <= NearlyRounding * rounding;
    look.IsNearRounding = look.IsNearRounding && isNear;
    look.IsAtRounding = look.IsAtRounding && residual <= rounding;
    look.IsAboveFirst = look.IsAboveFirst || residual > this->First[band];
    const double goal = (isNear ? 0.9 : 1.0) * this->Smallest[band];
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
    aborted = !this->Problem.Report(this->Count, look.Residual, look.ErrorBound);
    this->LastReport = this->Count;
  }
  this->NearRounding = look.IsNearRounding;
  this->SinceSmallest = look.IsFalling ? 0 : this->SinceSmallest + 1;
  const int patience = look.IsNearRounding ? PatienceNearRounding : Patience;
  if (aborted)
  {
    this->Status = RadiosityStatus::Aborted;
  }
  else if (look.HasGrown)
  {
    this->Status = RadiosityStatus::Diverged;
  }
  else if (look.Reached)
  {
    this->Status = RadiosityStatus::Converged;
  }
  else if (look.IsAtRounding || this->SinceSmallest > patience)
  {
    this->Status = look.IsAboveFirst ? RadiosityStatus::Diverged : RadiosityStatus::Stagnated;
  }
  else
  {
    this->Status = RadiosityStatus::IterationsUsedUp;
    return this->Count < this->Problem.MaximumNumberOfIterations;
  }
  return false;
}
} // namespace LightTransport
