// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SizedRemeshing.h"

#include "Mesher/PatchSizing.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
using SizedRemeshing::LengthSource;
using SizedRemeshing::Settings;

constexpr double MAXIMUM_NUMBER_OF_TRIANGLES = 2e7;

//------------------------------------------------------------------------------
Outcome GetLengthsOfArray(const SurfaceRemesher& remesher, const TriangleSoup& soup,
  const Settings& settings, std::vector<double>& lengths)
{
  for (const std::size_t point : remesher.GetPointsOfSoup())
  {
    const vtkIdType id = soup.PointIds[point];
    const double length = settings.LengthsOfPoints[id];
    if (!(length > 0.0) || !std::isfinite(length))
    {
      std::ostringstream text;
      text << "The array of edge lengths has the value " << length << " at point " << id
           << ": give positive, finite lengths.";
      return Outcome::Failed(text.str());
    }
    lengths.push_back(length);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome GetLengths(const SurfaceRemesher& remesher, const SourceSurface& surface,
  const TriangleSoup& soup, const Settings& settings, std::vector<double>& lengths)
{
  if (settings.SizeField == LengthSource::Array)
  {
    return GetLengthsOfArray(remesher, soup, settings, lengths);
  }
  lengths.assign(surface.Points.size(), settings.TargetEdgeLength);
  if (settings.SizeField == LengthSource::Curvature)
  {
    const std::vector<double> curvatures = PatchSizing::GetCurvatures(surface);
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      lengths[i] = PatchSizing::GetLengthForCurvature(curvatures[i], settings.ApproximationError,
        settings.MinimumEdgeLength, settings.TargetEdgeLength);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Planar regions may have long edges: as long as elsewhere, if the curvature at their borders would
// shorten those within; or as long as the regions are wide, if they stay coarse.
void FreePlanarRegions(SurfaceRemesher& remesher, const SourceSurface& surface,
  const Settings& settings, double diagonal, std::vector<double>& lengths)
{
  const bool coarse = settings.CoarsePlanarRegions;
  if (!coarse && settings.SizeField != LengthSource::Curvature)
  {
    return;
  }
  const std::vector<std::size_t> regions = PatchSizing::FindPlanarRegions(surface, lengths);
  std::vector<double> inside(surface.Triangles.size(), settings.TargetEdgeLength);
  if (coarse)
  {
    // Triangles across a narrow region are not thinner than 1 : 1.5.
    const double lengthOverWidth = 1.5;
    inside = PatchSizing::GetWidths(surface, regions);
    for (double& length : inside)
    {
      length = std::min(lengthOverWidth * length, diagonal);
    }
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      double longest = diagonal;
      for (const std::size_t triangle : surface.GetTrianglesAround(i))
      {
        const bool planar = regions[triangle] != SourceSurface::NONE;
        longest = std::min(longest, planar ? inside[triangle] : lengths[i]);
      }
      lengths[i] = std::max(lengths[i], longest);
    }
  }
  remesher.SetPlanarRegions(regions, inside, coarse);
}

//------------------------------------------------------------------------------
Outcome CheckNumberOfTriangles(double number, const Settings& settings)
{
  // Written so that a length too small for the estimate, infinite then, is refused too.
  if (number <= MAXIMUM_NUMBER_OF_TRIANGLES)
  {
    return Outcome::Done();
  }
  std::ostringstream text;
  if (settings.SizeField == LengthSource::Array)
  {
    text << "The array of edge lengths";
  }
  else
  {
    text << "TargetEdgeLength " << settings.TargetEdgeLength;
  }
  text << " would give about " << number << " triangles, more than " << MAXIMUM_NUMBER_OF_TRIANGLES
       << " are refused: give larger lengths.";
  return Outcome::Failed(text.str());
}

//------------------------------------------------------------------------------
Outcome CheckTargetNumber(vtkIdType number)
{
  if (number > MAXIMUM_NUMBER_OF_TRIANGLES)
  {
    std::ostringstream text;
    text << "TargetNumberOfPatches is " << number << ", more than " << MAXIMUM_NUMBER_OF_TRIANGLES
         << " are refused: ask for fewer.";
    return Outcome::Failed(text.str());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome RemeshToLengths(SurfaceRemesher& remesher, const Settings& settings, const Monitor& monitor)
{
  remesher.Prepare(1.0, settings.Grading);
  return remesher.Remesh(settings.NumberOfIterations, monitor);
}

//------------------------------------------------------------------------------
// Finds the factor of all lengths that leads to a number of triangles.
class FactorSearch
{
public:
  FactorSearch(SurfaceRemesher& remesher, const Settings& settings, double firstFactor)
    : Remesher(remesher), Grading(settings.Grading), Factor(firstFactor)
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
  SurfaceRemesher& Remesher;
  double Grading;
  double Factor;
  double Expected = 0.0;
};

//------------------------------------------------------------------------------
// `factor` becomes that of all lengths.
Outcome RemeshToNumber(SurfaceRemesher& remesher, const Settings& settings, double firstNumber,
  const Monitor& monitor, double& factor)
{
  const double number = static_cast<double>(settings.TargetNumberOfPatches);
  FactorSearch search(remesher, settings, std::sqrt(firstNumber / number));
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
    if (Outcome remeshed =
          remesher.Remesh(settings.NumberOfIterations, monitor.GetStage(begin, end));
        !remeshed)
    {
      return remeshed;
    }
    result = static_cast<double>(remesher.GetNumberOfTriangles());
    excess = result / search.GetExpected();
  }
  // Where all edges are alike, the number jumps when they become long enough to be split. From too
  // few triangles any number can be reached, while it may be impossible to collapse edges.
  factor = search.GetFactor();
  return remesher.AdjustNumberOfTriangles(static_cast<std::size_t>(number),
    monitor.GetStage(1.0, 1.0));
}
} // namespace

//------------------------------------------------------------------------------
Outcome SizedRemeshing::ReadLengths(vtkDataArray* array, std::vector<double>& lengths)
{
  if (array->GetNumberOfComponents() != 1)
  {
    return Outcome::Failed("The array of edge lengths \"" + std::string(array->GetName()) +
      "\" has " + std::to_string(array->GetNumberOfComponents()) +
      " components: give an array with one.");
  }
  lengths.resize(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    lengths[i] = array->GetTuple1(i);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome SizedRemeshing::Remesh(SurfaceRemesher& remesher, const TriangleSoup& soup,
  const Settings& settings, const Monitor& monitor, double& length)
{
  const SourceSurface surface = remesher.GetSurface();
  std::vector<double> lengths;
  if (Outcome known = GetLengths(remesher, surface, soup, settings, lengths); !known)
  {
    return known;
  }
  const double meanLength = PatchSizing::GetMeanLength(surface, lengths);
  FreePlanarRegions(remesher, surface, settings, soup.GetDiagonal(), lengths);
  remesher.SetLengths(lengths);
  const double number = PatchSizing::EstimateNumberOfTriangles(surface, lengths);
  const bool fromArray = settings.SizeField == LengthSource::Array;
  const bool toNumber = settings.TargetNumberOfPatches > 0 && std::isfinite(number);
  if (Outcome checked = toNumber ? CheckTargetNumber(settings.TargetNumberOfPatches)
                                 : CheckNumberOfTriangles(number, settings);
      !checked)
  {
    return checked;
  }
  double factor = 1.0;
  Outcome remeshed = toNumber ? RemeshToNumber(remesher, settings, number, monitor, factor)
                              : RemeshToLengths(remesher, settings, monitor);
  length = factor * (fromArray ? meanLength : settings.TargetEdgeLength);
  return remeshed;
}
} // namespace LightTransport
