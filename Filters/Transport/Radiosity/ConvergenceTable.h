// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The history of a solver for users: columns "Iteration", "Seconds", "Residual", "ErrorBound", and
/// how far it is.
#ifndef ConvergenceTable_h
#define ConvergenceTable_h

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkSmartPointer.h"

class vtkTable;

namespace LightTransport
{
class ConvergenceTable
{
public:
  /// Clears `table`. Seconds are counted from `begin` (vtkTimerLog::GetUniversalTime) on.
  ConvergenceTable(vtkTable* table, double begin);

  /// A row for an iteration. Returns which fraction of the way to `tolerance` has been made by the
  /// logarithm of the residual, which falls steadily.
  double Add(int iteration, double residual, double errorBound, double tolerance);

private:
  vtkSmartPointer<vtkIntArray> Iterations;
  vtkSmartPointer<vtkDoubleArray> Seconds;
  vtkSmartPointer<vtkDoubleArray> Residuals;
  vtkSmartPointer<vtkDoubleArray> ErrorBounds;
  double Begin;
  double FirstResidual = 0.0;
};
} // namespace LightTransport

#endif
