// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorClosure.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/ViewFactorAssembly.h"
#include "vtkCPULinkOperator.h"
#include "vtkDenseLinkOperator.h"
#include "vtkNew.h"
#include "vtkSMPThreadLocal.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// Row sums of scaled links, and how often they are scaled.
constexpr double ScaledGap = 1e-13;
constexpr int MaximumScalings = 300;
// A step that gains less has no better one after it: these rows cannot all be closed.
constexpr double SlowestGain = 0.999;

using Array = Eigen::ArrayXd;
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;

// Row sums closer to 1 than this are closed: single precision storage loses more.
constexpr double Goal = 1e-8;
// What is missing in a closed row by no more than this has been rounded away.
constexpr double Rounding = 2e-7;
// Each round lets go of the entries that met their bounds in the one before. Rounds end earlier
// when none helps any more.
constexpr int MaximumRounds = 20;
// Of conjugate gradients in one round.
constexpr int MaximumIterations = 300;
constexpr double ShortestStep = 1.0 / 64.0;

//------------------------------------------------------------------------------
// A partly visible pair between two closed rows. It is lifted out of the matrix while the change is
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
// G_ij becomes G_ij (1 + c_i + c_j) between closed rows; what moves is summed per row.
struct Scaling
{
  std::vector<vtkExchangeMatrix::Tile>& Tiles;
  const Array& Closed; // both padded to whole tiles
  const Array& Change;
  vtkSMPThreadLocal<Array> Moved;
  Array TotalMoved;

  void Initialize() { this->Moved.Local() = Array::Zero(this->Closed.size()); }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    using Row = Eigen::Map<Eigen::Array<float, N, 1>>;
    using Values = Eigen::Array<double, N, 1>;
    Array& moved = this->Moved.Local();
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkExchangeMatrix::Tile& tile = this->Tiles[index];
      const vtkIdType column = tile.Column * N;
      for (vtkIdType k = 0; tile.Values && k < N; ++k)
      {
        const vtkIdType i = tile.Row * N + k;
        if (this->Closed[i] == 0.0)
        {
          continue;
        }
        Row row(tile.Values + k * N);
        const Values old = row.cast<double>();
        row = (old *
          (1.0 +
            this->Closed.segment<N>(column) * (this->Change[i] + this->Change.segment<N>(column))))
                .cast<float>();
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
    this->TotalMoved = Array::Zero(this->Closed.size());
    for (const Array& moved : this->Moved)
    {
      this->TotalMoved += moved;
    }
  }
};

//------------------------------------------------------------------------------
/*
 * With one multiplier l per closed row, the change of a pair is its error estimate times l_i + l_j,
 * cut at its bounds, and the change of any other entry is relativeError G_ij (c_i + c_j) with c = l
 * cut at +-1/2. The row sums are piecewise linear in l: Newton's method, each step by conjugate
 * gradients.
 */
class Closing
{
public:
  Closing(vtkExchangeMatrix* exchange, const std::vector<PartlyVisiblePair>& pairs,
    const std::vector<bool>& closed, double relativeError, const Ranks& ranks)
    : Exchange(exchange), AllRanks(ranks), RelativeError(relativeError),
      Areas(Eigen::Map<const Array>(exchange->GetAreas().data(),
        static_cast<Eigen::Index>(exchange->GetAreas().size()))),
      Closed(this->Areas.size())
  {
    std::copy(closed.begin(), closed.end(), this->Closed.begin());
    this->Product->SetController(ranks.GetController());
    this->Ok = this->Product->Initialize(exchange, 1);
    this->LiftPairs(pairs);
  }

  // False when the link operator has failed; the matrix is whole in any case.
  bool Run(ViewFactorClosure::Report& report)
  {
    this->Multipliers = Array::Zero(this->Areas.size());
    this->ClosedSums = this->Multiply(this->Closed);
    this->Missing = this->Closed *
      (this->Areas - this->Multiply(Array::Ones(this->Areas.size())) -
        this->SumPairs([](const Pair& pair) { return pair.Value; }));
    this->Iterate();
    report.Change = this->Write();
    return this->Ok;
  }

