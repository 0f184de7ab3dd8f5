// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/LinkCheck.h"

#include "Geometry/PatchRays.h"
#include "Geometry/ShaftCuller.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/PatchPairs.h"
#include "ViewFactors/UnoccludedPairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
// Patches that are checked, at most; the part of them that is chosen by area alone.
constexpr int Samples = 96;
constexpr double ShareByArea = 0.2;
// Rays of each, in groups whose spread is what they are off by: the groups are parts of one
// sequence, whose variance falls with this power of their number.
constexpr int Rays = 1024;
constexpr int Groups = 8;
constexpr double VariancePower = 1.24;
// Patches with which the exchange is exact, at most, and how exact.
constexpr std::size_t MostBright = 64;
constexpr double PairTolerance = 1e-3;
constexpr double Visible = 0x1p-8;
} // namespace

//------------------------------------------------------------------------------
// What the square of an error of H counts.
double LinkCheck::GetWeight(std::size_t k, bool isReflected) const
{
  const double reflectance = isReflected ? this->Solved.Reflectance[k] : 1.0;
  return this->Scene.GetAreas()[k / this->Solved.NumberOfBands] * reflectance * reflectance;
}

//------------------------------------------------------------------------------
// What the error is relative to, of each band.
std::vector<double> LinkCheck::SumLight(bool isReflected) const
{
  std::vector<double> sums(this->Solved.NumberOfBands, 0.0);
  for (std::size_t k = 0; k < this->Solved.Irradiance.size(); ++k)
  {
    const double irradiance = this->Solved.Irradiance[k];
    sums[k % sums.size()] += this->GetWeight(k, isReflected) * irradiance * irradiance;
  }
  return sums;
}

//------------------------------------------------------------------------------
// The part of each patch in that, of all bands.
std::vector<double> LinkCheck::FindLight(const std::vector<double>& sums, bool isReflected) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> light(areas.size());
  std::transform(areas.begin(), areas.end(), light.begin(),
    [=](double each) { return ShareByArea * each / area; });
  const auto bands = static_cast<double>(
    std::count_if(sums.begin(), sums.end(), [](double sum) { return sum > 0.0; }));
  for (std::size_t k = 0; k < this->Solved.Irradiance.size(); ++k)
  {
    if (const double sum = sums[k % sums.size()]; sum > 0.0)
    {
      const double counts =
        this->GetWeight(k, isReflected) * std::pow(this->Solved.Irradiance[k], 2);
      light[k / sums.size()] += (1.0 - ShareByArea) / bands * counts / sum;
    }
  }
  return light;
}

//------------------------------------------------------------------------------
// At equal steps of the light, in the order of the tree.
std::vector<LinkCheck::Sample> LinkCheck::ChooseSamples(const std::vector<double>& light) const
{
  const double step = std::accumulate(light.begin(), light.end(), 0.0) / Samples;
  std::vector<Sample> samples;
  double before = 0.0;
  for (std::size_t patch = 0; patch < light.size(); ++patch)
  {
    const double first = std::ceil(before / step - 0.5);
    before += light[patch];
    const double count = std::ceil(before / step - 0.5) - first;
    if (count > 0.0)
    {
      samples.push_back({ static_cast<vtkIdType>(patch), count * step / light[patch] });
    }
  }
  return samples;
}

//------------------------------------------------------------------------------
// Patches whose light is least like that of others: what rays happen to meet of it says little.
std::vector<vtkIdType> LinkCheck::ChooseBright() const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const int bands = this->Solved.NumberOfBands;
  std::vector<double> unlike(areas.size(), 0.0);
  for (int band = 0; band < bands; ++band)
  {
    const auto get = [&](std::size_t patch)
    { return this->Solved.Radiosity[patch * bands + band]; };
    double mean = 0.0, most = 0.0;
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      mean += areas[patch] * get(patch) / area;
      most = std::max(most, std::abs(get(patch)));
    }
    for (std::size_t patch = 0; patch < areas.size() && most > 0.0; ++patch)
    {
      unlike[patch] += areas[patch] * std::pow((get(patch) - mean) / most, 2);
    }
  }
  std::vector<vtkIdType> order(areas.size());
  std::iota(order.begin(), order.end(), vtkIdType(0));
  const std::size_t count = std::min(MostBright, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
    [&](vtkIdType a, vtkIdType b)
    { return unlike[a] != unlike[b] ? unlike[a] > unlike[b] : a < b; });
  order.resize(count);
  return order;
}

//------------------------------------------------------------------------------
// Samples of this rank; of each the square of what is wrong with its H, of each band.
struct LinkCheck::Checker
{
  const LinkCheck& Outer;
  const PatchRays& Caster;
  const PatchPairs& Pairs;
  const std::vector<vtkIdType>& Bright;
  const std::vector<Sample>& Chosen;
  const Ranks& AllRanks;
  std::vector<bool> IsBright;
  RayPattern Pattern;
  std::vector<double> Squares; ///< samples x bands

