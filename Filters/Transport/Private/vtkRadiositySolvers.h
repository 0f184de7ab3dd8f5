// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solvers for B = E + (rho / A) G B, all bands in lockstep, written against vtkLinkOperator: those
 * that only multiply and combine vectors run on any device without moving a vector per iteration.
 *
 * Sources: Jacobi and Gauss-Seidel as in Carr, Hall and Hart (2003); Southwell: progressive
 * refinement, Cohen et al. (1988); Chebyshev: Saad, Iterative Methods for Sparse Linear Systems
 * (2003), algorithm 12.1; conjugate gradients: ibid., algorithm 6.18.
 */
#ifndef vtkRadiositySolvers_h
#define vtkRadiositySolvers_h

#include "vtkType.h"

#include <functional>
#include <string>
#include <vector>

class vtkCPULinkOperator;
class vtkLinkOperator;

struct vtkRadiosityProblem
{
  vtkLinkOperator* Operator = nullptr;
  /// The same links on the CPU: what goes from patch to patch works on it, and residuals in double
  /// precision come from it.
  vtkCPULinkOperator* Reference = nullptr;
  int Solver = 0; ///< vtkRadiosity::SolverType, not SOLVER_AUTO
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
};

struct vtkRadiositySolution
{
  std::vector<double> Radiosity; ///< patches x bands
  int NumberOfIterations = 0;
  double ErrorBound = 0.0; ///< largest over bands and patches
  bool Converged = false;
  bool Aborted = false;
  /// Not empty after an error: the problem and the remedy.
  std::string Error;
};

namespace vtkRadiositySolvers
{
vtkRadiositySolution Solve(const vtkRadiosityProblem& problem);

/// "Jacobi", "GaussSeidel", ...
const char* GetName(int solver);

/// True for the solvers that go from patch to patch, which run on the CPU of one process.
bool IsSequential(int solver);
} // namespace vtkRadiositySolvers

#endif
