// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// One call of UnoccludedPairs::Fill: goes down from the pair of two nodes until one choice of
/// rules serves all pairs of a block, or there are few enough of them to take one by one.
#ifndef BlockFiller_h
#define BlockFiller_h

#include "Scene/PatchScene.h"
#include "ViewFactors/NodeViews.h"
#include "ViewFactors/PairPlanner.h"
#include "ViewFactors/PatchRules.h"
#include "ViewFactors/RuleChoice.h"
#include "ViewFactors/UnoccludedPairs.h"

namespace LightTransport
{
class BlockFiller
{
public:
  /// Where results go, as UnoccludedPairs::Fill describes them.
  struct Output
  {
    vtkIdType FirstI; ///< patch of the first row
    vtkIdType FirstJ; ///< and of the first column
    float* Values;
    vtkIdType Stride;
    double* ErrorsI;
    double* ErrorsJ;
    UnoccludedPairs::Counters& Count;
  };

  BlockFiller(const PatchScene& scene, const NodeViews& views, const PatchRules& rules,
    const PairPlanner& pairs, const Output& output)
    : Scene(scene), Tree(scene.GetTree()), Views(views), Rules(rules), Pairs(pairs), Out(output)
  {
  }

  void Fill(int nodeI, int nodeJ);

private:
  using Estimate = PairIntegrals::Estimate;
  using Node = PatchTree::Node;
  using Plan = PairPlanner::Plan;
  using View = NodeViews::View;

  void Split(int nodeI, int nodeJ);
  RuleChoice::Rules ChooseRules(const Node& a, const Node& b, const View& view,
    double distance) const;
  bool FillByOneRule(const Node& a, const Node& b, const View& view);
  void AddErrors(const Node& a, const Node& b, double error);
  void FillRows(const Node& a, const Node& b, const RuleChoice::Rules& rules, bool clear,
    double error);
  void CorrectRow(vtkIdType i, int ruleI, vtkIdType first, int ruleJ, int size, double* sums,
    const double* margins, double error);
  void FillPairs(const Node& a, const Node& b, bool same);
  void AddPair(vtkIdType i, vtkIdType j, const Plan& plan, const Estimate& pair);

  const PatchScene& Scene;
  const PatchTree& Tree;
  const NodeViews& Views;
  const PatchRules& Rules;
  const PairPlanner& Pairs;
  const Output Out;
};
} // namespace LightTransport

#endif
