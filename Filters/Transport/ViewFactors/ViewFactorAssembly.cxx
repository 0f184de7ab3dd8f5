// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorAssembly.h"

#include "Scene/PatchTree.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/RowBudget.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// Weights and errors are counted in whole numbers of these parts.
constexpr double WeightUnits = 65536.0;
constexpr double BudgetUnits = 1099511627776.0;

/// Of the pairs of a row, in these parts: those that are exact enough, and the others.
enum Share
{
  ERRORS,
  SQUARED_ERRORS,
  WEIGHTS,
  SQUARED_WEIGHTS,
  NUMBER_OF_SHARES
};
} // namespace

//------------------------------------------------------------------------------
void ViewFactorAssembly::Counters::Add(const Counters& other)
{
  this->Open.Examined += other.Open.Examined;
  this->Open.BackFacing += other.Open.BackFacing;
  this->Open.Facing += other.Open.Facing;
  this->Open.Rules += other.Open.Rules;
  this->Open.Contours += other.Open.Contours;
  this->NotSending += other.NotSending;
  this->Free += other.Free;
  this->Hidden += other.Hidden;
  this->PartlyVisible += other.PartlyVisible;
  this->Rastered += other.Rastered;
}

//------------------------------------------------------------------------------
struct ViewFactorAssembly::UnitResult
{
  double ErrorsI[UnitSize] = {};
  double ErrorsJ[UnitSize] = {};
  VerdictErrors VerdictsI[UnitSize];
  VerdictErrors VerdictsJ[UnitSize];
  std::vector<PartlyVisiblePair> Pairs;
  Counters Count;
};

//------------------------------------------------------------------------------
// Stage 1 for units [First, First + Results.size()).
struct ViewFactorAssembly::Looker
{
  const ViewFactorAssembly& Outer;
  vtkExchangeMatrix* Exchange;
  vtkIdType First;
  std::vector<UnitResult> Results;
  Threads::Local<ShaftCuller::SideCache> Sides;

  // One unit at work: what all steps of the descent share.
  struct Work
  {
    const PatchTree& Tree;
    vtkIdType FirstI, FirstJ;
    float* Values; ///< of the pair (FirstI, FirstJ)
    UnitResult& Result;
    ShaftCuller::SideCache& Sides;
    std::vector<ShaftCuller::Candidates> Lists;
    std::vector<ShaftCuller::Occluder> Between;
    PairVisibility Visibility;
    vtkIdType HidingWall; ///< the latest one that hid two nodes from each other

    float& GetValue(vtkIdType i, vtkIdType j) const
    {
      return this->Values[(i - this->FirstI) * vtkExchangeMatrix::TileSize + (j - this->FirstJ)];
    }
    // A list of the descent; a reference stays good only until the next call.
    ShaftCuller::Candidates& GetList(std::size_t depth)
    {
      if (this->Lists.size() <= depth)
      {
        this->Lists.resize(depth + 1);
      }
      return this->Lists[depth];
    }
  };

  void operator()(vtkIdType begin, vtkIdType end)
  {
    constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
    const PatchTree& tree = this->Outer.Scene.GetTree();
    for (vtkIdType index = begin; index < end; ++index)
    {
      const Unit& unit = this->Outer.Units[index];
      vtkExchangeMatrix::Tile& tile = this->Exchange->GetTiles()[unit.Tile];
      const vtkIdType firstI = tree.GetNode(unit.I).First;
      const vtkIdType firstJ = tree.GetNode(unit.J).First;
      Work work{ tree, firstI, firstJ,
        tile.Values + (firstI - tile.Row * N) * N + (firstJ - tile.Column * N),
        this->Results[index - this->First], this->Sides.Get(), {}, {}, {}, -1 };
      this->Fill(unit.I, unit.J, work);
      if (this->Outer.Culler.HasOccluders() && MayExchange(unit.I, unit.J, work))
      {
        this->Outer.Culler.Find(unit.I, unit.J, work.GetList(0));
        this->Descend(unit.I, unit.J, 0, work);
      }
      else
      {
        work.Result.Count.Free += work.Result.Count.Open.Facing;
      }
      if (tile.Row == tile.Column)
      {
        this->Mirror(unit, tile, work);
      }
    }
  }

