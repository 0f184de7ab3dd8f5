// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/CheckedRows.h"

#include "Links/ExchangeRow.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/DenseViewFactors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

namespace LightTransport
{
namespace
{
// Rows that tell of all, and patches that are the brightest. In a model of random scenes with exact
// rows that told how wrong a solution is within a factor of two in 97 of 100, with twice as many in
// 98.
constexpr int Sample = 16;
constexpr std::size_t Brightest = 8;
// How much more exact than the links rows are checked, and the range: a coarser tolerance is often
// kept by the first look at each pair, which would agree with itself.
constexpr double Finer = 0.1;
constexpr double LeastTolerance = 1e-8;
constexpr double MostTolerance = 1e-3;
// Rows whose tiles are stored at the same time.
constexpr double BytesAtOnce = 64.0 * 1024.0 * 1024.0;
} // namespace

//------------------------------------------------------------------------------
std::vector<vtkIdType> CheckedRows::TakeSample(const std::vector<double>& areas)
{
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<vtkIdType> sample;
  double before = 0.0;
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    before += areas[patch];
    while (static_cast<int>(sample.size()) < Sample &&
      before >= (static_cast<double>(sample.size()) + 0.5) / Sample * whole)
    {
      sample.push_back(static_cast<vtkIdType>(patch));
    }
  }
  return sample;
}

//------------------------------------------------------------------------------
// By what they send beside what is the same everywhere.
std::vector<vtkIdType> CheckedRows::FindBrightest(const std::vector<double>& areas,
  const std::vector<double>& radiosity)
{
  const std::size_t bands = radiosity.size() / areas.size();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> shares(areas.size(), 0.0);
  for (std::size_t band = 0; band < bands; ++band)
  {
    double mean = 0.0, whole = 0.0;
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      mean += areas[patch] / area * radiosity[patch * bands + band];
    }
    std::vector<double> here(areas.size());
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      here[patch] = areas[patch] * std::pow(radiosity[patch * bands + band] - mean, 2);
      whole += here[patch];
    }
    for (std::size_t patch = 0; patch < areas.size() && whole > 0.0; ++patch)
    {
      shares[patch] += here[patch] / whole;
    }
  }
  std::vector<vtkIdType> order(areas.size());
  std::iota(order.begin(), order.end(), vtkIdType(0));
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(std::min(Brightest, order.size()));
  std::partial_sort(order.begin(), last, order.end(),
    [&](vtkIdType a, vtkIdType b)
    { return shares[a] > shares[b] || (shares[a] == shares[b] && a < b); });
  order.erase(last, order.end());
  return order;
}

//------------------------------------------------------------------------------
Outcome CheckedRows::Provide(const PatchScene& scene, const Links& links,
  const std::vector<double>& radiosity, const Ranks& ranks, const Monitor& monitor)
{
  const double tolerance =
    std::min(std::max(Finer * links.Tolerance, LeastTolerance), MostTolerance);
  if (this->Fingerprint != scene.GetFingerprint() || this->Tolerance > tolerance)
  {
    this->Rows.clear();
    this->Fingerprint = scene.GetFingerprint();
    this->Tolerance = tolerance;
  }
  std::set<vtkIdType> wanted;
  for (const auto& patches :
    { TakeSample(scene.GetAreas()), FindBrightest(scene.GetAreas(), radiosity) })
  {
    wanted.insert(patches.begin(), patches.end());
  }
  std::vector<vtkIdType> missing;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing),
    [this](vtkIdType patch) { return this->Rows.count(patch) == 0; });
  const double rowBytes =
    static_cast<double>(scene.GetNumberOfPatches()) * vtkExchangeMatrix::TileSize * sizeof(float);
  const auto atOnce = static_cast<std::size_t>(std::max(BytesAtOnce / rowBytes, 1.0));
  const auto all = static_cast<double>(missing.size());
  for (std::size_t first = 0; first < missing.size(); first += atOnce)
  {
    const std::size_t last = std::min(first + atOnce, missing.size());
    const Outcome filled = this->Fill(scene,
      { missing.begin() + static_cast<std::ptrdiff_t>(first),
        missing.begin() + static_cast<std::ptrdiff_t>(last) },
      ranks, monitor.GetStage(static_cast<double>(first) / all, static_cast<double>(last) / all));
    if (!filled)
    {
      return filled;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome CheckedRows::Fill(const PatchScene& scene, const std::vector<vtkIdType>& patches,
  const Ranks& ranks, const Monitor& monitor)
{
  std::vector<bool> flags(scene.GetNumberOfPatches(), false);
  for (const vtkIdType patch : patches)
  {
    flags[patch] = true;
  }
  vtkSmartPointer<vtkExchangeMatrix> matrix;
  Outcome filled =
    DenseViewFactors::FillRows(scene, this->Tolerance, flags, ranks, monitor, matrix);
  std::vector<double> row;
  for (std::size_t k = 0; filled && k < patches.size(); ++k)
  {
    ExchangeRow::Copy(matrix, patches[k], row);
    ranks.Sum(row);
    this->Rows[patches[k]].assign(row.begin(), row.end());
  }
  return filled;
}
} // namespace LightTransport
