// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What links of scattering carry through the air between parts of a body (AirGaps), as far as they
/// were looked at.
#ifndef LinksThroughAir_h
#define LinksThroughAir_h

#include "Support/Ranks.h"

#include <vector>

namespace LightTransport
{
struct LinksThroughAir
{
  ///@{ Per patch and band: what its links through air carry for a unit of light on it, and the
  /// variance of that where it is an estimate.
  std::vector<double> Carried;
  std::vector<double> Variances;
  ///@}
  /// Of each band what one link of a sample stands for at most; 0 where all were looked at.
  std::vector<double> Samples;

  /// From what each rank has to what all have. Collective.
  void SumUp(const Ranks& ranks)
  {
    ranks.Sum(this->Carried);
    ranks.Sum(this->Variances);
  }
};
} // namespace LightTransport

#endif
