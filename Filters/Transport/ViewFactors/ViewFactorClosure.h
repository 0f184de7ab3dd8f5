// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes the rows of closed scenes sum to 1 without losing reciprocity: the symmetric change that is
 * smallest in least squares weighted with what is known of the errors (van Leersum, Int. J. Heat
 * Mass Transfer 32, 1989, weights with the view factors themselves), so that an entry moves in
 * proportion to its own error estimate; bounded, so that no entry becomes negative or larger than
 * with nothing between the two patches (plus the error bound of that number itself).
 *
 * What storage in single precision rounds away of a closed row (6e-8) goes to the diagonal in
 * double precision (vtkExchangeMatrix::SetRemainders): the sums are then exact to 1e-15, which
 * reflectances next to 1 need.
 */
#ifndef ViewFactorClosure_h
#define ViewFactorClosure_h

#include "ViewFactors/ViewFactorsResult.h"

class vtkMultiProcessController;

namespace LightTransport
{
namespace ViewFactorClosure
{
struct Report
{
  double Change = 0.0; ///< largest sum_j |change of F_ij| of a row
  double Gap = 0.0;    ///< largest |1 - row sum| that is left in a closed row
};

/**
 * Rows with closed[i] get the sum 1, as far as the bounds let them; other rows keep theirs.
 * `pairs` are the partly visible pairs of this rank's part of the matrix; all other entries are
 * taken to be right within `relativeError` of their value. Result.RowSums is brought up to date.
 * Collective. Returns false when the link operator fails (its error has been reported).
 */
bool Close(ViewFactorsResult& result, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<bool>& closed, double relativeError, vtkMultiProcessController* controller,
  Report& report);

/**
 * For links between clusters (Result.Hierarchy): scale the weights of the patches until the closed
 * rows sum to 1, and others to no more (symmetric scaling: Sinkhorn and Knopp 1967). RowSums
 * follow. Collective.
 */
bool Scale(ViewFactorsResult& result, const std::vector<bool>& closed,
  vtkMultiProcessController* controller, Report& report);
} // namespace ViewFactorClosure
} // namespace LightTransport

#endif
