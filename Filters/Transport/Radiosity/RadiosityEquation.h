// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// B = E + (rho / A) G B in several bands: its links, its coefficients, and how well they are
/// known.
#ifndef RadiosityEquation_h
#define RadiosityEquation_h

#include "vtkType.h"

#include <functional>
#include <vector>

class vtkCPULinkOperator;
class vtkLinkOperator;

namespace LightTransport
{
struct RadiosityEquation
{
  /// Of each band, with `areas` of the patches: all that is emitted as if it were spread over the
  /// scene evenly, and went on until it is lost (Cohen et al. 1988); 0 where nothing is lost.
  std::vector<double> FindAmbientIrradiance(const std::vector<double>& areas) const;

  ///@{ Not there for a solver that needs no links.
  vtkLinkOperator* Operator = nullptr;
  /// The same links on the CPU: what goes from patch to patch works on it, and residuals in double
  /// precision come from it.
  vtkCPULinkOperator* Reference = nullptr;
  const std::vector<double>* Areas = nullptr;
  const std::vector<double>* RowSums = nullptr; ///< of F
  std::vector<double> RowSumErrors;
  ///@}
  vtkIdType NumberOfPatches = 0;
  int NumberOfBands = 0;
  std::vector<double> Emission;    ///< patches x bands, the reflected direct light included
  std::vector<double> Reflectance; ///< patches x bands
  /// The number that users know a patch by; empty: the same.
  std::function<vtkIdType(vtkIdType)> GetPolygon;
};
} // namespace LightTransport

#endif
