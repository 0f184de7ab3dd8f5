// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/LinkRefinement.h"

#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/ThresholdSearch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace LightTransport
{
namespace
{
// Units of work are the pairs of nodes with this part of the patches each.
constexpr double UnitsAcross = 64.0;
constexpr vtkIdType UnitsPerBatch = 32;
// Clusters of which one is this much larger than the other: the larger one is divided.
constexpr double UnlikeAreas = 8.0;
// Quarters know nothing of what varies within them, and samples are few. Measured against dense
// matrices in rooms, canyons and cities of 600 to 14,000 patches: row sums are off by up to 1.3
// times the sum. When rows have been closed it is the radiosity that counts, by a lamp, by even
// light and by the sky: relative to it up to 0.4 times the sum where all is closed, 0.7 times with
// openings, which take part in the closure with an error of their own.
constexpr double RowCalibration = 1.3;
constexpr double OpenCalibration = 0.7;
constexpr double ClosedCalibration = 0.5;
// The smallest part of the threshold that a cluster's links get.
constexpr double SmallestShare = 1.0 / 64.0;
constexpr int MaximumPasses = 24;
// Passes after each other that find hardly more links: there are no more.
constexpr double LeastGrowth = 1.01;
constexpr int MostStalls = 3;
} // namespace

//------------------------------------------------------------------------------
void LinkRefinement::Counters::Add(const Counters& other)
{
  this->Links += other.Links;
  this->PatchLinks += other.PatchLinks;
  this->PairsExamined += other.PairsExamined;
  this->PairsBackFacing += other.PairsBackFacing;
  this->PairsUnobstructed += other.PairsUnobstructed;
  this->Rays += other.Rays;
  this->SquaredError += other.SquaredError;
}

//------------------------------------------------------------------------------
// One pass over the pairs: links and counters of every Step-th unit.
struct LinkRefinement::Refiner
{
  const LinkRefinement& Outer;
  PairLooks& Looks;
  SlotErrors& Errors;
  double Threshold;
  vtkIdType First; ///< unit of the first result
  vtkIdType Step;  ///< from one result to the next
  std::vector<Result>& Results;

  void operator()(vtkIdType begin, vtkIdType end)
  {
    PairVisibility visibility;
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkIdType unit = this->First + index * this->Step;
      if (unit < static_cast<vtkIdType>(this->Outer.Units.size()))
      {
        PairLooks::Unit& looks = this->Looks.GetUnit(unit);
        looks.resize(std::max<std::size_t>(looks.size(), 1));
        this->Visit(this->Outer.Units[unit], 0, { looks, this->Results[index], visibility });
      }
    }
  }

  /// A unit, as far as it has come.
  struct Work
  {
    PairLooks::Unit& Looks;
    Result& Found;
    PairVisibility& Visibility;
  };

  bool ArePatches(const Pair& pair) const
  {
    return this->Outer.Slots.IsPatch(pair.I) && this->Outer.Slots.IsPatch(pair.J);
  }

  void Visit(Pair pair, std::size_t place, const Work& work) const
  {
    Pulse::Beat();
    if (pair.I == pair.J)
    {
      this->VisitWithin(pair, place, work);
      return;
    }
    Counters& count = work.Found.Count;
    ++count.PairsExamined;
    PairLooks::Look& look = work.Looks[place];
    look = look.Kind == PairLooks::Look::UNKNOWN ? this->LookAt(pair, count.Rays, work.Visibility)
                                                 : look;
    if (look.Kind == PairLooks::Look::DARK)
    {
      ++count.PairsBackFacing;
      return;
    }
    pair.IsFree = look.IsFree;
    const bool arePatches = look.Kind == PairLooks::Look::PATCHES;
    const LinkEstimator& estimator = this->Outer.Estimator;
    const Estimate estimate = arePatches
      ? estimator.WeighPatches(pair, this->Threshold, work.Visibility, look.Patches)
      : estimator.Weigh(pair, look.Clusters);
    const double error =
      estimate.ErrorI / this->Outer.Shares[pair.I] + estimate.ErrorJ / this->Outer.Shares[pair.J];
    if (arePatches || error <= this->Threshold)
    {
      this->Keep(pair, estimate, work.Found);
      return;
    }
    this->Divide(pair, estimate, place, work);
  }

  // Once for all thresholds.
  PairLooks::Look LookAt(const Pair& pair, double& rays, PairVisibility& visibility) const
  {
    PairLooks::Look look;
    const int nodeI = this->Outer.Slots.GetNode(pair.I);
    const int nodeJ = this->Outer.Slots.GetNode(pair.J);
    const double highest = nodeI == nodeJ ? std::numeric_limits<double>::infinity()
                                          : this->Outer.Open.GetKernelBound(nodeI, nodeJ);
    if (highest <= 0.0)
    {
      look.Kind = PairLooks::Look::DARK;
      return look;
    }
    const LinkEstimator& estimator = this->Outer.Estimator;
    if (this->ArePatches(pair))
    {
      look.Kind = PairLooks::Look::PATCHES;
      look.IsFree = pair.IsFree;
      look.Patches = estimator.LookAtPatches(pair, visibility);
      return look;
    }
    look.Kind = PairLooks::Look::CLUSTERS;
    look.IsFree = pair.IsFree || (nodeI != nodeJ && !this->Outer.Culler.MayBlock(nodeI, nodeJ));
    look.Clusters = estimator.Look({ pair.I, pair.J, look.IsFree }, highest, rays);
    return look;
  }

  // Pairs within one node.
  void VisitWithin(const Pair& pair, std::size_t place, const Work& work) const
  {
    if (this->Outer.Slots.IsPatch(pair.I) || !this->Outer.Open.MayFace(pair.I, pair.I))
    {
      return;
    }
    const LinkSlots::Node children = this->Outer.Slots.GetChildren(pair.I);
    const int number = children.Last - children.First;
    std::size_t next = PairLooks::Divide(work.Looks, place, 0, number * (number + 1) / 2);
    for (int i = children.First; i < children.Last; ++i)
    {
      for (int j = i; j < children.Last; ++j)
      {
        this->Visit({ i, j, pair.IsFree }, next++, work);
      }
    }
  }

  void Divide(const Pair& pair, const Estimate& estimate, std::size_t place, const Work& work) const
  {
    const LinkSlots& slots = this->Outer.Slots;
    const double areaI = slots.GetArea(pair.I);
    const double areaJ = slots.GetArea(pair.J);
    // Where the irradiance varies over a cluster, that one; where the two are of unlike size the
    // larger one, which the variation will be over sooner or later.
    bool divideI = estimate.ErrorI > estimate.ErrorJ;
    divideI = areaI > UnlikeAreas * areaJ || (divideI && areaJ <= UnlikeAreas * areaI);
    divideI = (divideI && !slots.IsPatch(pair.I)) || slots.IsPatch(pair.J);
    const LinkSlots::Node children = slots.GetChildren(divideI ? pair.I : pair.J);
    std::size_t next =
      PairLooks::Divide(work.Looks, place, divideI ? 0 : 1, children.Last - children.First);
    for (int child = children.First; child < children.Last; ++child)
    {
      this->Visit(divideI ? Pair{ child, pair.J, pair.IsFree } : Pair{ pair.I, child, pair.IsFree },
        next++, work);
    }
  }

  void Keep(const Pair& pair, const Estimate& estimate, Result& result) const
  {
    const bool arePatches = this->ArePatches(pair);
    result.Count.SquaredError += arePatches ? estimate.ErrorI + estimate.ErrorJ : estimate.Mean;
    result.Count.PairsUnobstructed += pair.IsFree ? 1.0 : 0.0;
    if (!arePatches)
    {
      this->Errors.Add(pair.I, estimate.ErrorI, estimate.DeviationsI);
      this->Errors.Add(pair.J, estimate.ErrorJ, estimate.DeviationsJ);
    }
    if (estimate.Value > 0.0)
    {
      ++result.Count.Links;
      result.Count.PatchLinks += arePatches ? 1.0 : 0.0;
      result.Links.push_back({ pair.I, pair.J, static_cast<float>(estimate.Value) });
    }
  }
};

