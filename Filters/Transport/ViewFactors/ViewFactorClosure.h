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

#include "Shared/Outcome.h"
#include "ViewFactors/PartlyVisiblePair.h"

#include <vector>

namespace LightTransport
{
class Ranks;
struct Links;

namespace ViewFactorClosure
{
struct Report
{
  double Change = 0.0; ///< largest sum_j |change of F_ij| of a row
  double Gap = 0.0;    ///< largest |1 - row sum| that is left in a closed row
};

/// Relative error of an entry by storing it in single precision.
constexpr double SinglePrecision = 6e-8;

/**
 * Rows with closed[i] get the sum 1, as far as the bounds let them; other rows keep theirs. `pairs`
 * are the partly visible pairs of this rank's part of the matrix; all other entries are taken to be
 * right within `relativeError` of their value. RowSums are brought up to date. Collective.
 */
Outcome Close(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<bool>& closed, double relativeError, const Ranks& ranks, Report& report);

/**
 * For links between clusters: scale the weights of the patches until the closed rows sum to 1, and
 * others to no more (symmetric scaling: Sinkhorn and Knopp 1967). RowSums follow. Collective.
 */
Outcome Scale(Links& links, const std::vector<bool>& closed, const Ranks& ranks, Report& report);

///@{
/// The same for the rows of links that see no opening, with the report among their summaries
/// ("ClosureChange", "ClosureGap"). `tolerance` is that of the matrix's assembly.
Outcome CloseMatrix(Links& links, const std::vector<PartlyVisiblePair>& pairs, double tolerance,
  const Ranks& ranks);
Outcome ScaleHierarchy(Links& links, const Ranks& ranks);
///@}
} // namespace ViewFactorClosure
} // namespace LightTransport

#endif
