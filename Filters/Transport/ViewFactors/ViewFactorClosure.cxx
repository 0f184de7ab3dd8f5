// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorClosure.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/ViewFactorAssembly.h"
#include "vtkCPULinkOperator.h"
#include "vtkDenseLinkOperator.h"
#include "vtkNew.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// How often links are scaled.
constexpr int MaximumScalings = 30;
// Where so many steps in a row gain less on the best one, these rows cannot all be closed.
constexpr double SlowestGain = 0.9;
constexpr int StuckSteps = 3;
// Of the logarithm of a scale; what a step may leave of what is missing, squared; and what it need
// not go below, of the goal.
constexpr double LongestStep = 1.0;
constexpr double RestOfGap = 0.03;
constexpr double LargestRest = 1e-2;
// Curvatures along what cannot be closed, by pairs and by scaling.
constexpr double SmallestCurvature = 1e-12;
constexpr double SmallestScalingCurvature = 1e-9;

using Array = Eigen::ArrayXd;
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;

// Row sums, with openings, closer to 1 than this are closed: single precision storage loses more.
constexpr double Goal = 1e-8;
// What is missing in a row by no more than this has been rounded away.
constexpr double Rounding = 2e-7;
// Each round lets go of the entries that met their bounds in the one before. Rounds end earlier
// when none helps any more.
constexpr int MaximumRounds = 20;
// Of conjugate gradients in one round.
constexpr int MaximumIterations = 300;
constexpr double ShortestStep = 1.0 / 64.0;

//------------------------------------------------------------------------------
// Conjugate gradients with a diagonal in front, from 0, until hasEnded(residual, its square). They
// end before along what cannot be closed, a part of the scene that is linked like a chessboard:
// there the curvature is zero, or no more than `smallest` of the diagonal's.
template <typename Apply, typename HasEnded>
Array SolveByGradients(const Array& missing, const Array& diagonal, double smallest,
  const Apply& apply, const HasEnded& hasEnded)
{
  const Array inverse = (diagonal > 0.0).select(1.0 / diagonal, 0.0);
  Array step = Array::Zero(missing.size());
  Array residual = (diagonal > 0.0).select(missing, 0.0);
  Array direction = inverse * residual;
  double squared = (residual * direction).sum();
  for (int iteration = 0; iteration < MaximumIterations && !hasEnded(residual, squared);
       ++iteration)
  {
    const Array image = apply(direction);
    const double curvature = (direction * image).sum();
    if (!(curvature > smallest * (direction * diagonal * direction).sum()))
    {
      break;
    }
    step += squared / curvature * direction;
    residual -= squared / curvature * image;
    const double next = (residual * inverse * residual).sum();
    direction = inverse * residual + next / squared * direction;
    squared = next;
  }
  return step;
}

//------------------------------------------------------------------------------
// A partly visible pair. It is lifted out of the matrix while the change is
// sought, so that it is not counted as an entry of the matrix as well.
struct Pair
{
  vtkIdType I, J;
  double Value;
  double Weight;
  double Low, High; // what may be added to Value
  vtkExchangeMatrix::Tile* Tile;

  double GetChange(const Array& l) const
  {
    return std::clamp(this->Weight * (l[this->I] + l[this->J]), this->Low, this->High);
  }
  // The derivative of the change.
  double GetSlope(const Array& l) const
  {
    const double change = this->Weight * (l[this->I] + l[this->J]);
    return change >= this->Low && change <= this->High ? this->Weight : 0.0;
  }
  void Store(double value) const
  {
    vtkExchangeMatrix::SetValue(*this->Tile, static_cast<int>(this->I % N),
      static_cast<int>(this->J % N), 0, value);
  }
};

//------------------------------------------------------------------------------
// G_ij becomes G_ij (1 + c_i + c_j); what moves is summed per row.
struct Scaling
{
  std::vector<vtkExchangeMatrix::Tile>& Tiles;
  const Array& Change; // padded to whole tiles
  Threads::Local<Array> Moved;
  Array TotalMoved;

