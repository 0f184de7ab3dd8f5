// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The vectors of B = E + (rho / A) G B in the slots of a link operator. What is written against
 * them runs wherever the links are.
 */
#ifndef RadiosityVectors_h
#define RadiosityVectors_h

#include <vector>

class vtkLinkOperator;

namespace LightTransport
{
struct RadiosityEquation;

class RadiosityVectors
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

  /// Writes the coefficients of the equation with `source` for its right-hand side; B = `source` at
  /// first.
  RadiosityVectors(const RadiosityEquation& equation, vtkLinkOperator* links, const double* source);

  /// RESIDUAL from SOLUTION.
  bool ComputeResidual();

  /// What rounding may add to a residual where values are as large as `size`, on an operator.
  static double GetRounding(bool isSinglePrecision, double size, int steps);

  const RadiosityEquation& Equation;
  vtkLinkOperator* Links;
  const Bands Ones, MinusOnes, Zeros;
  bool Ok = true; ///< false after an error of the link operator
};
} // namespace LightTransport

#endif
