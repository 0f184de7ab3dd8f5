// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The classical dipole: a source one mean free path below the surface, and a negative one above it,
 * so placed that the fluence vanishes a little outside, as reflection at the surface asks for. H.
 * W. Jensen et al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001, with the
 * correction of the first term made in C. Donner and H. W. Jensen, 2005.
 */
#ifndef DipoleProfile_h
#define DipoleProfile_h

#include "Scattering/PointSource.h"
#include "Scattering/ScatteringMedium.h"
#include "Scattering/ScatteringProfile.h"

#include <vector>

namespace LightTransport
{
class DipoleProfile : public ScatteringProfile
{
public:
  explicit DipoleProfile(const ScatteringMedium& medium);

  double Evaluate(double radius) const override;
  double GetTail(double radius) const override;
  void GetMoments(double radius, double moments[3]) const override;
  double GetSmallestScale() const override { return this->GetRealDepth(); }
  double GetDecay() const override { return this->TransportCoefficient; }

  ///@{ The quantities that the profile is made of.
  double GetAlbedo() const { return this->Albedo; }
  double GetDiffusionCoefficient() const { return this->DiffusionCoefficient; }
  /// Effective transport coefficient, 1 / diffusion length.
  double GetTransportCoefficient() const { return this->TransportCoefficient; }
  double GetRealDepth() const { return this->Sources[0].GetDepth(); }
  double GetVirtualDepth() const { return this->Sources[1].GetDepth(); }
  ///@}

private:
  double Albedo;
  double DiffusionCoefficient;
  double TransportCoefficient;
  /// The real one, and the image by its height above the surface.
  std::vector<PointSource> Sources;
};
} // namespace LightTransport

#endif
