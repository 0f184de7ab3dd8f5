// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonLinks.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Photons/ClosedSurface.h"
#include "Photons/PhotonRecorder.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
/// Adds photons to the tiles that this rank has.
class TileRecorder : public PhotonRecorder
{
public:
  TileRecorder(vtkExchangeMatrix* matrix, const Ranks& ranks) : Matrix(matrix), AllRanks(ranks)
  {
    for (vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
    {
      this->Tiles[matrix->GetTileIndex(tile.Row, tile.Column)] = &tile;
    }
  }

  void Add(std::vector<Event>& events, const std::vector<int>& bands) override;

private:
  std::vector<Event> Gather(const std::vector<Event>& events) const;
  void AddSum(vtkIdType row, vtkIdType column, const double* sums, const std::vector<int>& bands);

  vtkExchangeMatrix* Matrix;
  const Ranks& AllRanks;
  std::unordered_map<vtkIdType, vtkExchangeMatrix::Tile*> Tiles; ///< by number
};

//------------------------------------------------------------------------------
// As numbers, which is what ranks exchange.
std::vector<PhotonRecorder::Event> TileRecorder::Gather(const std::vector<Event>& events) const
{
  if (!this->AllRanks.AreSeveral())
  {
    return events;
  }
  std::vector<double> mine;
  for (const Event& event : events)
  {
    mine.push_back(static_cast<double>(event.Entry));
    mine.push_back(static_cast<double>(event.Exit));
    mine.insert(mine.end(), event.Weights, event.Weights + MostPhotonBands);
  }
  const std::vector<double> all = this->AllRanks.Gather(mine);
  std::vector<Event> gathered(all.size() / (2 + MostPhotonBands));
  const double* next = all.data();
  for (Event& event : gathered)
  {
    event.Entry = static_cast<vtkIdType>(next[0]);
    event.Exit = static_cast<vtkIdType>(next[1]);
    std::copy_n(next + 2, MostPhotonBands, event.Weights);
    next += 2 + MostPhotonBands;
  }
  return gathered;
}

//------------------------------------------------------------------------------
// Sums over pairs go to the matrix, whose single precision would not take one photon after another.
void TileRecorder::Add(std::vector<Event>& events, const std::vector<int>& bands)
{
  for (Event& event : events)
  {
    if (event.Entry > event.Exit)
    {
      std::swap(event.Entry, event.Exit);
    }
    // Both directions are the same link.
    const double share = event.Entry == event.Exit ? 1.0 : 0.5;
    std::for_each(event.Weights, event.Weights + MostPhotonBands,
      [share](double& w) { w *= share; });
  }
  std::vector<Event> all = this->Gather(events);
  std::sort(all.begin(), all.end(),
    [](const Event& a, const Event& b)
    {
      // By weight, too: the order of equal pairs, and so the rounding of their sum, is the same on
      // any number of ranks.
      return std::tie(a.Entry, a.Exit, a.Weights[0], a.Weights[1], a.Weights[2]) <
        std::tie(b.Entry, b.Exit, b.Weights[0], b.Weights[1], b.Weights[2]);
    });
  for (std::size_t k = 0; k < all.size();)
  {
    const Event& first = all[k];
    double sums[MostPhotonBands] = {};
    for (; k < all.size() && all[k].Entry == first.Entry && all[k].Exit == first.Exit; ++k)
    {
      for (std::size_t band = 0; band < bands.size(); ++band)
      {
        sums[band] += all[k].Weights[band];
      }
    }
    this->AddSum(first.Entry, first.Exit, sums, bands);
  }
}

//------------------------------------------------------------------------------
void TileRecorder::AddSum(vtkIdType row, vtkIdType column, const double* sums,
  const std::vector<int>& bands)
{
  constexpr int size = vtkExchangeMatrix::TileSize;
  const auto found = this->Tiles.find(this->Matrix->GetTileIndex(row / size, column / size));
  if (found == this->Tiles.end())
  {
    return;
  }
  const auto inRow = static_cast<int>(row % size);
  const auto inColumn = static_cast<int>(column % size);
  for (std::size_t k = 0; k < bands.size(); ++k)
  {
    const double before =
      found->second->Values[(bands[k] * size + inRow) * std::size_t(size) + inColumn];
    vtkExchangeMatrix::SetValue(*found->second, inRow, inColumn, bands[k], before + sums[k]);
  }
}

//------------------------------------------------------------------------------
/// From weights to links. Returns how many this rank has, each pair counted once.
double ScaleTiles(vtkExchangeMatrix* matrix, const std::vector<double>& factors)
{
  constexpr std::size_t size = vtkExchangeMatrix::TileSize;
  double links = 0.0;
  for (vtkExchangeMatrix::Tile& tile : matrix->GetTiles())
  {
    std::vector<bool> isLinked(size * size, false);
    for (std::size_t k = 0; k < size * size * factors.size(); ++k)
    {
      isLinked[k % (size * size)] = isLinked[k % (size * size)] || tile.Values[k] != 0.0f;
      tile.Values[k] *= static_cast<float>(factors[k / (size * size)]);
    }
    for (std::size_t k = 0; k < size * size; ++k)
    {
      const bool isRepeated = tile.Row == tile.Column && k % size <= k / size;
      links += isLinked[k] && !isRepeated ? 1.0 : 0.0;
    }
  }
  return links;
}
} // namespace

