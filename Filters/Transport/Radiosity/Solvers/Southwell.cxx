// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Progressive refinement (Cohen et al. 1988), which is Southwell's method, with the overshooting of
// Feda and Purgathofer (1992).
#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityIteration.h"
#include "Radiosity/SolverEntry.h"
#include "Shared/Pulse.h"
#include "vtkCPULinkOperator.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace LightTransport
{
namespace
{
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
  explicit Shooter(RadiosityIteration& state)
    : State(state), Links(vtkCPULinkOperator::SafeDownCast(state.Links)),
      Areas(*state.Equation.Areas), Patches(state.Equation.NumberOfPatches),
      Bands(state.Equation.NumberOfBands), Unshot(state.Equation.Emission.size()),
      Radiosity(Unshot.size()), Row(Patches), Ambient(Bands), Shot(Bands), Losses(Bands, 0.0)
  {
  }

  bool Begin()
  {
    const std::vector<double>& reflectance = this->State.Equation.Reflectance;
    RadiosityIteration::Bands returned(this->Bands);
    if (!this->Links ||
      !this->Links->SetVector(RadiosityIteration::DIRECTION, reflectance.data()) ||
      !this->Links->Multiply(RadiosityIteration::IMAGE, RadiosityIteration::DIRECTION) ||
      !this->Links->Dot(RadiosityIteration::DIRECTION, RadiosityIteration::IMAGE, returned.data()))
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
    if (!this->Links->GetVector(RadiosityIteration::RESIDUAL, this->Unshot.data()) ||
      !this->Links->GetVector(RadiosityIteration::SOLUTION, this->Radiosity.data()))
    {
      return false;
    }
    this->CheckOvershooting();
    for (vtkIdType shot = 0; shot < this->Patches; ++shot)
    {
      Pulse::Beat();
      this->ComputeAmbient();
      const vtkIdType from = this->FindBrightest();
      if (!this->Links->GetRow(from, 0, this->Row.data()))
      {
        return false;
      }
      this->Shoot(from);
    }
    return this->Links->SetVector(RadiosityIteration::SOLUTION, this->Radiosity.data());
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

  RadiosityIteration& State;
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
void Iterate(RadiosityIteration& state)
{
  Shooter shooter(state);
  state.Ok = state.Ok && shooter.Begin();
  while (state.Ok && (state.Ok = state.ComputeResidual()) && state.Continue())
  {
    state.Ok = shooter.Sweep();
    ++state.Count;
  }
}
} // namespace

namespace Solvers
{
//------------------------------------------------------------------------------
extern const SolverEntry Southwell = { vtkRadiosity::SOLVER_SOUTHWELL, "Southwell",
  SolverEntry::Order::PatchToPatch, SolverEntry::Links::AnyForm, Iterate };
} // namespace Solvers
} // namespace LightTransport
