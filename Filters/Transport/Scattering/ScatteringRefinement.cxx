// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringRefinement.h"

#include "Links/LinkChoice.h"
#include "Scattering/ScatteringRows.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace LightTransport
{
namespace
{
using Values = ScatteringIntegrals::Bands;

/// Receivers of a sample, by which rows are foreseen.
constexpr vtkIdType SampleSize = 256;
/// Where the light is given, which may be sharp.
constexpr vtkIdType LitSampleSize = 512;
/// Deviation of the light from its mean over a cluster, as a part of it.
constexpr double Deviation = 0.6;
///@{ Thresholds that are tried: of what a patch receives, largest and smallest, and steps of
/// halving between.
constexpr double LargestThreshold = 1.0;
constexpr double SmallestThreshold = 1e-10;
constexpr int ThresholdSteps = 12;
///@}
///@{ Links that others are compared with, where the light is given: their error by its deviation,
/// as a part of the tolerance, how many a receiver has at most, and steps to find them.
constexpr double FineShare = 0.03;
constexpr double MostFineLinks = 4096.0;
constexpr int FineSteps = 6;
///@}
/// The error is that much larger than what a sample misses beside finer links, at most: these have
/// the same errors of values (the bunny, a plate and the dragon of 10 to 1,000 mean free paths).
constexpr double MarginOfSample = 1.2;
/// Squared deviation of the profile from its mean over a cluster, as parts of it, that its pieces
/// tell the mean of, over the tolerance of links.
constexpr double WidestPerTolerance = 25.0;
/// A sample may have that much fewer links than all receivers.
constexpr double LinkMargin = 0.98;
///@{ By what the error and the number of kept links may exceed those of others, at most, and what
/// they are refined to.
constexpr double MostGrowth = 1.2;
constexpr double GrowthAimedAt = 1.1;
///@}
/// Of kept links, over that of others: the first by which the error is what is aimed at.
constexpr double KeptThresholds[] = { 2.0, 1.5, 1.2, 1.0 };
/// As LinkMargin, of kept links.
constexpr double KeptMargin = 0.99;
/// What is left of an error by rounding.
constexpr double NoError = 1e-6;

} // namespace

//------------------------------------------------------------------------------
ScatteringRefinement::ScatteringRefinement(const ScatteringClusters& clusters,
  const std::vector<double>& areas, const std::vector<double>& light, double reference,
  double leaveOut)
  : Clusters(clusters), Areas(areas), Light(clusters, light), Reference(reference),
    LeaveOut(leaveOut)
{
}

//------------------------------------------------------------------------------
bool ScatteringRefinement::Divides(const ScatteringReceiver& receiver,
  const ScatteringReceiver::Part& part, double threshold) const
{
  const double most = part.IsKept ? threshold : std::min(threshold, this->NewThreshold);
  return this->AreDivided[part.Slot] ||
    (receiver.IsOwn(part) && (this->DividesOwn || !part.IsExact)) ||
    (this->GetDeviation(receiver, part) > most).any();
}

//------------------------------------------------------------------------------
// Of the profile, times how much more than assumed that of the light is, where it is given.
Values ScatteringRefinement::GetDeviation(const ScatteringReceiver& receiver,
  const ScatteringReceiver::Part& part) const
{
  return this->Light.HasSizes() ? this->Light.GetDeviation(receiver, part)
                                : receiver.GetDeviation(part);
}

//------------------------------------------------------------------------------
vtkIdType ScatteringRefinement::GetSampleSize() const
{
  const vtkIdType most = this->Light.GetNumberOfComponents() > 0 ? LitSampleSize : SampleSize;
  return std::min(static_cast<vtkIdType>(this->Areas.size()), most);
}

//------------------------------------------------------------------------------
vtkIdType ScatteringRefinement::GetSample(vtkIdType index) const
{
  const auto patches = static_cast<vtkIdType>(this->Areas.size());
  return (2 * index + 1) * patches / (2 * this->GetSampleSize());
}

//------------------------------------------------------------------------------
void ScatteringRefinement::Begin(double tolerance)
{
  this->AreDivided.assign(this->Clusters.GetSlots().GetNumberOfSlots(), false);
  this->LookAround();
  if (this->Light.GetNumberOfComponents() > 0)
  {
    this->LookAtLight(tolerance);
  }
}

//------------------------------------------------------------------------------
// Of what is shared with other ranks each looks from its own receivers.
void ScatteringRefinement::LookAround()
{
  const vtkIdType count = this->GetSampleSize();
  this->Receivers.assign(count, ScatteringReceiver(this->Clusters, this->LeaveOut));
  const auto look = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType k = begin; k < end; ++k)
    {
      Pulse::Beat();
      const vtkIdType patch = this->GetSample(k);
      if (ScatteringRows::IsOfRank(patch, this->SharedWith))
      {
        this->Look(patch, this->Receivers[k]);
      }
    }
  };
  Threads::For(0, count, 1, look);
}

