// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/RayErrors.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "ViewFactors/RayHits.h"
#include "vtkCPULinkOperator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
// Steps towards the weights that close the links of a group, each of which leaves at most half of
// what is not closed.
constexpr int ClosingSteps = 4;
// The variance of N points of the sequence falls with this power of N, beside 1 of independent
// ones.
constexpr double VariancePower = 1.24;
// Neighbours on either side whose variances count as well, and the cosine from which on they do.
constexpr vtkIdType PooledPatches = 3;
constexpr double FacingAlike = 0.8;
} // namespace

//------------------------------------------------------------------------------
// What the rays of each group give, patches x groups [x bands].
struct RayErrors::Sums
{
  std::vector<double> Rows;     ///< sum of the exchange with others
  std::vector<double> Sampled;  ///< the part of a patch's own rays that are part of that
  std::vector<double> Sky;      ///< that leave
  std::vector<double> Open;     ///< and that leave or meet back faces
  std::vector<double> Received; ///< of the radiosity
  std::vector<double> Apart;    ///< of it by links of patches that cast more rays
};

//------------------------------------------------------------------------------
RayErrors::RayErrors(const PatchScene& scene, const RayHits& hits, const Links& links,
  const Ranks& ranks)
  : Scene(scene), Hits(hits), AllLinks(links), AllRanks(ranks)
{
}

//------------------------------------------------------------------------------
// What the rays of one group give, patch by patch: sums of their own, that are near each other.
class RayErrors::GroupSums
{
public:
  GroupSums(const RayErrors& errors, const std::vector<double>& radiosity, int numberOfBands)
    : Owner(errors), Radiosity(radiosity), Bands(numberOfBands),
      Partners(errors.Scene.GetAreas().size())
  {
    const std::vector<double>& weights = errors.AllLinks.Hierarchy->GetWeights();
    const Links& links = errors.AllLinks;
    for (vtkIdType patch = 0; patch < static_cast<vtkIdType>(this->Partners.size()); ++patch)
    {
      const double area = errors.Scene.GetAreas()[patch];
      this->Partners[patch] = { links.IsExact(patch) ? 0.0 : weights[patch], area,
        links.Rays.GetTimes(patch) };
    }
  }

  void Add(int group, Sums& sums)
  {
    this->Rows.assign(this->Partners.size(), 0.0);
    this->Received.assign(this->Radiosity.size(), 0.0);
    this->Apart.assign(this->Radiosity.size(), 0.0);
    const RayHits& hits = this->Owner.Hits;
    for (vtkIdType patch = hits.GetFirst(); patch < hits.GetLast(); ++patch)
    {
      Pulse::Beat(patch);
      if (this->Partners[patch].Weight > 0.0)
      {
        this->AddPatch(patch, group, sums);
      }
    }
    for (std::size_t patch = 0; patch < this->Partners.size(); ++patch)
    {
      const std::size_t here = patch * Groups + group;
      sums.Rows[here] = this->Rows[patch];
      for (int band = 0; band < this->Bands; ++band)
      {
        sums.Received[here * this->Bands + band] = this->Received[patch * this->Bands + band];
        sums.Apart[here * this->Bands + band] = this->Apart[patch * this->Bands + band];
      }
    }
  }

private:
  /// What a ray needs of the patch that it meets; no weight: the link is exact.
  struct Partner
  {
    double Weight;
    double Area;
    int Times; ///< by which it casts more rays than others
  };

  void AddPatch(vtkIdType patch, int group, Sums& sums)
  {
    const Partner here = this->Partners[patch];
    const double each = this->Owner.AllLinks.Rays.Each / Groups;
    const int rays = here.Times * this->Owner.AllLinks.Rays.Each / Groups;
    int sampled = 0, sky = 0, open = 0;
    this->Owner.Hits.Visit(patch, group * rays, (group + 1) * rays,
      [&](RayHits::Hit hit)
      {
        if (hit < 0)
        {
          ++open;
          sky += hit == PatchRays::Sky ? 1 : 0;
          return;
        }
        const Partner there = this->Partners[hit];
        const bool isApart = here.Times > 1 || there.Times > 1;
        const double known = isApart ? here.Area * there.Area : here.Weight * there.Weight;
        const double exchange = there.Weight > 0.0
          ? known / (each * (here.Times * there.Area + there.Times * here.Area))
          : 0.0;
        if (!isApart)
        {
          sampled += exchange > 0.0 ? 1 : 0;
          this->Rows[patch] += exchange;
          this->Rows[hit] += exchange;
        }
        std::vector<double>& received = isApart ? this->Apart : this->Received;
        for (int band = 0; band < this->Bands; ++band)
        {
          const std::size_t mine = patch * this->Bands + band;
          const std::size_t other = static_cast<std::size_t>(hit) * this->Bands + band;
          received[mine] += exchange * this->Radiosity[other];
          received[other] += exchange * this->Radiosity[mine];
        }
      });
    const std::size_t place = patch * Groups + group;
    sums.Sampled[place] = static_cast<double>(sampled) / rays;
    sums.Sky[place] = static_cast<double>(sky) / rays;
    sums.Open[place] = static_cast<double>(open) / rays;
  }