  void Initialize() { this->Moved.Get() = Array::Zero(this->Change.size()); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    using Row = Eigen::Map<Eigen::Array<float, N, 1>>;
    using Values = Eigen::Array<double, N, 1>;
    Array& moved = this->Moved.Get();
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkExchangeMatrix::Tile& tile = this->Tiles[index];
      const vtkIdType column = tile.Column * N;
      for (vtkIdType k = 0; tile.Values && k < N; ++k)
      {
        const vtkIdType i = tile.Row * N + k;
        Row row(tile.Values + k * N);
        const Values old = row.cast<double>();
        row = (old * (1.0 + this->Change[i] + this->Change.segment<N>(column))).cast<float>();
        const Values difference = (row.cast<double>() - old).abs();
        moved[i] += difference.sum();
        if (tile.Row != tile.Column)
        {
          moved.segment<N>(column) += difference;
        }
      }
    }
  }

  void Reduce()
  {
    this->TotalMoved = Array::Zero(this->Change.size());
    this->Moved.ForEach([&](const Array& moved) { this->TotalMoved += moved; });
  }
};

//------------------------------------------------------------------------------
/*
 * With one multiplier l per row, the change of a pair is its error estimate times l_i + l_j, cut at
 * its bounds, that of what is open in a row its error times l_i, and the change of any other entry
 * is relativeError G_ij (c_i + c_j) with c = l cut at +-1/2. The row sums are piecewise linear in
 * l: Newton's method, each step by conjugate gradients.
 */
class Closing
{
public:
  Closing(const Links& links, const std::vector<PartlyVisiblePair>& pairs,
    const std::vector<double>& openingErrors, double relativeError, const Ranks& ranks)
    : Exchange(links.Matrix), AllRanks(ranks), RelativeError(relativeError),
      Areas(Map(this->Exchange->GetAreas())),
      Open(this->Areas * (Map(links.SkyFractions) + Map(links.BackFaceFractions))),
      OpenWeights(this->Areas * Map(openingErrors))
  {
    this->Product->SetController(ranks.GetController());
    this->Ok = this->Product->Initialize(this->Exchange, 1);
    this->LiftPairs(pairs);
  }

  // False when the link operator has failed; the matrix is whole in any case.
  bool Run(ViewFactorClosure::Report& report)
  {
    this->Multipliers = Array::Zero(this->Areas.size());
    this->Sums = this->Multiply(Array::Ones(this->Areas.size()));
    this->Missing = this->Areas - this->Open - this->Sums -
      this->SumPairs([](const Pair& pair) { return pair.Value; });
    this->Iterate();
    report.Change = this->Write();
    return this->Ok;
  }

  std::vector<double> GetRowSums()
  {
    const Array sums = this->Multiply(Array::Ones(this->Areas.size())) / this->Areas;
    return { sums.begin(), sums.end() };
  }

  // After Run: by what each row's openings are to be multiplied.
  Array GetOpeningScales() const
  {
    const Array change = this->GetOpenChange(this->Multipliers);
    return 1.0 + (this->Open > 0.0).select(change / this->Open, 0.0);
  }

  bool IsOk() const { return this->Ok; }

private:
  static Eigen::Map<const Array> Map(const std::vector<double>& values)
  {
    return { values.data(), static_cast<Eigen::Index>(values.size()) };
  }

  void LiftPairs(const std::vector<PartlyVisiblePair>& pairs)
  {
    std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
    for (const PartlyVisiblePair& pair : pairs)
    {
      Pulse::Beat(this->Pairs.size());
      const vtkIdType index = this->Exchange->GetTileIndex(pair.I / N, pair.J / N);
      vtkExchangeMatrix::Tile& tile = tiles[index / this->Exchange->GetNumberOfParts()];
      if (tile.Values)
      {
        this->Pairs.push_back({ pair.I, pair.J, pair.Value, pair.Error, -pair.Value,
          std::max(0.0, pair.Open - pair.Value), &tile });
        this->Pairs.back().Store(0.0);
      }
    }
  }

  Array Multiply(const Array& x)
  {
    Array product(x.size());
    this->Ok = this->Ok && this->Product->SetVector(0, x.data()) && this->Product->Multiply(1, 0) &&
      this->Product->GetVector(1, product.data());
    return product;
  }

  // The sums over the rows of a value per pair, pairs of all ranks.
  template <typename Function>
  Array SumPairs(Function&& getValue)
  {
    Array sums = Array::Zero(this->Areas.size());
    std::size_t step = 0;
    for (const Pair& pair : this->Pairs)
    {
      Pulse::Beat(++step);
      const double value = getValue(pair);
      sums[pair.I] += value;
      sums[pair.J] += value;
    }
    return this->AddRanks(sums);
  }

