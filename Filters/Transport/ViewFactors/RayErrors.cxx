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

namespace LightTransport
{
namespace
{
// Steps towards the weights that close the links of a group, each of which leaves at most half of
// what is not closed.
constexpr int ClosingSteps = 6;
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
  std::vector<double> Sky;      ///< what leaves
  std::vector<double> Open;     ///< and what meets back faces as well
  std::vector<double> Received; ///< of the radiosity
};

//------------------------------------------------------------------------------
RayErrors::RayErrors(const PatchScene& scene, const RayHits& hits, const Links& links,
  const Ranks& ranks)
  : Scene(scene), Hits(hits), AllLinks(links), AllRanks(ranks)
{
}

//------------------------------------------------------------------------------
// A group to a thread: none of them writes what another does.
void RayErrors::SumHits(const std::vector<double>& radiosity, int numberOfBands, Sums& sums) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const std::vector<double>& weights = this->AllLinks.Hierarchy->GetWeights();
  const std::size_t patches = areas.size();
  const int rays = this->AllLinks.RaysPerPatch;
  for (auto* values : { &sums.Rows, &sums.Sky, &sums.Open })
  {
    values->assign(patches * Groups, 0.0);
  }
  sums.Received.assign(patches * Groups * numberOfBands, 0.0);
  const auto count = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType group = begin; group < end; ++group)
    {
      const int first = static_cast<int>(group) * (rays / Groups);
      const double share = static_cast<double>(Groups) / rays;
      for (vtkIdType patch = this->Hits.GetFirst(); patch < this->Hits.GetLast(); ++patch)
      {
        Pulse::Beat(patch);
        if (this->AllLinks.IsExact(patch))
        {
          continue;
        }
        const std::size_t here = patch * Groups + group;
        this->Hits.Visit(patch, first, first + rays / Groups,
          [&](RayHits::Hit hit)
          {
            if (hit < 0)
            {
              const double open = weights[patch] * share;
              sums.Open[here] += open;
              sums.Sky[here] += hit == PatchRays::Sky ? open : 0.0;
              return;
            }
            if (this->AllLinks.IsExact(hit))
            {
              return;
            }
            const double exchange =
              share * weights[patch] * weights[hit] / (areas[patch] + areas[hit]);
            const std::size_t there = static_cast<std::size_t>(hit) * Groups + group;
            sums.Rows[here] += exchange;
            sums.Rows[there] += exchange;
            for (int band = 0; band < numberOfBands; ++band)
            {
              sums.Received[here * numberOfBands + band] +=
                exchange * radiosity[static_cast<std::size_t>(hit) * numberOfBands + band];
              sums.Received[there * numberOfBands + band] +=
                exchange * radiosity[patch * numberOfBands + band];
            }
          });
      }
    }
  };
  Threads::For(0, Groups, 1, count);
  for (auto* values : { &sums.Rows, &sums.Sky, &sums.Open, &sums.Received })
  {
    this->AllRanks.Sum(*values);
  }
}

//------------------------------------------------------------------------------
Outcome RayErrors::FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
  const std::vector<double>& background, std::vector<double>& differences) const
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  const std::size_t patches = areas.size();
  Sums sums;
  this->SumHits(radiosity, numberOfBands, sums);
  std::vector<double> changes, received;
  if (Outcome closed = this->Close(radiosity, numberOfBands, sums, changes, received); !closed)
  {
    return closed;
  }
  differences.assign(sums.Received.size(), 0.0);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    const double sky = this->AllLinks.SkyFractions[patch] * areas[patch];
    for (int band = 0; band < numberOfBands; ++band)
    {
      const auto at = [&](int group) { return (patch * Groups + group) * numberOfBands + band; };
      double mean = 0.0;
      for (int group = 0; group < Groups; ++group)
      {
        mean += sums.Received[at(group)] / Groups;
      }
      for (int group = 0; group < Groups && !this->AllLinks.IsExact(patch); ++group)
      {
        const std::size_t here = patch * Groups + group;
        double difference =
          sums.Received[at(group)] - mean + changes[here] * mean + received[at(group)];
        if (!background.empty())
        {
          difference += (sums.Sky[here] * (1.0 + changes[here]) - sky) * background[band];
        }
        differences[at(group)] = difference / areas[patch];
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
  const std::size_t patches = this->Scene.GetAreas().size();
  changes.assign(patches * Groups, 0.0);
  std::vector<double> wholes(patches, 0.0);
  std::vector<double> missing(patches * Groups, 0.0);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    for (int group = 0; group < Groups; ++group)
    {
      const std::size_t here = patch * Groups + group;
      missing[here] = -(sums.Rows[here] + sums.Open[here]);
      wholes[patch] -= missing[here] / Groups;
    }
    for (int group = 0; group < Groups; ++group)
    {
      missing[patch * Groups + group] += wholes[patch];
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
        this->AllLinks.IsExact(patch) == this->AllLinks.IsExact(other))
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