  const RayErrors& Owner;
  const std::vector<double>& Radiosity;
  int Bands;
  std::vector<Partner> Partners;
  std::vector<double> Rows;
  std::vector<double> Received;
  std::vector<double> Apart;
};

//------------------------------------------------------------------------------
// A group to a thread: none of them writes what another does.
void RayErrors::SumHits(const std::vector<double>& radiosity, int numberOfBands, Sums& sums) const
{
  const std::size_t patches = this->Scene.GetAreas().size();
  for (auto* values : { &sums.Rows, &sums.Sampled, &sums.Sky, &sums.Open })
  {
    values->assign(patches * Groups, 0.0);
  }
  sums.Received.assign(patches * Groups * numberOfBands, 0.0);
  sums.Apart = sums.Received;
  const auto add = [&](vtkIdType begin, vtkIdType end)
  {
    GroupSums sum(*this, radiosity, numberOfBands);
    for (vtkIdType group = begin; group < end; ++group)
    {
      sum.Add(static_cast<int>(group), sums);
    }
  };
  Threads::For(0, Groups, 1, add);
  for (auto* values :
    { &sums.Rows, &sums.Sampled, &sums.Sky, &sums.Open, &sums.Received, &sums.Apart })
  {
    this->AllRanks.Sum(*values);
  }
}

//------------------------------------------------------------------------------
// What sampled links of a row sum to.
double RayErrors::GetWhole(std::size_t patch, const Sums& sums)
{
  const auto first = sums.Rows.begin() + static_cast<std::ptrdiff_t>(patch * Groups);
  return std::accumulate(first, first + Groups, 0.0) / Groups;
}

//------------------------------------------------------------------------------
// What links that stand apart leave of a row.
double RayErrors::GetRest(std::size_t patch, const Sums& sums) const
{
  return GetWhole(patch, sums) / this->Scene.GetAreas()[patch] +
    this->AllLinks.SkyFractions[patch] + this->AllLinks.BackFaceFractions[patch];
}

//------------------------------------------------------------------------------
// Of each band, over the scene.
std::vector<double> RayErrors::FindMeans(const std::vector<double>& radiosity,
  int numberOfBands) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> means(numberOfBands, 0.0);
  for (std::size_t k = 0; k < radiosity.size(); ++k)
  {
    means[k % numberOfBands] += areas[k / numberOfBands] / whole * radiosity[k];
  }
  return means;
}

