// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/RemeshToTarget.h"

#include "Mesher/EdgeLengths.h"
#include "Mesher/WantedLengths.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace LightTransport
{
namespace
{
constexpr double MaximumNumberOfTriangles = 2e7;

//------------------------------------------------------------------------------
Outcome CheckNumberOfTriangles(double number, const PatchTarget& target)
{
  // Written so that a length too small for the estimate, infinite then, is refused too.
  if (number <= MaximumNumberOfTriangles)
  {
    return Outcome::Done();
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
Outcome CheckTargetNumber(vtkIdType number)
{
  if (number > MaximumNumberOfTriangles)
  {
    std::ostringstream text;
    text << "TargetNumberOfPatches is " << number << ", more than " << MaximumNumberOfTriangles
         << " are refused: ask for fewer.";
    return Outcome::Failed(text.str());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome RemeshToLengths(IsotropicRemesher& remesher, const PatchTarget& target,
  const Monitor& monitor)
{
  remesher.Prepare(1.0, target.Grading);
  return remesher.Remesh(target.NumberOfIterations, monitor);
}

//------------------------------------------------------------------------------
// Finds the factor of all lengths that leads to a number of triangles.
class FactorSearch
{
public:
  FactorSearch(IsotropicRemesher& remesher, const PatchTarget& target, double firstFactor)
    : Remesher(remesher), Grading(target.Grading), Factor(firstFactor)
  {
  }

  /// Prepare the surface so that `number` triangles are to be expected.
  void Prepare(double number)
  {
    const double tolerance = 0.003;
    const int steps = 8;
    this->Expected = this->Remesher.Prepare(this->Factor, this->Grading);
    // The number goes with the factor to this power, or a smaller one near edges to keep.
    double power = 2.0;
    for (int i = 0; i < steps && std::abs(this->Expected / number - 1.0) > tolerance; ++i)
    {
      const double change = std::pow(this->Expected / number, 1.0 / power);
      const double before = this->Expected;
      this->Factor *= change;
      this->Expected = this->Remesher.Prepare(this->Factor, this->Grading);
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
  double Expected = 0.0;
};

//------------------------------------------------------------------------------
// `factor` becomes that of all lengths.
Outcome RemeshToNumber(IsotropicRemesher& remesher, const PatchTarget& target, double firstNumber,
  const Monitor& monitor, double& factor)
{
  const double number = static_cast<double>(target.TargetNumberOfPatches);
  FactorSearch search(remesher, target, std::sqrt(firstNumber / number));
  // How many triangles come out for each that is expected; measured, then corrected.
  double excess = 1.15;
  const int passes = 4;
  const double tolerance = 0.03;
  double result = 2.0 * number;
  for (int i = 0; i < passes && result > (1.0 + tolerance) * number; ++i)
  {
    search.Prepare(number / excess);
    // One correction is the rule.
    const double begin = 1.0 - std::pow(0.5, i);
    const double end = begin + 0.5 * (1.0 - begin);
    if (Outcome remeshed = remesher.Remesh(target.NumberOfIterations, monitor.GetStage(begin, end));
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
} // namespace

//------------------------------------------------------------------------------
Outcome RemeshToTarget::Run(IsotropicRemesher& remesher, const TriangleSoup& soup,
  const PatchTarget& target, const Monitor& monitor, double& length)
{
  const SourceSurface surface = remesher.GetSurface();
  std::vector<double> lengths;
  if (Outcome known = WantedLengths::Find(remesher, surface, soup, target, lengths); !known)
  {
    return known;
  }
  const double meanLength = EdgeLengths::GetMeanLength(surface, lengths);
  WantedLengths::FreePlanarRegions(remesher, surface, target, soup.GetDiagonal(), lengths);
  remesher.SetLengths(lengths);
  const double number = EdgeLengths::EstimateNumberOfTriangles(surface, lengths);
  const bool fromArray = target.SizeField == PatchTarget::LengthSource::Array;
  const bool toNumber = target.TargetNumberOfPatches > 0 && std::isfinite(number);
  if (Outcome checked = toNumber ? CheckTargetNumber(target.TargetNumberOfPatches)
                                 : CheckNumberOfTriangles(number, target);
      !checked)
  {
    return checked;
  }
  double factor = 1.0;
  Outcome remeshed = toNumber ? RemeshToNumber(remesher, target, number, monitor, factor)
                              : RemeshToLengths(remesher, target, monitor);
  length = factor * (fromArray ? meanLength : target.TargetEdgeLength);
  return remeshed;
}
} // namespace LightTransport