//------------------------------------------------------------------------------
LinkRefinement::LinkRefinement(const PatchScene& scene, const SceneRayCaster& caster,
  PairLooks& looks)
  : Scene(scene), Slots(scene), Open(scene, OpenTolerance), Culler(scene),
    Estimator(scene, this->Slots, caster, this->Open, this->Culler), Looks(looks)
{
  this->SetBrightness(std::vector<double>(scene.GetNumberOfPatches(), 1.0));
  this->MakeUnits();
}

//------------------------------------------------------------------------------
void LinkRefinement::SetBrightness(const std::vector<double>& brightness)
{
  this->Estimator.SetBrightness(brightness);
  this->Shares.assign(this->Slots.GetNumberOfSlots(), 1.0);
}

//------------------------------------------------------------------------------
// All pairs of nodes of some size: enough of them for many threads.
void LinkRefinement::MakeUnits()
{
  const auto& nodes = this->Scene.GetTree().GetNodes();
  const double size = static_cast<double>(this->Scene.GetNumberOfPatches()) / UnitsAcross;
  std::vector<int> starts;
  for (int index = 0; index < this->Slots.GetNumberOfNodes(); ++index)
  {
    const int parent = nodes[index].Parent;
    const bool isSmall = nodes[index].IsLeaf() || nodes[index].GetSize() <= size;
    const bool isParentSmall = parent >= 0 && nodes[parent].GetSize() <= size;
    if (isSmall && !isParentSmall)
    {
      starts.push_back(index);
    }
  }
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    for (std::size_t j = i; j < starts.size(); ++j)
    {
      this->Units.push_back({ starts[i], starts[j], !this->Culler.HasOccluders() });
    }
  }
}

