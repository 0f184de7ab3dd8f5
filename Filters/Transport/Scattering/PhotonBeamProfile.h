// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Photon beam diffusion: sources (GrosjeanDipole) along the whole refracted beam rather than at one
 * depth, less of them where diffusion theory claims too much close to a source, and exact single
 * scattering. R. Habel, P. H. Christensen, W. Jarosz, "Photon Beam Diffusion: A Hybrid Monte Carlo
 * Method for Subsurface Scattering", EGSR 2013, for light that enters along the normal:
 *
 *   integral over z of sigma_t' exp(-sigma_t' z) (1 - exp(-2 sigma_t' (d + z))) E(r, z), d^2 = r^2
 * + z^2
 */
#ifndef PhotonBeamProfile_h
#define PhotonBeamProfile_h

#include "Scattering/GrosjeanDipole.h"
#include "Scattering/IntegratedProfile.h"
#include "Scattering/SingleScattering.h"

#include <vector>

namespace LightTransport
{
class PhotonBeamProfile : public IntegratedProfile
{
public:
  explicit PhotonBeamProfile(const ScatteringMedium& medium);

  double Evaluate(double radius) const override;
  bool IsSingular() const override { return true; }

private:
  struct Source
  {
    double Depth;
    double Weight;
  };

  double Extinction;
  GrosjeanDipole Dipole;
  SingleScattering Single;
  std::vector<Source> Sources;
};
} // namespace LightTransport

#endif
