// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityMethods.h"

#include "Radiosity/ErrorBound.h"
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityIteration.h"
#include "vtkDenseLinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace LightTransport
{
namespace
{
using Iteration = RadiosityIteration;
using Bands = Iteration::Bands;

//------------------------------------------------------------------------------
// B' = B + E - K B.
void IterateJacobi(Iteration& state)
{
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = state.Links->Combine(Iteration::SOLUTION, state.Ones.data(), Iteration::SOLUTION,
      state.Ones.data(), Iteration::RESIDUAL);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
void IterateGaussSeidel(Iteration& state)
{
  auto* links = vtkDenseLinkOperator::SafeDownCast(state.Links);
  state.Ok = state.Ok && links;
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = links->Sweep(Iteration::SOLUTION, Iteration::SOURCE, Iteration::REFLECTION);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
/*
 * Shoots from patch to patch. Beside what is unshot a patch sends what it is about to receive: its
 * reflectance times an ambient irradiance, which Feda and Purgathofer estimate from the mean
 * reflectance as if the scene were closed. Here the ambient a is such that a rho is the best
 * correction of its kind (Galerkin): sum A u = a sum A (rho - rho F rho) over all patches. In a
 * closed scene of one reflectance that is the same, and open scenes are not shot over.
 */
class Shooter
{
public:
  explicit Shooter(Iteration& state)
    : State(state), Links(vtkCPULinkOperator::SafeDownCast(state.Links)),
      Areas(*state.Equation.Areas), Patches(state.Equation.NumberOfPatches),
      Bands(state.Equation.NumberOfBands), Unshot(state.Equation.Emission.size()),
      Radiosity(Unshot.size()), Row(Patches), Ambient(Bands), Shot(Bands), Losses(Bands, 0.0)
  {
  }

  bool Begin()
  {
    const std::vector<double>& reflectance = this->State.Equation.Reflectance;
    Iteration::Bands returned(this->Bands);
    if (!this->Links || !this->Links->SetVector(Iteration::DIRECTION, reflectance.data()) ||
      !this->Links->Multiply(Iteration::IMAGE, Iteration::DIRECTION) ||
      !this->Links->Dot(Iteration::DIRECTION, Iteration::IMAGE, returned.data()))
    {
      return false;
    }
    for (std::size_t k = 0; k < reflectance.size(); ++k)
    {
      this->Losses[k % this->Bands] += reflectance[k] * this->Areas[k / this->Bands];
    }
    std::transform(this->Losses.begin(), this->Losses.end(), returned.begin(), this->Losses.begin(),
      std::minus<double>());
    return true;
  }

  // As many shots as there are patches, on a RESIDUAL that belongs to SOLUTION.
  bool Sweep()
  {
    if (!this->Links->GetVector(Iteration::RESIDUAL, this->Unshot.data()) ||
      !this->Links->GetVector(Iteration::SOLUTION, this->Radiosity.data()))
    {
      return false;
    }
    this->CheckOvershooting();
    for (vtkIdType shot = 0; shot < this->Patches; ++shot)
    {
      this->ComputeAmbient();
      const vtkIdType from = this->FindBrightest();
      if (!this->Links->GetRow(from, 0, this->Row.data()))
      {
        return false;
      }
      this->Shoot(from);
    }
    return this->Links->SetVector(Iteration::SOLUTION, this->Radiosity.data());
  }

private:
  // Shots of what is unshot alone always converge: where overshooting does not, it ends. In the
  // first few sweeps it may bring more into the scene than there was.
  void CheckOvershooting()
  {
    double power = 0.0;
    for (std::size_t k = 0; k < this->Unshot.size(); ++k)
    {
      power += std::abs(this->Unshot[k]) * this->Areas[k / this->Bands];
    }
    this->Rises += power < this->Power ? 0 : 1;
    this->Power = power;
    this->Overshoots = this->Rises <= MostRises;
  }

  void ComputeAmbient()
  {
    std::fill(this->Ambient.begin(), this->Ambient.end(), 0.0);
    for (std::size_t k = 0; this->Overshoots && k < this->Unshot.size(); ++k)
    {
      this->Ambient[k % this->Bands] += this->Unshot[k] * this->Areas[k / this->Bands];
    }
    for (int band = 0; band < this->Bands; ++band)
    {
      this->Ambient[band] =
        this->Losses[band] > 0.0 ? this->Ambient[band] / this->Losses[band] : 0.0;
    }
  }

  double GetShot(vtkIdType patch, int band) const
  {
    const std::size_t k = patch * this->Bands + band;
    return this->Unshot[k] + this->State.Equation.Reflectance[k] * this->Ambient[band];
  }

  vtkIdType FindBrightest() const
  {
    vtkIdType brightest = 0;
    double most = -1.0;
    for (vtkIdType patch = 0; patch < this->Patches; ++patch)
    {
      double power = 0.0;
      for (int band = 0; band < this->Bands; ++band)
      {
        power += std::abs(this->GetShot(patch, band));
      }
      power *= this->Areas[patch];
      brightest = power > most ? patch : brightest;
      most = std::max(most, power);
    }
    return brightest;
  }

  void Shoot(vtkIdType from)
  {
    for (int band = 0; band < this->Bands; ++band)
    {
      this->Shot[band] = this->GetShot(from, band);
      this->Radiosity[from * this->Bands + band] += this->Shot[band];
      this->Unshot[from * this->Bands + band] -= this->Shot[band];
    }
    for (vtkIdType patch = 0; patch < this->Patches; ++patch)
    {
      const double share = this->Row[patch] / this->Areas[patch];
      for (int band = 0; share != 0.0 && band < this->Bands; ++band)
      {
        const std::size_t k = patch * this->Bands + band;
        this->Unshot[k] += this->State.Equation.Reflectance[k] * share * this->Shot[band];
      }
    }
  }

  Iteration& State;
  vtkCPULinkOperator* Links;
  const std::vector<double>& Areas;
  vtkIdType Patches;
  int Bands;
  ///@{ patches x bands
  std::vector<double> Unshot;
  std::vector<double> Radiosity;
  ///@}
  std::vector<double> Row;
  ///@{ one per band
  std::vector<double> Ambient;
  std::vector<double> Shot;
  std::vector<double> Losses; // sum A (rho - rho F rho)
  ///@}
  static constexpr int MostRises = 5;
  double Power = std::numeric_limits<double>::infinity(); // unshot, after the last sweep
  int Rises = 0;
  bool Overshoots = true;
};

//------------------------------------------------------------------------------
void IterateSouthwell(Iteration& state)
{
  Shooter shooter(state);
  state.Ok = state.Ok && shooter.Begin();
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = shooter.Sweep();
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
void IterateChebyshev(Iteration& state)
{
  vtkLinkOperator* links = state.Links;
  const int bands = state.Equation.NumberOfBands;
  // The spectrum of I - rho F lies in [1 - radius, 1 + radius].
  const Bands& radii = state.Bound.SpectralRadii;
  Bands ratios = radii; // rho_k of the recurrence: 1 / sigma at first
  state.Ok = state.Ok && state.ComputeResidual() &&
    links->Combine(Iteration::DIRECTION, state.Ones.data(), Iteration::RESIDUAL, state.Zeros.data(),
      Iteration::RESIDUAL);
  while (state.Ok && state.Continue())
  {
    state.Ok = links->Combine(Iteration::SOLUTION, state.Ones.data(), Iteration::SOLUTION,
                 state.Ones.data(), Iteration::DIRECTION) &&
      state.ComputeResidual();
    Bands previous(bands), residual(bands);
    for (int band = 0; band < bands; ++band)
    {
      const double radius = radii[band];
      const double next = radius / (2.0 - radius * ratios[band]);
      previous[band] = next * ratios[band];
      residual[band] = radius > 0.0 ? 2.0 * next / radius : 1.0;
      ratios[band] = next;
    }
    state.Ok = state.Ok &&
      links->Combine(Iteration::DIRECTION, previous.data(), Iteration::DIRECTION, residual.data(),
        Iteration::RESIDUAL);
    ++state.Count;
  }
}

//------------------------------------------------------------------------------
void IterateConjugateGradients(Iteration& state)
{
  RadiosityMethods::ConjugateGradients gradients(state);
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
} // namespace

//------------------------------------------------------------------------------
RadiosityMethods::ConjugateGradients::ConjugateGradients(RadiosityVectors& vectors)
  : Vectors(vectors), Squares(vectors.Equation.NumberOfBands), Indefinite(vectors.Zeros)
{
}

//------------------------------------------------------------------------------
// y = 0, r = p = s G E
bool RadiosityMethods::ConjugateGradients::Begin()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  const double* zeros = this->Vectors.Zeros.data();
  const int image = RadiosityVectors::IMAGE;
  return links->Multiply(image, RadiosityVectors::SOURCE) &&
    links->Scale(image, RadiosityVectors::SYMMETRIC, image) &&
    links->Combine(RadiosityVectors::DIRECTION, ones, image, zeros, image) &&
    links->Combine(RadiosityVectors::UNKNOWN, zeros, image, zeros, image) &&
    links->Combine(RadiosityVectors::GRADIENT, ones, image, zeros, image) &&
    links->Dot(RadiosityVectors::GRADIENT, RadiosityVectors::GRADIENT, this->Squares.data()) &&
    this->Translate();
}

//------------------------------------------------------------------------------
// IMAGE = (I - s G s) p, and how far to go along p in each band.
bool RadiosityMethods::ConjugateGradients::ComputeSteps(std::vector<double>& steps)
{
  vtkLinkOperator* links = this->Vectors.Links;
  Bands curvatures(steps.size());
  if (!links->Apply(RadiosityVectors::IMAGE, RadiosityVectors::SYMMETRIC,
        RadiosityVectors::SYMMETRIC, RadiosityVectors::DIRECTION, RadiosityVectors::SCRATCH) ||
    !links->Combine(RadiosityVectors::IMAGE, this->Vectors.Ones.data(), RadiosityVectors::DIRECTION,
      this->Vectors.MinusOnes.data(), RadiosityVectors::IMAGE) ||
    !links->Dot(RadiosityVectors::DIRECTION, RadiosityVectors::IMAGE, curvatures.data()))
  {
    return false;
  }
  for (std::size_t band = 0; band < steps.size(); ++band)
  {
    const bool idle = this->Squares[band] == 0.0;
    const bool positive = curvatures[band] > 0.0;
    this->Indefinite[band] = idle || positive ? 0.0 : 1.0;
    steps[band] = positive ? this->Squares[band] / curvatures[band] : 0.0;
  }
  return true;
}

//------------------------------------------------------------------------------
bool RadiosityMethods::ConjugateGradients::Step()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  const std::size_t bands = this->Squares.size();
  Bands steps(bands), back(bands), next(bands), ratios(bands);
  if (!this->ComputeSteps(steps) || this->IsIndefinite())
  {
    return this->IsIndefinite();
  }
  std::transform(steps.begin(), steps.end(), back.begin(), std::negate<double>());
  if (!links->Combine(RadiosityVectors::UNKNOWN, ones, RadiosityVectors::UNKNOWN, steps.data(),
        RadiosityVectors::DIRECTION) ||
    !links->Combine(RadiosityVectors::GRADIENT, ones, RadiosityVectors::GRADIENT, back.data(),
      RadiosityVectors::IMAGE) ||
    !links->Dot(RadiosityVectors::GRADIENT, RadiosityVectors::GRADIENT, next.data()))
  {
    return false;
  }
  for (std::size_t band = 0; band < bands; ++band)
  {
    ratios[band] = this->Squares[band] > 0.0 ? next[band] / this->Squares[band] : 0.0;
  }
  this->Squares = next;
  return links->Combine(RadiosityVectors::DIRECTION, ones, RadiosityVectors::GRADIENT,
           ratios.data(), RadiosityVectors::DIRECTION) &&
    this->Translate();
}

//------------------------------------------------------------------------------
bool RadiosityMethods::ConjugateGradients::IsIndefinite() const
{
  return std::any_of(this->Indefinite.begin(), this->Indefinite.end(),
    [](double band) { return band > 0.0; });
}

//------------------------------------------------------------------------------
bool RadiosityMethods::ConjugateGradients::GetIndefiniteDirection(double* direction)
{
  vtkLinkOperator* links = this->Vectors.Links;
  return links->Scale(RadiosityVectors::SCRATCH, RadiosityVectors::SYMMETRIC,
           RadiosityVectors::DIRECTION) &&
    links->Combine(RadiosityVectors::SCRATCH, this->Indefinite.data(), RadiosityVectors::SCRATCH,
      this->Vectors.Zeros.data(), RadiosityVectors::SCRATCH) &&
    links->GetVector(RadiosityVectors::SCRATCH, direction);
}

//------------------------------------------------------------------------------
// B = E + s y, and its residual s r.
bool RadiosityMethods::ConjugateGradients::Translate()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  return links->Scale(RadiosityVectors::SOLUTION, RadiosityVectors::SYMMETRIC,
           RadiosityVectors::UNKNOWN) &&
    links->Combine(RadiosityVectors::SOLUTION, ones, RadiosityVectors::SOURCE, ones,
      RadiosityVectors::SOLUTION) &&
    links->Scale(RadiosityVectors::RESIDUAL, RadiosityVectors::SYMMETRIC,
      RadiosityVectors::GRADIENT);
}

//------------------------------------------------------------------------------
// Errors fall by the radius in each step of Jacobi's method, and about by q in one of conjugate
// gradients, whose first product comes before the first step.
double RadiosityMethods::EstimateProducts(int solver, double radius, double tolerance)
{
  if (radius <= 0.0)
  {
    return 1.0;
  }
  if (solver == vtkRadiosity::SOLVER_JACOBI)
  {
    return radius < 1.0 ? std::ceil(std::log(tolerance) / std::log(radius))
                        : std::numeric_limits<double>::infinity();
  }
  const double q = radius / (1.0 + std::sqrt(std::max(0.0, 1.0 - radius * radius)));
  return 1.0 + std::ceil(std::log(0.5 * tolerance) / std::log(std::min(q, 1.0 - 1e-12)));
}

//------------------------------------------------------------------------------
void RadiosityMethods::Iterate(int solver, RadiosityIteration& state)
{
  switch (solver)
  {
    case vtkRadiosity::SOLVER_JACOBI:
      return IterateJacobi(state);
    case vtkRadiosity::SOLVER_GAUSS_SEIDEL:
      return IterateGaussSeidel(state);
    case vtkRadiosity::SOLVER_SOUTHWELL:
      return IterateSouthwell(state);
    case vtkRadiosity::SOLVER_CHEBYSHEV:
      return IterateChebyshev(state);
    default:
      return IterateConjugateGradients(state);
  }
}
} // namespace LightTransport