  std::vector<double> GetRowSums()
  {
    const Array sums = this->Multiply(Array::Ones(this->Areas.size())) / this->Areas;
    return { sums.begin(), sums.end() };
  }

  bool IsOk() const { return this->Ok; }

private:
  void LiftPairs(const std::vector<PartlyVisiblePair>& pairs)
  {
    std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
    for (const PartlyVisiblePair& pair : pairs)
    {
      const vtkIdType index = this->Exchange->GetTileIndex(pair.I / N, pair.J / N);
      vtkExchangeMatrix::Tile& tile = tiles[index / this->Exchange->GetNumberOfParts()];
      if (tile.Values && this->Closed[pair.I] > 0.0 && this->Closed[pair.J] > 0.0)
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
    for (const Pair& pair : this->Pairs)
    {
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

  // What is still missing in closed rows.
  Array GetResidual(const Array& l)
  {
    Array change = this->SumPairs([&](const Pair& pair) { return pair.GetChange(l); });
    if (this->RelativeError > 0.0)
    {
      const Array c = this->Closed * Cut(l);
      change += this->RelativeError * (this->ClosedSums * c + this->Multiply(c));
    }
    return this->Missing - this->Closed * change;
  }

  // The derivative of the row sums' change at l, times x; `free` is 1 where c still follows l.
  Array ApplyDerivative(const Array& l, const Array& free, const Array& x)
  {
    Array change =
      this->SumPairs([&](const Pair& pair) { return pair.GetSlope(l) * (x[pair.I] + x[pair.J]); });
    if (this->RelativeError > 0.0)
    {
      const Array c = free * x;
      change += this->RelativeError * free * (this->ClosedSums * c + this->Multiply(c));
    }
    return change;
  }

  // The step that Newton's method takes at l. Rows in which nothing can move any more stay.
  Array GetStep(const Array& l, const Array& missing)
  {
    const Array free = this->Closed * (l.abs() < 0.5).cast<double>();
    const Array diagonal = this->RelativeError * free * this->ClosedSums +
      this->SumPairs([&](const Pair& pair) { return pair.GetSlope(l); });
    const Array inverse = (diagonal > 0.0).select(1.0 / diagonal, 0.0);
    Array step = Array::Zero(l.size());
    Array residual = (diagonal > 0.0).select(missing, 0.0);
    Array direction = inverse * residual;
    double squared = (residual * direction).sum();
    for (int iteration = 0; iteration < MaximumIterations && !this->IsClosed(residual); ++iteration)
    {
      const Array image = this->ApplyDerivative(l, free, direction);
      const double curvature = (direction * image).sum();
      // Zero along what cannot be closed: a part of the scene that is linked like a chessboard.
      if (!(curvature > 1e-12 * squared))
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
    Array closed = Array::Zero(size);
    Array change = Array::Zero(size);
    closed.head(this->Areas.size()) = this->Closed;
    change.head(this->Areas.size()) = this->RelativeError * this->Closed * Cut(this->Multipliers);
    std::vector<vtkExchangeMatrix::Tile>& tiles = this->Exchange->GetTiles();
    Scaling scaling{ tiles, closed, change, {}, Array::Zero(size) };
    Threads::For(0, static_cast<vtkIdType>(tiles.size()), 1, scaling);
    Array moved = this->AddRanks(scaling.TotalMoved.head(this->Areas.size()));
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
  Array Closed; // 1 in closed rows, else 0
  std::vector<Pair> Pairs;
  Array ClosedSums; // of what is in the matrix: with other closed rows
  Array Missing;
  Array Multipliers;
  bool Ok = false;
};

//------------------------------------------------------------------------------
void AddRemainders(vtkExchangeMatrix& exchange, const std::vector<bool>& closed,
  const std::vector<double>& sums)
{
  std::vector<double> remainders(sums.size(), 0.0);
  for (std::size_t row = 0; row < sums.size(); ++row)
  {
    const double missing = 1.0 - sums[row];
    if (closed[row] && std::abs(missing) <= Rounding)
    {
      remainders[row] = missing * exchange.GetAreas()[row];
    }
  }
  exchange.SetRemainders(remainders);
}

//------------------------------------------------------------------------------
// Those that see no opening.
std::vector<bool> FindClosedRows(const Links& links)
{
  std::vector<bool> closed(links.RowSums.size());
  for (std::size_t row = 0; row < closed.size(); ++row)
  {
    closed[row] = links.SkyFractions[row] + links.BackFaceFractions[row] == 0.0;
  }
  return closed;
}

//------------------------------------------------------------------------------
void Summarize(const ViewFactorClosure::Report& report, Links& links)
{
  links.AreRowsClosed = true;
  links.Summaries.emplace_back("ClosureChange", report.Change);
  links.Summaries.emplace_back("ClosureGap", report.Gap);
}
} // namespace

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::Close(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  const std::vector<bool>& closed, double relativeError, const Ranks& ranks, Report& report)
{
  Closing closing(links.Matrix, pairs, closed, relativeError, ranks);
  if (!closing.Run(report))
  {
    return Outcome::FailedAsReported();
  }
  AddRemainders(*links.Matrix, closed, closing.GetRowSums());
  links.RowSums = closing.GetRowSums();
  report.Gap = 0.0;
  for (std::size_t row = 0; row < closed.size(); ++row)
  {
    report.Gap = std::max(report.Gap, closed[row] ? std::abs(1.0 - links.RowSums[row]) : 0.0);
  }
  return closing.IsOk() ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::Scale(Links& links, const std::vector<bool>& closed, const Ranks& ranks,
  Report& report)
{
  vtkExchangeHierarchy* hierarchy = links.Hierarchy;
  const std::vector<double>& areas = hierarchy->GetAreas();
  auto product = LinkOperators::MakeOnCPU(hierarchy, 1, ranks);
  std::vector<double> sums(areas.size(), 1.0);
  bool good = product && product->SetVector(0, sums.data());
  std::vector<double> weights = hierarchy->GetWeights();
  double last = std::numeric_limits<double>::max();
  for (int step = 0; good && step <= MaximumScalings; ++step)
  {
    good = product->Multiply(1, 0) && product->GetVector(1, sums.data());
    report.Gap = 0.0;
    for (std::size_t row = 0; row < areas.size(); ++row)
    {
      sums[row] /= areas[row];
      // A row without links stays one.
      const bool scales = (closed[row] && sums[row] > 0.0) || sums[row] > 1.0;
      report.Gap = std::max(report.Gap, scales ? std::abs(1.0 - sums[row]) : 0.0);
      weights[row] *= scales ? 1.0 / std::sqrt(sums[row]) : 1.0;
    }
    if (report.Gap <= ScaledGap || step == MaximumScalings || report.Gap > SlowestGain * last)
    {
      break;
    }
    last = report.Gap;
    hierarchy->SetWeights(weights);
  }
  for (std::size_t row = 0; row < areas.size(); ++row)
  {
    report.Change = std::max(report.Change, std::abs(sums[row] - links.RowSums[row]));
  }
  links.RowSums = sums;
  return good ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::CloseMatrix(Links& links, const std::vector<PartlyVisiblePair>& pairs,
  double tolerance, const Ranks& ranks)
{
  Report report;
  Outcome closed = Close(links, pairs, FindClosedRows(links),
    ViewFactorAssembly::OpenShare * tolerance + SinglePrecision, ranks, report);
  if (closed)
  {
    Summarize(report, links);
  }
  return closed;
}

//------------------------------------------------------------------------------
Outcome ViewFactorClosure::ScaleHierarchy(Links& links, const Ranks& ranks)
{
  Report report;
  Outcome scaled = Scale(links, FindClosedRows(links), ranks, report);
  if (scaled)
  {
    Summarize(report, links);
  }
  return scaled;
}
} // namespace LightTransport