  // The exchange with nothing in between, where at least one of two patches sends.
  void Fill(int nodeI, int nodeJ, Work& work)
  {
    const PatchTree::Node& i = work.Tree.GetNode(nodeI);
    const PatchTree::Node& j = work.Tree.GetNode(nodeJ);
    const vtkIdType pairs =
      nodeI == nodeJ ? i.GetSize() * (i.GetSize() - 1) / 2 : i.GetSize() * j.GetSize();
    const vtkIdType sendersI = this->Outer.NodeSenders[nodeI];
    const vtkIdType sendersJ = this->Outer.NodeSenders[nodeJ];
    if (sendersI == 0 && sendersJ == 0)
    {
      work.Result.Count.NotSending += pairs;
      return;
    }
    if (i.IsLeaf() && j.IsLeaf() && sendersI < i.GetSize() && sendersJ < j.GetSize())
    {
      this->FillSendingPairs(nodeI, nodeJ, work);
      return;
    }
    if (sendersI == i.GetSize() || sendersJ == j.GetSize())
    {
      this->Outer.Open.Fill(nodeI, nodeJ, &work.GetValue(i.First, j.First),
        vtkExchangeMatrix::TileSize, work.Result.ErrorsI + (i.First - work.FirstI),
        work.Result.ErrorsJ + (j.First - work.FirstJ), work.Result.Count.Open);
      return;
    }
    VisitChildren(nodeI, nodeJ, work.Tree,
      [&](int childI, int childJ) { this->Fill(childI, childJ, work); });
  }

  void FillSendingPairs(int nodeI, int nodeJ, Work& work) const
  {
    const PatchTree::Node& i = work.Tree.GetNode(nodeI);
    const PatchTree::Node& j = work.Tree.GetNode(nodeJ);
    const std::vector<bool>& senders = *this->Outer.Senders;
    Counters& count = work.Result.Count;
    for (vtkIdType row = i.First; row < i.Last; ++row)
    {
      for (vtkIdType column = nodeI == nodeJ ? row + 1 : j.First; column < j.Last; ++column)
      {
        if (!senders[row] && !senders[column])
        {
          ++count.NotSending;
          continue;
        }
        const PairIntegrals::Estimate pair = this->Outer.Open.Compute(row, column);
        ++count.Open.Examined;
        ++(pair.Value > 0.0 ? count.Open.Facing : count.Open.BackFacing);
        work.GetValue(row, column) = static_cast<float>(pair.Value);
        work.Result.ErrorsI[row - work.FirstI] += pair.Error;
        work.Result.ErrorsJ[column - work.FirstJ] += pair.Error;
      }
    }
  }

  // Calls visit for the pairs of nodes below a pair of nodes.
  template <typename Visit>
  static void VisitChildren(int nodeI, int nodeJ, const PatchTree& tree, const Visit& visit)
  {
    const PatchTree::Node& i = tree.GetNode(nodeI);
    const PatchTree::Node& j = tree.GetNode(nodeJ);
    if (nodeI == nodeJ)
    {
      visit(i.Left, i.Left);
      visit(i.Left, i.Left + 1);
      visit(i.Left + 1, i.Left + 1);
    }
    else if (j.IsLeaf())
    {
      visit(i.Left, nodeJ);
      visit(i.Left + 1, nodeJ);
    }
    else if (i.IsLeaf())
    {
      visit(nodeI, j.Left);
      visit(nodeI, j.Left + 1);
    }
    else
    {
      visit(i.Left, j.Left);
      visit(i.Left, j.Left + 1);
      visit(i.Left + 1, j.Left);
      visit(i.Left + 1, j.Left + 1);
    }
  }