  Array AddRanks(const Array& mine)
  {
    Array all = mine;
    this->Ok = this->AllRanks.Sum(all.data(), static_cast<std::size_t>(all.size())) && this->Ok;
    return all;
  }

  static Array Cut(const Array& l) { return l.max(-0.5).min(0.5); }

  // Of what is open. A row without an opening gets none.
  Array GetOpenChange(const Array& l) const { return (this->OpenWeights * l).max(-this->Open); }

  Array GetOpenSlope(const Array& l) const
  {
    return (this->OpenWeights * l >= -this->Open).select(this->OpenWeights, 0.0);
  }

  // What is still missing in the rows.
  Array GetResidual(const Array& l)
  {
    Array change =
      this->GetOpenChange(l) + this->SumPairs([&](const Pair& pair) { return pair.GetChange(l); });
    if (this->RelativeError > 0.0)
    {
      const Array c = Cut(l);
      change += this->RelativeError * (this->Sums * c + this->Multiply(c));
    }
    return this->Missing - change;
  }

  // The derivative of the row sums' change at l, times x; `free` is 1 where c still follows l.
  Array ApplyDerivative(const Array& l, const Array& free, const Array& x)
  {
    Array change = this->GetOpenSlope(l) * x +
      this->SumPairs([&](const Pair& pair) { return pair.GetSlope(l) * (x[pair.I] + x[pair.J]); });
    if (this->RelativeError > 0.0)
    {
      const Array c = free * x;
      change += this->RelativeError * free * (this->Sums * c + this->Multiply(c));
    }
    return change;
  }

  // The step that Newton's method takes at l. Rows in which nothing can move any more stay.
  Array GetStep(const Array& l, const Array& missing)
  {
    const Array free = (l.abs() < 0.5).cast<double>();
    const Array diagonal = this->RelativeError * free * this->Sums + this->GetOpenSlope(l) +
      this->SumPairs([&](const Pair& pair) { return pair.GetSlope(l); });
    return SolveByGradients(
      missing, diagonal, SmallestCurvature,
      [&](const Array& x) { return this->ApplyDerivative(l, free, x); },
      [&](const Array& residual, double) { return this->IsClosed(residual); });
  }

  bool IsClosed(const Array& residual) const
  {
    return (residual.abs() <= Goal * this->Areas).all();
  }

  void Iterate()
  {
    Array residual = this->GetResidual(this->Multipliers);
    for (int round = 0; round < MaximumRounds && !this->IsClosed(residual); ++round)
    {
      const Array step = this->GetStep(this->Multipliers, residual);
      if ((step == 0.0).all() || !this->Advance(step, residual))
      {
        return;
      }
    }
  }

  // Takes the step, or less of it where bounds are met on the way, so that row sums get better.
  bool Advance(const Array& step, Array& residual)
  {
    const double size = (residual.square() / this->Areas).sum();
    for (double length = 1.0; length >= ShortestStep; length *= 0.5)
    {
      const Array trial = this->Multipliers + length * step;
      const Array next = this->GetResidual(trial);
      if ((next.square() / this->Areas).sum() < size)
      {
        this->Multipliers = trial;
        residual = next;
        return true;
      }
    }
    return false;
  }

  // Brings the change into the matrix, and the pairs back. Returns the largest change of a row.
  double Write()
  {
    const auto size = static_cast<Eigen::Index>(this->Exchange->GetNumberOfTileRows() * N);
    Array change = Array::Zero(size);
    change.head(this->Areas.size()) = this->RelativeError * Cut(this->Multipliers);
    std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
    Scaling scaling{ tiles, change, {}, Array::Zero(size) };
    Threads::For(0, static_cast<vtkIdType>(tiles.size()), 1, scaling);
    Array moved = this->AddRanks(scaling.TotalMoved.head(this->Areas.size())) +
      this->GetOpenChange(this->Multipliers).abs();
    moved += this->SumPairs(
      [&](const Pair& pair)
      {
        const double difference = pair.GetChange(this->Multipliers);
        pair.Store(pair.Value + difference);
        return std::abs(difference);
      });
    return (moved / this->Areas).maxCoeff();
  }

  vtkExchangeMatrix* Exchange;
  Ranks AllRanks;
  vtkNew<vtkDenseLinkOperator> Product;
  double RelativeError;
  Array Areas;
  ///@{ What meets an opening, and its error.
  Array Open;
  Array OpenWeights;
  ///@}
  std::vector<Pair> Pairs;
  Array Sums; // of what is in the matrix
  Array Missing;
  Array Multipliers;
  bool Ok = false;
};

