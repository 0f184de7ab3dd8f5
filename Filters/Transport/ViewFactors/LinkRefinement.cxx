// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/LinkRefinement.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Threads.h"
#include "Support/Ranks.h"
#include "Support/TransportMemory.h"
#include "ViewFactors/PairVisibility.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

constexpr double Pi = 3.14159265358979323846;
// Units of work are the pairs of nodes with this part of the patches each.
constexpr double UnitsAcross = 64.0;
constexpr vtkIdType UnitsPerBatch = 32;
// How far the visible part may be off where all rays agree: the standard deviation of a share of
// which 16 samples showed nothing.
constexpr double UnseenShare = 0.05;
// Where the kernel may be this much larger than any sample, the points are taken to miss what is
// near: a share of the receiver (squared deviation) gets as much as is possible.
constexpr double NearRatio = 2.0;
constexpr double NearShare = 0.003;
// Clusters of which one is this much larger than the other: the larger one is divided.
constexpr double UnlikeAreas = 8.0;
// Quarters know nothing of what varies within them, and samples are few. Measured against dense
// matrices in furnished rooms of 900 to 14,000 patches: the error is up to 1.7 times the sum; where
// rows are closed next to nothing for even light, and up to 0.4 times, relative to the radiosity,
// for the light of a lamp.
constexpr double Calibration = 2.0;
constexpr double ClosedCalibration = 0.5;
// Whole numbers of these parts are summed.
constexpr double DeviationParts = 0x1.0p40;
constexpr double SquareParts = 0x1.0p50;
// The first threshold, as a part of the squared error that is allowed; how fast it falls, and the
// power of it that the error is taken for.
constexpr double FirstThreshold = 1.0 / 64.0;
constexpr double FastestFall = 1.0 / 64.0;
constexpr double SlowestFall = 0.9;
constexpr double UsualPower = 0.4;
constexpr double SmallestPower = 0.33;
constexpr double LargestPower = 0.6;
// What a pass aims at, as a part of the tolerance.
constexpr double Aim = 0.98;
// The smallest part of the threshold that a cluster's links get.
constexpr double SmallestShare = 1.0 / 64.0;
constexpr int MaximumPasses = 24;
// Passes after each other that find hardly more links: there are no more.
constexpr double LeastGrowth = 1.01;
constexpr int MostStalls = 3;

//------------------------------------------------------------------------------
// Random numbers from a key: splitmix64 (Steele, Lea and Flood 2014).
class Randomness
{
public:
  Randomness(int i, int j)
    : State((static_cast<std::uint64_t>(i) << 32) ^ static_cast<std::uint64_t>(j))
  {
  }
  double Get()
  {
    this->State += 0x9E3779B97F4A7C15ull;
    std::uint64_t bits = this->State;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
    return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1.0p-53;
  }

private:
  std::uint64_t State;
};

struct Sample
{
  vtkIdType Patch;
  Vector Point;
};

//------------------------------------------------------------------------------
// A point of a patch from two numbers, evenly.
Vector GetPoint(const PatchScene& scene, vtkIdType patch, double u, double v)
{
  const int last = scene.GetNumberOfCorners(patch) - 2;
  const Vector& origin = scene.GetCorner(patch, 0);
  int corner = 1;
  if (last > 1)
  {
    double left = u * scene.GetAreas()[patch];
    for (;; ++corner)
    {
      const Vector a = scene.GetCorner(patch, corner) - origin;
      const Vector b = scene.GetCorner(patch, corner + 1) - origin;
      const double area = 0.5 * a.cross(b).norm();
      if (left < area || corner == last)
      {
        u = std::min(left / area, 1.0);
        break;
      }
      left -= area;
    }
  }
  const double root = std::sqrt(u);
  return origin + root * (1.0 - v) * (scene.GetCorner(patch, corner) - origin) +
    root * v * (scene.GetCorner(patch, corner + 1) - origin);
}

//------------------------------------------------------------------------------
// Thresholds from pass to pass: the error is about a power of the threshold, which two passes tell.
class ThresholdSearch
{
public:
  ThresholdSearch(double tolerance, double first) : Tolerance(tolerance), Threshold(first) {}