  void operator()(vtkIdType begin, vtkIdType end)
  {
    const int bands = this->Outer.Solved.NumberOfBands;
    PairVisibility visibility;
    std::vector<PatchRays::Hit> hits(Rays);
    std::vector<double> exact, groups;
    for (vtkIdType sample = begin; sample < end; ++sample)
    {
      Pulse::Beat();
      if (sample % this->AllRanks.GetNumber() != this->AllRanks.GetMine())
      {
        continue;
      }
      const vtkIdType patch = this->Chosen[sample].Patch;
      this->Caster.Cast(patch, this->Pattern, hits.data());
      this->AddExact(patch, visibility, exact);
      this->AddRays(hits, groups);
      for (int band = 0; band < bands; ++band)
      {
        this->Squares[sample * bands + band] =
          this->Compare(patch * bands + band, exact[band], groups.data() + band * Groups);
      }
    }
  }

  void AddExact(vtkIdType patch, PairVisibility& visibility, std::vector<double>& exact) const
  {
    const int bands = this->Outer.Solved.NumberOfBands;
    exact.assign(bands, 0.0);
    for (const vtkIdType other : this->Bright)
    {
      if (other == patch)
      {
        continue;
      }
      PatchPairs::View view = this->Pairs.Look(patch, other, false, visibility);
      const auto share = this->Pairs.See(patch, other, Visible, visibility, view);
      const double factor =
        static_cast<double>(view.Kernel) * share.Value * this->Outer.Scene.GetAreas()[other];
      for (int band = 0; band < bands; ++band)
      {
        exact[band] += factor * this->Outer.Solved.Radiosity[other * bands + band];
      }
    }
  }

  // What each group of rays brings of the rest, band by band.
  void AddRays(const std::vector<PatchRays::Hit>& hits, std::vector<double>& groups) const
  {
    const Solution& solved = this->Outer.Solved;
    const int bands = solved.NumberOfBands;
    groups.assign(static_cast<std::size_t>(bands) * Groups, 0.0);
    for (int ray = 0; ray < Rays; ++ray)
    {
      const PatchRays::Hit hit = hits[ray];
      const bool isSky = hit == PatchRays::Sky && !solved.Background.empty();
      if (!isSky && (hit < 0 || this->IsBright[hit]))
      {
        continue;
      }
      const double* light = isSky ? solved.Background.data()
                                  : solved.Radiosity.data() + static_cast<std::size_t>(hit) * bands;
      for (int band = 0; band < bands; ++band)
      {
        groups[band * Groups + ray * Groups / Rays] += light[band] * Groups / Rays;
      }
    }
  }

  double Compare(std::size_t k, double exact, const double* groups) const
  {
    const double mean = std::accumulate(groups, groups + Groups, 0.0) / Groups;
    double spread = 0.0;
    for (int group = 0; group < Groups; ++group)
    {
      spread += std::pow(groups[group] - mean, 2) / (Groups - 1);
    }
    const double difference = this->Outer.Solved.Received[k] - exact - mean;
    return difference * difference - spread * std::pow(Groups, -VariancePower);
  }
};

//------------------------------------------------------------------------------
double LinkCheck::SumUp(const std::vector<Sample>& samples, const std::vector<double>& squares,
  const std::vector<double>& sums, bool isReflected) const
{
  double error = 0.0;
  for (std::size_t band = 0; band < sums.size(); ++band)
  {
    double square = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      square += samples[k].Weight *
        this->GetWeight(samples[k].Patch * sums.size() + band, isReflected) *
        squares[k * sums.size() + band];
    }
    error = sums[band] > 0.0 ? std::max(error, square / sums[band]) : error;
  }
  return std::sqrt(error);
}

//------------------------------------------------------------------------------
Outcome LinkCheck::Find(const Ranks& ranks, const Monitor& monitor, double& error) const
{
  error = 0.0;
  std::vector<double> sums = this->SumLight(true);
  const bool isReflected = *std::max_element(sums.begin(), sums.end()) > 0.0;
  sums = isReflected ? sums : this->SumLight(false);
  if (*std::max_element(sums.begin(), sums.end()) <= 0.0)
  {
    return Outcome::Done();
  }
  PatchRays rays;
  if (Outcome ready = ranks.Agree(rays.Build(this->Scene)); !ready)
  {
    return ready;
  }
  const UnoccludedPairs open(this->Scene, PairTolerance);
  const ShaftCuller culler(this->Scene);
  const PatchPairs pairs(this->Scene, open, culler);
  const std::vector<Sample> samples = this->ChooseSamples(this->FindLight(sums, isReflected));
  const std::vector<vtkIdType> bright = this->ChooseBright();
  Checker checker{ *this, rays, pairs, bright, samples, ranks,
    std::vector<bool>(this->Scene.GetNumberOfPatches(), false), RayPattern(0, Rays),
    std::vector<double>(samples.size() * sums.size(), 0.0) };
  for (const vtkIdType patch : bright)
  {
    checker.IsBright[patch] = true;
  }
  Threads::For(0, static_cast<vtkIdType>(samples.size()), 1, checker);
  ranks.Sum(checker.Squares);
  error = this->SumUp(samples, checker.Squares, sums, isReflected);
  return monitor.Check(1.0);
}
} // namespace LightTransport