//------------------------------------------------------------------------------
Outcome LinkRefinement::Refine(double tolerance, double availableBytes, const Ranks& ranks,
  const Monitor& monitor)
{
  this->Looks.Prepare(this->Scene, ranks, this->Units.size());
  this->BytesBefore = this->Looks.GetNumberOfBytes();
  double rays = 0.0;
  ThresholdSearch search(tolerance, this->Estimator.GetSquaredBrightness());
  double links = 0.0;
  int stalls = 0;
  for (int pass = 0; pass < MaximumPasses; ++pass)
  {
    // How many passes there will be is not known: each gets half of what is left.
    const double done = 1.0 - std::pow(0.5, pass);
    if (Outcome outcome = this->RunPass(search.GetThreshold(), availableBytes, ranks,
          monitor.GetStage(done, done + 0.5 * (1.0 - done)));
        !outcome)
    {
      return outcome;
    }
    this->Assess();
    rays += this->Total.Rays;
    // Pairs of patches are not divided any further.
    stalls = this->Total.Links <= LeastGrowth * links ? stalls + 1 : 0;
    if (stalls == MostStalls || search.IsReached(this->ErrorEstimate))
    {
      break;
    }
    links = this->Total.Links;
  }
  this->Total.Rays = rays;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome LinkRefinement::RunPass(double threshold, double availableBytes, const Ranks& ranks,
  const Monitor& monitor)
{
  this->Links.clear();
  this->Total = Counters();
  this->Errors.Clear(this->Slots.GetNumberOfSlots());
  const vtkIdType numberOfRanks = ranks.GetNumber();
  const auto units = static_cast<vtkIdType>(this->Units.size());
  const vtkIdType batch = UnitsPerBatch * numberOfRanks;
  for (vtkIdType first = 0; first < units; first += batch)
  {
    std::vector<Result> results(UnitsPerBatch);
    Refiner refiner{ *this, this->Looks, this->Errors, threshold, first + ranks.GetMine(),
      numberOfRanks, results };
    Threads::For(0, UnitsPerBatch, 1, refiner);
    for (const Result& result : results)
    {
      this->Links.insert(this->Links.end(), result.Links.begin(), result.Links.end());
      this->Total.Add(result.Count);
    }
    if (Outcome fits = ranks.Agree(this->CheckMemory(availableBytes)); !fits)
    {
      return fits;
    }
    if (!monitor.Report(static_cast<double>(first) / static_cast<double>(units)))
    {
      return Outcome::Aborted();
    }
  }
  this->AddUpRanks(ranks);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome LinkRefinement::CheckMemory(double availableBytes) const
{
  const auto links = static_cast<double>(this->Links.size());
  const double bytes = 2.0 * links * sizeof(this->Links[0]) +
    vtkExchangeHierarchy::GetEstimatedBytes(links) + this->Looks.GetNumberOfBytes() -
    this->BytesBefore;
  return bytes <= availableBytes
    ? Outcome::Done()
    : Outcome::Failed("The links between clusters of " +
        std::to_string(this->Scene.GetNumberOfPatches()) + " patches need more than the " +
        TransportMemory::Format(availableBytes) +
        " of memory that are free for them: raise LinkTolerance, use fewer patches or processes "
        "on more machines (each holds a part).");
}

//------------------------------------------------------------------------------
void LinkRefinement::AddUpRanks(const Ranks& ranks)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  this->Errors.AddUp(ranks);
  Counters& total = this->Total;
  double* const values[] = { &total.Links, &total.PatchLinks, &total.PairsExamined,
    &total.PairsBackFacing, &total.PairsUnobstructed, &total.Rays, &total.SquaredError };
  for (double* value : values)
  {
    ranks.Sum(value, 1);
  }
}

//------------------------------------------------------------------------------
// The error of a pass, and which slots' links must be finer in the next: those whose deviations add
// up to more than each of them.
void LinkRefinement::Assess()
{
  double sum = this->Total.SquaredError;
  for (int slot = 0; slot < this->Slots.GetNumberOfSlots(); ++slot)
  {
    const double coherent = this->Errors.GetCoherent(slot) * this->Slots.GetArea(slot);
    // Within a patch nothing varies.
    sum += this->Slots.IsPatch(slot) ? 0.0 : coherent;
    const double apart = this->Errors.GetApart(slot);
    this->Shares[slot] = apart > 0.0
      ? std::min(std::max(apart / std::max(coherent, apart), SmallestShare), 1.0)
      : this->Shares[this->Slots.GetParent(slot)];
  }
  const double squared = this->Estimator.GetSquaredBrightness();
  const double relative = squared > 0.0 ? std::sqrt(sum / squared) : 0.0;
  this->ErrorEstimate = (this->HasOpenings ? OpenCalibration : ClosedCalibration) * relative;
  this->RowDeviation = RowCalibration * relative + OpenTolerance;
}
} // namespace LightTransport
