// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What all iterative solvers of B = E + (rho / A) G B share: the vectors in their slots, the
 * residual and its error bound after each iteration, and when to stop. Written against
 * vtkLinkOperator, so that it runs wherever the links are.
 */
#ifndef RadiosityIteration_h
#define RadiosityIteration_h

#include "Radiosity/RadiositySolvers.h"

#include <vector>

namespace LightTransport
{
struct RadiosityBound;

class RadiosityIteration
{
public:
  enum Slot
  {
    SOURCE,       // E
    REFLECTION,   // rho / A
    SYMMETRIC,    // sqrt(rho / A)
    BOUND_WEIGHT, // 1 / d
    SOLUTION,     // B
    RESIDUAL,     // E + rho F B - B
    UNKNOWN,      // y of the symmetrised system
    DIRECTION,
    IMAGE,
    GRADIENT,
    SCRATCH
  };
  using Bands = std::vector<double>;

  /// Writes the vectors of the problem with `source` for its right-hand side; B = `source` at
  /// first. Without a bound Continue must not be called.
  RadiosityIteration(const RadiosityProblem& problem, vtkLinkOperator* links, const double* source,
    const RadiosityBound* bound = nullptr);

  /// RESIDUAL from SOLUTION.
  bool ComputeResidual();

  /**
   * To be asked with a RESIDUAL that belongs to SOLUTION: reports it with its error bound. False
   * when the iteration is over; Status then says how. With `isRecurrence` the residual was updated
   * along with the solution and not computed from it, so that it may have drifted.
   */
  bool Continue(bool isRecurrence = false);

  /// Whether the residual that Continue saw last was about what rounding allows.
  bool IsNearRounding() const { return this->NearRounding; }

  /// What rounding may add to a residual where values are as large as `size`, on an operator.
  static double GetRounding(bool isSinglePrecision, double size, int steps);

  const RadiosityProblem& Problem;
  vtkLinkOperator* Links;
  const RadiosityBound* Bound;
  const Bands Ones, MinusOnes, Zeros;
  /// Largest |B| of the whole solution, where this iteration finds a correction of it.
  Bands Scales;
  int Count = 0;
  int LastReport = -1; ///< number of the iteration that was reported last
  bool Ok = true;      ///< false after an error of the link operator
  RadiosityStatus Status = RadiosityStatus::IterationsUsedUp;

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