  double GetThreshold() const { return this->Threshold; }

  // After a pass: true where the error is small enough; otherwise the threshold is a new one.
  bool IsReached(double error)
  {
    if (error <= this->Tolerance)
    {
      return true;
    }
    double power = UsualPower;
    if (this->Error > error)
    {
      power = std::log(this->Error / error) / std::log(this->LastThreshold / this->Threshold);
    }
    power = std::min(std::max(power, SmallestPower), LargestPower);
    this->Error = error;
    this->LastThreshold = this->Threshold;
    const double fall = std::pow(Aim * this->Tolerance / error, 1.0 / power);
    this->Threshold *= std::min(std::max(fall, FastestFall), SlowestFall);
    return false;
  }

private:
  double Tolerance;
  double Threshold;
  double LastThreshold = 0.0;
  double Error = 0.0; // of the last pass; 0 for none
};
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
// One pass: links and counters of every Step-th unit.
struct LinkRefinement::Refiner
{
  const LinkRefinement& Outer;
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
        this->Visit(this->Outer.Units[unit], this->Results[index], visibility);
      }
    }
  }

  bool IsPatch(int slot) const { return slot >= this->Outer.NumberOfNodes; }
  vtkIdType GetPatch(int slot) const { return slot - this->Outer.NumberOfNodes; }
  int GetNode(int slot) const
  {
    return this->IsPatch(slot) ? this->Outer.Leaves[this->GetPatch(slot)] : slot;
  }
  double GetArea(int slot) const
  {
    return this->IsPatch(slot) ? this->Outer.Scene.GetAreas()[this->GetPatch(slot)]
                               : this->Outer.Scene.GetTree().GetNode(slot).Area;
  }

  // Slots below a slot.
  std::pair<int, int> GetChildren(int slot) const
  {
    const PatchTree::Node& node = this->Outer.Scene.GetTree().GetNode(slot);
    if (node.IsLeaf())
    {
      return { this->Outer.NumberOfNodes + static_cast<int>(node.First),
        this->Outer.NumberOfNodes + static_cast<int>(node.Last) };
    }
    return { node.Left, node.Left + 2 };
  }

  void Visit(Pair pair, Result& result, PairVisibility& visibility) const
  {
    if (pair.I == pair.J)
    {
      this->VisitWithin(pair, result, visibility);
      return;
    }
    ++result.Count.PairsExamined;
    const int nodeI = this->GetNode(pair.I);
    const int nodeJ = this->GetNode(pair.J);
    const double highest = nodeI == nodeJ ? std::numeric_limits<double>::infinity()
                                          : this->Outer.Open.GetKernelBound(nodeI, nodeJ);
    if (highest <= 0.0)
    {
      ++result.Count.PairsBackFacing;
      return;
    }
    const bool arePatches = this->IsPatch(pair.I) && this->IsPatch(pair.J);
    pair.IsFree =
      pair.IsFree || (nodeI != nodeJ && !arePatches && !this->Outer.Culler.MayBlock(nodeI, nodeJ));
    const Estimate estimate =
      arePatches ? this->Integrate(pair, visibility) : this->Look(pair, highest, result);
    const double error =
      estimate.ErrorI / this->Outer.Shares[pair.I] + estimate.ErrorJ / this->Outer.Shares[pair.J];
    if (arePatches || error <= this->Threshold)
    {
      this->Keep(pair, estimate, result);
      return;
    }
    this->Divide(pair, estimate, result, visibility);
  }

  // Pairs within one node.
  void VisitWithin(const Pair& pair, Result& result, PairVisibility& visibility) const
  {
    if (this->IsPatch(pair.I) || !this->Outer.Open.MayFace(pair.I, pair.I))
    {
      return;
    }
    const std::pair<int, int> children = this->GetChildren(pair.I);
    for (int i = children.first; i < children.second; ++i)
    {
      for (int j = i; j < children.second; ++j)
      {
        this->Visit({ i, j, pair.IsFree }, result, visibility);
      }
    }
  }

  void Divide(const Pair& pair, const Estimate& estimate, Result& result,
    PairVisibility& visibility) const
  {
    const double areaI = this->GetArea(pair.I);
    const double areaJ = this->GetArea(pair.J);
    // Where the irradiance varies over a cluster, that one; where the two are of unlike size the
    // larger one, which the variation will be over sooner or later.
    bool divideI = estimate.ErrorI > estimate.ErrorJ;
    divideI = areaI > UnlikeAreas * areaJ || (divideI && areaJ <= UnlikeAreas * areaI);
    divideI = (divideI && !this->IsPatch(pair.I)) || this->IsPatch(pair.J);
    const std::pair<int, int> children = this->GetChildren(divideI ? pair.I : pair.J);
    for (int child = children.first; child < children.second; ++child)
    {
      this->Visit(divideI ? Pair{ child, pair.J, pair.IsFree } : Pair{ pair.I, child, pair.IsFree },
        result, visibility);
    }
  }

  void Keep(const Pair& pair, const Estimate& estimate, Result& result) const
  {
    const bool arePatches = this->IsPatch(pair.I) && this->IsPatch(pair.J);
    result.Count.SquaredError += arePatches ? estimate.ErrorI + estimate.ErrorJ : estimate.Mean;
    result.Count.PairsUnobstructed += pair.IsFree ? 1.0 : 0.0;
    if (!arePatches)
    {
      this->AddDeviations(pair.I, estimate.ErrorI, estimate.DeviationsI);
      this->AddDeviations(pair.J, estimate.ErrorJ, estimate.DeviationsJ);
    }
    if (estimate.Value > 0.0)
    {
      ++result.Count.Links;
      result.Count.PatchLinks += arePatches ? 1.0 : 0.0;
      result.Links.push_back({ pair.I, pair.J, static_cast<float>(estimate.Value) });
    }
  }

  void AddDeviations(int slot, double error, const double* deviations) const
  {
    for (int k = 0; k < Points; ++k)
    {
      this->Outer.Deviations[Points * slot + k] += std::llround(deviations[k] * DeviationParts);
    }
    this->Outer.Squares[slot] += std::llround(error * SquareParts);
  }

  // One point of each of equal parts of the area, in the order of the tree: neighbours in it are
  // neighbours in space.
  void TakeSamples(int slot, Randomness& random, Sample* samples) const
  {
    const std::vector<double>& before = this->Outer.AreaBefore;
    const PatchTree::Node& node = this->Outer.Scene.GetTree().GetNode(this->GetNode(slot));
    const vtkIdType first = this->IsPatch(slot) ? this->GetPatch(slot) : node.First;
    const vtkIdType last = this->IsPatch(slot) ? first + 1 : node.Last;
    const double area = before[last] - before[first];
    for (int k = 0; k < Points; ++k)
    {
      const double target = before[first] + area * (k + random.Get()) / Points;
      const auto next = std::upper_bound(before.begin() + first + 1, before.begin() + last, target);
      const vtkIdType patch = std::min<vtkIdType>(next - before.begin(), last) - 1;
      const double within = (target - before[patch]) / (before[patch + 1] - before[patch]);
      samples[k] = { patch,
        GetPoint(this->Outer.Scene, patch, std::min(std::max(within, 0.0), 1.0), random.Get()) };
    }
  }

  double GetKernel(const Sample& a, const Sample& b) const
  {
    const Vector ray = b.Point - a.Point;
    const double cosines = std::max(this->Outer.Scene.GetNormal(a.Patch).dot(ray), 0.0) *
      std::max(-this->Outer.Scene.GetNormal(b.Patch).dot(ray), 0.0);
    const double squared = ray.squaredNorm();
    return cosines > 0.0 ? cosines / (Pi * squared * squared) : 0.0;
  }

  // Mean and spread of the kernel from all pairs of a few points.
  Estimate Look(const Pair& pair, double highest, Result& result) const
  {
    Randomness random(pair.I, pair.J);
    Sample a[Points], b[Points];
    this->TakeSamples(pair.I, random, a);
    this->TakeSamples(pair.J, random, b);
    double rows[Points] = {};
    double columns[Points] = {};
    double open = 0.0;
    double seen = 0.0;
    for (int i = 0; i < Points; ++i)
    {
      for (int j = 0; j < Points; ++j)
      {
        double kernel = this->GetKernel(a[i], b[j]);
        open += kernel;
        if (kernel > 0.0 && !pair.IsFree)
        {
          ++result.Count.Rays;
          kernel = this->Outer.Caster.IsOccluded(a[i].Point, b[j].Point, a[i].Patch, b[j].Patch)
            ? 0.0
            : kernel;
        }
        seen += kernel;
        rows[i] += kernel / Points;
        columns[j] += kernel / Points;
      }
    }
    open /= Points * Points;
    seen /= Points * Points;
    const Estimate spread = this->GetSpread(pair, highest, rows, columns);
    const double unseen = pair.IsFree ? 0.0 : open * UnseenShare;
    return this->Weigh(pair, seen, spread, unseen * unseen);
  }

  // Variances of rows and columns.
  Estimate GetSpread(const Pair& pair, double highest, const double* rows,
    const double* columns) const
  {
    const auto getVariance = [&](const double* values, double area)
    {
      const double mean = std::accumulate(values, values + Points, 0.0) / Points;
      double sum = 0.0;
      for (int k = 0; k < Points; ++k)
      {
        sum += (values[k] - mean) * (values[k] - mean) / (Points - 1);
      }
      // No more than everything arrives.
      const double most = std::min(highest, 1.0 / area);
      const bool mayMiss = most > NearRatio * *std::max_element(values, values + Points);
      return mayMiss ? sum + NearShare * (most - mean) * (most - mean) : sum;
    };
    Estimate spread;
    spread.ErrorI = getVariance(rows, this->GetArea(pair.J));
    spread.ErrorJ = getVariance(columns, this->GetArea(pair.I));
    std::copy(rows, rows + Points, spread.DeviationsI);
    std::copy(columns, columns + Points, spread.DeviationsJ);
    return spread;
  }

  // From the kernel to the irradiance that counts.
  Estimate Weigh(const Pair& pair, double seen, Estimate spread, double unseen) const
  {
    const double areaI = this->GetArea(pair.I);
    const double areaJ = this->GetArea(pair.J);
    const double sentI = areaI * this->Outer.Brightness[pair.I];
    const double sentJ = areaJ * this->Outer.Brightness[pair.J];
    // The mean is off by about half of how much rows and columns vary, in both directions.
    const double mean = (spread.ErrorI + spread.ErrorJ) / (2 * Points) + unseen;
    spread.Value = seen;
    spread.ErrorI = (spread.ErrorI + mean) * areaI * sentJ * sentJ;
    spread.ErrorJ = (spread.ErrorJ + mean) * areaJ * sentI * sentI;
    spread.Mean = mean * (areaI * sentJ * sentJ + areaJ * sentI * sentI);
    for (int k = 0; k < Points; ++k)
    {
      spread.DeviationsI[k] = (spread.DeviationsI[k] - seen) * sentJ;
      spread.DeviationsJ[k] = (spread.DeviationsJ[k] - seen) * sentI;
    }
    return spread;
  }

  // Two patches.
  Estimate Integrate(const Pair& pair, PairVisibility& visibility) const
  {
    const vtkIdType i = this->GetPatch(pair.I);
    const vtkIdType j = this->GetPatch(pair.J);
    const double areaI = this->Outer.Scene.GetAreas()[i];
    const double areaJ = this->Outer.Scene.GetAreas()[j];
    const double open = this->Outer.Open.Compute(i, j).Value;
    Estimate estimate;
    estimate.Value = open / (areaI * areaJ);
    if (pair.IsFree || estimate.Value <= 0.0 || !this->Outer.Culler.HasOccluders())
    {
      return estimate;
    }
    std::vector<vtkIdType> between;
    this->Outer.Culler.FindBetween(i, j, between);
    if (between.empty())
    {
      return estimate;
    }
    Polygon a, b;
    Polygon::SetToClippedPair(this->Outer.Scene, i, j, a, b);
    const std::uint64_t key = static_cast<std::uint64_t>(i) << 32 ^ static_cast<std::uint64_t>(j);
    if (!visibility.SetPair(a, b, this->Outer.Scene, between, key,
          this->Outer.Scene.AreTouching(i, j) ? open : 0.0))
    {
      return estimate;
    }
    PairVisibility::Share share = visibility.Look();
    const double sentI = open / areaJ * this->Outer.Brightness[pair.I];
    const double sentJ = open / areaI * this->Outer.Brightness[pair.J];
    const double weight = areaI * sentJ * sentJ + areaJ * sentI * sentI;
    const double allowed = weight > 0.0 ? std::sqrt(this->Threshold / weight) : 1.0;
    if (share.Error > allowed)
    {
      share = visibility.Integrate(allowed);
    }
    estimate.Value *= share.Value;
    estimate.ErrorI = share.Error * share.Error * areaI * sentJ * sentJ;
    estimate.ErrorJ = share.Error * share.Error * areaJ * sentI * sentI;
    return estimate;
  }
};

