// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringAssembly.h"

#include "Scattering/AirGaps.h"
#include "Scattering/ScatteringIntegrals.h"
#include "Scattering/ScatteringPatches.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/SplitMix.h"
#include "vtkExchangeMatrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace LightTransport
{
namespace
{
/// Rows of a tile that one thread works on at a time.
constexpr int RowsPerStrip = 8;
/// Calls of the monitor; the same on all ranks. The first tiles, of neighbours, take the longest.
constexpr int NumberOfBatches = 500;

///@{ How the tolerance is granted: in proportion to values, to areas, and to neighbours: in a
/// triangle mesh there are about 40.
constexpr double ShareOfValues = 0.4;
constexpr double ShareOfAreas = 0.3;
constexpr double ShareOfNeighbours = 0.3 / 40.0;
///@}

/// Above the longest distance in the scene.
constexpr double RoundingMargin = 1.01;
/// Halvings of the longest distance in the search for the one beyond which pairs are left out.
constexpr int CutOffSteps = 60;

//------------------------------------------------------------------------------
/// What a thread leaves behind for a patch.
struct PatchSummary
{
  using Bands = ScatteringIntegrals::Bands;
  double Error = 0.0;
  Bands ThroughAir = Bands::Zero();
  Bands ThroughAirVariance = Bands::Zero();

  void Add(const PatchSummary& other)
  {
    this->Error += other.Error;
    this->ThroughAir += other.ThroughAir;
    this->ThroughAirVariance += other.ThroughAirVariance;
  }
  void AddTo(ScatteringAssembly::Summary& summary, vtkIdType patch) const
  {
    summary.Errors[patch] += this->Error;
    for (int band = 0; band < ScatteringIntegrals::NumberOfBands; ++band)
    {
      const vtkIdType k = patch * ScatteringIntegrals::NumberOfBands + band;
      summary.ThroughAir.Carried[k] += this->ThroughAir[band];
      summary.ThroughAir.Variances[k] += this->ThroughAirVariance[band];
    }
  }
};

//------------------------------------------------------------------------------
/// And for one strip of a tile.
struct StripSummary
{
  vtkIdType Links = 0;
  vtkIdType LeftOut = 0;
  std::array<PatchSummary, RowsPerStrip> Rows;
  std::array<PatchSummary, vtkExchangeMatrix::TileSize> Columns;
};

//------------------------------------------------------------------------------
/// Fills strips of tiles.
class StripFiller
{
public:
  StripFiller(const ScatteringPatches& body, const ScatteringIntegrals& integrals,
    const ScatteringProfiles& profiles, double tolerance, double furthest,
    const ScatteringAssembly::AirLinks& air, vtkExchangeMatrix* exchange)
    : Patches(body), Integrals(integrals), Air(air), Tiles(exchange->GetTiles())
  {
    for (std::size_t band = 0; band < profiles.size(); ++band)
    {
      this->Totals[band] = profiles[band]->GetTotal();
    }
    // A patch receives at most everything, and on a small body at most the peak from all of it.
    const double allowed = tolerance * integrals.GetLargestShare(body.TotalArea);
    this->PerArea = ShareOfAreas * allowed / body.TotalArea;
    this->PerNeighbour = ShareOfNeighbours * allowed;
    this->FindCutOff(furthest);
  }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType strip = begin; strip < end; ++strip)
    {
      this->FillStrip(strip);
    }
  }

  /// The strips [first, first + number) are about to be filled.
  void Start(vtkIdType first, vtkIdType number)
  {
    this->FirstStrip = first;
    this->Strips.assign(number, StripSummary());
  }

  /// Add what the strips came to, in their order, so that the sums do not depend on threads.
  void Finish(ScatteringAssembly::Summary& summary) const
  {
    for (std::size_t k = 0; k < this->Strips.size(); ++k)
    {
      const StripSummary& strip = this->Strips[k];
      summary.Links += strip.Links;
      summary.LeftOut += strip.LeftOut;
      vtkIdType firstRow;
      const vtkExchangeMatrix::Tile& tile =
        this->Locate(this->FirstStrip + static_cast<vtkIdType>(k), firstRow);
      const vtkIdType count = static_cast<vtkIdType>(this->Patches.Areas.size());
      const vtkIdType row = tile.Row * vtkExchangeMatrix::TileSize + firstRow;
      const vtkIdType column = tile.Column * vtkExchangeMatrix::TileSize;
      for (vtkIdType i = 0; i < std::min<vtkIdType>(RowsPerStrip, count - row); ++i)
      {
        strip.Rows[i].AddTo(summary, row + i);
      }
      for (vtkIdType j = 0; j < std::min<vtkIdType>(vtkExchangeMatrix::TileSize, count - column);
           ++j)
      {
        strip.Columns[j].AddTo(summary, column + j);
      }
    }
  }

  static constexpr int StripsPerTile = vtkExchangeMatrix::TileSize / RowsPerStrip;

private:
  void FindCutOff(double furthest)
  {
    double begin = 0.0;
    double end = furthest;
    if (this->Integrals.GetBound(end) >= this->PerArea)
    {
      this->CutOff = end;
      return;
    }
    for (int step = 0; step < CutOffSteps; ++step)
    {
      const double middle = 0.5 * (begin + end);
      (this->Integrals.GetBound(middle) >= this->PerArea ? begin : end) = middle;
    }
    this->CutOff = end;
  }

  const vtkExchangeMatrix::Tile& Locate(vtkIdType strip, vtkIdType& firstRow) const
  {
    firstRow = strip % StripsPerTile * RowsPerStrip;
    return this->Tiles[strip / StripsPerTile];
  }

  void FillStrip(vtkIdType strip)
  {
    StripSummary& summary = this->Strips[strip - this->FirstStrip];
    vtkIdType firstRow;
    vtkExchangeMatrix::Tile tile = this->Locate(strip, firstRow);
    const vtkIdType count = static_cast<vtkIdType>(this->Patches.Areas.size());
    const vtkIdType rowOffset = tile.Row * vtkExchangeMatrix::TileSize;
    const vtkIdType columnOffset = tile.Column * vtkExchangeMatrix::TileSize;
    for (vtkIdType row = firstRow; row < firstRow + RowsPerStrip; ++row)
    {
      const vtkIdType i = rowOffset + row;
      if (i >= count)
      {
        break;
      }
      Pulse::Beat();
      const vtkIdType last = std::min<vtkIdType>(vtkExchangeMatrix::TileSize, count - columnOffset);
      for (vtkIdType column = std::max<vtkIdType>(0, i - columnOffset); column < last; ++column)
      {
        const vtkIdType j = columnOffset + column;
        PatchSummary pair;
        this->FillPair(tile, row, column, i, j, summary, pair);
        summary.Rows[row - firstRow].Add(pair);
        if (i != j)
        {
          summary.Columns[column].Add(pair);
        }
      }
    }
  }

  /// `pair`: what it adds to the summaries of both patches.
  void FillPair(vtkExchangeMatrix::Tile& tile, vtkIdType row, vtkIdType column, vtkIdType i,
    vtkIdType j, StripSummary& summary, PatchSummary& pair) const
  {
    ScatteringIntegrals::Result result;
    if (i == j)
    {
      this->Patches.AddSelf(this->Integrals, i, this->PerNeighbour / this->Patches.Areas[i],
        result);
    }
    else
    {
      const double reach = this->Patches.Radii[i] + this->Patches.Radii[j];
      const double distance = (this->Patches.Centroids[i] - this->Patches.Centroids[j]).norm();
      if (distance - reach > this->CutOff)
      {
        ++summary.LeftOut;
        pair.Error = this->PerArea * (this->Patches.Areas[i] * this->Patches.Areas[j]);
        return;
      }
      ++summary.Links;
      const double tolerance =
        this->Patches.GetTolerance(i, j, distance, this->PerArea, this->PerNeighbour);
      this->Patches.AddPair(this->Integrals, i, j, tolerance, result);
      this->LookForAir(i, j, result.Value, pair);
    }
    pair.Error = result.Error;
    for (int band = 0; band < ScatteringIntegrals::NumberOfBands; ++band)
    {
      vtkExchangeMatrix::SetValue(tile, static_cast<int>(row), static_cast<int>(column), band,
        this->Totals[band] * result.Value[band]);
    }
  }

  /// Of the links of a patch about as many are looked at as AirGaps::SampleSize says, stronger ones
  /// more likely, by a number that is the link's own: so that threads and ranks do not matter.
  void LookForAir(vtkIdType i, vtkIdType j, ScatteringIntegrals::Bands& value,
    PatchSummary& pair) const
  {
    if (!this->Air.Gaps.MayBeThere())
    {
      return;
    }
    double chance = 1.0;
    if (!this->Air.AreDropped)
    {
      const double part =
        value.maxCoeff() / std::min(this->Patches.Areas[i], this->Patches.Areas[j]);
      chance = std::min(AirGaps::SampleSize * part, 1.0);
      const auto count = static_cast<std::uint64_t>(this->Patches.Areas.size());
      SplitMix number(static_cast<std::uint64_t>(i) * count + static_cast<std::uint64_t>(j));
      if (!AirGaps::IsInSample(number, chance))
      {
        return;
      }
    }
    if (this->Air.Gaps.AreBetween(i, j))
    {
      pair.ThroughAir = value * this->Totals / chance;
      pair.ThroughAirVariance = (1.0 - chance) * pair.ThroughAir.square();
      value *= this->Air.AreDropped ? 0.0 : 1.0;
    }
  }

  const ScatteringPatches& Patches;
  const ScatteringIntegrals& Integrals;
  const ScatteringAssembly::AirLinks& Air;
  const std::vector<vtkExchangeMatrix::Tile>& Tiles;
  ScatteringIntegrals::Bands Totals = ScatteringIntegrals::Bands::Zero();
  double PerArea;
  double PerNeighbour;
  double CutOff = 0.0;
  vtkIdType FirstStrip = 0;
  std::vector<StripSummary> Strips;
};
} // namespace

