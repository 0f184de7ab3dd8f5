// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PairPlanner.h"

#include "ViewFactors/QuadratureRules.h"
#include "ViewFactors/RuleChoice.h"

#include "vtkMath.h"

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

// The shares of the tolerance, a bound on the error of a whole row: a rule's error on each side is
// relative to area / (pi distance^2), which sums to a few over a row; contours are few per row (a
// patch has a few dozen near ones).
constexpr double RuleShare = 1.0 / 32.0;
constexpr double ContourShare = 0.01;
} // namespace

//------------------------------------------------------------------------------
PairPlanner::PairPlanner(const PatchScene& scene, const PatchRules& rules, double tolerance)
  : Scene(scene), Rules(rules), RuleTolerance(RuleShare * tolerance),
    ContourTolerance(ContourShare * tolerance)
{
}

//------------------------------------------------------------------------------
PairPlanner::Plan PairPlanner::MakePlan(vtkIdType i, vtkIdType j) const
{
  Plan plan;
  const RuleChoice::Pair pair = RuleChoice::MakePair(this->Scene, i, j,
    this->Rules.AreTriangles(i, i + 1), this->Rules.AreTriangles(j, j + 1));
  if (!pair.Facing)
  {
    return plan;
  }
  const Sight sight = pair.Margin > this->GetDoubt(pair, i, j) ? Sight::Whole : this->Look(i, j);
  if (sight == Sight::None)
  {
    return plan;
  }
  const RuleChoice::Rules rules = RuleChoice::Choose(pair.SideI, pair.SideJ, this->RuleTolerance);
  if (!rules.AreFound())
  {
    plan.Method = Plan::Contours;
    return plan;
  }
  const bool large =
    this->Rules.HasLargePolygons(i, i + 1) || this->Rules.HasLargePolygons(j, j + 1);
  const bool crossing = sight == Sight::Part;
  const double factor = crossing ? RuleChoice::ClippedFactor : 1.0;
  const std::vector<double>& areas = this->Scene.GetAreas();
  plan.Method = large || crossing ? Plan::Clipped : Plan::Rules;
  plan.RuleI = rules.I;
  plan.RuleJ = rules.J;
  plan.Error = factor * (areas[i] * areas[j] / vtkMath::Pi()) * rules.Error;
  return plan;
}

//------------------------------------------------------------------------------
// Lowest points higher than this are certainly in front.
double PairPlanner::GetDoubt(const RuleChoice::Pair& pair, vtkIdType i, vtkIdType j) const
{
  const double furthest =
    pair.SideI.Distance + pair.SideJ.Radius + std::max(pair.SideI.Radius, pair.SideJ.Radius);
  return std::max(this->Scene.GetPlane(i).GetTolerance(furthest),
    this->Scene.GetPlane(j).GetTolerance(furthest));
}

//------------------------------------------------------------------------------
PairPlanner::Estimate PairPlanner::Follow(vtkIdType i, vtkIdType j, const Plan& plan) const
{
  Estimate pair{ 0.0, plan.Error };
  switch (plan.Method)
  {
    case Plan::None:
      break;
    case Plan::Rules:
      this->Rules.IntegrateRow(i, plan.RuleI, j, 1, plan.RuleJ, &pair.Value, nullptr);
      break;
    case Plan::Clipped:
      pair.Value = this->IntegrateClipped(i, plan.RuleI, j, plan.RuleJ);
      break;
    case Plan::Contours:
      pair = this->IntegrateNear(i, j);
      break;
  }
  pair.Value = this->Limit(i, j, pair.Value);
  return pair;
}

//------------------------------------------------------------------------------
PairPlanner::Sight PairPlanner::Look(vtkIdType i, vtkIdType j) const
{
  const auto look = [this](vtkIdType over, vtkIdType of)
  {
    const PatchPlane plane = this->Scene.GetPlane(over);
    bool front = false;
    bool behind = false;
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(of); ++corner)
    {
      const double height = plane.GetCertainHeight(this->Scene.GetCorner(of, corner));
      front = front || height > 0.0;
      behind = behind || height < 0.0;
    }
    return front ? (behind ? Sight::Part : Sight::Whole) : Sight::None;
  };
  const Sight first = look(i, j);
  return first == Sight::None ? first : std::min(first, look(j, i));
}

//------------------------------------------------------------------------------
double PairPlanner::IntegrateClipped(vtkIdType i, int ruleI, vtkIdType j, int ruleJ) const
{
  Polygon a, b;
  if (!Polygon::SetToClippedPair(this->Scene, i, j, a, b))
  {
    return 0.0;
  }
  constexpr int Most = QuadratureRules::MaximumPoints;
  Vector pointsA[Most], pointsB[Most];
  double weightsA[Most], weightsB[Most];
  QuadratureRules::Make(a, ruleI, pointsA, weightsA);
  QuadratureRules::Make(b, ruleJ, pointsB, weightsB);
  const int countA = QuadratureRules::GetNumberOfPoints(ruleI) * (a.Count - 2);
  const int countB = QuadratureRules::GetNumberOfPoints(ruleJ) * (b.Count - 2);
  return PairIntegrals::IntegrateRules({ countA, pointsA, weightsA }, a.Normal,
    { countB, pointsB, weightsB }, b.Normal);
}

//------------------------------------------------------------------------------
PairPlanner::Estimate PairPlanner::IntegrateNear(vtkIdType i, vtkIdType j) const
{
  Polygon a, b;
  if (!Polygon::SetToClippedPair(this->Scene, i, j, a, b))
  {
    return {};
  }
  const double smaller = std::min(this->Scene.GetAreas()[i], this->Scene.GetAreas()[j]);
  return PairIntegrals::Integrate(a, b, this->ContourTolerance * smaller);
}
} // namespace LightTransport
