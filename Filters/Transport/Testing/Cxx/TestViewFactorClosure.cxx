// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The closure of view factors, on the matrix of a sphere's inside: there G_ij = A_i A_j / (sum A)
// is exact, whatever the division into patches. Likewise with a smaller sphere within, and with a
// hole in the sphere.
#include "LightTransportTesting.h"
#include "Links/Links.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Support/Ranks.h"
#include "ViewFactors/ViewFactorClosure.h"

#include <algorithm>
#include <numeric>
#include <random>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
constexpr vtkIdType N = vtkExchangeMatrix::TileSize;
constexpr double Single = 3e-7;
constexpr double Double = 2e-15;

//------------------------------------------------------------------------------
// A sphere, some pairs of which are known badly: between the exchange with nothing between and 0,
// where the exact value is half of what is open.
struct Case
{
  explicit Case(vtkIdType patches) : Areas(patches), Open(patches, 0.0), OpeningErrors(patches, 0.0)
  {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    std::generate(this->Areas.begin(), this->Areas.end(), [&]() { return uniform(generator); });
    this->Total = std::accumulate(this->Areas.begin(), this->Areas.end(), 0.0);
  }

  vtkIdType GetNumberOfPatches() const { return static_cast<vtkIdType>(this->Areas.size()); }
  // Patches below this number are a sphere within the sphere of the others.
  void SetInner(vtkIdType inner)
  {
    this->Inner = inner;
    this->InnerArea = std::accumulate(this->Areas.begin(), this->Areas.begin() + inner, 0.0);
    this->Total -= this->InnerArea;
  }

  // What all rows miss: through a hole of some part of the sphere. As known, within an error.
  void SetHole(double part, double error)
  {
    this->Total /= 1.0 - part;
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (double& open : this->Open)
    {
      open = part + error * uniform(generator);
    }
    this->OpeningErrors.assign(this->Areas.size(), error);
  }

  double GetExact(vtkIdType i, vtkIdType j) const
  {
    const double apart = this->Areas[i] * this->Areas[j] / this->Total;
    if (i < this->Inner && j < this->Inner)
    {
      return 0.0;
    }
    return i < this->Inner || j < this->Inner ? apart
                                              : apart * (1.0 - this->InnerArea / this->Total);
  }

  // Every `stride`-th neighbour of each patch, wrong by up to its error estimate.
  void Perturb(vtkIdType stride, double error)
  {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (vtkIdType i = this->Inner; i < this->GetNumberOfPatches(); ++i)
    {
      for (vtkIdType j = i + 1; j < this->GetNumberOfPatches(); j += stride)
      {
        const double exact = this->GetExact(i, j);
        this->Pairs.push_back(
          { i, j, 2.0 * exact, exact * (1.0 + error * uniform(generator)), error * exact });
      }
    }
  }

  // The tiles of one rank, all others without storage, and the pairs in them.
  Links MakeResult(std::vector<PartlyVisiblePair>& pairs, int part = 0, int parts = 1) const
  {
    Links result;
    result.RowSums.assign(this->Areas.size(), 0.0);
    for (const double open : this->Open)
    {
      result.SkyFractions.push_back(0.75 * open);
      result.BackFaceFractions.push_back(0.25 * open);
    }
    result.Matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
    Check(result.Matrix->Allocate(this->Areas, 1, part, parts), "allocation");
    for (vtkExchangeMatrix::Tile& tile : result.Matrix->GetTiles())
    {
      this->ForEachEntry(tile,
        [&](int row, int column, vtkIdType i, vtkIdType j)
        { vtkExchangeMatrix::SetValue(tile, row, column, 0, this->GetExact(i, j)); });
    }
    for (const PartlyVisiblePair& pair : this->Pairs)
    {
      const vtkIdType index = result.Matrix->GetTileIndex(pair.I / N, pair.J / N);
      if (index % parts == part)
      {
        vtkExchangeMatrix::SetValue(result.Matrix->GetTiles()[index / parts],
          static_cast<int>(pair.I % N), static_cast<int>(pair.J % N), 0, pair.Value);
        pairs.push_back(pair);
      }
    }
    return result;
  }

  template <typename Function>
  void ForEachEntry(const vtkExchangeMatrix::Tile& tile, Function&& function) const
  {
    for (int row = 0; row < N && tile.Row * N + row < this->GetNumberOfPatches(); ++row)
    {
      for (int column = 0; column < N && tile.Column * N + column < this->GetNumberOfPatches();
           ++column)
      {
        function(row, column, tile.Row * N + row, tile.Column * N + column);
      }
    }
  }

  ViewFactorClosure::Report Close(Links& result, double relativeError) const
  {
    std::vector<PartlyVisiblePair> pairs;
    result = this->MakeResult(pairs);
    ViewFactorClosure::Report report;
    CheckDone(
      ViewFactorClosure::Close(result, pairs, this->OpeningErrors, relativeError, Ranks(), report),
      "closure");
    return report;
  }

