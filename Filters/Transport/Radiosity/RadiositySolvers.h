// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solves B = E + (rho / A) G B, all bands in lockstep, with any of the methods of
 * RadiosityMethods. A solution comes with its error bound (RadiosityBound), how it ended, and
 * messages that name problem, place and remedy.
 */
#ifndef RadiositySolvers_h
#define RadiositySolvers_h

#include "vtkType.h"

#include <functional>
#include <string>
#include <vector>

class vtkCPULinkOperator;
class vtkLinkOperator;

namespace LightTransport
{
enum class RadiosityStatus
{
  Converged,
  IterationsUsedUp,
  Stagnated, ///< rounding does not let the residual fall any further
  Diverged,  ///< the residual grows
  Aborted
};

struct RadiosityProblem
{
  vtkLinkOperator* Operator = nullptr;
  /// The same links on the CPU: what goes from patch to patch works on it, and residuals in double
  /// precision come from it.
  vtkCPULinkOperator* Reference = nullptr;
  int Solver = 0; ///< vtkRadiosity::SolverType
  vtkIdType NumberOfPatches = 0;
  int NumberOfBands = 0;
  const std::vector<double>* Areas = nullptr;
  const std::vector<double>* RowSums = nullptr; ///< of F
  double RowSumError = 0.0;                     ///< largest error of a row sum
  std::vector<double> Emission;    ///< patches x bands, the reflected direct light included
  std::vector<double> Reflectance; ///< patches x bands
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 1000;
  /// Called after every iteration with its number, the largest residual and the error bound;
  /// returns false to stop (abort).
  std::function<bool(int, double, double)> Report;
  /// The number that users know a patch by; empty: the same.
  std::function<vtkIdType(vtkIdType)> GetPolygon;
};

struct RadiositySolution
{
  bool HasConverged() const { return this->Status == RadiosityStatus::Converged; }

  std::vector<double> Radiosity; ///< patches x bands
  int NumberOfIterations = 0;
  double ErrorBound = 0.0; ///< largest over bands and patches
  RadiosityStatus Status = RadiosityStatus::Converged;
  int Solver = 0;          ///< vtkRadiosity::SolverType, never SOLVER_AUTO
  std::string Explanation; ///< which solver and why
  /// Not empty where there is a solution that users should doubt: why, and the remedy.
  std::string Warning;
  /// Not empty after an error: the problem and the remedy.
  std::string Error;
};

namespace RadiositySolvers
{
/**
 * Solve, look at the residual in double precision, and where it is not yet small enough (single
 * precision devices, the drift of a recurrence) solve again for the correction. Auto takes the
 * method that needs the fewest products with the links.
 */
RadiositySolution Solve(const RadiosityProblem& problem);

/// "Jacobi", "GaussSeidel", ...
const char* GetName(int solver);

/// "Converged", "IterationsUsedUp", ...
const char* GetName(RadiosityStatus status);

/// True for the solvers that go from patch to patch, which run on the CPU of one process.
bool IsSequential(int solver);
} // namespace RadiositySolvers
} // namespace LightTransport

#endif
