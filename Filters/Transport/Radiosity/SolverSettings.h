// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How the radiosity equation is to be solved, and how far.
#ifndef SolverSettings_h
#define SolverSettings_h

#include <functional>

namespace LightTransport
{
struct SolverSettings
{
  int Solver = 0; ///< vtkRadiosity::SolverType
  /// Of the largest B of a band: where the error bound is below this fraction of it, it is done.
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 1000;
  /// Called after every iteration with its number, the largest residual and the error bound;
  /// returns false to stop (abort).
  std::function<bool(int, double, double)> Report;
};
} // namespace LightTransport

#endif
