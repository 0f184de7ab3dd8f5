// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How wrong a solution with sampled links is: the equation solved for what each group of rays
/// would change of the irradiance.
#ifndef SampledErrors_h
#define SampledErrors_h

#include "Radiosity/RadiosityEquation.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <vector>

class vtkCPULinkOperator;

namespace LightTransport
{
class RayErrors;

struct SampledErrors
{
  ///@{ One standard error each, patches x bands.
  std::vector<double> Radiosity;
  std::vector<double> Irradiance;
  std::vector<double> NetFlux;
  ///@}
  /// Of the worst band sqrt(sum A dB^2 / sum A (B - E)^2), or of H where nothing reflects.
  double Whole = 0.0;

  /// Bytes that each rank takes to find them.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, int bands);

  /// For a solution of `equation`, whose links `links` has for as many bands as all groups have
  /// together; `background` is what RayErrors wants. Collective.
  Outcome Find(const RayErrors& rays, const RadiosityEquation& equation, vtkCPULinkOperator* links,
    const std::vector<double>& radiosity, const std::vector<double>& irradiance,
    const std::vector<double>& background, const Monitor& monitor);

private:
  void SumUp(const RadiosityEquation& equation, const std::vector<double>& irradiance);
};
} // namespace LightTransport

#endif