  // List `depth` holds what reaches into the shaft between the two nodes.
  void Descend(int nodeI, int nodeJ, std::size_t depth, Work& work)
  {
    Pulse::Beat();
    if (this->Outer.NodeSenders[nodeI] == 0 && this->Outer.NodeSenders[nodeJ] == 0)
    {
      return;
    }
    const PatchTree::Node& i = work.Tree.GetNode(nodeI);
    const PatchTree::Node& j = work.Tree.GetNode(nodeJ);
    if (work.GetList(depth).IsEmpty())
    {
      work.Result.Count.Free += this->CountFacing(nodeI, nodeJ, work);
      return;
    }
    const vtkIdType wall =
      this->Outer.Culler.FindHiding(nodeI, nodeJ, work.GetList(depth), work.HidingWall);
    if (wall >= 0)
    {
      work.HidingWall = wall;
      work.Result.Count.Hidden += this->CountFacing(nodeI, nodeJ, work);
      this->Hide(nodeI, nodeJ, work);
      return;
    }
    this->Outer.Culler.KeepParting(nodeI, nodeJ, work.Sides, work.GetList(depth));
    if (work.GetList(depth).IsEmpty())
    {
      work.Result.Count.Free += this->CountFacing(nodeI, nodeJ, work);
      return;
    }
    if (this->Outer.Rays && work.GetList(depth).HasSides && this->Judge(nodeI, nodeJ, work))
    {
      return;
    }
    if (i.IsLeaf() && j.IsLeaf())
    {
      VisitPairs(nodeI, nodeJ, work.Tree,
        [&](vtkIdType row, vtkIdType column) { this->LookAtPair(row, column, depth, work); });
      return;
    }
    VisitChildren(nodeI, nodeJ, work.Tree,
      [&](int childI, int childJ)
      {
        if (!MayExchange(childI, childJ, work))
        {
          return;
        }
        work.GetList(depth + 1);
        this->Outer.Culler.Narrow(childI, childJ, work.GetList(depth), work.GetList(depth + 1));
        this->Descend(childI, childJ, depth + 1, work);
      });
  }

  // Whether rays tell that all pairs are hidden, or free: then they are done with.
  bool Judge(int nodeI, int nodeJ, Work& work) const
  {
    const BlockRays& rays = *this->Outer.Rays;
    const vtkIdType firstI = work.Tree.GetNode(nodeI).First;
    const vtkIdType firstJ = work.Tree.GetNode(nodeJ).First;
    const BlockRays::Verdict verdict =
      rays.Ask(nodeI, nodeJ, &work.GetValue(firstI, firstJ), vtkExchangeMatrix::TileSize);
    if (verdict == BlockRays::Verdict::Unknown)
    {
      return false;
    }
    VisitPairs(nodeI, nodeJ, work.Tree,
      [&](vtkIdType i, vtkIdType j)
      {
        const double error = rays.GetError() * static_cast<double>(work.GetValue(i, j));
        work.Result.VerdictsI[i - work.FirstI].Add(error);
        work.Result.VerdictsJ[j - work.FirstJ].Add(error);
      });
    if (verdict == BlockRays::Verdict::Hidden)
    {
      work.Result.Count.Hidden += this->CountFacing(nodeI, nodeJ, work);
      this->Hide(nodeI, nodeJ, work);
    }
    return true;
  }

  // Whether any pair faces each other. On a curved body few nodes do: what is between the others
  // needs no search.
  static bool MayExchange(int nodeI, int nodeJ, const Work& work)
  {
    const PatchTree::Node& i = work.Tree.GetNode(nodeI);
    const PatchTree::Node& j = work.Tree.GetNode(nodeJ);
    for (vtkIdType row = i.First; row < i.Last; ++row)
    {
      const float* const values = &work.GetValue(row, j.First);
      if (std::any_of(values, values + j.GetSize(), [](float value) { return value > 0.0f; }))
      {
        return true;
      }
    }
    return false;
  }