//------------------------------------------------------------------------------
// What rounding leaves missing: the openings take it where there are any, else the diagonal.
void AddRemainders(Links& links)
{
  vtkExchangeMatrix& exchange = *links.Matrix;
  std::vector<double> remainders(links.RowSums.size(), 0.0);
  for (std::size_t row = 0; row < remainders.size(); ++row)
  {
    double& sky = links.SkyFractions[row];
    double& back = links.BackFaceFractions[row];
    const double open = sky + back;
    const double missing = 1.0 - links.RowSums[row] - open;
    if (std::abs(missing) > Rounding)
    {
      continue;
    }
    if (open > Rounding)
    {
      sky *= 1.0 + missing / open;
      back *= 1.0 + missing / open;
    }
    else
    {
      remainders[row] = missing * exchange.GetAreas()[row];
    }
  }
  exchange.SetRemainders(remainders);
}

//------------------------------------------------------------------------------
double GetLargestGap(const Links& links)
{
  double gap = 0.0;
  for (std::size_t row = 0; row < links.RowSums.size(); ++row)
  {
    gap = std::max(gap,
      std::abs(1.0 - links.RowSums[row] - links.SkyFractions[row] - links.BackFaceFractions[row]));
  }
  return gap;
}

//------------------------------------------------------------------------------
void Summarize(const ViewFactorClosure::Report& report, Links& links)
{
  links.AreRowsClosed = true;
  links.Summaries.emplace_back("ClosureChange", report.Change);
  links.Summaries.emplace_back("ClosureGap", report.Gap);
}

//------------------------------------------------------------------------------
/*
 * Symmetric scaling of links by the weights w of patches; openings by a power p of their row's
 * scale. Rows sum to their targets where the convex function
 * 1/2 sum_ij G_ij e^(x_i + x_j) + sum_i (O_i e^(p x_i) / p - T_i x_i) of the logarithms x of the
 * scales is least: Newton's method finds it, each step by conjugate gradients.
 */
class Balancing
{
public:
  Balancing(Links& links, const ViewFactorClosure::Scaling& asked, const Ranks& ranks)
    : AllLinks(links), Asked(asked), Hierarchy(links.Hierarchy),
      Areas(ToArray(this->Hierarchy->GetAreas())), Targets(this->Areas),
      Product(LinkOperators::MakeOnCPU(this->Hierarchy, 1, ranks)),
      FirstWeights(ToArray(this->Hierarchy->GetWeights())),
      FirstOpen(this->Areas * (ToArray(links.SkyFractions) + ToArray(links.BackFaceFractions))),
      Good(this->Product != nullptr)
  {
    if (!asked.Targets.empty())
    {
      this->Targets *= ToArray(asked.Targets);
    }
  }

  bool Run(ViewFactorClosure::Report& report)
  {
    double least = std::numeric_limits<double>::max();
    int stuck = 0;
    for (int step = 0; step < MaximumScalings; ++step)
    {
      report.Gap = this->FindGap();
      stuck = report.Gap > SlowestGain * least ? stuck + 1 : 0;
      if (!this->Good || report.Gap <= this->Asked.Goal || stuck == StuckSteps)
      {
        break;
      }
      least = std::min(least, report.Gap);
      this->ScaleWeights(this->FindStep().max(-LongestStep).min(LongestStep).exp());
    }
    if (this->Good && report.Gap > this->Asked.Goal)
    {
      // Some cannot be closed; none may be overfull, nor does this make another so.
      this->ScaleWeights(
        this->IsScaled().select(this->Targets / this->Whole.max(this->Targets), 1.0));
      report.Gap = this->FindGap();
    }
    this->Finish(report);
    return this->Good;
  }

private:
  static Eigen::Map<const Array> ToArray(const std::vector<double>& values)
  {
    return { values.data(), static_cast<Eigen::Index>(values.size()) };
  }

  Array Multiply(const Array& x)
  {
    Array product = Array::Zero(x.size());
    this->Good = this->Good && this->Product->SetVector(0, x.data()) &&
      this->Product->Multiply(1, 0) && this->Product->GetVector(1, product.data());
    return product;
  }

  // A row without links and openings stays empty, and one whose target is 0 as it is.
  Eigen::Array<bool, Eigen::Dynamic, 1> IsScaled() const
  {
    return this->Whole > 0.0 && this->Targets > 0.0;
  }