//------------------------------------------------------------------------------
Outcome ScatteringAssembly::Fill(const PatchScene& scene, double millimetersPerSceneUnit,
  const ScatteringProfiles& profiles, double tolerance, const AirLinks& air,
  vtkExchangeMatrix* exchange, const Monitor& monitor, Summary& summary)
{
  const ScatteringPatches body(scene, millimetersPerSceneUnit);
  // The scene's bounding box has diagonal 1.
  const double furthest = RoundingMargin * millimetersPerSceneUnit;
  const ScatteringIntegrals integrals(profiles, furthest, ShareOfValues * tolerance);
  StripFiller filler(body, integrals, profiles, tolerance, furthest, air, exchange);
  summary = Summary();
  summary.Errors.assign(body.Areas.size(), 0.0);
  summary.ThroughAir = air.Gaps.StartSums(body.Areas, profiles,
    air.AreDropped ? AirGaps::AllLinks : AirGaps::SampleSize);
  const vtkIdType strips =
    static_cast<vtkIdType>(exchange->GetTiles().size()) * StripFiller::StripsPerTile;
  for (int batch = 0; batch < NumberOfBatches; ++batch)
  {
    const vtkIdType first = strips * batch / NumberOfBatches;
    const vtkIdType last = strips * (batch + 1) / NumberOfBatches;
    filler.Start(first, last - first);
    Threads::For(first, last, 1, filler);
    filler.Finish(summary);
    if (Outcome goesOn = monitor.Check(static_cast<double>(batch + 1) / NumberOfBatches); !goesOn)
    {
      return goesOn;
    }
  }
  return Outcome::Done();
}
} // namespace LightTransport
