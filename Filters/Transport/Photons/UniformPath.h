// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a photon's path weighs in each of several bands, in a uniform medium. All bands share the
 * path: lengths are chosen by the extinction of one of them, the leader, which changes from photon
 * to photon; what a path is worth in a band is its density in that band over the mean of the
 * densities with which the leaders choose it (balance heuristic, E. Veach and L. Guibas, SIGGRAPH
 * 1995). Both depend on how often it was scattered and on its length alone. Never more than the
 * number of bands, so that a shared path is not noisier than a path for each.
 *
 * Absorption is weight that is lost; what weighs little survives by chance (Russian roulette).
 */
#ifndef UniformPath_h
#define UniformPath_h

#include "Photons/PhotonMedium.h"
#include "Photons/PhotonRandom.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LightTransport
{
/// The bands that share paths: all have the same anisotropy.
class UniformBands
{
public:
  explicit UniformBands(const std::vector<PhotonMedium>& media)
  {
    double albedo = 0.0;
    for (const PhotonMedium& medium : media)
    {
      const double extinction = medium.GetExtinction();
      this->Bands.push_back(
        { medium.Scattering, extinction, std::log(medium.Scattering), std::log(extinction) });
      albedo = std::max(albedo, medium.Scattering / extinction);
    }
    // Positive infinity where nothing is absorbed.
    const double scatterings = std::ceil(std::log(SmallPhotonWeight) / -std::abs(std::log(albedo)));
    this->RoulettePeriod =
      static_cast<int>(std::min(std::max(scatterings, 1.0), double(LongestPeriod)));
  }

  int GetNumber() const { return static_cast<int>(this->Bands.size()); }

private:
  friend class UniformPath;
  static constexpr int LongestPeriod = 1 << 20;

  struct Band
  {
    double Scattering;
    double Extinction;
    double LogScattering;
    double LogExtinction;
  };
  std::vector<Band> Bands;
  int RoulettePeriod; ///< scatterings after which a weight is small
};

class UniformPath
{
public:
  UniformPath(const UniformBands& bands, int leader)
    : Bands(bands), FreePath(1.0 / bands.Bands[leader].Extinction)
  {
  }

  /// How far to the next event.
  double ChooseStep(const Eigen::Vector3d&, const Eigen::Vector3d&, PhotonRandom& random) const
  {
    return random.GetExponential() * this->FreePath;
  }
  void Advance(double distance) { this->Length += distance; }

  /// What happens at the end of a step.
  PhotonEvent Meet(PhotonRandom& random)
  {
    ++this->Scatterings;
    const bool goesOn =
      this->Scatterings % this->Bands.RoulettePeriod != 0 || this->Survives(random);
    return goesOn ? PhotonEvent::SCATTERED : PhotonEvent::ENDED;
  }

  long long GetNumberOfEvents() const { return this->Scatterings; }
  long long GetNumberOfScatterings() const { return this->Scatterings; }

  void GetWeights(double* weights) const
  {
    const auto count = static_cast<double>(this->Scatterings);
    double largest = -std::numeric_limits<double>::infinity();
    const int bands = this->Bands.GetNumber();
    for (const UniformBands::Band& band : this->Bands.Bands)
    {
      largest = std::max(largest, count * band.LogExtinction - band.Extinction * this->Length);
    }
    double density = 0.0;
    for (const UniformBands::Band& band : this->Bands.Bands)
    {
      density += std::exp(count * band.LogExtinction - band.Extinction * this->Length - largest);
    }
    for (int k = 0; k < bands; ++k)
    {
      const UniformBands::Band& band = this->Bands.Bands[k];
      const double log = (this->Scatterings > 0 ? count * band.LogScattering : 0.0) -
        band.Extinction * this->Length - largest;
      weights[k] = this->Factor * bands * std::exp(log) / density;
    }
  }

private:
  bool Survives(PhotonRandom& random)
  {
    double weights[MostPhotonBands] = {};
    this->GetWeights(weights);
    const double weight = *std::max_element(weights, weights + this->Bands.GetNumber());
    if (weight >= 1.0)
    {
      return true;
    }
    this->Factor /= weight;
    return random.Get() < weight;
  }

  const UniformBands& Bands;
  double FreePath;
  double Length = 0.0;
  long long Scatterings = 0;
  double Factor = 1.0; ///< of a photon that has survived
};
} // namespace LightTransport

#endif