  // Of openings.
  Array GetOpenScales() const
  {
    return (ToArray(this->Hierarchy->GetWeights()) / this->FirstWeights).pow(this->Asked.OpenPower);
  }

  // The rows as they are.
  double FindGap()
  {
    this->Sums = this->Multiply(Array::Ones(this->Areas.size()));
    this->Open = this->FirstOpen * this->GetOpenScales();
    this->Whole = this->Sums + this->Open;
    this->Missing = this->IsScaled().select(this->Targets - this->Whole, 0.0);
    return (this->Missing.abs() / this->Areas).maxCoeff();
  }

  // The step of Newton's method: rows that are nearly closed need a better one.
  Array FindStep()
  {
    const Array diagonal =
      this->IsScaled().select(this->Sums + this->Asked.OpenPower * this->Open, 0.0);
    const double area = this->Areas.sum();
    const double first = (diagonal > 0.0).select(this->Missing.square() / diagonal, 0.0).sum();
    const double goal = std::max(first * std::min(LargestRest, first / area),
      std::pow(RestOfGap * this->Asked.Goal, 2) * area);
    return SolveByGradients(
      this->Missing, diagonal, SmallestScalingCurvature,
      [&](const Array& x)
      { return Array(this->IsScaled().select(diagonal * x + this->Multiply(x), 0.0)); },
      [=](const Array&, double squared) { return squared <= goal; });
  }

  void ScaleWeights(const Array& scales)
  {
    const Array scaled = scales * ToArray(this->Hierarchy->GetWeights());
    this->Hierarchy->SetWeights({ scaled.begin(), scaled.end() });
  }

  void Finish(ViewFactorClosure::Report& report)
  {
    const Array sums = this->Sums / this->Areas;
    report.Change = (sums - ToArray(this->AllLinks.RowSums)).abs().maxCoeff();
    const Array scales = this->GetOpenScales();
    for (std::size_t row = 0; row < this->AllLinks.RowSums.size(); ++row)
    {
      this->AllLinks.SkyFractions[row] *= scales[static_cast<Eigen::Index>(row)];
      this->AllLinks.BackFaceFractions[row] *= scales[static_cast<Eigen::Index>(row)];
    }
    this->AllLinks.RowSums.assign(sums.begin(), sums.end());
  }

  Links& AllLinks;
  const ViewFactorClosure::Scaling& Asked;
  vtkExchangeHierarchy* Hierarchy;
  Array Areas;
  Array Targets; ///< times areas, as all that follow
  vtkSmartPointer<vtkCPULinkOperator> Product;
  Array FirstWeights;
  Array FirstOpen;
  bool Good;
  Array Sums; ///< of links
  Array Open;
  Array Whole; ///< with openings
  Array Missing;
};
} // namespace

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::Close(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<double>& openingErrors, double relativeError, const Ranks& ranks,
  Report& report)
{
  Closing closing(links, pairs, openingErrors, relativeError, ranks);
  if (!closing.Run(report))
  {
    return Outcome::FailedAsReported();
  }
  const Array scales = closing.GetOpeningScales();
  for (std::size_t row = 0; row < links.RowSums.size(); ++row)
  {
    links.SkyFractions[row] *= scales[static_cast<Eigen::Index>(row)];
    links.BackFaceFractions[row] *= scales[static_cast<Eigen::Index>(row)];
  }
  links.RowSums = closing.GetRowSums();
  AddRemainders(links);
  links.RowSums = closing.GetRowSums();
  report.Gap = GetLargestGap(links);
  return closing.IsOk() ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::Scale(Links& links, const Scaling& scaling, const Ranks& ranks,
  Report& report)
{
  return Balancing(links, scaling, ranks).Run(report) ? Outcome::Done()
                                                      : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::CloseMatrix(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<double>& openingErrors, double tolerance, const Ranks& ranks)
{
  Report report;
  Outcome closed = Close(links, pairs, openingErrors,
    ViewFactorAssembly::OpenShare * tolerance + SinglePrecision, ranks, report);
  if (closed)
  {
    Summarize(report, links);
  }
  return closed;
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::ScaleHierarchy(Links& links, const Scaling& scaling, const Ranks& ranks)
{
  Report report;
  Outcome scaled = Scale(links, scaling, ranks, report);
  if (scaled)
  {
    Summarize(report, links);
  }
  return scaled;
}
} // namespace LightTransport