  double CountFacing(int nodeI, int nodeJ, const Work& work) const
  {
    double count = 0.0;
    VisitPairs(nodeI, nodeJ, work.Tree,
      [&](vtkIdType i, vtkIdType j) { count += work.GetValue(i, j) > 0.0f ? 1.0 : 0.0; });
    return count;
  }

  void Hide(int nodeI, int nodeJ, Work& work) const
  {
    VisitPairs(nodeI, nodeJ, work.Tree,
      [&](vtkIdType i, vtkIdType j) { work.GetValue(i, j) = 0.0f; });
  }

  // Calls visit for the pairs of patches of two nodes.
  template <typename Visit>
  static void VisitPairs(int nodeI, int nodeJ, const PatchTree& tree, const Visit& visit)
  {
    const PatchTree::Node& i = tree.GetNode(nodeI);
    const PatchTree::Node& j = tree.GetNode(nodeJ);
    for (vtkIdType row = i.First; row < i.Last; ++row)
    {
      for (vtkIdType column = nodeI == nodeJ ? row + 1 : j.First; column < j.Last; ++column)
      {
        visit(row, column);
      }
    }
  }

  void LookAtPair(vtkIdType i, vtkIdType j, std::size_t depth, Work& work)
  {
    float& value = work.GetValue(i, j);
    if (value <= 0.0f)
    {
      return;
    }
    Counters& count = work.Result.Count;
    std::vector<ShaftCuller::Occluder>& between = work.Between;
    this->Outer.Culler.NarrowBetween(i, j, work.GetList(depth), between);
    if (between.empty() ||
      !work.Visibility.SetPair(this->Outer.Scene, i, j, this->Outer.Culler.GetWalls(), between,
        PairVisibility::GetKey(i, j), value))
    {
      ++count.Free;
      return;
    }
    count.Rastered += work.Visibility.IsWalledOff() ? 0.0 : 1.0;
    const PairVisibility::Share share = work.Visibility.Look();
    if (share.Error > 0.0)
    {
      ++count.PartlyVisible;
      work.Result.Pairs.push_back(
        { i, j, value, share.Value * value, share.Error * static_cast<double>(value) });
    }
    else
    {
      count.Hidden += share.Value > 0.0 ? 0.0 : 1.0;
    }
    value *= static_cast<float>(share.Value);
  }

  // Diagonal tiles hold both triangles.
  void Mirror(const Unit& unit, const vtkExchangeMatrix::Tile& tile, const Work& work) const
  {
    constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
    const PatchTree::Node& i = work.Tree.GetNode(unit.I);
    const PatchTree::Node& j = work.Tree.GetNode(unit.J);
    for (vtkIdType row = i.First; row < i.Last; ++row)
    {
      for (vtkIdType column = unit.I == unit.J ? row + 1 : j.First; column < j.Last; ++column)
      {
        tile.Values[(column - tile.Column * N) * N + row - tile.Row * N] =
          work.GetValue(row, column);
      }
    }
  }
};

//------------------------------------------------------------------------------
// Stage 2.
struct ViewFactorAssembly::Refiner
{
  ViewFactorAssembly& Outer;
  vtkExchangeMatrix* Exchange;

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
    PairVisibility visibility;
    std::vector<ShaftCuller::Occluder> between;
    for (vtkIdType index = begin; index < end; ++index)
    {
      Pulse::Beat();
      PartlyVisiblePair& pair = this->Outer.Pairs[index];
      const double allowed = this->Outer.GetAllowedError(pair);
      if (pair.Error <= allowed)
      {
        continue;
      }
      this->Outer.Culler.FindBetween(pair.I, pair.J, between);
      if (visibility.SetPair(this->Outer.Scene, pair.I, pair.J, this->Outer.Culler.GetWalls(),
            between, PairVisibility::GetKey(pair.I, pair.J), pair.Open))
      {
        const PairVisibility::Share share =
          visibility.Integrate(allowed / pair.Open, pair.Value / pair.Open);
        pair.Value = share.Value * pair.Open;
        pair.Error = share.Error * pair.Open;
      }
      const vtkIdType tile = this->Exchange->GetTileIndex(pair.I / N, pair.J / N);
      vtkExchangeMatrix::SetValue(
        this->Exchange->GetTiles()[tile / this->Exchange->GetNumberOfParts()],
        static_cast<int>(pair.I % N), static_cast<int>(pair.J % N), 0, pair.Value);
    }
  }
};

