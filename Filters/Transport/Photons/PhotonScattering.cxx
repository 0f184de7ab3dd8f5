// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonScattering.h"

#include "Photons/MeshBoundary.h"
#include "Photons/PhotonSource.h"
#include "Photons/UniformPath.h"
#include "Photons/VaryingPath.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace LightTransport
{
namespace
{
// Balls without surface need not be larger than this many free paths: few steps are longer.
constexpr double FreePathsPerBall = 4.0;
// What one thread takes at a time, and one rank: pairs for each of up to three bands.
constexpr long long PhotonsPerPart = 60;
constexpr long long FewestPhotons = 64;
// Photons of the first look at the error, and at most by how much their number grows from look to
// look.
constexpr long long FirstPhotons = 1 << 14;
constexpr double MostGrowth = 16.0;
// More than are looked for, so that the next look is the last one as a rule.
constexpr double Reserve = 1.03;
// As many as the tally holds.
constexpr double MostPhotons = 1u << 30;
// Between two reports: a quarter of a second on one thread. A step at the surface costs as much as
// several scatterings.
constexpr double ScatteringsPerReport = 4e6;
constexpr double WorkPerPhoton = 20.0;
constexpr long long FirstTurn = 256;
} // namespace

//------------------------------------------------------------------------------
/// Bands that share their photons, and these; a single one where the medium varies.
class PhotonScattering::Group
{
public:
  Group(const PhotonScattering& owner, const std::vector<int>& bands,
    const PhotonBoundary& boundary, const std::vector<double>& entering,
    const VaryingMedium* varying)
    : Owner(owner), Scene(owner.Scene), Bands(bands), Paths(owner.ChooseMedia(bands)),
      Varying(varying), Walk(boundary, owner.RefractiveIndex, owner.Media[bands[0]].Anisotropy),
      Source(owner.Scene, owner.GetFlux(bands, entering), static_cast<int>(bands.size())),
      Tally(owner.Scene.GetFaces(), static_cast<int>(bands.size()))
  {
    for (const int band : bands)
    {
      this->CanScatter.push_back(
        varying ? varying->CanScatter() : owner.Media[band].Scattering > 0.0);
    }
  }

  Outcome Run(const Settings& settings, const Ranks& ranks, const Monitor& monitor,
    PhotonRecorder* recorder);
  void Collect(const Ranks& ranks, Result& result) const;

private:
  void Trace(long long count, std::uint64_t seed, const Ranks& ranks, PhotonRecorder* recorder);
  double GetDeviationOfNext(double left, std::size_t band) const;
  void Follow(const PhotonStart& start, int leader, PhotonRandom& random, PhotonListener& listener,
    PhotonWalk::Counts& counts) const;

  const PhotonScattering& Owner;
  const PatchScene& Scene;
  std::vector<int> Bands;
  std::vector<bool> CanScatter;
  UniformBands Paths;
  const VaryingMedium* Varying; ///< nullptr where the medium does not
  PhotonWalk Walk;
  PhotonSource Source;
  PhotonTally Tally;
  long long Photons = 0;
  PhotonWalk::Counts Counts; ///< of all ranks
};

//------------------------------------------------------------------------------
std::vector<std::vector<int>> PhotonScattering::GroupBands(
  const std::vector<double>& entering) const
{
  const auto bands = static_cast<int>(this->Media.size());
  std::vector<std::vector<int>> groups;
  for (int band = 0; band < bands; ++band)
  {
    double flux = 0.0;
    for (std::size_t k = band; k < entering.size(); k += bands)
    {
      flux += entering[k];
    }
    if (flux == 0.0)
    {
      continue;
    }
    const auto group = std::find_if(groups.begin(), groups.end(),
      [&](const auto& others) {
        return !this->Image && this->Media[others[0]].Anisotropy == this->Media[band].Anisotropy;
      });
    if (group != groups.end())
    {
      group->push_back(band);
    }
    else
    {
      groups.push_back({ band });
    }
  }
  return groups;
}

//------------------------------------------------------------------------------
std::vector<PhotonMedium> PhotonScattering::ChooseMedia(const std::vector<int>& bands) const
{
  std::vector<PhotonMedium> media;
  for (const int band : bands)
  {
    media.push_back(this->Media[band]);
  }
  return media;
}

//------------------------------------------------------------------------------
std::vector<PhotonMedium> PhotonScattering::GetMedia(const std::vector<ScatteringMedium>& bands,
  double millimeters)
{
  std::vector<PhotonMedium> media;
  for (const ScatteringMedium& band : bands)
  {
    media.push_back({ band.Scattering * millimeters / (1.0 - band.Anisotropy),
      band.Absorption * millimeters, band.Anisotropy });
  }
  return media;
}

//------------------------------------------------------------------------------
/// What enters through each patch in some of the bands.
std::vector<double> PhotonScattering::GetFlux(const std::vector<int>& bands,
  const std::vector<double>& entering) const
{
  std::vector<double> flux;
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    for (const int band : bands)
    {
      flux.push_back(entering[patch * this->Media.size() + band] * this->Scene.GetAreas()[patch]);
    }
  }
  return flux;
}

