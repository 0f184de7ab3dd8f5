// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/BlockFiller.h"

#include "Scene/PatchTree.h"
#include "ViewFactors/QuadratureKernels.h"

#include "vtkMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace LightTransport
{
namespace
{
// Nodes of at most this many patches are not cut further: their pairs choose their own rules.
constexpr vtkIdType RowSize = QuadratureKernels::Lanes;
// Nodes of at most this many patches take one rule even where their far pairs could do with less.
constexpr vtkIdType UniformSize = 32;
} // namespace

//------------------------------------------------------------------------------
void BlockFiller::Fill(int nodeI, int nodeJ)
{
  const Node& a = this->Tree.GetNode(nodeI);
  const Node& b = this->Tree.GetNode(nodeJ);
  const double pairs = nodeI == nodeJ ? 0.5 * a.GetSize() * (a.GetSize() - 1.0)
                                      : static_cast<double>(a.GetSize()) * b.GetSize();
  const View view = this->Views.Get(nodeI, nodeJ);
  if (!view.MayFace())
  {
    this->Out.Count.Examined += pairs;
    this->Out.Count.BackFacing += pairs;
    return;
  }
  if (nodeI != nodeJ && this->FillByOneRule(a, b, view))
  {
    this->Out.Count.Examined += pairs;
  }
  else if (a.GetSize() <= RowSize && b.GetSize() <= RowSize)
  {
    this->FillPairs(a, b, nodeI == nodeJ);
  }
  else
  {
    this->Split(nodeI, nodeJ);
  }
}

//------------------------------------------------------------------------------
void BlockFiller::Split(int nodeI, int nodeJ)
{
  const Node& a = this->Tree.GetNode(nodeI);
  const Node& b = this->Tree.GetNode(nodeJ);
  if (nodeI == nodeJ)
  {
    this->Fill(a.Left, a.Left);
    this->Fill(a.Left, a.Left + 1);
    this->Fill(a.Left + 1, a.Left + 1);
  }
  else if (b.GetSize() <= RowSize ||
    (a.GetSize() > RowSize &&
      (a.Upper - a.Lower).squaredNorm() > (b.Upper - b.Lower).squaredNorm()))
  {
    this->Fill(a.Left, nodeJ);
    this->Fill(a.Left + 1, nodeJ);
  }
  else
  {
    this->Fill(nodeI, b.Left);
    this->Fill(nodeI, b.Left + 1);
  }
}

//------------------------------------------------------------------------------
// Rules that serve all pairs whose centroids are `distance` apart, or more.
RuleChoice::Rules BlockFiller::ChooseRules(const Node& a, const Node& b, const View& view,
  double distance) const
{
  const double distanceI = distance - b.Radius;
  const double distanceJ = distance - a.Radius;
  const RuleChoice::Side sideI = { a.Radius, distanceI, view.HighestOfJ,
    view.HighestOfI + view.Sine * distanceI, this->Rules.AreTriangles(a.First, a.Last) };
  const RuleChoice::Side sideJ = { b.Radius, distanceJ, view.HighestOfI,
    view.HighestOfJ + view.Sine * distanceJ, this->Rules.AreTriangles(b.First, b.Last) };
  return RuleChoice::Choose(sideI, sideJ, this->Pairs.GetRuleTolerance());
}

//------------------------------------------------------------------------------
bool BlockFiller::FillByOneRule(const Node& a, const Node& b, const View& view)
{
  if (this->Rules.HasLargePolygons(a.First, a.Last) ||
    this->Rules.HasLargePolygons(b.First, b.Last))
  {
    return false;
  }
  const RuleChoice::Rules rules = this->ChooseRules(a, b, view, view.Nearest);
  if (!rules.AreFound())
  {
    return false;
  }
  if (std::max(a.GetSize(), b.GetSize()) > UniformSize)
  {
    const RuleChoice::Rules far = this->ChooseRules(a, b, view, view.Furthest);
    if (far.I < rules.I || far.J < rules.J)
    {
      return false;
    }
  }
  const double error = rules.Error / vtkMath::Pi();
  this->AddErrors(a, b, error);
  this->FillRows(a, b, rules, view.NoHorizonCrosses(), error);
  return true;
}

//------------------------------------------------------------------------------
// `error` is that of a pair, relative to area * area.
void BlockFiller::AddErrors(const Node& a, const Node& b, double error)
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  for (vtkIdType i = a.First; i < a.Last; ++i)
  {
    this->Out.ErrorsI[i - this->Out.FirstI] += error * areas[i] * b.Area;
  }
  for (vtkIdType j = b.First; j < b.Last; ++j)
  {
    this->Out.ErrorsJ[j - this->Out.FirstJ] += error * areas[j] * a.Area;
  }
}

