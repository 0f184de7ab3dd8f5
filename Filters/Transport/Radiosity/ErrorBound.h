// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The bound of the error of B by its residual r = E + rho F B - B: with any w > 0 for which d = (I
 * - rho F) w > 0, |error_i| <= w_i max_j |r_j| / d_j. w = 1 gives the row-sum bound; where that is
 * poor or infinite, w is an approximate solution for a right-hand side of ones. max_i (1 - d_i /
 * w_i) bounds the spectrum of rho F (Collatz and Wielandt). Where there is no such w the equation
 * has no unique solution, or none that can be had with these view factors: the message of the
 * failure says where.
 */
#ifndef ErrorBound_h
#define ErrorBound_h

#include "Shared/Outcome.h"

#include <string>
#include <vector>

namespace LightTransport
{
struct RadiosityEquation;

struct ErrorBound
{
  std::vector<double> Inverse; ///< 1 / d, patches x bands
  ///@{ one per band
  std::vector<double> LargestInverse;
  std::vector<double> LargestW;
  std::vector<double> SpectralRadii; ///< of rho F, from above
  ///@}
  /// Not empty where there is a solution that may be wrong: the problem, the place and the remedy.
  std::string Warning;

  static Outcome Find(const RadiosityEquation& equation, ErrorBound& bound);

  /// The bound from max_j |r_j| / d_j and what rounding may add to a residual.
  double Get(int band, double weightedResidual, double rounding) const
  {
    return (weightedResidual + rounding * this->LargestInverse[band]) * this->LargestW[band];
  }
};
} // namespace LightTransport

#endif
