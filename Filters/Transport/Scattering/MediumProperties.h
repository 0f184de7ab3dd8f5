// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What users say of a translucent material, and what it is in each band.
#ifndef MediumProperties_h
#define MediumProperties_h

#include "Scattering/ScatteringMedium.h"
#include "Shared/Outcome.h"

#include <vector>

namespace LightTransport
{
struct MediumProperties
{
  static constexpr int Bands = 3;

  int Material;             ///< vtkTransportAlgorithm::MaterialType
  const double* Scattering; ///< of a custom material, as all up to RefractiveIndex
  const double* Absorption;
  double RefractiveIndex;
  const double* Anisotropy; ///< nullptr: nobody looks at more than the reduced coefficient
  double MillimetersPerUnit;

  /// Fails with what is out of range.
  Outcome MakeMedia(std::vector<ScatteringMedium>& media) const;
};
} // namespace LightTransport

#endif
