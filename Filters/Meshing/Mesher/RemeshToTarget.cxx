// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/RemeshToTarget.h"

#include "Mesher/EdgeLengths.h"
#include "Mesher/LengthCorrection.h"
#include "Mesher/PatchCheck.h"
#include "Mesher/WantedLengths.h"
#include "Shared/TransportMemory.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace LightTransport
{
namespace
{
constexpr double MaximumNumberOfTriangles = IsotropicRemesher::MostTriangles;
// Of all meshes and arrays at the end, measured: 730 to 810.
constexpr double BytesPerTriangle = 700.0;

//------------------------------------------------------------------------------
// A system that promises any memory ends the process when it is used.
Outcome CheckMemory(double number)
{
  const double bytes = BytesPerTriangle * number;
  if (TransportMemory::CanAllocate(bytes))
  {
    return Outcome::Done();
  }
  std::ostringstream text;
  text << "About " << number << " triangles need " << TransportMemory::Format(bytes)
       << " of memory, which are not there: give larger lengths, or fewer patches.";
  return Outcome::Failed(text.str());
}

//------------------------------------------------------------------------------
Outcome CheckNumberOfTriangles(double number, const PatchTarget& target)
{
  // Written so that a length too small for the estimate, infinite then, is refused too.
  if (number <= MaximumNumberOfTriangles)
  {
    return CheckMemory(number);
  }
  std::ostringstream text;
  if (target.SizeField == PatchTarget::LengthSource::Array)
  {
    text << "The array of edge lengths";
  }
  else
  {
    text << "TargetEdgeLength " << target.TargetEdgeLength;
  }
  text << " would give about " << number << " triangles, more than " << MaximumNumberOfTriangles
       << " are refused: give larger lengths.";
  return Outcome::Failed(text.str());
}

//------------------------------------------------------------------------------
// Lengths that give `estimate` triangles are to be scaled.
Outcome CheckTargetNumber(const PatchTarget& target, double estimate)
{
  std::ostringstream text;
  if (!std::isnormal(estimate))
  {
    text << "TargetEdgeLength is " << target.TargetEdgeLength
         << ", too large to be scaled to TargetNumberOfPatches: give one that the surface has room "
            "for, or 0.";
    return Outcome::Failed(text.str());
  }
  if (target.TargetNumberOfPatches > MaximumNumberOfTriangles)
  {
    text << "TargetNumberOfPatches is " << target.TargetNumberOfPatches << ", more than "
         << MaximumNumberOfTriangles << " are refused: ask for fewer.";
    return Outcome::Failed(text.str());
  }
  return CheckMemory(static_cast<double>(target.TargetNumberOfPatches));
}

//------------------------------------------------------------------------------
// Once lengths are limited to the edges to keep, and graded from these.
Outcome CheckPrepared(double number, const PatchTarget& target)
{
  if (number <= MaximumNumberOfTriangles)
  {
    return CheckMemory(number);
  }
  std::ostringstream text;
  text << "Short edges that are kept, and Grading " << target.Grading << ", would give about "
       << number << " triangles, more than " << MaximumNumberOfTriangles
       << " are refused: raise Grading, or FeatureAngle.";
  return Outcome::Failed(text.str());
}

//------------------------------------------------------------------------------
Outcome RemeshToLengths(IsotropicRemesher& remesher, const PatchTarget& target,
  const Monitor& monitor)
{
  const double number = remesher.Prepare(1.0, target.Grading, monitor);
  if (Outcome checked = CheckPrepared(number, target); !checked)
  {
    return checked;
  }
  return remesher.Remesh(target.NumberOfIterations, monitor.GetStage(0.1, 1.0));
}

//------------------------------------------------------------------------------
// The factor of all lengths that gives so many triangles where nothing else shortens them. A part
// of the number goes with the area, the rest with the borders.
double EstimateFactor(const SourceSurface& surface, std::vector<double> lengths, double number)
{
  const double whole = EdgeLengths::EstimateNumberOfTriangles(surface, lengths);
  std::for_each(lengths.begin(), lengths.end(), [](double& length) { length *= 0.5; });
  const double halved = EdgeLengths::EstimateNumberOfTriangles(surface, lengths);
  const double ofArea = std::max(0.5 * halved - whole, 0.0);
  const double ofBorders = std::max(whole - ofArea, 0.0);
  return (ofBorders + std::sqrt(ofBorders * ofBorders + 4.0 * ofArea * number)) / (2.0 * number);
}

//------------------------------------------------------------------------------
// Finds the factor of all lengths that leads to a number of triangles.
class FactorSearch
{
public:
  FactorSearch(IsotropicRemesher& remesher, const PatchTarget& target, double firstFactor,
    double leastFactor)
    : Remesher(remesher), Grading(target.Grading), Factor(firstFactor), Least(leastFactor)
  {
  }

  /// Prepare the surface so that `number` triangles are to be expected.
  void Prepare(double number, const Monitor& monitor)
  {
    const double tolerance = 0.003;
    const int steps = 8;
    this->Expected = this->Remesher.Prepare(this->Factor, this->Grading, monitor);
    // The number goes with the factor to this power, or a smaller one near edges to keep.
    double power = 2.0;
    for (int i = 0; i < steps && std::abs(this->Expected / number - 1.0) > tolerance; ++i)
    {
      double change = std::pow(this->Expected / number, 1.0 / power);
      const double before = this->Expected;
      // Lengths beyond those of all edges do not show in the number, so that its power is no guide:
      // it would lead to any number of triangles.
      if (this->Factor * change < this->Least)
      {
        change = this->Least / this->Factor;
        if (!(change < 1.0))
        {
          return;
        }
      }
      this->Factor *= change;
      this->Expected = this->Remesher.Prepare(this->Factor, this->Grading, monitor);
      const double measured = std::log(before / this->Expected) / std::log(change);
      power = std::min(std::max(measured, 0.3), 2.2);
    }
  }
  double GetExpected() const { return this->Expected; }
  double GetFactor() const { return this->Factor; }

private:
  IsotropicRemesher& Remesher;
  double Grading;
  double Factor;
  double Least;
  double Expected = 0.0;
};

//------------------------------------------------------------------------------
// `lengths` give `firstNumber`; `factor` becomes that of all.
Outcome RemeshToNumber(IsotropicRemesher& remesher, const SourceSurface& surface,
  const std::vector<double>& lengths, const PatchTarget& target, double firstNumber,
  const Monitor& monitor, double& factor)
{
  const double number = static_cast<double>(target.TargetNumberOfPatches);
  // Lengths that differ much give fewer triangles than their estimate.
  constexpr double largestExcess = 10.0;
  FactorSearch search(remesher, target, std::sqrt(firstNumber / number),
    EstimateFactor(surface, lengths, number) / largestExcess);
  // How many triangles come out for each that is expected; measured, then corrected.
  double excess = 1.15;
  const int passes = 4;
  const double tolerance = 0.03;
  double result = 2.0 * number;
  for (int i = 0; i < passes && result > (1.0 + tolerance) * number; ++i)
  {
    // One correction is the rule.
    const double begin = 1.0 - std::pow(0.5, i);
    const Monitor stage = monitor.GetStage(begin, begin + 0.5 * (1.0 - begin));
    search.Prepare(number / excess, stage);
    if (Outcome checked = CheckPrepared(search.GetExpected(), target); !checked)
    {
      return checked;
    }
    if (Outcome remeshed = remesher.Remesh(target.NumberOfIterations, stage.GetStage(0.1, 1.0));
        !remeshed)
    {
      return remeshed;
    }
    result = static_cast<double>(remesher.GetNumberOfTriangles());
    excess = result / search.GetExpected();
  }
  factor = search.GetFactor();
  // Where all edges are alike, the number jumps when they become long enough to be split. From too
  // few triangles any number can be reached, while it may be impossible to collapse edges.
  return remesher.AdjustNumberOfTriangles(static_cast<std::size_t>(number),
    monitor.GetStage(1.0, 1.0));
}

//------------------------------------------------------------------------------
// Remeshes, looks at the patches, and does so again with what that calls for.
class CheckedRemeshing
{
public:
  CheckedRemeshing(IsotropicRemesher& remesher, const TriangleSoup& soup, const PatchTarget& target)
    : Remesher(remesher), Soup(soup), Target(target), Surface(remesher.GetSurface()), Check(soup)
  {
  }

  Outcome FindLengths()
  {
    if (Outcome known = WantedLengths::Find(this->Remesher, this->Surface, this->Soup, this->Target,
          this->Lengths);
        !known)
    {
      return known;
    }
    const bool fromArray = this->Target.SizeField == PatchTarget::LengthSource::Array;
    this->Length = fromArray ? EdgeLengths::GetMeanLength(this->Surface, this->Lengths)
                             : this->Target.TargetEdgeLength;
    WantedLengths::FreePlanarRegions(this->Remesher, this->Surface, this->Target,
      this->Soup.GetDiagonal(), this->Lengths);
    return Outcome::Done();
  }

  Outcome Run(const Monitor& monitor, RemeshToTarget::Result& result)
  {
    // What is left after so many rounds is no matter of lengths.
    const int rounds = 9;
    bool again = true;
    for (int round = 0; round < rounds && again; ++round)
    {
      // The first round is the rule.
      const double begin = 1.0 - std::pow(0.2, round);
      const Monitor stage = monitor.GetStage(begin, begin + 0.8 * (1.0 - begin));
      if (Outcome done = this->Remesh(stage.GetStage(0.0, 0.8), result); !done)
      {
        return done;
      }
      result.Patches = this->Remesher.GetResult(stage.GetStage(0.8, 0.85));
      this->Findings = this->Check.Compare(result.Patches, stage.GetStage(0.85, 0.95));
      again = this->Correct(round, result.Patches, stage.GetStage(0.95, 1.0));
    }
    return this->Conclude(result);
  }

private:
  Outcome Remesh(const Monitor& monitor, RemeshToTarget::Result& result)
  {
    this->Remesher.SetLengths(this->Lengths);
    const double number = EdgeLengths::EstimateNumberOfTriangles(this->Surface, this->Lengths);
    const bool toNumber = this->Target.TargetNumberOfPatches > 0 && std::isfinite(number);
    if (Outcome checked = toNumber ? CheckTargetNumber(this->Target, number)
                                   : CheckNumberOfTriangles(number, this->Target);
        !checked)
    {
      return checked;
    }
    double factor = 1.0;
    Outcome remeshed = toNumber ? RemeshToNumber(this->Remesher, this->Surface, this->Lengths,
                                    this->Target, number, monitor, factor)
                                : RemeshToLengths(this->Remesher, this->Target, monitor);
    result.Length = factor * this->Length;
    return remeshed;
  }

  // Whether there is something to do again.
  bool Correct(int round, const IsotropicRemesher::Result& patches, const Monitor& monitor)
  {
    const bool isDefault = this->Target.IsDefaultLength &&
      this->Target.TargetNumberOfPatches == 0 &&
      this->Target.SizeField != PatchTarget::LengthSource::Array;
    bool again = isDefault &&
      LengthCorrection::ShortenInComponents(this->Surface, this->Check, this->Findings.Losses,
        LargestLoss, this->Lengths);
    if (!this->Findings.NewCrossings.empty())
    {
      this->Uncross(round, patches, monitor);
      again = true;
    }
    return again;
  }

  // Shorter lengths, then patches in the triangles of the surface, there and at last all over.
  void Uncross(int round, const IsotropicRemesher::Result& patches, const Monitor& monitor)
  {
    const std::vector<TriangleCrossings::Pair>& crossings = this->Findings.NewCrossings;
    const int lastOfHalving = 2;
    const int lastOfPlaces = 6;
    const std::vector<bool> points = round <= lastOfPlaces
      ? LengthCorrection::FindPoints(this->Surface, this->Check, patches, crossings, monitor)
      : LengthCorrection::FindPointsOfComponents(this->Surface, this->Check, patches, crossings);
    if (round <= lastOfHalving)
    {
      LengthCorrection::Halve(points, this->Lengths);
    }
    else
    {
      this->Remesher.KeepCreases(points);
    }
  }

  Outcome Conclude(RemeshToTarget::Result& result)
  {
    const std::vector<std::size_t>& components = this->Check.GetComponents();
    const auto getComponent = [&](std::size_t patch)
    { return components[result.Patches.SourcesOfTriangles[patch]]; };
    for (const TriangleCrossings::Pair& pair : this->Findings.Crossings)
    {
      const bool within = getComponent(pair.First) == getComponent(pair.Second);
      (within ? result.CrossingsWithin : result.CrossingsBetween)
        .emplace_back(pair.First, pair.Second);
    }
    if (const std::string losses = this->DescribeLosses(); !losses.empty())
    {
      result.Warnings.push_back(losses);
    }
    if (this->Findings.NewCrossings.empty())
    {
      return Outcome::Done();
    }
    const std::string crossings = this->DescribeCrossings(result.Patches);
    if (!this->Target.AllowsCrossings)
    {
      return Outcome::Failed(crossings +
        "give a smaller TargetEdgeLength or FeatureAngle, or set SelfIntersections to Keep.");
    }
    result.Warnings.push_back(crossings + "give a smaller TargetEdgeLength or FeatureAngle.");
    return Outcome::Done();
  }

  std::string DescribeCrossings(const IsotropicRemesher::Result& patches) const
  {
    const TriangleCrossings::Pair& first = this->Findings.NewCrossings[0];
    const CGAL::Bbox_3 box = TriangleCrossings::Intersect(
      TriangleCrossings::GetBox(patches.Points, patches.Triangles[first.First]),
      TriangleCrossings::GetBox(patches.Points, patches.Triangles[first.Second]));
    std::ostringstream text;
    text << this->Findings.NewCrossings.size()
         << " pairs of patches cross where the surface does not, the first near ("
         << 0.5 * (box.xmin() + box.xmax()) << ", " << 0.5 * (box.ymin() + box.ymax()) << ", "
         << 0.5 * (box.zmin() + box.zmax()) << "), however short edges are there: ";
    return text.str();
  }

  std::string DescribeLosses() const
  {
    const std::vector<double>& losses = this->Findings.Losses;
    const auto many =
      std::count_if(losses.begin(), losses.end(), [](double loss) { return loss > LargestLoss; });
    if (many == 0)
    {
      return {};
    }
    const auto worst = std::max_element(losses.begin(), losses.end());
    const TriangleSoup::Point center =
      this->Check.GetCenter(static_cast<std::size_t>(worst - losses.begin()));
    std::ostringstream text;
    text << many << " of " << losses.size() << " components lost more than " << 100.0 * LargestLoss
         << " % of their area or volume, the most " << std::round(100.0 * *worst)
         << " %, by the one around (" << center[0] << ", " << center[1] << ", " << center[2]
         << "): give a smaller TargetEdgeLength, more patches, or lengths by curvature.";
    return text.str();
  }

  static constexpr double LargestLoss = 0.05;

  IsotropicRemesher& Remesher;
  const TriangleSoup& Soup;
  const PatchTarget& Target;
  const SourceSurface Surface;
  PatchCheck Check;
  PatchCheck::Findings Findings;
  std::vector<double> Lengths;
  double Length = 0.0;
};
} // namespace

//------------------------------------------------------------------------------
Outcome RemeshToTarget::Run(IsotropicRemesher& remesher, const TriangleSoup& soup,
  const PatchTarget& target, const Monitor& monitor, Result& result)
{
  CheckedRemeshing remeshing(remesher, soup, target);
  const Outcome found = remeshing.FindLengths();
  return found ? remeshing.Run(monitor, result) : found;
}
} // namespace LightTransport
