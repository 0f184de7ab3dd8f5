// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How wrong a radiosity is by its links, checked by other means: what some patches receive of it,
 * by rays of their own and the exact exchange with the patches that rays know least of, beside what
 * the links gave them. Patches are chosen by their light, so that it is the error for the light as
 * it is, of a small lamp as of an even one. What rays themselves are off by is taken out.
 *
 * It is the first bounce of the error: what is wrong with the irradiance, reflected once.
 */
#ifndef LinkCheck_h
#define LinkCheck_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;

class LinkCheck
{
public:
  /// A solution: patches x bands, and the irradiance of a patch that sees nothing but the
  /// background, of each band (empty: there is none).
  struct Solution
  {
    int NumberOfBands;
    const std::vector<double>& Radiosity;
    const std::vector<double>& Reflectance;
    const std::vector<double>& Irradiance; ///< all of it
    const std::vector<double>& Received;   ///< by links and through openings
    const std::vector<double>& Background;
  };

  LinkCheck(const PatchScene& scene, const Solution& solution) : Scene(scene), Solved(solution) {}

  /// Of the worst band sqrt(sum A dB^2 / sum A (B - E)^2), or of H where nothing reflects.
  /// Collective.
  Outcome Find(const Ranks& ranks, const Monitor& monitor, double& error) const;

private:
  struct Sample
  {
    vtkIdType Patch;
    double Weight; ///< how much of the surface it stands for
  };
  struct Checker;

  double GetWeight(std::size_t k, bool isReflected) const;
  std::vector<double> SumLight(bool isReflected) const;
  std::vector<double> FindLight(const std::vector<double>& sums, bool isReflected) const;
  std::vector<Sample> ChooseSamples(const std::vector<double>& light) const;
  std::vector<vtkIdType> ChooseBright() const;
  double SumUp(const std::vector<Sample>& samples, const std::vector<double>& squares,
    const std::vector<double>& sums, bool isReflected) const;

  const PatchScene& Scene;
  const Solution Solved;
};
} // namespace LightTransport

#endif
