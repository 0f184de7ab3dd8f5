// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How wrong a solution is by its links and its solver: the equation solved for what each
/// alternative of the links would change of the irradiance, and for what is known to be missing.
#ifndef SolutionErrors_h
#define SolutionErrors_h

#include "Radiosity/RadiosityEquation.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <vector>

class vtkCPULinkOperator;

namespace LightTransport
{
class LinkDoubts;

struct SolutionErrors
{
  ///@{ One standard error each, patches x bands.
  std::vector<double> Radiosity;
  std::vector<double> Irradiance;
  std::vector<double> NetFlux;
  ///@}
  /// Of the worst band sqrt(sum A dB^2 / sum A (B - E)^2), or of H where nothing reflects; negative
  /// where it has not been looked for.
  double Whole = -1.0;

  /// Vectors of the equation that is solved for them, of each band.
  static int GetNumberOfVectors();

  /// Bytes that each rank takes to find them.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, int bands);

  /// For a solution of `equation`, whose links `links` has for as many bands as there are vectors;
  /// `background` is what LinkDoubts wants, `change` what the last product changed the radiosity
  /// by, of which the irradiance knows nothing. Collective.
  Outcome Find(const LinkDoubts& doubts, const RadiosityEquation& equation,
    vtkCPULinkOperator* links, const std::vector<double>& radiosity,
    const std::vector<double>& irradiance, const std::vector<double>& change,
    const std::vector<double>& background, const Monitor& monitor);

private:
  static Outcome Spread(const RadiosityEquation& equation, vtkCPULinkOperator* links,
    std::vector<double>& differences, std::vector<double>& changes, const Monitor& monitor);
  void SumUp(const RadiosityEquation& equation, const std::vector<double>& irradiance);
};
} // namespace LightTransport

#endif
