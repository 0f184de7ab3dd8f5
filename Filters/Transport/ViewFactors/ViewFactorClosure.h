// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes each row sum to 1 with what it sees of the sky and of back faces, without losing
 * reciprocity: the symmetric change that is smallest in least squares weighted with what is known
 * of the errors (van Leersum, Int. J. Heat Mass Transfer 32, 1989, weights with the view factors
 * themselves), so that an entry moves in proportion to its own error estimate; bounded, so that no
 * entry becomes negative or larger than with nothing between the two patches (plus the error bound
 * of that number itself). What is open in a row is one more entry of it, with an error of its own;
 * sky and back faces keep their proportion.
 *
 * What storage in single precision rounds away of a row (6e-8) goes to its openings, or where it
 * has none to the diagonal in double precision (vtkExchangeMatrix::SetRemainders): the sums are
 * then exact to 1e-15, which reflectances next to 1 need.
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
  double Gap = 0.0;    ///< largest |1 - row sum - openings| that is left
};

/// Relative error of an entry by storing it in single precision.
constexpr double SinglePrecision = 6e-8;

/**
 * Close all rows as far as the bounds let them. `pairs` are the partly visible pairs of this rank's
 * part of the matrix, `openingErrors` those of what is open in each row; all other entries are
 * taken to be right within `relativeError` of their value. RowSums and the fractions of `links` are
 * brought up to date. Collective.
 */
Outcome Close(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<double>& openingErrors, double relativeError, const Ranks& ranks,
  Report& report);

/// How links of a hierarchy are scaled.
struct Scaling
{
  /// What rows are to sum to with their openings (empty: to 1). One whose target is 0 keeps its
  /// weight.
  std::vector<double> Targets;
  /// Openings are scaled by this power of the scale of their patch: less than 1 where they are
  /// better known than links.
  double OpenPower = 1.0;
  double Goal = 1e-12; ///< the gap that need not become smaller
};

/**
 * For links of a hierarchy: scale the weights of the patches until the rows are closed (symmetric
 * scaling: Sinkhorn and Knopp 1967, by Newton's method: Knight and Ruiz 2013). Where that cannot be
 * none is left with more than its target, but for what its openings are scaled less. RowSums and
 * fractions follow. Collective.
 */
Outcome Scale(Links& links, const Scaling& scaling, const Ranks& ranks, Report& report);

///@{
/// The same with the report among the summaries of links ("ClosureChange", "ClosureGap").
/// `tolerance` is that of the matrix's assembly.
Outcome CloseMatrix(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<double>& openingErrors, double tolerance, const Ranks& ranks);
Outcome ScaleHierarchy(Links& links, const Scaling& scaling, const Ranks& ranks);
///@}
} // namespace ViewFactorClosure
} // namespace LightTransport

#endif
