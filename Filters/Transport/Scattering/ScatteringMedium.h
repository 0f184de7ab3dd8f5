// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ScatteringMedium_h
#define ScatteringMedium_h

namespace LightTransport
{
/// What a translucent medium is in one band, for any model.
struct ScatteringMedium
{
  ///@{ Reduced scattering and absorption coefficient, per mm; not negative, not both zero.
  double Scattering;
  double Absorption;
  ///@}
  /// Relative to the outside, at least 1.
  double RefractiveIndex;
  /// Mean cosine of the angle of scattering, for models that look at more than the reduced one.
  double Anisotropy = 0.0;
};
} // namespace LightTransport

#endif