  std::vector<double> Areas;
  std::vector<double> Open; ///< what each row is said to miss
  std::vector<double> OpeningErrors;
  std::vector<PartlyVisiblePair> Pairs;
  double Total = 0.0; // area of the outer sphere, the hole included
  vtkIdType Inner = 0;
  double InnerArea = 0.0;
};

//------------------------------------------------------------------------------
double SumRow(const Links& result, vtkIdType i)
{
  double sum = 0.0;
  for (vtkIdType j = 0; j < result.Matrix->GetNumberOfPatches(); ++j)
  {
    sum += result.Matrix->GetValue(i, j);
  }
  return sum / result.Matrix->GetAreas()[i];
}

//------------------------------------------------------------------------------
// Largest |change of an entry that is not listed| relative to the entry; the squares of the
// distances of the listed ones to the exact matrix, before and after.
struct Comparison
{
  double Unlisted = 0.0;
  double Before = 0.0;
  double After = 0.0;
};

Comparison Compare(const Case& scene, const Links& result)
{
  Comparison comparison;
  std::vector<bool> listed(scene.GetNumberOfPatches() * scene.GetNumberOfPatches(), false);
  for (const PartlyVisiblePair& pair : scene.Pairs)
  {
    const double value = result.Matrix->GetValue(pair.I, pair.J);
    const double exact = scene.GetExact(pair.I, pair.J);
    Check(value >= 0.0 && value <= pair.Open * (1.0 + 1e-7), "a pair keeps its bounds");
    comparison.Before += std::pow(pair.Value - exact, 2);
    comparison.After += std::pow(value - exact, 2);
    listed[pair.I * scene.GetNumberOfPatches() + pair.J] = true;
    listed[pair.J * scene.GetNumberOfPatches() + pair.I] = true;
  }
  for (vtkIdType i = 0; i < scene.GetNumberOfPatches(); ++i)
  {
    for (vtkIdType j = 0; j < scene.GetNumberOfPatches(); ++j)
    {
      const double value = result.Matrix->GetValue(i, j);
      Check(value == result.Matrix->GetValue(j, i), "the matrix stays symmetric");
      if (scene.GetExact(i, j) > 0.0 && !listed[i * scene.GetNumberOfPatches() + j])
      {
        const double exact = static_cast<float>(scene.GetExact(i, j));
        // The diagonal also takes what its row has lost in single precision.
        const double lost = i == j ? 2e-7 * scene.Areas[i] : 0.0;
        const double change = std::max(0.0, std::abs(value - exact) - lost);
        comparison.Unlisted = std::max(comparison.Unlisted, change / exact);
      }
    }
  }
  return comparison;
}

//------------------------------------------------------------------------------
void TestClosedScene(vtkIdType patches, double relativeError)
{
  const std::string what = " (" + std::to_string(patches) + " patches, others within " +
    std::to_string(relativeError) + ")";
  Case scene(patches);
  scene.Perturb(5, 0.3);
  Links result;
  const ViewFactorClosure::Report report = scene.Close(result, relativeError);
  Check(report.Gap < Double, "no gap is left" + what);
  double worst = 0.0;
  for (vtkIdType i = 0; i < patches; ++i)
  {
    CheckClose(SumRow(result, i), 1.0, Double, "closed row" + what);
    CheckClose(result.RowSums[i], SumRow(result, i), Double, "row sum as stored" + what);
    worst = std::max(worst, std::abs(1.0 - result.RowSums[i]));
  }
  CheckClose(report.Gap, worst, 1e-14, "the gap" + what);
  const Comparison comparison = Compare(scene, result);
  // What single precision rounds counts as unmoved.
  Check(comparison.Unlisted <= relativeError + 1.2e-7, "entries that are right stay" + what);
  Check(comparison.After < comparison.Before, "closer to the exact matrix" + what);
  Check(report.Change > 1e-3 && report.Change < 0.1, "change of a row" + what);
}

//------------------------------------------------------------------------------
// A sphere within the sphere: the inner rows have nothing but entries that may move a little, the
// outer ones make up for that with the pairs that are known badly.
void TestSphereWithinSphere()
{
  Case scene(400);
  scene.SetInner(80);
  scene.Perturb(5, 0.3);
  std::vector<PartlyVisiblePair> pairs;
  Links result = scene.MakeResult(pairs);
  for (vtkExchangeMatrix::Tile& tile : result.Matrix->GetTiles())
  {
    scene.ForEachEntry(tile,
      [&](int row, int column, vtkIdType i, vtkIdType j)
      {
        if (i < 80)
        {
          vtkExchangeMatrix::SetValue(tile, row, column, 0,
            scene.GetExact(i, j) * (1.0 + 5e-5 * std::sin(static_cast<double>(i))));
        }
      });
  }
  ViewFactorClosure::Report report;
  CheckDone(ViewFactorClosure::Close(result, pairs, scene.OpeningErrors, 1e-4, Ranks(), report),
    "closure");
  Check(report.Gap < Double, "sphere within a sphere");
  const Comparison comparison = Compare(scene, result);
  Check(comparison.Unlisted < 1.5e-4, "entries of the sphere within");
  Check(comparison.After < comparison.Before, "the sphere within is closer to the exact matrix");
}

