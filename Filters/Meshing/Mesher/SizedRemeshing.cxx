// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SizedRemeshing.h"

#include "Common/MeshingRun.h"
#include "Mesher/PatchSizing.h"
#include "vtkPatchMesher.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
using MeshingRun::InputError;
using SizedRemeshing::Settings;

constexpr double MAXIMUM_NUMBER_OF_TRIANGLES = 2e7;

//------------------------------------------------------------------------------
std::vector<double> GetLengthsOfArray(const SurfaceRemesher& remesher, const TriangleSoup& soup,
  const Settings& settings)
{
  std::vector<double> lengths;
  for (const std::size_t point : remesher.GetPointsOfSoup())
  {
    const vtkIdType id = soup.PointIds[point];
    const double length = settings.LengthsOfPoints[id];
    if (!(length > 0.0) || !std::isfinite(length))
    {
      std::ostringstream text;
      text << "The array of edge lengths has the value " << length << " at point " << id
           << ": give positive, finite lengths.";
      throw InputError(text.str());
    }
    lengths.push_back(length);
  }
  return lengths;
}

//------------------------------------------------------------------------------
std::vector<double> GetLengths(const SurfaceRemesher& remesher, const SourceSurface& surface,
  const TriangleSoup& soup, const Settings& settings)
{
  if (settings.SizeField == vtkPatchMesher::SIZE_FIELD_ARRAY)
  {
    return GetLengthsOfArray(remesher, soup, settings);
  }
  std::vector<double> lengths(surface.Points.size(), settings.TargetEdgeLength);
  if (settings.SizeField == vtkPatchMesher::SIZE_FIELD_CURVATURE)
  {
    const std::vector<double> curvatures = PatchSizing::GetCurvatures(surface);
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      lengths[i] = PatchSizing::GetLengthForCurvature(curvatures[i], settings.ApproximationError,
        settings.MinimumEdgeLength, settings.TargetEdgeLength);
    }
  }
  return lengths;
}

//------------------------------------------------------------------------------
// Planar regions may have long edges: as long as elsewhere, if the curvature at their borders would
// shorten those within; or as long as the regions are wide, if they stay coarse.
void FreePlanarRegions(SurfaceRemesher& remesher, const SourceSurface& surface,
  const Settings& settings, double diagonal, std::vector<double>& lengths)
{
  const bool coarse = settings.CoarsePlanarRegions;
  if (!coarse && settings.SizeField != vtkPatchMesher::SIZE_FIELD_CURVATURE)
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
void CheckNumberOfTriangles(double number, const Settings& settings)
{
  // Written so that a length too small for the estimate, infinite then, is refused too.
  if (!(number <= MAXIMUM_NUMBER_OF_TRIANGLES))
  {
    std::ostringstream text;
    if (settings.SizeField == vtkPatchMesher::SIZE_FIELD_ARRAY)
    {
      text << "The array of edge lengths";
    }
    else
    {
      text << "TargetEdgeLength " << settings.TargetEdgeLength;
    }
    text << " would give about " << number << " triangles, more than "
         << MAXIMUM_NUMBER_OF_TRIANGLES << " are refused: give larger lengths.";
    throw InputError(text.str());
  }
}

//------------------------------------------------------------------------------
void CheckTargetNumber(vtkIdType number)
{
  if (number > MAXIMUM_NUMBER_OF_TRIANGLES)
  {
    std::ostringstream text;
    text << "TargetNumberOfPatches is " << number << ", more than " << MAXIMUM_NUMBER_OF_TRIANGLES
         << " are refused: ask for fewer.";
    throw InputError(text.str());
  }
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
// Returns the factor of all lengths.
double RemeshToNumber(SurfaceRemesher& remesher, const Settings& settings, double firstNumber,
  const SurfaceRemesher::Monitor& monitor)
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
    remesher.Remesh(settings.NumberOfIterations,
      [&](double fraction) { monitor(begin + 0.5 * (1.0 - begin) * fraction); });
    result = static_cast<double>(remesher.GetNumberOfTriangles());
    excess = result / search.GetExpected();
  }
  // Where all edges are alike, the number jumps when they become long enough to be split. From too
  // few triangles any number can be reached, while it may be impossible to collapse edges.
  remesher.AdjustNumberOfTriangles(static_cast<std::size_t>(number), monitor);
  return search.GetFactor();
}
} // namespace

//------------------------------------------------------------------------------
std::vector<double> SizedRemeshing::ReadLengths(vtkDataArray* array)
{
  if (array->GetNumberOfComponents() != 1)
  {
    throw InputError("The array of edge lengths \"" + std::string(array->GetName()) + "\" has " +
      std::to_string(array->GetNumberOfComponents()) + " components: give an array with one.");
  }
  std::vector<double> lengths(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    lengths[i] = array->GetTuple1(i);
  }
  return lengths;
}

//------------------------------------------------------------------------------
double SizedRemeshing::Remesh(SurfaceRemesher& remesher, const TriangleSoup& soup,
  const Settings& settings, const SurfaceRemesher::Monitor& monitor)
{
  const SourceSurface surface = remesher.GetSurface();
  std::vector<double> lengths = GetLengths(remesher, surface, soup, settings);
  const double meanLength = PatchSizing::GetMeanLength(surface, lengths);
  FreePlanarRegions(remesher, surface, settings, soup.GetDiagonal(), lengths);
  remesher.SetLengths(lengths);
  const double number = PatchSizing::EstimateNumberOfTriangles(surface, lengths);
  double factor = 1.0;
  if (settings.TargetNumberOfPatches > 0 && std::isfinite(number))
  {
    CheckTargetNumber(settings.TargetNumberOfPatches);
    factor = RemeshToNumber(remesher, settings, number, monitor);
  }
  else
  {
    CheckNumberOfTriangles(number, settings);
    remesher.Prepare(factor, settings.Grading);
    remesher.Remesh(settings.NumberOfIterations, monitor);
  }
  const bool fromArray = settings.SizeField == vtkPatchMesher::SIZE_FIELD_ARRAY;
  return factor * (fromArray ? meanLength : settings.TargetEdgeLength);
}
} // namespace LightTransport
