// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Conjugate gradients (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 6.18) on
 * (I - s G s) y = s G E with s = sqrt(rho / A) and B = E + s y: symmetric without division by rho.
 * A residual r of that system is a residual s r of B = E + rho F B. All bands in lockstep.
 */
#ifndef ConjugateGradients_h
#define ConjugateGradients_h

#include <vector>

namespace LightTransport
{
class RadiosityVectors;

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
} // namespace LightTransport

#endif
