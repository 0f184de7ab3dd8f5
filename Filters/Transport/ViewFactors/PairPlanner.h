// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One pair of patches with nothing between them: how its exchange is to be computed, and computing
 * it so. Far pairs take the points of both patches as they are; where the plane of one patch passes
 * through the other the positive parts of cosines are no smooth functions, and rules are made on
 * what is in front; near pairs take contour integrals (PairIntegrals).
 */
#ifndef PairPlanner_h
#define PairPlanner_h

#include "Geometry/Polygon.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/PairIntegrals.h"
#include "ViewFactors/PatchRules.h"
#include "ViewFactors/RuleChoice.h"

#include <algorithm>
#include <vector>

namespace LightTransport
{
class PairPlanner
{
public:
  using Estimate = PairIntegrals::Estimate;

  struct Plan
  {
    enum
    {
      None,    ///< certainly nothing
      Rules,   ///< by the points of both patches
      Clipped, ///< by rules on what is in front of the other's plane
      Contours
    } Method = None;
    int RuleI = -1;
    int RuleJ = -1;
    double Error = 0.0;
  };

  /// `tolerance`: of the sum of the absolute errors of the view factors of a row. Scene and rules
  /// must outlive this.
  PairPlanner(const PatchScene& scene, const PatchRules& rules, double tolerance);

  Plan MakePlan(vtkIdType i, vtkIdType j) const;
  Estimate Follow(vtkIdType i, vtkIdType j, const Plan& plan) const;

  /// What the rules of a pair, or of a block of them, may be off: see RuleChoice::Choose.
  double GetRuleTolerance() const { return this->RuleTolerance; }
  /// How much the two have in front of each other's plane.
  enum class Sight
  {
    None, ///< one of them nothing
    Part, ///< the plane of one passes through the other
    Whole
  };
  Sight Look(vtkIdType i, vtkIdType j) const;
  /// The exchange of what each patch has in front of the plane of the other.
  double IntegrateClipped(vtkIdType i, int ruleI, vtkIdType j, int ruleJ) const;
  /// No more leaves or arrives than there is.
  double Limit(vtkIdType i, vtkIdType j, double value) const
  {
    const std::vector<double>& areas = this->Scene.GetAreas();
    return std::max(0.0, std::min(value, std::min(areas[i], areas[j])));
  }

private:
  double GetDoubt(const RuleChoice::Pair& pair, vtkIdType i, vtkIdType j) const;
  Estimate IntegrateNear(vtkIdType i, vtkIdType j) const;

  const PatchScene& Scene;
  const PatchRules& Rules;
  const double RuleTolerance;
  const double ContourTolerance; ///< of the smaller patch's view factor
};
} // namespace LightTransport

#endif