//------------------------------------------------------------------------------
PhotonLinks::PhotonLinks(std::vector<ScatteringMedium> bands, double millimetersPerUnit,
  const PhotonScattering::Settings& settings, const MediumImage* image)
  : Bands(std::move(bands)), MillimetersPerUnit(millimetersPerUnit), Settings(settings),
    Image(image)
{
}

//------------------------------------------------------------------------------
LinkKey PhotonLinks::GetKey() const
{
  LinkKey key{ "PhotonLinks",
    { this->MillimetersPerUnit, this->Settings.TargetError,
      static_cast<double>(this->Settings.NumberOfPhotons),
      static_cast<double>(this->Settings.Seed) },
    {} };
  for (const ScatteringMedium& band : this->Bands)
  {
    key.Parameters.insert(key.Parameters.end(),
      { band.Scattering, band.Absorption, band.RefractiveIndex, band.Anisotropy });
  }
  if (this->Image)
  {
    // Halves of it are exact as numbers.
    const std::uint64_t fingerprint = this->Image->GetFingerprint();
    key.Parameters.push_back(static_cast<double>(fingerprint >> 32));
    key.Parameters.push_back(static_cast<double>(fingerprint & 0xFFFFFFFFu));
  }
  return key;
}

//------------------------------------------------------------------------------
Outcome PhotonLinks::Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
  Links& links) const
{
  const double begin = vtkTimerLog::GetUniversalTime();
  const std::size_t bands = this->Bands.size();
  const double scale = scene.GetScale() * this->MillimetersPerUnit;
  std::vector<double> areas = scene.GetAreas();
  double surface = 0.0;
  for (double& area : areas)
  {
    area *= scale * scale;
    surface += area;
  }
  Outcome done = ClosedSurface::Check(scene);
  done = done
    ? LinkOperators::AllocateMatrix(areas, static_cast<int>(bands), "", ranks, links.Matrix)
    : done;
  if (!done)
  {
    return done;
  }
  TileRecorder recorder(links.Matrix, ranks);
  const PhotonScattering scattering(scene, PhotonScattering::GetMedia(this->Bands, scale),
    this->Bands[0].RefractiveIndex, this->Image);
  PhotonScattering::Result photons;
  done = scattering.Run(std::vector<double>(areas.size() * bands, 1.0), this->Settings, ranks,
    monitor, photons, &recorder);
  if (!done)
  {
    return done;
  }
  for (std::size_t band = 0; band < bands; ++band)
  {
    links.PhotonAreas.push_back(surface / photons.PhotonsOfBands[band]);
    links.PhotonSizes.push_back(links.PhotonAreas[band] * photons.MeanWeights[band]);
  }
  double count = ScaleTiles(links.Matrix, links.PhotonAreas);
  ranks.Sum(&count, 1);
  links.Tolerance = this->Settings.TargetError;
  links.Summaries = { { "NumberOfLinks", count }, { "LinksLeftOut", 0.0 },
    { "LinkErrorBound",
      *std::max_element(photons.RelativeErrors.begin(), photons.RelativeErrors.end()) },
    { "PhotonsTraced", static_cast<double>(photons.Photons) },
    { "LostShare", *std::max_element(photons.LostShares.begin(), photons.LostShares.end()) },
    { "LinkSeconds", vtkTimerLog::GetUniversalTime() - begin } };
  return done;
}

//------------------------------------------------------------------------------
std::vector<double> PhotonLinks::GetErrors(const Links& links, const std::vector<double>& light,
  const std::vector<double>& scattered, const std::vector<double>& squares, const Ranks& ranks)
{
  const std::vector<double>& areas = links.Matrix->GetAreas();
  const std::size_t bands = links.PhotonSizes.size();
  const std::size_t components = light.size() / areas.size();
  // What comes back where it has entered.
  std::vector<double> own(light.size());
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    const auto patch = static_cast<vtkIdType>(k / components);
    own[k] =
      links.Matrix->GetValue(patch, patch, static_cast<int>(k % bands)) * light[k] / areas[patch];
  }
  ranks.Sum(own);
  std::vector<double> largest(components, 0.0);
  for (std::size_t k = 0; k < light.size(); ++k)
  {
    largest[k % components] = std::max(largest[k % components], std::abs(light[k]));
  }
  std::vector<double> errors(light.size());
  for (std::size_t k = 0; k < errors.size(); ++k)
  {
    // Links to others are means of two counts. How many photons start on a patch is not left to
    // chance: what leaves of all that enter it, and of those that enter and leave it, has the
    // variance of a share of them.
    const double perPhoton = links.PhotonSizes[k % bands] / areas[k / components];
    const double chosen = links.PhotonAreas[k % bands] / areas[k / components];
    const double variance = perPhoton * 0.5 * (squares[k] + own[k] * light[k]) -
      0.25 * chosen * (scattered[k] + own[k]) * (scattered[k] + own[k]);
    // One photon is never certain; and where none has linked any light, the next one may.
    const double one = perPhoton * perPhoton * squares[k];
    errors[k] =
      squares[k] > 0.0 ? std::sqrt(std::max(variance, one)) : perPhoton * largest[k % components];
  }
  return errors;
}
} // namespace LightTransport
