// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the patches of a scene are made of, and what enters through its openings: the coefficients
 * of B = E + rho H for every patch and band, and temperatures.
 */
#ifndef RadiosityMaterials_h
#define RadiosityMaterials_h

#include "Radiosity/MaterialArrays.h"

#include <string>
#include <vector>

namespace LightTransport
{
struct RadiosityMaterials
{
  MaterialSettings Settings; ///< to be set before Read

  int NumberOfBands = 0;
  ///@{ patches x bands
  std::vector<double> Emission;
  std::vector<double> Reflectance;
  std::vector<double> DirectIrradiance;
  ///@}
  std::vector<double> Background; ///< irradiance of a patch that sees nothing else, of each band

  std::vector<std::string> Warnings; ///< what users should know of the arrays, a line each

  ///@{ One per patch; empty in a scene without temperatures.
  std::vector<double> Temperature; ///< as given
  std::vector<double> Emissivity;  ///< of the first band
  std::vector<bool> HasGivenFlux;  ///< else the temperature is given
  ///@}

  /// Fill in all of the above; see MaterialArrays.
  Outcome Read(const CellArrays& source, const PatchScene& scene,
    const std::vector<std::string>& names);

  /// The patches that send anything, one way or the other.
  std::vector<bool> FindSenders() const;

  /// Add what enters through openings to the direct irradiance, for the sky fraction of each patch.
  void AddBackground(const std::vector<double>& skyFractions);

  bool IsThermal() const { return !this->Temperature.empty(); }
  bool HasGivenFluxes() const;
  /**
   * The temperature of each face of a thermal scene whose patches receive this irradiance (for
   * their mean): the given one, or where the net flux is given the one at which it emits that flux
   * and what it absorbs. Where there is none, since more is taken out than it absorbs (`impossible`
   * counts those where that exceeds `tolerance`), and for faces without patches, 0. One of
   * emissivity 0 (and net flux 0) gets the limit for small emissivities.
   */
  std::vector<double> ComputeTemperatures(const PatchScene& scene,
    const std::vector<double>& irradiance, double tolerance, vtkIdType& impossible) const;

  /**
   * What a patch is made of, as far as points are not averaged across a change of it: 2 values per
   * patch and band. That a patch emits, or that its net flux is given, is part of it, how much is
   * not: temperatures, emissions and fluxes may vary from patch to patch.
   */
  std::vector<double> GetPointMaterials() const;
};
} // namespace LightTransport

#endif
