// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// "ViewFactorError" on random scenes beside brute force: in 99 % of all rows the largest error of
// an entry and the error of the sum are no larger, but for three standard errors of the brute
// force. ViewFactorProofBenchmark takes ten thousand scenes and says which ones are worst.
#include "ViewFactorProof.h"

using namespace LightTransportTesting;

namespace
{
/// Standard error that is small enough wherever the estimate is smaller than three times that.
constexpr double Sigma = 2e-4;

//------------------------------------------------------------------------------
struct Count
{
  int Rows = 0;
  int Told = 0; ///< of which brute force tells whether the estimate holds
  int Failed = 0;
  double Worst = 0.0;
  std::string Text;
};

//------------------------------------------------------------------------------
void AddScene(int number, double tolerance, Count& count)
{
  SceneMaker maker(number);
  const auto& kinds = SceneMaker::GetKinds();
  const RandomScene scene = maker.Make(kinds[number % kinds.size()]);
  const Placement placement = maker.MakePlacement();
  const auto polygons = Place(scene.Polygons, placement);
  const double worth = BruteForce::GetWorth(polygons, placement.Single);
  const BruteForce force(polygons, worth);
  const auto widths = GetWidths(polygons);
  const FactorTable table = MakeFactorTable(polygons, placement.Single, tolerance);
  for (std::size_t row = 0; row < polygons.size(); ++row)
  {
    const double ambiguity = GetAmbiguity(table, row, widths, worth);
    const double sigma = std::max((table.Errors[row] + ambiguity) / 3.0, Sigma);
    const RowProof proof = Compare(table, row, force.Count(row, sigma, number), ambiguity);
    const Deviation& worse =
      proof.GetFactor(proof.Largest) > proof.GetFactor(proof.Sum) ? proof.Largest : proof.Sum;
    const double factor = proof.GetFactor(worse);
    ++count.Rows;
    count.Told += proof.Tells() ? 1 : 0;
    count.Failed += factor > 1.0 ? 1 : 0;
    if (factor > count.Worst)
    {
      count.Worst = factor;
      count.Text = "scene " + std::to_string(number) + ", " + scene.Kind + ", " + placement.Name +
        ", row " + std::to_string(row) + " " + worse.What;
    }
  }
}

//------------------------------------------------------------------------------
void TestEstimate(double tolerance, int scenes)
{
  Count count;
  for (int number = 0; number < scenes; ++number)
  {
    AddScene(number, tolerance, count);
  }
  const std::string what = "estimates at " + std::to_string(tolerance);
  Check(count.Told > count.Rows / 4,
    what + ": brute force tells in " + std::to_string(count.Told) + " of " +
      std::to_string(count.Rows));
  Check(count.Failed * 100 <= count.Rows,
    what + " fail in " + std::to_string(count.Failed) + " of " + std::to_string(count.Rows) +
      " rows, worst " + std::to_string(count.Worst) + " times: " + count.Text);
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactorEstimate(int, char*[])
{
  TestEstimate(1e-2, 105);
  TestEstimate(1e-3, 28);
  return Result();
}