//------------------------------------------------------------------------------
// What leaves is known well enough by what is smooth to say how large an error is, then by links
// much finer than those that are wanted.
void ScatteringRefinement::LookAtLight(double tolerance)
{
  this->WidestDeviation2 = WidestPerTolerance * tolerance;
  std::vector<double> sizes =
    this->GetSizes(this->Receive([](const ScatteringReceiver&, const ScatteringReceiver::Part& part)
      { return part.NumberBelow > 0; }));
  for (double& size : sizes)
  {
    size *= Deviation / this->Reference;
  }
  this->Light.SetSizes(sizes);
  const double threshold = this->FindThreshold(FineShare * tolerance, MostFineLinks, FineSteps);
  this->Received =
    this->Receive([&](const ScatteringReceiver& receiver, const ScatteringReceiver::Part& part)
      { return this->Divides(receiver, part, threshold); });
}

//------------------------------------------------------------------------------
// What is wide, and is not divided because its light is even, is the sum of parts that are not: the
// pieces of a cluster may agree with its centre by chance.
Values ScatteringRefinement::GetValue(const ScatteringReceiver& receiver,
  const ScatteringReceiver::Part& part) const
{
  Values value = Values::Zero();
  receiver.VisitPart(
    part,
    [&](const ScatteringReceiver::Part& below)
    {
      return !below.IsExact &&
        (receiver.GetDeviation(below).square() > this->WidestDeviation2 * below.Value.square())
          .any();
    },
    [&](const ScatteringReceiver::Part& below)
    {
      value += below.IsExact || below.IsFactor
        ? below.Value
        : this->Clusters.Integrate(receiver.GetPatch(), below.Slot);
    });
  return value;
}

//------------------------------------------------------------------------------
// Receivers x components of the light.
template <typename Divide>
std::vector<double> ScatteringRefinement::Receive(const Divide& divide) const
{
  const std::size_t components = this->Light.GetNumberOfComponents();
  std::vector<double> received(this->Receivers.size() * components, 0.0);
  const auto receive = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType k = begin; k < end; ++k)
    {
      Pulse::Beat();
      const ScatteringReceiver& receiver = this->Receivers[k];
      receiver.Visit([&](const ScatteringReceiver::Part& part) { return divide(receiver, part); },
        [&](const ScatteringReceiver::Part& part)
        {
          if (!part.IsLeftOut)
          {
            this->Light.Add(part.Slot, this->GetValue(receiver, part), &received[k * components]);
          }
        });
    }
  };
  Threads::For(0, static_cast<vtkIdType>(this->Receivers.size()), 1, receive);
  return received;
}

//------------------------------------------------------------------------------
// Root mean square of each component.
std::vector<double> ScatteringRefinement::GetSizes(const std::vector<double>& received) const
{
  const std::size_t components = this->Light.GetNumberOfComponents();
  std::vector<double> sizes(components, 0.0);
  double area = 0.0;
  for (std::size_t k = 0; k < this->Receivers.size(); ++k)
  {
    const double weight = this->Areas[this->Receivers[k].GetPatch()];
    area += weight;
    for (std::size_t component = 0; component < components; ++component)
    {
      const double value = received[k * components + component];
      sizes[component] += weight * value * value;
    }
  }
  for (double& size : sizes)
  {
    size = std::sqrt(size / area);
  }
  return sizes;
}

//------------------------------------------------------------------------------
// Relative, of the worst component; an estimate from above.
double ScatteringRefinement::GetLightError(const std::vector<double>& received) const
{
  std::vector<double> differences(received.size());
  std::transform(received.begin(), received.end(), this->Received.begin(), differences.begin(),
    std::minus<double>());
  const std::vector<double> errors = this->GetSizes(differences);
  const std::vector<double> sizes = this->GetSizes(this->Received);
  double worst = 0.0;
  for (std::size_t component = 0; component < sizes.size(); ++component)
  {
    worst = std::max(worst, sizes[component] > 0.0 ? errors[component] / sizes[component] : 0.0);
  }
  return MarginOfSample * worst;
}

