// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/LooseTriangles.h"

#include "Shared/ZeroedArray.h"

#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace LightTransport
{
namespace
{
using Triangle = TriangleSoup::Triangle;

// Fewer are a scene of single triangles.
constexpr std::size_t FewTriangles = 16;
// So many corners tell how far they are from others.
constexpr std::size_t MostSamples = 500;
// Two more of its own triangle, itself, and one beyond.
constexpr int PointsAround = 4;
// Gaps below this part of the triangles are rounding, not distances of a scene.
constexpr double LargestGap = 0.02;
// The tolerance that joins most of what is such a gap apart.
constexpr double ToleranceOverGap = 10.0;

//------------------------------------------------------------------------------
double GetMedian(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

//------------------------------------------------------------------------------
// The median distance from corners to those of other triangles, if it is small beside the
// triangles; else 0.
double FindGap(const TriangleSoup& soup, const std::vector<std::size_t>& loose)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  ZeroedArray::Fill(points->GetData(), 3 * static_cast<vtkIdType>(loose.size()));
  vtkIdType next = 0;
  for (const std::size_t triangle : loose)
  {
    for (const std::size_t corner : soup.Triangles[triangle])
    {
      points->SetPoint(next++, soup.Points[corner].data());
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  std::vector<double> gaps;
  std::vector<double> sides;
  vtkNew<vtkIdList> near;
  const std::size_t step = std::max<std::size_t>(loose.size() / MostSamples, 1);
  for (std::size_t i = 0; i < loose.size(); i += step)
  {
    const Triangle& triangle = soup.Triangles[loose[i]];
    const double* corner = soup.Points[triangle[0]].data();
    sides.push_back(
      std::sqrt(vtkMath::Distance2BetweenPoints(corner, soup.Points[triangle[1]].data())));
    locator->FindClosestNPoints(PointsAround, corner, near);
    for (vtkIdType j = 0; j < near->GetNumberOfIds(); ++j)
    {
      if (near->GetId(j) / 3 != static_cast<vtkIdType>(i))
      {
        double other[3];
        points->GetPoint(near->GetId(j), other);
        gaps.push_back(std::sqrt(vtkMath::Distance2BetweenPoints(corner, other)));
        break;
      }
    }
  }
  const double gap = gaps.empty() ? 0.0 : GetMedian(gaps);
  return gap <= LargestGap * GetMedian(sides) ? gap : 0.0;
}
} // namespace

//------------------------------------------------------------------------------
std::string LooseTriangles::Describe(const TriangleSoup& soup, const SideJoiner& joiner)
{
  std::vector<std::size_t> loose;
  for (std::size_t i = 0; i < soup.Triangles.size(); ++i)
  {
    if (joiner.GetPartner(3 * i) == SideJoiner::None &&
      joiner.GetPartner(3 * i + 1) == SideJoiner::None &&
      joiner.GetPartner(3 * i + 2) == SideJoiner::None)
    {
      loose.push_back(i);
    }
  }
  if (loose.size() < FewTriangles || 2 * loose.size() <= soup.Triangles.size())
  {
    return {};
  }
  std::ostringstream text;
  text.precision(2);
  text << loose.size() << " of " << soup.Triangles.size()
       << " triangles are loose: they share no edge with any other";
  if (const double gap = FindGap(soup, loose); gap > 0.0)
  {
    text << ", and most corners are some " << gap << " apart from the next. Set WeldTolerance to "
         << ToleranceOverGap * gap << " if they are to be one surface.";
  }
  else
  {
    text << ". Set WeldTolerance if they are to be one surface.";
  }
  return text.str();
}
} // namespace LightTransport
