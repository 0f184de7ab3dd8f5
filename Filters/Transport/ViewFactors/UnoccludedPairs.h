// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The exchange between the patches of two nodes of a scene's tree with nothing between them, a
 * block at a time (BlockFiller): what cannot face each other (NodeViews) costs nothing, far blocks
 * take one product of Gauss rules for all their pairs in vector instructions (PatchRules), near
 * pairs go one by one (PairPlanner). The rules of each block are the cheapest whose error bounds
 * keep the tolerance (RuleChoice).
 */
#ifndef UnoccludedPairs_h
#define UnoccludedPairs_h

#include "Scene/PatchScene.h"
#include "ViewFactors/NodeViews.h"
#include "ViewFactors/PairIntegrals.h"
#include "ViewFactors/PairPlanner.h"
#include "ViewFactors/PatchRules.h"

namespace LightTransport
{
class UnoccludedPairs
{
public:
  /// Pairs, each counted once. Examined = BackFacing + Facing.
  struct Counters
  {
    double Examined = 0.0;
    double BackFacing = 0.0; ///< of which no exchange: back to front, or in one plane
    double Facing = 0.0;
    double Rules = 0.0;    ///< facing pairs by Gauss rules
    double Contours = 0.0; ///< facing pairs by contour integrals
  };

  /// `tolerance`: of the sum of the absolute errors of the view factors of a row. The scene must
  /// outlive this.
  UnoccludedPairs(const PatchScene& scene, double tolerance);
  UnoccludedPairs(const UnoccludedPairs&) = delete;
  void operator=(const UnoccludedPairs&) = delete;

  /// Whether any patch of one node may face any of the other; false is certain.
  bool MayFace(int nodeI, int nodeJ) const;

  /// A bound of the kernel cos cos / (pi r^2) between the points of two nodes; infinite where they
  /// may touch, 0 where they certainly do not face each other.
  double GetKernelBound(int nodeI, int nodeJ) const;

  /**
   * The exchange of all pairs of two nodes of at most PatchTree::BlockSize patches:
   * values[(i - first of I) * stride + (j - first of J)], in scene units (lengths where the scene's
   * diagonal is 1). Where the nodes are the same only pairs i < j are written. `values` must be
   * zero before. Bounds of the errors are added to errorsI[i - first of I] and errorsJ[j - first of
   * J]. May be called from several threads.
   */
  void Fill(int nodeI, int nodeJ, float* values, vtkIdType stride, double* errorsI, double* errorsJ,
    Counters& counters) const;

  /// The exchange of one pair in double precision.
  PairIntegrals::Estimate Compute(vtkIdType i, vtkIdType j) const;

private:
  const PatchScene& Scene;
  const NodeViews Views;
  const PatchRules Rules;
  const PairPlanner Pairs; ///< by these rules
};
} // namespace LightTransport

#endif