//------------------------------------------------------------------------------
void ScatteringRefinement::Look(vtkIdType patch, ScatteringReceiver& receiver) const
{
  if (this->Kept)
  {
    const int* const columns = this->Kept->Columns.data();
    receiver.Look(patch, columns + this->Kept->Offsets[patch],
      columns + this->Kept->Offsets[patch + 1]);
  }
  else
  {
    receiver.Look(patch);
  }
}

//------------------------------------------------------------------------------
ScatteringRefinement::Prospect ScatteringRefinement::Measure(double threshold) const
{
  const auto count = static_cast<vtkIdType>(this->Receivers.size());
  std::vector<Values> squares(count, Values::Zero());
  std::vector<double> links(count, 0.0);
  const auto measure = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType k = begin; k < end; ++k)
    {
      Pulse::Beat();
      const ScatteringReceiver& receiver = this->Receivers[k];
      // Others have not looked.
      if (receiver.GetPatch() < 0)
      {
        continue;
      }
      receiver.Visit([&](const ScatteringReceiver::Part& part)
        { return this->Divides(receiver, part, threshold); },
        [&](const ScatteringReceiver::Part& part)
        {
          links[k] += part.IsLeftOut ? 0.0 : 1.0;
          squares[k] += this->GetDeviation(receiver, part).square();
        });
    }
  };
  Threads::For(0, count, 1, measure);
  // One rank has each of them: no order changes the sums.
  this->SharedWith.Sum(links);
  this->SharedWith.Sum(squares.data()->data(), 4 * squares.size());
  double area = 0.0;
  Values errors = Values::Zero();
  Prospect prospect;
  for (vtkIdType k = 0; k < count; ++k)
  {
    const double weight = this->Areas[this->GetSample(k)];
    prospect.Links += links[k] / static_cast<double>(count);
    area += weight;
    errors += weight * squares[k];
  }
  prospect.Error = Deviation * std::sqrt(errors.maxCoeff() / area) / this->Reference;
  if (!this->Received.empty())
  {
    prospect.Error = this->GetLightError(
      this->Receive([&](const ScatteringReceiver& receiver, const ScatteringReceiver::Part& part)
        { return this->Divides(receiver, part, threshold); }));
  }
  return prospect;
}

//------------------------------------------------------------------------------
// The largest threshold for the tolerance, or the smallest for the number of links.
double ScatteringRefinement::FindThreshold(double tolerance, double mostLinks, int steps) const
{
  double high = std::log(LargestThreshold * this->Reference);
  double low = std::log(SmallestThreshold * this->Reference);
  for (int step = 0; step < steps; ++step)
  {
    const double middle = 0.5 * (low + high);
    const Prospect prospect = this->Measure(std::exp(middle));
    const bool isFine = prospect.Error <= tolerance || prospect.Links > mostLinks;
    (isFine ? low : high) = middle;
  }
  return std::exp(this->Measure(std::exp(low)).Links > mostLinks ? high : low);
}

//------------------------------------------------------------------------------
void ScatteringRefinement::ChooseAdaptive(double tolerance, double mostLinks)
{
  this->Begin(tolerance);
  this->DividesOwn = !this->Light.HasSizes();
  const double most =
    mostLinks > 0.0 ? LinkMargin * mostLinks : std::numeric_limits<double>::infinity();
  this->Threshold = this->FindThreshold(tolerance, most, ThresholdSteps);
  this->Expected = this->Measure(this->Threshold);
  this->Limited = this->Expected.Error > tolerance;
}

//------------------------------------------------------------------------------
bool ScatteringRefinement::KeepUniform(int clusters, const LinkChoice& kept, const Ranks& ranks)
{
  this->ChooseUniform(clusters, 0.0);
  const Prospect others = this->Expected;
  this->StartFrom(kept, ranks);
  this->Expected = this->Measure(this->Threshold);
  return this->IsAsGoodAs(others, std::numeric_limits<double>::infinity());
}