//------------------------------------------------------------------------------
// The change is the smallest: its sum of squares over the estimates is stationary against closed
// loops i-j-k-l that keep the row sums.
void TestLeastSquares()
{
  Case scene(40);
  scene.Perturb(1, 0.1);
  for (PartlyVisiblePair& pair : scene.Pairs)
  {
    pair.Error *= 1.0 + static_cast<double>((pair.I * 7 + pair.J * 3) % 5);
  }
  Links result;
  scene.Close(result, 0.0);
  std::map<std::pair<vtkIdType, vtkIdType>, double> slopes;
  double largest = 0.0;
  for (const PartlyVisiblePair& pair : scene.Pairs)
  {
    const double slope = (result.Matrix->GetValue(pair.I, pair.J) - pair.Value) / pair.Error;
    slopes[{ pair.I, pair.J }] = slope;
    largest = std::max(largest, std::abs(slope));
  }
  for (vtkIdType i = 0; i + 3 < 40; ++i)
  {
    const double loop = slopes[{ i, i + 1 }] - slopes[{ i + 1, i + 2 }] + slopes[{ i + 2, i + 3 }] -
      slopes[{ i, i + 3 }];
    CheckClose(loop, 0.0, 1e-5 * largest, "the change is the smallest");
  }
}

//------------------------------------------------------------------------------
// Errors that only the few pairs that cause them can mend: bounds are met on the way.
void TestBounds()
{
  Case scene(300);
  scene.Perturb(7, 0.2);
  // Nothing visible where half is open, and all open where half is: the estimates say less.
  for (std::size_t k = 0; k < scene.Pairs.size(); k += 3)
  {
    PartlyVisiblePair& pair = scene.Pairs[k];
    pair.Value = k % 2 == 0 ? 0.0 : 0.98 * pair.Open;
    pair.Error = 5.0 * pair.Error;
  }
  Links result;
  const ViewFactorClosure::Report report = scene.Close(result, 1e-7);
  Check(report.Gap < Double, "closed at the bounds");
  const Comparison comparison = Compare(scene, result);
  Check(comparison.After < comparison.Before, "closer to the exact matrix at the bounds");
  vtkIdType atBounds = 0;
  for (const PartlyVisiblePair& pair : scene.Pairs)
  {
    const double value = result.Matrix->GetValue(pair.I, pair.J);
    atBounds += value == 0.0 || value > pair.Open * (1.0 - 1e-7) ? 1 : 0;
  }
  Check(atBounds > 10, "some pairs are at their bounds");
}

//------------------------------------------------------------------------------
double SumWithOpenings(const Links& result, vtkIdType i)
{
  return SumRow(result, i) + result.SkyFractions[i] + result.BackFaceFractions[i];
}

//------------------------------------------------------------------------------
// Through a hole: what is open moves by its own error, the pairs by theirs, each by the multipliers
// of its rows, which is what makes the weighted squares smallest. The sky is three quarters of it.
void TestHole()
{
  Case scene(60);
  scene.SetHole(0.3, 0.05);
  scene.Perturb(1, 0.1);
  Links result;
  const ViewFactorClosure::Report report = scene.Close(result, 0.0);
  Check(report.Gap < Double, "rows with openings are closed");
  double before = 0.0, after = 0.0;
  std::vector<double> multipliers;
  for (vtkIdType i = 0; i < 60; ++i)
  {
    CheckClose(SumWithOpenings(result, i), 1.0, Double, "row with its openings");
    const double open = result.SkyFractions[i] + result.BackFaceFractions[i];
    CheckClose(result.SkyFractions[i], 0.75 * open, 1e-12, "sky and back faces in proportion");
    before += std::pow(scene.Open[i] - 0.3, 2);
    after += std::pow(open - 0.3, 2);
    multipliers.push_back((open - scene.Open[i]) / scene.OpeningErrors[i]);
  }
  Check(after < 0.5 * before, "the openings are closer to the exact ones");
  for (const PartlyVisiblePair& pair : scene.Pairs)
  {
    const double change = (result.Matrix->GetValue(pair.I, pair.J) - pair.Value) / pair.Error;
    CheckClose(change - multipliers[pair.I] - multipliers[pair.J], 0.0, 1e-4,
      "pairs move as their rows do");
  }
}

