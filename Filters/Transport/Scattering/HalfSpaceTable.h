// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What leaves a flat, semi-infinite medium over the distance from where it entered, by photons that
 * walk in it (PhotonWalk). Lengths are reduced mean free paths, 1 / (sigma_s' + sigma_a), so that a
 * table serves media of any size.
 *
 * Photons are counted in rings whose radii grow by a factor. Of what these hold the shape
 *
 *   M(r) = g(kappa r) / (r (1 + r^2 / 9)),   g(x) = (1 + x) exp(-x)
 *
 * is taken off, which is how every such profile begins (single scattering) and ends (diffusion,
 * whose decay kappa is exact here), and a smooth spline is drawn through the logarithm of the rest,
 * by the weights of the rings' standard errors (P. Eilers, B. Marx, "Flexible smoothing with
 * B-splines and penalties", Statistical Science 11, 1996). Beyond the first and the last ring that
 * enough photons have reached the spline goes on as a constant, so that the profile goes on as M.
 * It is made to fall everywhere, and its total is that of the walk.
 *
 * Where less than 1e-4 is absorbed (LeastAbsorption) the walk is that of 1e-4, which ends in
 * bounded time: what it lacks leaves far away, by diffusion, as g of the medium says
 * (TabulatedProfile).
 */
#ifndef HalfSpaceTable_h
#define HalfSpaceTable_h

#include "Support/Ranks.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LightTransport
{
class HalfSpaceTable
{
public:
  struct Settings
  {
    double Albedo; ///< sigma_s' / (sigma_s' + sigma_a), above 0
    double RefractiveIndex;
    double Anisotropy;
    /// 0: as many as about a second of CPU time allows.
    long long NumberOfPhotons = 0;
    std::uint64_t Seed = 1;
    /// Light that enters along the normal instead of diffuse light, as published tables have it.
    bool IsNormal = false;
  };

  /// The least that is absorbed of what is scattered or absorbed, else walks have no mean length.
  static constexpr double LeastAbsorption = 1e-4;

  /// Each rank takes some of the photons; the bits are the same on any number. Collective.
  explicit HalfSpaceTable(const Settings& settings, const Ranks& ranks = Ranks());

  /// The same table where it is kept from before, by this process: the last few are. Thread-safe;
  /// collective.
  static std::shared_ptr<const HalfSpaceTable> Get(const Settings& settings,
    const Ranks& ranks = Ranks());

  /// kappa. `absorption` is 1 - albedo, which that difference may not hold to all digits.
  static double GetDecay(double absorption, double anisotropy);

  /// Of what entered, per unit area. `decay` is that of the medium. With a `gain` that is not 1
  /// only this part of what differs from a medium with `walkDecay` is there.
  double Evaluate(double radius, double decay, double walkDecay = 0.0, double gain = 1.0) const;

  /// Standard error of what leaves of the walk in all, relative.
  double GetError() const { return this->Error; }
  long long GetNumberOfPhotons() const { return this->Photons; }

private:
  class Rings;

  static std::shared_ptr<const HalfSpaceTable> Find(const Settings& settings);
  static void Keep(const Settings& settings, const std::shared_ptr<const HalfSpaceTable>& table);
  double Interpolate(double position) const;
  double SumRing(int ring, double decay) const;
  void Fit(const Rings& rings, double extinction, double decay);
  void Smooth(const std::vector<double>& logarithms, const std::vector<double>& weights,
    double extinction);
  void LimitRise();

  std::vector<double> Controls; ///< of a uniform cubic spline over the logarithm of the radius
  double Error = 0.0;
  long long Photons = 0;
};
} // namespace LightTransport

#endif