//------------------------------------------------------------------------------
// Where their number is limited others of the same clusters, by the threshold that they had, tell
// whether the body is still as it was: about as many, and as good. Kept links are refined until
// they are hardly worse.
bool ScatteringRefinement::KeepAdaptive(double mostLinks, const LinkChoice& kept,
  const Ranks& ranks)
{
  this->Limited = kept.IsLimited;
  this->NewThreshold = kept.Threshold * this->Reference;
  Prospect others{ kept.LinksPerReceiver, kept.Error };
  if (kept.IsLimited)
  {
    this->Begin(0.0);
    others = this->Measure(this->NewThreshold);
  }
  this->StartFrom(kept, ranks);
  this->Threshold = std::numeric_limits<double>::infinity();
  this->Expected = this->Measure(this->Threshold);
  const double most = std::min(this->GetMostLinks(others),
    mostLinks > 0.0 ? KeptMargin * mostLinks : std::numeric_limits<double>::infinity());
  const double aim = GrowthAimedAt * std::min(others.Error, kept.Error);
  for (const double factor : KeptThresholds)
  {
    if (this->Expected.Error <= aim)
    {
      break;
    }
    const Prospect finer = this->Measure(factor * this->NewThreshold);
    if (finer.Links > most)
    {
      break;
    }
    this->Threshold = factor * this->NewThreshold;
    this->Expected = finer;
  }
  const bool couldBeFiner = kept.IsLimited && others.Links < kept.LinksPerReceiver / MostGrowth;
  return !couldBeFiner && this->IsAsGoodAs(others, most);
}

//------------------------------------------------------------------------------
void ScatteringRefinement::StartFrom(const LinkChoice& kept, const Ranks& ranks)
{
  this->Kept = &kept;
  this->SharedWith = ranks;
  this->AreDivided = kept.AreDivided;
  this->LookAround();
}

//------------------------------------------------------------------------------
double ScatteringRefinement::GetMostLinks(const Prospect& others) const
{
  return MostGrowth * std::min(others.Links, this->Kept->LinksPerReceiver);
}

//------------------------------------------------------------------------------
bool ScatteringRefinement::IsAsGoodAs(const Prospect& others, double mostLinks) const
{
  const double error = MostGrowth * std::min(others.Error, this->Kept->Error);
  return this->Expected.Error <= std::max(error, NoError) &&
    this->Expected.Links <= std::min(mostLinks, this->GetMostLinks(others));
}

//------------------------------------------------------------------------------
LinkChoice ScatteringRefinement::GetChoice() const
{
  LinkChoice choice;
  choice.Error = this->Expected.Error;
  choice.LinksPerReceiver = this->Expected.Links;
  choice.Threshold = this->Threshold / this->Reference;
  choice.IsLimited = this->Limited;
  choice.AreDivided = this->AreDivided;
  return choice;
}

//------------------------------------------------------------------------------
// What a cluster adds to the squared error of the receivers outside of it.
double ScatteringRefinement::GetClusterError(int slot) const
{
  Values sum = Values::Zero();
  for (const ScatteringReceiver& receiver : this->Receivers)
  {
    if (!this->Clusters.HoldsPatch(slot, receiver.GetPatch()))
    {
      sum += this->Areas[receiver.GetPatch()] *
        this->GetDeviation(receiver, receiver.GetPart(slot)).square();
    }
  }
  return sum.maxCoeff();
}

//------------------------------------------------------------------------------
void ScatteringRefinement::ChooseUniform(int clusters, double tolerance)
{
  this->Begin(tolerance);
  std::priority_queue<std::pair<double, int>> queue;
  // The root holds all receivers.
  queue.emplace(std::numeric_limits<double>::infinity(), 0);
  while (static_cast<int>(queue.size()) < clusters && queue.top().first > 0.0)
  {
    Pulse::Beat();
    const int node = queue.top().second;
    queue.pop();
    this->AreDivided[node] = true;
    const LinkSlots::Node children = this->Clusters.GetSlots().GetChildren(node);
    for (int child = children.First; child < children.Last; ++child)
    {
      const bool isPatch = this->Clusters.GetSlots().IsPatch(child);
      queue.emplace(isPatch ? 0.0 : this->GetClusterError(child), child);
    }
  }
  this->Threshold = std::numeric_limits<double>::infinity();
  this->Expected = this->Measure(this->Threshold);
  this->Limited = true;
}

//------------------------------------------------------------------------------
// As Divides has it, for any light.
std::vector<double> ScatteringRefinement::GetLimits() const
{
  std::vector<double> limits(this->AreDivided.size(), this->Threshold);
  for (std::size_t slot = 0; slot < limits.size(); ++slot)
  {
    limits[slot] = this->AreDivided[slot] ? -1.0 : limits[slot];
  }
  return limits;
}
} // namespace LightTransport