//------------------------------------------------------------------------------
void BlockFiller::FillRows(const Node& a, const Node& b, const RuleChoice::Rules& rules, bool clear,
  double error)
{
  double sums[PatchTree::BlockSize];
  double margins[PatchTree::BlockSize];
  const int size = static_cast<int>(b.GetSize());
  double facing = 0.0;
  for (vtkIdType i = a.First; i < a.Last; ++i)
  {
    this->Rules.IntegrateRow(i, rules.I, b.First, size, rules.J, sums, clear ? nullptr : margins);
    if (!clear)
    {
      this->CorrectRow(i, rules.I, b.First, rules.J, size, sums, margins, error);
    }
    float* row =
      this->Out.Values + (i - this->Out.FirstI) * this->Out.Stride + (b.First - this->Out.FirstJ);
    int count = 0;
    for (int column = 0; column < size; ++column)
    {
      row[column] = static_cast<float>(sums[column]);
      count += sums[column] > 0.0 ? 1 : 0;
    }
    facing += count;
  }
  this->Out.Count.Facing += facing;
  this->Out.Count.Rules += facing;
  this->Out.Count.BackFacing += static_cast<double>(a.GetSize()) * size - facing;
}

//------------------------------------------------------------------------------
// Where a horizon crosses, the positive parts of cosines are no smooth functions: clip.
void BlockFiller::CorrectRow(vtkIdType i, int ruleI, vtkIdType first, int ruleJ, int size,
  double* sums, const double* margins, double error)
{
  for (int column = 0; column < size; ++column)
  {
    const vtkIdType j = first + column;
    const auto sight =
      std::abs(margins[column]) < 1.0 ? this->Pairs.Look(i, j) : PairPlanner::Sight::Whole;
    if (sight == PairPlanner::Sight::None)
    {
      sums[column] = 0.0;
    }
    else if (sight == PairPlanner::Sight::Part)
    {
      sums[column] = this->Pairs.IntegrateClipped(i, ruleI, j, ruleJ);
      const std::vector<double>& areas = this->Scene.GetAreas();
      const double more = (RuleChoice::ClippedFactor - 1.0) * error * areas[i] * areas[j];
      this->Out.ErrorsI[i - this->Out.FirstI] += more;
      this->Out.ErrorsJ[j - this->Out.FirstJ] += more;
    }
  }
}

//------------------------------------------------------------------------------
// Each pair by rules of its own, or by contours; a row of them at once where rules do.
void BlockFiller::FillPairs(const Node& a, const Node& b, bool same)
{
  std::array<Plan, RowSize> plans;
  std::array<double, RowSize> sums;
  for (vtkIdType i = a.First; i < a.Last; ++i)
  {
    const vtkIdType first = same ? i + 1 : b.First;
    const int size = static_cast<int>(b.Last - first);
    int ruleI = -1;
    int ruleJ = -1;
    for (int column = 0; column < size; ++column)
    {
      Plan& plan = plans[column];
      plan = this->Pairs.MakePlan(i, first + column);
      if (plan.Method == Plan::Rules)
      {
        ruleI = std::max(ruleI, plan.RuleI);
        ruleJ = std::max(ruleJ, plan.RuleJ);
      }
    }
    if (ruleI >= 0)
    {
      this->Rules.IntegrateRow(i, ruleI, first, size, ruleJ, sums.data(), nullptr);
    }
    for (int column = 0; column < size; ++column)
    {
      const Plan& plan = plans[column];
      const vtkIdType j = first + column;
      this->AddPair(i, j, plan,
        plan.Method == Plan::Rules ? Estimate{ sums[column], plan.Error }
                                   : this->Pairs.Follow(i, j, plan));
    }
  }
}

//------------------------------------------------------------------------------
void BlockFiller::AddPair(vtkIdType i, vtkIdType j, const Plan& plan, const Estimate& pair)
{
  this->Out.Count.Examined += 1.0;
  if (!(pair.Value > 0.0))
  {
    this->Out.Count.BackFacing += 1.0;
    return;
  }
  this->Out.Count.Facing += 1.0;
  (plan.Method == Plan::Contours ? this->Out.Count.Contours : this->Out.Count.Rules) += 1.0;
  this->Out.ErrorsI[i - this->Out.FirstI] += pair.Error;
  this->Out.ErrorsJ[j - this->Out.FirstJ] += pair.Error;
  this->Out.Values[(i - this->Out.FirstI) * this->Out.Stride + (j - this->Out.FirstJ)] =
    static_cast<float>(this->Pairs.Limit(i, j, pair.Value));
}
} // namespace LightTransport
