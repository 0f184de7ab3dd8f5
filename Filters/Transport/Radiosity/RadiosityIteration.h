// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What all iterative solvers of the radiosity equation share beside their vectors: the error bound
 * of the residual after each iteration, and when to stop.
 */
#ifndef RadiosityIteration_h
#define RadiosityIteration_h

#include "Radiosity/RadiositySolution.h"
#include "Radiosity/RadiosityVectors.h"

namespace LightTransport
{
struct ErrorBound;
struct SolverSettings;

class RadiosityIteration : public RadiosityVectors
{
public:
  RadiosityIteration(const RadiosityEquation& equation, const SolverSettings& settings,
    const ErrorBound& bound, vtkLinkOperator* links, const double* source);

  /**
   * To be asked with a RESIDUAL that belongs to SOLUTION: reports it with its error bound. False
   * when the iteration is over; Status then says how. With `isRecurrence` the residual was updated
   * along with the solution and not computed from it, so that it may have drifted.
   */
  bool Continue(bool isRecurrence = false);

  /// Whether the residual that Continue saw last was about what rounding allows.
  bool IsNearRounding() const { return this->NearRounding; }

  const SolverSettings& Settings;
  const ErrorBound& Bound;
  /// Largest |B| of the whole solution, where this iteration finds a correction of it.
  Bands Scales;
  int Count = 0;
  int LastReport = -1; ///< number of the iteration that was reported last
  SolverStatus Status = SolverStatus::IterationsUsedUp;

private:
  struct Look;
  bool Measure(bool isRecurrence, Look& look);

  Bands Largest; // |B| so far
  Bands First;   // residuals at the beginning
  Bands FirstBounds;
  Bands Smallest; // residuals so far
  int SinceSmallest = 0;
  bool NearRounding = false;
};
} // namespace LightTransport

#endif