//------------------------------------------------------------------------------
// Openings that are not there go to nothing, no further; patches that see nothing else are left.
void TestBoundsOfOpenings()
{
  Case scene(50);
  scene.Perturb(1, 0.2);
  scene.Open.assign(50, 0.02);
  scene.OpeningErrors.assign(50, 10.0);
  Links result;
  Check(scene.Close(result, 1e-6).Gap < Double, "closed with openings at their bounds");
  for (vtkIdType i = 0; i < 50; ++i)
  {
    Check(result.SkyFractions[i] >= 0.0 && result.BackFaceFractions[i] >= 0.0, "no negative share");
    CheckClose(SumWithOpenings(result, i), 1.0, Double, "row with openings at their bounds");
  }

  Case lonely(3);
  lonely.Total = 1e30;
  lonely.Open.assign(3, 0.97);
  lonely.OpeningErrors.assign(3, 0.05);
  Check(lonely.Close(result, 1e-3).Gap < Double, "rows that see nothing but openings");
  CheckClose(result.SkyFractions[1], 0.75, 1e-7, "sky of a row without links");
}

//------------------------------------------------------------------------------
// Where the entries may not move far enough they go to their bounds, and the gap says so.
void TestUnclosable()
{
  Case scene(100);
  scene.Perturb(1, 0.0);
  for (PartlyVisiblePair& pair : scene.Pairs)
  {
    pair.Value = 0.4 * pair.Value;
    pair.Open = 0.25 * pair.Open;
    pair.Error = 0.1 * pair.Value;
  }
  Links result;
  ViewFactorClosure::Report report = scene.Close(result, 1e-6);
  for (const PartlyVisiblePair& pair : scene.Pairs)
  {
    CheckClose(result.Matrix->GetValue(pair.I, pair.J), pair.Open, 1e-7, "all that is open");
  }
  // The diagonal has all of its share, the other entries half of it.
  double gap = 0.0;
  for (const double area : scene.Areas)
  {
    gap = std::max(gap, 0.5 * (1.0 - area / scene.Total));
  }
  CheckClose(report.Gap, gap, 1e-5, "gap");

  // Without pairs: every entry may shrink by its error, no more.
  scene.Pairs.clear();
  for (double& area : scene.Areas)
  {
    area *= 1.01;
  }
  report = scene.Close(result, 1e-3);
  CheckClose(report.Gap, 0.01 - 1.01e-3, 1e-3, "gap of a matrix without pairs");
  CheckClose(report.Change, 1.01e-3, 1e-3, "change of a matrix without pairs");
}

//------------------------------------------------------------------------------
// Nothing to do, and no room to do it in.
void TestNothing()
{
  Case scene(50);
  Links result;
  ViewFactorClosure::Report report = scene.Close(result, 1e-3);
  Check(report.Change < 1e-7 && report.Gap < Double, "a matrix that is closed stays");
  scene.SetHole(0.4, 0.0);
  report = scene.Close(result, 1e-3);
  Check(report.Change < 1e-7 && report.Gap < Double, "an open scene that is closed stays");
}

//------------------------------------------------------------------------------
// Ranks that hold the parts of a matrix find what one rank finds.
void TestRanks()
{
  Case scene(700);
  scene.Perturb(5, 0.3);
  Links whole;
  const ViewFactorClosure::Report expected = scene.Close(whole, 1e-5);
  constexpr int ranks = 4;
  std::vector<Links> results(ranks);
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      std::vector<PartlyVisiblePair> pairs;
      results[rank] = scene.MakeResult(pairs, rank, ranks);
      ViewFactorClosure::Report report;
      CheckDone(ViewFactorClosure::Close(results[rank], pairs, scene.OpeningErrors, 1e-5,
                  Ranks(controller), report),
        "closure on several ranks");
      CheckClose(report.Change, expected.Change, 1e-6, "change on several ranks");
      Check(report.Gap < Double, "gap on several ranks");
    });
  for (vtkIdType i = 0; i < 700; i += 3)
  {
    for (vtkIdType j = 0; j < 700; j += 7)
    {
      double sum = 0.0;
      for (const Links& result : results)
      {
        sum += result.Matrix->GetValue(i, j);
      }
      CheckClose(sum, whole.Matrix->GetValue(i, j), 2e-7, "entry of the parts");
    }
    CheckClose(results[1].RowSums[i], whole.RowSums[i], 1e-7, "row sum on several ranks");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactorClosure(int, char*[])
{
  TestClosedScene(64, 0.0);
  TestClosedScene(300, 1e-6);
  TestClosedScene(520, 1e-4);
  TestLeastSquares();
  TestSphereWithinSphere();
  TestBounds();
  TestHole();
  TestBoundsOfOpenings();
  TestUnclosable();
  TestNothing();
  TestRanks();
  return Result();
}
