// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/CheckedErrors.h"

#include "Links/ExchangeRow.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/CheckedRows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace LightTransport
{
//------------------------------------------------------------------------------
// What there is of one band.
struct CheckedErrors::Light
{
  std::vector<double> Uneven; ///< the radiosity beside its mean
  double Mean = 0.0;
  double Background = 0.0;
};

//------------------------------------------------------------------------------
CheckedErrors::CheckedErrors(const PatchScene& scene, const CheckedRows& rows, const Links& links,
  const Ranks& ranks)
  : Scene(scene), Rows(rows), AllLinks(links), AllRanks(ranks)
{
  const std::vector<double>& areas = scene.GetAreas();
  this->Area = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    this->IsClosed = this->IsClosed && !this->IsOpen(patch);
  }
}

//------------------------------------------------------------------------------
double CheckedErrors::GetOpen(std::size_t patch) const
{
  return this->AllLinks.SkyFractions[patch] + this->AllLinks.BackFaceFractions[patch];
}

//------------------------------------------------------------------------------
// Whether what its row misses may be more than an error.
bool CheckedErrors::IsOpen(std::size_t patch) const
{
  return !this->AllLinks.AreRowsWhole || this->GetOpen(patch) > 0.0;
}

//------------------------------------------------------------------------------
// Of the checked rows, each with all others, in units of exchange. Collective.
CheckedErrors::Changes CheckedErrors::FindChanges() const
{
  Changes changes;
  for (const auto& [patch, exact] : this->Rows.Get())
  {
    std::vector<double>& row = changes[patch];
    ExchangeRow::Copy(this->AllLinks.GetExchange(), patch, row);
    this->AllRanks.Sum(row);
    std::transform(exact.begin(), exact.end(), row.begin(), row.begin(), std::minus<double>());
  }
  return changes;
}

//------------------------------------------------------------------------------
// Where pairs have been left out, since they send nothing, means are not sent either.
CheckedErrors::Light CheckedErrors::GetLight(const std::vector<double>& radiosity, int band,
  int numberOfBands, const std::vector<double>& background) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  Light light;
  light.Background = background.empty() ? 0.0 : background[band];
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    light.Uneven.push_back(radiosity[patch * numberOfBands + band]);
    light.Mean +=
      this->AllLinks.AreRowsWhole ? areas[patch] / this->Area * light.Uneven.back() : 0.0;
  }
  for (double& value : light.Uneven)
  {
    value -= light.Mean;
  }
  return light;
}

//------------------------------------------------------------------------------
// What a checked patch receives less than it should.
double CheckedErrors::GetWhole(vtkIdType patch, const std::vector<double>& changes,
  const Light& light) const
{
  const double area = this->Scene.GetAreas()[patch];
  const double uneven =
    std::inner_product(changes.begin(), changes.end(), light.Uneven.begin(), 0.0) / area;
  if (!this->IsOpen(patch))
  {
    return uneven + light.Mean * (1.0 - this->AllLinks.RowSums[patch]);
  }
  const double more = std::accumulate(changes.begin(), changes.end(), 0.0) / area;
  const double open = this->GetOpen(patch);
  const double missing = 1.0 - this->AllLinks.RowSums[patch] - more - open;
  const double sky = open > 0.0 ? this->AllLinks.SkyFractions[patch] / open : 1.0;
  return uneven + light.Mean * more + sky * missing * light.Background;
}

//------------------------------------------------------------------------------
// What every patch is known to receive too little of the checked ones, and of the mean.
std::vector<double> CheckedErrors::FindKnown(const Light& light, const Changes& changes) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  std::vector<double> known(areas.size(), 0.0);
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    known[patch] = this->IsOpen(patch) ? 0.0 : light.Mean * (1.0 - this->AllLinks.RowSums[patch]);
  }
  for (const auto& [sender, row] : changes)
  {
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      known[patch] += row[patch] * light.Uneven[sender] / areas[patch];
    }
  }
  return known;
}

//------------------------------------------------------------------------------
// Symmetric links whose rows miss so much of their sums lose that of all that is sent, and no more:
// the rest is spread over the patches that have not been checked.
void CheckedErrors::KeepEnergy(double total, std::vector<double>& differences) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  double unchecked = this->Area;
  for (const auto& row : this->Rows.Get())
  {
    unchecked -= areas[row.first];
  }
  total -= std::inner_product(areas.begin(), areas.end(), differences.begin(), 0.0);
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    const bool isChecked = this->Rows.Get().count(static_cast<vtkIdType>(patch)) > 0;
    differences[patch] += isChecked ? 0.0 : total / unchecked;
  }
}

//------------------------------------------------------------------------------
Outcome CheckedErrors::FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
  const std::vector<double>& background, std::vector<double>& differences,
  std::vector<double>& known) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const std::vector<vtkIdType> sample = CheckedRows::TakeSample(areas);
  const Changes changes = this->FindChanges();
  const std::size_t bands = numberOfBands;
  differences.assign(areas.size() * Groups * bands, 0.0);
  for (std::size_t band = 0; band < bands; ++band)
  {
    const Light light =
      this->GetLight(radiosity, static_cast<int>(band), numberOfBands, background);
    std::vector<double> here = this->FindKnown(light, changes);
    double squares = 0.0;
    for (const vtkIdType patch : sample)
    {
      const double rest = this->GetWhole(patch, changes.at(patch), light) - here[patch];
      squares += rest * rest / static_cast<double>(sample.size());
    }
    double lost = 0.0;
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      lost +=
        areas[patch] * (light.Uneven[patch] + light.Mean) * (1.0 - this->AllLinks.RowSums[patch]);
    }
    for (const auto& [patch, row] : changes)
    {
      here[patch] = this->GetWhole(patch, row, light);
    }
    if (this->IsClosed)
    {
      this->KeepEnergy(lost, here);
    }
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      known[patch * bands + band] += here[patch];
    }
    this->AddAlternatives(std::sqrt(squares), band, bands, differences);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The same signs in all bands, whose links are the same.
void CheckedErrors::AddAlternatives(double deviation, std::size_t band, std::size_t bands,
  std::vector<double>& differences) const
{
  std::mt19937 chance(1);
  for (int group = 0; group < Groups; ++group)
  {
    std::vector<double> here(this->Scene.GetAreas().size());
    for (std::size_t patch = 0; patch < here.size(); ++patch)
    {
      const double sign = (chance() & 1U) != 0 ? 1.0 : -1.0;
      const bool isChecked = this->Rows.Get().count(static_cast<vtkIdType>(patch)) > 0;
      here[patch] = isChecked ? 0.0 : sign * deviation;
    }
    if (this->IsClosed)
    {
      this->KeepEnergy(0.0, here);
    }
    for (std::size_t patch = 0; patch < here.size(); ++patch)
    {
      differences[(patch * Groups + group) * bands + band] = here[patch];
    }
  }
}

//------------------------------------------------------------------------------
std::vector<double> CheckedErrors::GetDeviations(const std::vector<double>& differences) const
{
  const std::size_t bands = differences.size() / (this->Scene.GetAreas().size() * Groups);
  std::vector<double> deviations(differences.size() / Groups, 0.0);
  for (std::size_t k = 0; k < differences.size(); ++k)
  {
    deviations[k / (Groups * bands) * bands + k % bands] +=
      differences[k] * differences[k] / Groups;
  }
  for (double& value : deviations)
  {
    value = std::sqrt(value);
  }
  return deviations;
}
} // namespace LightTransport