//------------------------------------------------------------------------------
LinkRefinement::LinkRefinement(const PatchScene& scene, const SceneRayCaster& caster)
  : Scene(scene), Caster(caster), Open(scene, OpenTolerance), Culler(scene),
    NumberOfNodes(static_cast<int>(scene.GetTree().GetNodes().size())),
    AreaBefore(scene.GetNumberOfPatches() + 1, 0.0), Leaves(scene.GetNumberOfPatches())
{
  std::partial_sum(scene.GetAreas().begin(), scene.GetAreas().end(), this->AreaBefore.begin() + 1);
  for (int index = 0; index < this->NumberOfNodes; ++index)
  {
    const PatchTree::Node& node = scene.GetTree().GetNode(index);
    if (node.IsLeaf())
    {
      std::fill(this->Leaves.begin() + node.First, this->Leaves.begin() + node.Last, index);
    }
  }
  this->SetBrightness(std::vector<double>(scene.GetNumberOfPatches(), 1.0));
  this->MakeUnits();
}

//------------------------------------------------------------------------------
// A cluster's is the root of the mean square of its patches'.
void LinkRefinement::SetBrightness(const std::vector<double>& brightness)
{
  const double most = *std::max_element(brightness.begin(), brightness.end());
  const std::vector<double>& areas = this->Scene.GetAreas();
  std::vector<double> before(1, 0.0);
  for (std::size_t patch = 0; patch < brightness.size(); ++patch)
  {
    const double relative = most > 0.0 ? brightness[patch] / most : 0.0;
    before.push_back(before.back() + areas[patch] * relative * relative);
  }
  this->SquaredBrightness = before.back();
  this->Brightness.clear();
  for (const PatchTree::Node& node : this->Scene.GetTree().GetNodes())
  {
    this->Brightness.push_back(std::sqrt((before[node.Last] - before[node.First]) / node.Area));
  }
  for (const double value : brightness)
  {
    this->Brightness.push_back(most > 0.0 ? value / most : 0.0);
  }
  this->Shares.assign(this->Brightness.size(), 1.0);
}

