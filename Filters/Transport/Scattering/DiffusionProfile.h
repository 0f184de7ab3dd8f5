// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Diffuse reflectance of a semi-infinite translucent medium in one band: how much of the light that
 * enters at one point leaves per unit area at distance r. The classical dipole (H. W. Jensen et
 * al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001, with the correction of
 * the first term made in C. Donner and H. W. Jensen, 2005). Lengths in millimetres.
 */
#ifndef DiffusionProfile_h
#define DiffusionProfile_h

#include <vector>

namespace LightTransport
{
class DiffusionProfile
{
public:
  /**
   * Reduced scattering and absorption coefficients (per mm; not negative, not both zero) and the
   * refractive index relative to the outside (at least 1).
   */
  DiffusionProfile(double scattering, double absorption, double refractiveIndex);

  /// R_d(r), per mm^2.
  double Evaluate(double radius) const;

  /// Integral of R_d over the whole plane.
  double GetTotal() const { return this->Total; }

  /// Integral of R_d over the plane beyond a radius.
  double GetTail(double radius) const;

  /// moments[k] = integral from 0 to `radius` of R_d(r) r^(k + 1) dr, k = 0, 1, 2.
  void GetMoments(double radius, double moments[3]) const;

  ///@{ The quantities that the profile is made of.
  double GetAlbedo() const { return this->Albedo; }
  double GetDiffusionCoefficient() const { return this->DiffusionCoefficient; }
  /// Effective transport coefficient, 1 / diffusion length.
  double GetTransportCoefficient() const { return this->TransportCoefficient; }
  double GetRealDepth() const { return this->Depths[0]; }
  double GetVirtualDepth() const { return this->Depths[1]; }
  ///@}

private:
  void TabulateSecondMoment();
  double InterpolateSecondMoment(int source, double radius) const;

  double Albedo = 0.0;
  double DiffusionCoefficient = 0.0;
  double TransportCoefficient = 0.0;
  double Depths[2] = { 0.0, 0.0 };
  double Total = 0.0;

  /// Integral of exp(-sigma d) / d dr from 0 to r = depth sinh(t), at equally spaced t, for each
  /// source.
  std::vector<double> Table[2];
};
} // namespace LightTransport

#endif