//------------------------------------------------------------------------------
// What is the same everywhere closed rows carry without error, but for what they take for open.
Outcome RayErrors::FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
  const std::vector<double>& background, std::vector<double>& differences,
  std::vector<double>&) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const std::size_t patches = areas.size();
  const std::vector<double> means = this->FindMeans(radiosity, numberOfBands);
  std::vector<double> uneven = radiosity;
  for (std::size_t k = 0; k < uneven.size(); ++k)
  {
    uneven[k] -= means[k % numberOfBands];
  }
  Sums sums;
  this->SumHits(uneven, numberOfBands, sums);
  std::vector<double> changes, fromOthers;
  if (Outcome closed = this->Close(uneven, numberOfBands, sums, changes, fromOthers); !closed)
  {
    return closed;
  }
  differences.assign(sums.Received.size(), 0.0);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    const double sky = this->AllLinks.SkyFractions[patch];
    const double open = sky + this->AllLinks.BackFaceFractions[patch];
    const double rest = this->GetRest(patch, sums);
    for (int band = 0; band < numberOfBands; ++band)
    {
      const auto at = [&](int group) { return (patch * Groups + group) * numberOfBands + band; };
      double mean = 0.0, meanApart = 0.0;
      for (int group = 0; group < Groups; ++group)
      {
        mean += sums.Received[at(group)] / Groups;
        meanApart += sums.Apart[at(group)] / Groups;
      }
      for (int group = 0; group < Groups && !this->AllLinks.IsExact(patch); ++group)
      {
        const std::size_t here = patch * Groups + group;
        const double scaled = this->AllLinks.IsApart(patch)
          ? 0.0
          : sums.Received[at(group)] - mean + changes[here] * mean + fromOthers[at(group)];
        const double received = scaled + sums.Apart[at(group)] - meanApart;
        const double own = sums.Sampled[here] + sums.Open[here];
        const double moreSky = own > 0.0 ? rest * sums.Sky[here] / own - sky : 0.0;
        const double moreOpen = own > 0.0 ? rest * sums.Open[here] / own - open : 0.0;
        differences[at(group)] = received / areas[patch] - moreOpen * means[band] +
          (background.empty() ? 0.0 : moreSky * background[band]);
      }
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// The change of each group's weights that closes its rows, and what others' changes do to what a
// patch receives: to first order, with the links of all rays.
Outcome RayErrors::Close(const std::vector<double>& radiosity, int numberOfBands, const Sums& sums,
  std::vector<double>& changes, std::vector<double>& received) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const std::size_t patches = areas.size();
  changes.assign(patches * Groups, 0.0);
  std::vector<double> wholes(patches, 0.0);
  std::vector<double> missing(patches * Groups, 0.0);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    wholes[patch] = GetWhole(patch, sums);
    const double rest = areas[patch] * this->GetRest(patch, sums);
    for (std::size_t here = patch * Groups; here < (patch + 1) * Groups; ++here)
    {
      const double own = sums.Sampled[here] + sums.Open[here];
      const double target = own > 0.0 ? rest * sums.Sampled[here] / own : wholes[patch];
      missing[here] = target - sums.Rows[here];
    }
  }
  auto product = LinkOperators::MakeOnCPU(this->AllLinks.Hierarchy, Groups, this->AllRanks);
  std::vector<double> moved(patches * Groups, 0.0);
  bool good = product != nullptr;
  for (int step = 0; good && step < ClosingSteps; ++step)
  {
    for (std::size_t k = 0; k < changes.size(); ++k)
    {
      const double whole = wholes[k / Groups];
      changes[k] += whole > 0.0 ? 0.5 * ((missing[k] - moved[k]) / whole - changes[k]) : 0.0;
    }
    good = product->SetVector(0, changes.data()) && product->Multiply(1, 0) &&
      product->GetVector(1, moved.data());
  }
  const int all = Groups * numberOfBands;
  std::vector<double> sent(patches * all);
  for (std::size_t k = 0; k < sent.size(); ++k)
  {
    const std::size_t patch = k / all;
    sent[k] = changes[k / numberOfBands] * radiosity[patch * numberOfBands + k % numberOfBands];
  }
  received.resize(sent.size());
  product = LinkOperators::MakeOnCPU(this->AllLinks.Hierarchy, all, this->AllRanks);
  good = good && product && product->SetVector(0, sent.data()) && product->Multiply(1, 0) &&
    product->GetVector(1, received.data());
  return good ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
// Groups alone tell a variance by seven differences; with those of some patches beside it in the
// order of the tree, which are near and face alike, by thirty and more.
std::vector<double> RayErrors::GetDeviations(const std::vector<double>& differences) const
{
  static const double scale = std::pow(Groups, 1.0 - VariancePower) / (Groups * (Groups - 1.0));
  const auto patches = static_cast<vtkIdType>(this->Scene.GetAreas().size());
  const auto bands = static_cast<vtkIdType>(differences.size()) / (patches * Groups);
  std::vector<double> variances(patches * bands, 0.0);
  for (vtkIdType k = 0; k < static_cast<vtkIdType>(differences.size()); ++k)
  {
    variances[k / (Groups * bands) * bands + k % bands] += scale * differences[k] * differences[k];
  }
  std::vector<double> deviations(variances.size(), 0.0);
  for (vtkIdType k = 0; k < static_cast<vtkIdType>(variances.size()); ++k)
  {
    const vtkIdType patch = k / bands;
    double sum = 0.0;
    int count = 0;
    for (vtkIdType other = std::max<vtkIdType>(patch - PooledPatches, 0);
         other <= std::min(patch + PooledPatches, patches - 1); ++other)
    {
      if (this->Scene.GetNormal(patch).dot(this->Scene.GetNormal(other)) > FacingAlike &&
        this->AllLinks.IsApart(patch) == this->AllLinks.IsApart(other))
      {
        sum += variances[other * bands + k % bands];
        ++count;
      }
    }
    deviations[k] = std::sqrt(0.5 * (variances[k] + sum / count));
  }
  return deviations;
}
} // namespace LightTransport
