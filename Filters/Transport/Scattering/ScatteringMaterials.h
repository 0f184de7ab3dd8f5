// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Measured translucent materials: H. W. Jensen et al., "A Practical Model for Subsurface Light
 * Transport", SIGGRAPH 2001, table 1; the refractive indices are from the same place.
 */
#ifndef ScatteringMaterials_h
#define ScatteringMaterials_h

namespace LightTransport
{
/// Coefficients of red, green and blue, per mm; scattering is the reduced one.
struct ScatteringMaterial
{
  const char* Name;
  double Scattering[3];
  double Absorption[3];
  double RefractiveIndex;
};

namespace ScatteringMaterials
{
/// By the number in vtkTransportAlgorithm::MaterialType, 1 to 12. nullptr for all others, also
/// for 0, a custom material.
const ScatteringMaterial* Find(int number);
} // namespace ScatteringMaterials
} // namespace LightTransport

#endif