//------------------------------------------------------------------------------
ViewFactorAssembly::ViewFactorAssembly(const PatchScene& scene, double tolerance,
  const std::vector<bool>* senders)
  : Scene(scene), Tolerance(tolerance), Senders(senders), Open(scene, OpenShare * tolerance),
    Culler(scene), RowErrors(scene.GetNumberOfPatches(), 0.0), Verdicts(scene.GetNumberOfPatches())
{
  this->CountSenders();
  // Of a few bright patches, which are asked for to be exact, nothing is left to rays.
  if (this->Culler.HasOccluders() && this->NodeSenders[0] == scene.GetNumberOfPatches())
  {
    this->Rays = std::make_unique<BlockRays>(scene, tolerance);
  }
}

//------------------------------------------------------------------------------
void ViewFactorAssembly::CountSenders()
{
  const auto& nodes = this->Scene.GetTree().GetNodes();
  this->NodeSenders.resize(nodes.size());
  std::transform(nodes.begin(), nodes.end(), this->NodeSenders.begin(),
    [this](const PatchTree::Node& node)
    {
      return this->Senders ? static_cast<vtkIdType>(std::count(this->Senders->begin() + node.First,
                               this->Senders->begin() + node.Last, true))
                           : node.GetSize();
    });
}

//------------------------------------------------------------------------------
// The nodes of a block with at most UnitSize patches.
std::vector<int> ViewFactorAssembly::GetQuarters(vtkIdType block) const
{
  const PatchTree& tree = this->Scene.GetTree();
  std::vector<int> quarters;
  std::vector<int> open(1, tree.GetBlock(block));
  while (!open.empty())
  {
    const int node = open.back();
    open.pop_back();
    if (tree.GetNode(node).GetSize() <= UnitSize)
    {
      quarters.push_back(node);
      continue;
    }
    open.push_back(tree.GetNode(node).Left + 1);
    open.push_back(tree.GetNode(node).Left);
  }
  return quarters;
}

//------------------------------------------------------------------------------
vtkIdType ViewFactorAssembly::Plan(const vtkExchangeMatrix& structure)
{
  const auto& tiles = structure.GetTiles();
  this->Units.clear();
  this->TilesWithPairs.assign(tiles.size(), false);
  vtkIdType count = 0;
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
  {
    Pulse::Beat();
    const std::size_t before = this->Units.size();
    this->AddUnits(static_cast<vtkIdType>(tile), tiles[tile]);
    count += this->Units.size() > before ? 1 : 0;
  }
  return count;
}

//------------------------------------------------------------------------------
void ViewFactorAssembly::AddUnits(vtkIdType tileIndex, const vtkExchangeMatrix::Tile& tile)
{
  const auto& nodes = this->Scene.GetTree().GetNodes();
  const std::vector<int> columns = this->GetQuarters(tile.Column);
  for (const int i : this->GetQuarters(tile.Row))
  {
    for (const int j : columns)
    {
      if (nodes[j].First < nodes[i].First)
      {
        continue;
      }
      const double pairs =
        static_cast<double>(i == j ? nodes[i].GetSize() * (nodes[i].GetSize() - 1) / 2
                                   : nodes[i].GetSize() * nodes[j].GetSize());
      if (this->NodeSenders[i] == 0 && this->NodeSenders[j] == 0)
      {
        this->Total.NotSending += pairs;
      }
      else if (this->Open.MayFace(i, j))
      {
        this->Units.push_back({ tileIndex, i, j });
      }
      else
      {
        this->Total.Open.Examined += pairs;
        this->Total.Open.BackFacing += pairs;
      }
    }
  }
}