//------------------------------------------------------------------------------
double PhotonScattering::GetBallSize(const std::vector<VaryingMedium>& varying) const
{
  double extinction = std::numeric_limits<double>::infinity();
  for (const PhotonMedium& medium : this->Media)
  {
    extinction = std::min(extinction, medium.GetExtinction());
  }
  for (const VaryingMedium& medium : varying)
  {
    extinction = std::min(extinction, medium.GetMeanMajorant());
  }
  return std::min(FreePathsPerBall / extinction, 1.0);
}

//------------------------------------------------------------------------------
Outcome PhotonScattering::Run(const std::vector<double>& entering, const Settings& settings,
  const Ranks& ranks, const Monitor& monitor, Result& result, PhotonRecorder* recorder) const
{
  result = this->MakeResult();
  std::vector<VaryingMedium> varying;
  for (std::size_t band = 0; band < this->Media.size() && this->Image; ++band)
  {
    varying.emplace_back(*this->Image, this->Media[band], static_cast<int>(band));
  }
  MeshBoundary boundary;
  Outcome done = boundary.Build(this->Scene, this->GetBallSize(varying));
  const std::vector<std::vector<int>> groups = this->GroupBands(entering);
  const auto count = static_cast<double>(groups.size());
  for (std::size_t k = 0; k < groups.size() && done; ++k)
  {
    Group group(*this, groups[k], boundary, entering,
      this->Image ? &varying[groups[k][0]] : nullptr);
    Settings share = settings;
    share.NumberOfPhotons = (settings.NumberOfPhotons + groups.size() - 1) / groups.size();
    done = group.Run(share, ranks, monitor.GetStage(k / count, (k + 1) / count), recorder);
    group.Collect(ranks, result);
  }
  return done;
}