//------------------------------------------------------------------------------
std::vector<vtkExchangeHierarchy::Node> LinkRefinement::GetNodes() const
{
  std::vector<vtkExchangeHierarchy::Node> nodes;
  for (const PatchTree::Node& node : this->Scene.GetTree().GetNodes())
  {
    const int patches = this->NumberOfNodes + static_cast<int>(node.First);
    nodes.push_back(node.IsLeaf()
        ? vtkExchangeHierarchy::Node{ patches, patches + static_cast<int>(node.GetSize()) }
        : vtkExchangeHierarchy::Node{ node.Left, node.Left + 2 });
  }
  return nodes;
}

//------------------------------------------------------------------------------
// All pairs of nodes of some size: enough of them for many threads.
void LinkRefinement::MakeUnits()
{
  const auto& nodes = this->Scene.GetTree().GetNodes();
  const double size = static_cast<double>(this->Scene.GetNumberOfPatches()) / UnitsAcross;
  std::vector<int> starts;
  for (int index = 0; index < this->NumberOfNodes; ++index)
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
  ThresholdSearch search(tolerance,
    FirstThreshold * tolerance * tolerance * this->SquaredBrightness);
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
    // Pairs of patches are not divided any further.
    stalls = this->Total.Links <= LeastGrowth * links ? stalls + 1 : 0;
    if (stalls == MostStalls || search.IsReached(this->ErrorEstimate))
    {
      break;
    }
    links = this->Total.Links;
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void LinkRefinement::ClearSums()
{
  this->Links.clear();
  this->Total = Counters();
  const std::size_t slots = this->Brightness.size();
  this->Deviations = std::make_unique<std::atomic<std::int64_t>[]>(Points * slots);
  this->Squares = std::make_unique<std::atomic<std::int64_t>[]>(slots);
  for (std::size_t k = 0; k < Points * slots; ++k)
  {
    this->Deviations[k] = 0;
    this->Squares[k / Points] = 0;
  }
}

//------------------------------------------------------------------------------
Outcome LinkRefinement::RunPass(double threshold, double availableBytes, const Ranks& ranks,
  const Monitor& monitor)
{
  this->ClearSums();
  const vtkIdType numberOfRanks = ranks.GetNumber();
  const auto units = static_cast<vtkIdType>(this->Units.size());
  const vtkIdType batch = UnitsPerBatch * numberOfRanks;
  for (vtkIdType first = 0; first < units; first += batch)
  {
    std::vector<Result> results(UnitsPerBatch);
    Refiner refiner{ *this, threshold, first + ranks.GetMine(), numberOfRanks, results };
    Threads::For(0, UnitsPerBatch, 1, refiner);
    for (const Result& result : results)
    {
      this->Links.insert(this->Links.end(), result.Links.begin(), result.Links.end());
      this->Total.Add(result.Count);
    }
    const double bytes = 2.0 * static_cast<double>(this->Links.size()) * sizeof(this->Links[0]) +
      vtkExchangeHierarchy::GetEstimatedBytes(static_cast<double>(this->Links.size()));
    Outcome fits = bytes <= availableBytes
      ? Outcome::Done()
      : Outcome::Failed("The links between clusters of " +
          std::to_string(this->Scene.GetNumberOfPatches()) + " patches need more than the " +
          TransportMemory::Format(availableBytes) +
          " of memory that are free for them: raise LinkTolerance, use fewer patches or processes "
          "on more machines (each holds a part).");
    fits = ranks.Agree(fits);
    if (!fits)
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
void LinkRefinement::AddUpRanks(const Ranks& ranks)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  const auto addUp = [&](Sums& sums, std::size_t count)
  {
    std::vector<vtkTypeInt64> all(sums.get(), sums.get() + count);
    ranks.Sum(all);
    std::copy(all.begin(), all.end(), sums.get());
  };
  addUp(this->Deviations, Points * this->Brightness.size());
  addUp(this->Squares, this->Brightness.size());
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
  for (int slot = 0; slot < this->GetNumberOfSlots(); ++slot)
  {
    const bool isPatch = slot >= this->NumberOfNodes;
    const int patch = slot - this->NumberOfNodes;
    double coherent = 0.0;
    for (int k = 0; k < Points; ++k)
    {
      const double deviation =
        static_cast<double>(this->Deviations[Points * slot + k]) / DeviationParts;
      coherent += deviation * deviation / Points;
    }
    coherent *= isPatch ? this->Scene.GetAreas()[patch] : this->Scene.GetTree().GetNode(slot).Area;
    // Within a patch nothing varies.
    sum += isPatch ? 0.0 : coherent;
    const int parent =
      isPatch ? this->Leaves[patch] : std::max(this->Scene.GetTree().GetNode(slot).Parent, 0);
    const double apart = static_cast<double>(this->Squares[slot]) / SquareParts;
    this->Shares[slot] = apart > 0.0
      ? std::min(std::max(apart / std::max(coherent, apart), SmallestShare), 1.0)
      : this->Shares[parent];
  }
  const double calibration = this->ClosesRows ? ClosedCalibration : Calibration;
  this->ErrorEstimate =
    this->SquaredBrightness > 0.0 ? calibration * std::sqrt(sum / this->SquaredBrightness) : 0.0;
}
} // namespace LightTransport
