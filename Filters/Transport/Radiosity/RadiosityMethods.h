// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The iterative methods for B = E + (rho / A) G B.
 *
 * Sources: Jacobi (B' = B + E - K B, K = I - rho F) and Gauss-Seidel as in Carr, Hall and Hart
 * (2003); Southwell: progressive refinement, Cohen et al. (1988), with the overshooting of Feda and
 * Purgathofer (1992); Chebyshev: Saad, Iterative Methods for Sparse Linear Systems (2003),
 * algorithm 12.1; conjugate gradients: ibid., algorithm 6.18.
 */
#ifndef RadiosityMethods_h
#define RadiosityMethods_h

#include <vector>

namespace LightTransport
{
class RadiosityIteration;
class RadiosityVectors;

namespace RadiosityMethods
{
/// Run a method (vtkRadiosity::SolverType, not SOLVER_AUTO) until Continue of the iteration says
/// that it is over.
void Iterate(int solver, RadiosityIteration& state);

/**
 * Products with the links that a method needs about until errors have fallen by `tolerance`, where
 * `radius` bounds the spectrum of rho F.
 */
double EstimateProducts(int solver, double radius, double tolerance);

/// Conjugate gradients on (I - s G s) y = s G E with s = sqrt(rho / A) and B = E + s y: symmetric
/// without division by rho. A residual r of that system is a residual s r of B = E + rho F B.
class ConjugateGradients
{
public:
  explicit ConjugateGradients(RadiosityVectors& vectors);

  bool Begin();
  bool Step();

  ///@{
  /// True when a direction was met along which rho F returns all or more; Step then takes none. The
  /// direction in terms of B, 0 in other bands.
  bool IsIndefinite() const;
  bool GetIndefiniteDirection(double* direction);
  ///@}

private:
  bool ComputeSteps(std::vector<double>& steps);
  bool Translate();

  RadiosityVectors& Vectors;
  std::vector<double> Squares;
  std::vector<double> Indefinite; // 1 in bands that are, else 0
};
} // namespace RadiosityMethods
} // namespace LightTransport

#endif
