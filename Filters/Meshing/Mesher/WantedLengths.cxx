// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/WantedLengths.h"

#include "Mesher/EdgeLengths.h"
#include "Mesher/PlanarRegions.h"
#include "Mesher/SurfaceCurvature.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
Outcome GetLengthsOfArray(const IsotropicRemesher& remesher, const TriangleSoup& soup,
  const PatchTarget& target, std::vector<double>& lengths)
{
  for (const std::size_t point : remesher.GetPointsOfSoup())
  {
    const vtkIdType id = soup.PointIds[point];
    const double length = target.LengthsOfPoints[id];
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
} // namespace

//------------------------------------------------------------------------------
Outcome WantedLengths::Read(vtkDataArray* array, std::vector<double>& lengths)
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
Outcome WantedLengths::Find(const IsotropicRemesher& remesher, const SourceSurface& surface,
  const TriangleSoup& soup, const PatchTarget& target, std::vector<double>& lengths)
{
  if (target.SizeField == PatchTarget::LengthSource::Array)
  {
    return GetLengthsOfArray(remesher, soup, target, lengths);
  }
  lengths.assign(surface.Points.size(), target.TargetEdgeLength);
  if (target.SizeField == PatchTarget::LengthSource::Curvature)
  {
    const std::vector<double> curvatures = SurfaceCurvature::Find(surface);
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      lengths[i] = EdgeLengths::GetLengthForCurvature(curvatures[i], target.ApproximationError,
        target.MinimumEdgeLength, target.TargetEdgeLength);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void WantedLengths::FreePlanarRegions(IsotropicRemesher& remesher, const SourceSurface& surface,
  const PatchTarget& target, double diagonal, std::vector<double>& lengths)
{
  const bool coarse = target.CoarsePlanarRegions;
  if (!coarse && target.SizeField != PatchTarget::LengthSource::Curvature)
  {
    return;
  }
  const std::vector<std::size_t> regions = PlanarRegions::Find(surface, lengths);
  std::vector<double> inside(surface.Triangles.size(), target.TargetEdgeLength);
  if (coarse)
  {
    // Triangles across a narrow region are not thinner than 1 : 1.5.
    const double lengthOverWidth = 1.5;
    inside = PlanarRegions::GetWidths(surface, regions);
    for (double& length : inside)
    {
      length = std::min(lengthOverWidth * length, diagonal);
    }
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      double longest = diagonal;
      for (const std::size_t triangle : surface.GetTrianglesAround(i))
      {
        const bool planar = regions[triangle] != SourceSurface::None;
        longest = std::min(longest, planar ? inside[triangle] : lengths[i]);
      }
      lengths[i] = std::max(lengths[i], longest);
    }
  }
  remesher.SetPlanarRegions(regions, inside, coarse);
}
} // namespace LightTransport
