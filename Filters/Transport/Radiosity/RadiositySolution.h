// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What a solver leaves: B, how good it is, and how the solver ended.
#ifndef RadiositySolution_h
#define RadiositySolution_h

#include <string>
#include <vector>

namespace LightTransport
{
enum class SolverStatus
{
  Converged,
  IterationsUsedUp,
  Stagnated, ///< rounding does not let the residual fall any further
  Diverged,  ///< the residual grows
  Aborted
};

/// "Converged", "IterationsUsedUp", ...
const char* GetName(SolverStatus status);

struct RadiositySolution
{
  bool HasConverged() const { return this->Status == SolverStatus::Converged; }

  std::vector<double> Radiosity;  ///< patches x bands
  std::vector<double> Irradiance; ///< likewise, what shots have brought; empty of other solvers
  int NumberOfIterations = 0;
  double ErrorBound = 0.0; ///< largest over bands and patches
  SolverStatus Status = SolverStatus::Converged;
  int Solver = 0;          ///< vtkRadiosity::SolverType, never SOLVER_AUTO
  std::string Explanation; ///< which solver and why
  /// Not empty where there is a solution that users should doubt: why, and the remedy.
  std::string Warning;
};
} // namespace LightTransport

#endif
