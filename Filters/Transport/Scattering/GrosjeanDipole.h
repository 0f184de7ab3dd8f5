// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a source of light below the surface of a flat, semi-infinite medium sends out of it:
 * diffusion theory of C. C. Grosjean for light that was scattered at least twice, the boundary and
 * the exitance (fluence and flux together) with the exact moments of Fresnel reflection. E. d'Eon,
 * G. Irving, "A Quantized-Diffusion Model for Rendering Translucent Materials", SIGGRAPH 2011; E.
 * d'Eon, "A Better Dipole", 2012. Lengths in millimetres.
 */
#ifndef GrosjeanDipole_h
#define GrosjeanDipole_h

#include "Scattering/ScatteringMedium.h"

namespace LightTransport
{
class GrosjeanDipole
{
public:
  explicit GrosjeanDipole(const ScatteringMedium& medium);

  /// Per mm^2, at a distance from the point over a source at a depth, for a unit of light that
  /// enters and reaches the source with no loss but the albedo.
  double Evaluate(double radius, double depth) const;

  /// Integral over the whole plane.
  double GetTotal(double depth) const;

private:
  double Albedo;
  double DiffusionCoefficient;
  double TransportCoefficient;
  /// Depth of the virtual source: less the real one's, half of that.
  double BoundaryDepth;
  double FluenceShare;
  double FluxShare;
};
} // namespace LightTransport

#endif