//------------------------------------------------------------------------------
Outcome PhotonScattering::Group::Run(const Settings& settings, const Ranks& ranks,
  const Monitor& monitor, PhotonRecorder* recorder)
{
  long long planned = settings.NumberOfPhotons > 0 ? settings.NumberOfPhotons : FirstPhotons;
  long long turn = FirstTurn;
  while (this->Photons < planned)
  {
    const long long count = std::min(turn, planned - this->Photons);
    this->Trace(count, settings.Seed, ranks, recorder);
    const double work = WorkPerPhoton + double(this->Counts.Scatterings) / this->Photons;
    turn = std::max(static_cast<long long>(ScatteringsPerReport / work), FewestPhotons);
    if (settings.NumberOfPhotons == 0 && this->Photons == planned)
    {
      Result result = this->Owner.MakeResult();
      this->Collect(ranks, result);
      const double excess =
        *std::max_element(result.RelativeErrors.begin(), result.RelativeErrors.end()) /
        settings.TargetError;
      const double wanted = this->Photons * std::min(Reserve * excess * excess, MostGrowth);
      planned = static_cast<long long>(excess > 1.0 ? std::min(wanted, MostPhotons) : 0.0);
    }
    if (!monitor.Report(double(this->Photons) / std::max(planned, this->Photons)))
    {
      return Outcome::Aborted();
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Every rank takes some of them.
void PhotonScattering::Group::Trace(long long count, std::uint64_t seed, const Ranks& ranks,
  PhotonRecorder* recorder)
{
  std::mutex mutex;
  PhotonWalk::Counts all;
  std::vector<PhotonRecorder::Event> allEvents;
  const auto work = [&](vtkIdType begin, vtkIdType end)
  {
    PhotonWalk::Counts counts;
    std::vector<PhotonRecorder::Event> events;
    // Those of one leader are alike.
    std::vector<PhotonTally::Pair> pairs(this->Paths.GetNumber(), PhotonTally::Pair(this->Tally));
    for (vtkIdType k = begin; k < end; ++k)
    {
      if (k / PhotonsPerPart % ranks.GetNumber() != ranks.GetMine())
      {
        continue;
      }
      Pulse::Beat();
      PhotonRandom random(seed, this->Photons + k);
      const PhotonSource::Photon photon =
        this->Source.Start((k + random.Get()) / count, this->Walk, random);
      const auto leader = static_cast<int>((this->Photons + k) % this->Paths.GetNumber());
      PhotonTally::Listener listener(this->Tally, photon, pairs[leader],
        recorder ? &events : nullptr);
      this->Follow(photon.Start, leader, random, listener, counts);
      pairs[leader].End();
    }
    for (PhotonTally::Pair& pair : pairs)
    {
      pair.Close();
    }
    const std::lock_guard<std::mutex> lock(mutex);
    all.Add(counts);
    allEvents.insert(allEvents.end(), events.begin(), events.end());
  };
  Threads::For(0, count, PhotonsPerPart, work);
  if (recorder)
  {
    recorder->Add(allEvents, this->Bands);
  }
  double sums[] = { double(all.Scatterings), double(all.Entries), double(all.Rays) };
  ranks.Sum(sums, 3);
  this->Counts.Add({ static_cast<long long>(sums[0]), static_cast<long long>(sums[1]),
    static_cast<long long>(sums[2]) });
  this->Photons += count;
}

//------------------------------------------------------------------------------
void PhotonScattering::Group::Follow(const PhotonStart& start, int leader, PhotonRandom& random,
  PhotonListener& listener, PhotonWalk::Counts& counts) const
{
  if (this->Varying)
  {
    VaryingPath path(*this->Varying);
    this->Walk.Follow(start, true, path, random, listener, counts);
    return;
  }
  UniformPath path(this->Paths, leader);
  this->Walk.Follow(start, true, path, random, listener, counts);
}

//------------------------------------------------------------------------------
// Where no two photons have done different things: what nothing has reached may be reached by the
// next one, and what few have reached by one less.
double PhotonScattering::Group::GetDeviationOfNext(double left, std::size_t band) const
{
  return left > 0.0 ? std::min(left, 1.0) : (this->CanScatter[band] ? 1.0 : 0.0);
}

//------------------------------------------------------------------------------
// Write the bands of this group to those of all.
void PhotonScattering::Group::Collect(const Ranks& ranks, Result& result) const
{
  const PhotonTally::Totals totals = this->Tally.Collect(ranks);
  const SceneFaces& faces = this->Scene.GetFaces();
  const std::size_t all = result.RelativeErrors.size();
  const std::size_t mine = this->Bands.size();
  const auto count = static_cast<double>(this->Photons);
  for (std::size_t k = 0; k < mine; ++k)
  {
    const int band = this->Bands[k];
    double squares = 0.0;
    double errors = 0.0;
    double allLeft = 0.0;
    for (vtkIdType face = 0; face < faces.GetNumberOfFaces(); ++face)
    {
      const double left = totals.Left[face * mine + k];
      const double area = faces.GetArea(face);
      if (area == 0.0)
      {
        continue;
      }
      const double perPhoton = this->Source.GetFlux(static_cast<int>(k)) / (count * area);
      const double variance = totals.LeftVariances[face * mine + k];
      const double value = perPhoton * left;
      const double error =
        perPhoton * (variance > 0.0 ? std::sqrt(variance) : this->GetDeviationOfNext(left, k));
      result.Scattered[face * all + band] = value;
      result.Errors[face * all + band] = error;
      squares += area * value * value;
      errors += area * error * error;
      allLeft += left;
    }
    result.RelativeErrors[band] = errors > 0.0 ? std::sqrt(errors / squares) : 0.0;
    result.LeavingShares[band] = totals.Leaving[k] / count;
    result.LeavingShareErrors[band] = std::sqrt(totals.LeavingVariances[k]) / count;
    result.UnscatteredShares[band] = totals.Unscattered[k] / count;
    result.LostShares[band] = totals.Lost[k] / count;
    result.PhotonsOfBands[band] = count;
    result.MeanWeights[band] = allLeft > 0.0 ? totals.WeightSquares[k] / allLeft : 0.0;
  }
  result.Photons += this->Photons;
  result.Counts.Add(this->Counts);
}

//------------------------------------------------------------------------------
PhotonScattering::Result PhotonScattering::MakeResult() const
{
  const std::size_t bands = this->Media.size();
  const std::size_t faces = this->Scene.GetFaces().GetNumberOfFaces();
  Result result;
  for (auto* values : { &result.Scattered, &result.Errors })
  {
    values->assign(faces * bands, 0.0);
  }
  for (auto* values :
    { &result.RelativeErrors, &result.LeavingShares, &result.LeavingShareErrors,
      &result.UnscatteredShares, &result.LostShares, &result.PhotonsOfBands, &result.MeanWeights })
  {
    values->assign(bands, 0.0);
  }
  return result;
}
} // namespace LightTransport