//------------------------------------------------------------------------------
bool ViewFactorAssembly::Look(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end)
{
  for (vtkIdType unit = begin; unit < end; ++unit)
  {
    if (!exchange->AllocateTile(exchange->GetTiles()[this->Units[unit].Tile]))
    {
      return false;
    }
  }
  Looker looker{ *this, exchange, begin, std::vector<UnitResult>(end - begin), {} };
  Threads::For(begin, end, 1, looker);
  // In the order of the units: sums then do not depend on the threads.
  for (vtkIdType unit = begin; unit < end; ++unit)
  {
    this->Collect(this->Units[unit], looker.Results[unit - begin]);
  }
  this->ReleaseTiles(exchange, begin, end);
  return true;
}

//------------------------------------------------------------------------------
void ViewFactorAssembly::Collect(const Unit& unit, const UnitResult& result)
{
  this->Total.Add(result.Count);
  const auto& nodes = this->Scene.GetTree().GetNodes();
  for (vtkIdType k = 0; k < nodes[unit.I].GetSize(); ++k)
  {
    this->RowErrors[nodes[unit.I].First + k] += result.ErrorsI[k];
    this->Verdicts[nodes[unit.I].First + k].Add(result.VerdictsI[k]);
  }
  for (vtkIdType k = 0; k < nodes[unit.J].GetSize(); ++k)
  {
    this->RowErrors[nodes[unit.J].First + k] += result.ErrorsJ[k];
    this->Verdicts[nodes[unit.J].First + k].Add(result.VerdictsJ[k]);
  }
  this->Pairs.insert(this->Pairs.end(), result.Pairs.begin(), result.Pairs.end());
  if (!result.Pairs.empty())
  {
    this->TilesWithPairs[unit.Tile] = true;
  }
}

//------------------------------------------------------------------------------
// Tiles whose last unit is among these and that have come out as zero.
void ViewFactorAssembly::ReleaseTiles(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end)
{
  constexpr int values = vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize;
  for (vtkIdType unit = begin; unit < end; ++unit)
  {
    const vtkIdType index = this->Units[unit].Tile;
    const bool isLast = unit + 1 == this->GetNumberOfUnits() || this->Units[unit + 1].Tile != index;
    vtkExchangeMatrix::Tile& tile = exchange->GetTiles()[index];
    if (isLast && !this->TilesWithPairs[index] &&
      std::all_of(tile.Values, tile.Values + values, [](float value) { return value == 0.0f; }))
    {
      exchange->ReleaseTile(tile);
    }
  }
}

//------------------------------------------------------------------------------
// The error of a pair by the square root of its exchange: about what makes the sum of all errors
// smallest for the same work, since errors fall a little slower than the number of points grows.
double ViewFactorAssembly::GetWeight(const PartlyVisiblePair& pair, vtkIdType row) const
{
  return std::ceil(WeightUnits * std::sqrt(pair.Open / this->Scene.GetAreas()[row]));
}

//------------------------------------------------------------------------------
// What partly visible pairs may put a row off by.
double ViewFactorAssembly::GetBudget(vtkIdType row) const
{
  return VisibilityShare * this->Tolerance * this->Scene.GetAreas()[row];
}

//------------------------------------------------------------------------------
double ViewFactorAssembly::GetAllowedError(const PartlyVisiblePair& pair) const
{
  return std::min(this->GetWeight(pair, pair.I) * this->Allowances[pair.I],
    this->GetWeight(pair, pair.J) * this->Allowances[pair.J]);
}

//------------------------------------------------------------------------------
// Each row divides what its tolerance allows among its pairs by their weights. Pairs that need less
// leave the rest to the others: a second and a third division.
void ViewFactorAssembly::PrepareRefinement(const Ranks& ranks)
{
  constexpr int divisions = 3;
  const std::size_t rows = this->RowErrors.size();
  this->Allowances.assign(rows, 0.0);
  for (int division = 0; division < divisions; ++division)
  {
    // Sums of whole numbers, which do not depend on the order: all ranks decide the same.
    std::vector<double> sums(NUMBER_OF_SHARES * rows, 0.0);
    for (std::size_t row = 0; row < rows; ++row)
    {
      const double budget = this->GetBudget(static_cast<vtkIdType>(row));
      const VerdictErrors& verdicts = this->Verdicts[row];
      sums[NUMBER_OF_SHARES * row + ERRORS] = std::ceil(BudgetUnits * verdicts.Sum / budget);
      sums[NUMBER_OF_SHARES * row + SQUARED_ERRORS] =
        std::ceil(BudgetUnits * verdicts.Squares / (budget * budget));
    }
    std::size_t step = 0;
    const auto add = [&](const PartlyVisiblePair& pair, bool isSettled, vtkIdType row)
    {
      double* own = &sums[NUMBER_OF_SHARES * row];
      if (isSettled)
      {
        const double part = pair.Error / this->GetBudget(row);
        own[ERRORS] += std::ceil(BudgetUnits * part);
        own[SQUARED_ERRORS] += std::ceil(BudgetUnits * part * part);
        return;
      }
      const double weight = this->GetWeight(pair, row);
      own[WEIGHTS] += weight;
      own[SQUARED_WEIGHTS] += weight * weight;
    };
    for (const PartlyVisiblePair& pair : this->Pairs)
    {
      Pulse::Beat(++step);
      const bool isSettled = pair.Error <= this->GetAllowedError(pair);
      add(pair, isSettled, pair.I);
      add(pair, isSettled, pair.J);
    }
    ranks.Sum(sums);
    for (std::size_t row = 0; row < rows; ++row)
    {
      const double* own = &sums[NUMBER_OF_SHARES * row];
      const double allowance = this->GetBudget(static_cast<vtkIdType>(row)) *
        RowBudget::GetAllowance(1.0, own[ERRORS] / BudgetUnits, own[SQUARED_ERRORS] / BudgetUnits,
          own[WEIGHTS], own[SQUARED_WEIGHTS]);
      this->Allowances[row] = std::max(this->Allowances[row], allowance);
    }
  }
}

//------------------------------------------------------------------------------
void ViewFactorAssembly::Refine(vtkExchangeMatrix* exchange, vtkIdType begin, vtkIdType end)
{
  Refiner refiner{ *this, exchange };
  Threads::For(begin, end, 1, refiner);
}

//------------------------------------------------------------------------------
std::vector<double> ViewFactorAssembly::GetRowErrors(const Ranks& ranks) const
{
  const std::size_t rows = this->RowErrors.size();
  std::vector<double> sums = this->RowErrors;
  sums.resize(3 * rows, 0.0);
  for (std::size_t row = 0; row < rows; ++row)
  {
    sums[rows + row] = this->Verdicts[row].Sum;
    sums[2 * rows + row] = this->Verdicts[row].Squares;
  }
  for (const PartlyVisiblePair& pair : this->Pairs)
  {
    for (const vtkIdType row : { pair.I, pair.J })
    {
      sums[rows + row] += pair.Error;
      sums[2 * rows + row] += pair.Error * pair.Error;
    }
  }
  ranks.Sum(sums);
  for (std::size_t row = 0; row < rows; ++row)
  {
    sums[row] += RowBudget::GetError(sums[rows + row], sums[2 * rows + row]);
  }
  sums.resize(rows);
  return sums;
}
} // namespace LightTransport
