// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/PatchCheck.h"

#include "Common/SoupEdges.h"
#include "Mesher/PointVectors.h"
#include "Shared/DisjointSets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace LightTransport
{
namespace
{
using TriangleCrossings::Pair;

//------------------------------------------------------------------------------
double GetLongestSide(const TriangleCrossings::Points& points,
  const TriangleSoup::Triangle& triangle)
{
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const double side =
      (ToVector(points[triangle[(i + 1) % 3]]) - ToVector(points[triangle[i]])).norm();
    longest = std::max(longest, side);
  }
  return longest;
}

//------------------------------------------------------------------------------
// Where each pair is, and somewhat further.
std::vector<CGAL::Bbox_3> GetPlaces(const TriangleCrossings::Points& points,
  const TriangleCrossings::Triangles& triangles, const std::vector<Pair>& pairs, bool widen)
{
  std::vector<CGAL::Bbox_3> places;
  for (const Pair& pair : pairs)
  {
    const TriangleSoup::Triangle& a = triangles[pair.First];
    const TriangleSoup::Triangle& b = triangles[pair.Second];
    const double reach =
      widen ? std::max(GetLongestSide(points, a), GetLongestSide(points, b)) : 0.0;
    places.push_back(
      TriangleCrossings::Widen(TriangleCrossings::Intersect(TriangleCrossings::GetBox(points, a),
                                 TriangleCrossings::GetBox(points, b)),
        reach));
  }
  return places;
}
} // namespace

//------------------------------------------------------------------------------
PatchCheck::PatchCheck(const TriangleSoup& soup) : Soup(soup)
{
  this->FindComponents();
  this->Before = this->Measure(soup.Points, soup.Triangles, nullptr);
  for (std::size_t i = 0; i < soup.Triangles.size(); ++i)
  {
    this->Before[this->Components[i]].Box +=
      TriangleCrossings::GetBox(soup.Points, soup.Triangles[i]);
  }
  std::vector<std::size_t> componentOfPoint(soup.Points.size(), 0);
  for (std::size_t i = 0; i < soup.Triangles.size(); ++i)
  {
    for (const std::size_t corner : soup.Triangles[i])
    {
      componentOfPoint[corner] = this->Components[i];
    }
  }
  SoupEdges::ForEach(soup.Triangles,
    [&](const SoupEdges::Edge& edge, int forward, int backward)
    {
      Measures& component = this->Before[componentOfPoint[edge.first]];
      component.IsClosed = component.IsClosed && forward == 1 && backward == 1;
    });
}

//------------------------------------------------------------------------------
// Numbered in the order of their first triangles.
void PatchCheck::FindComponents()
{
  DisjointSets sets(this->Soup.Points.size());
  for (const TriangleSoup::Triangle& triangle : this->Soup.Triangles)
  {
    sets.Join(triangle[0], triangle[1]);
    sets.Join(triangle[0], triangle[2]);
  }
  std::vector<std::size_t> numbers(this->Soup.Points.size(), SourceSurface::None);
  std::size_t next = 0;
  for (const TriangleSoup::Triangle& triangle : this->Soup.Triangles)
  {
    std::size_t& number = numbers[sets.Find(triangle[0])];
    number = number == SourceSurface::None ? next++ : number;
    this->Components.push_back(number);
  }
  this->Before.resize(next);
}

//------------------------------------------------------------------------------
TriangleSoup::Point PatchCheck::GetCenter(std::size_t component) const
{
  const CGAL::Bbox_3& box = this->Before[component].Box;
  return { 0.5 * (box.xmin() + box.xmax()), 0.5 * (box.ymin() + box.ymax()),
    0.5 * (box.zmin() + box.zmax()) };
}

//------------------------------------------------------------------------------
std::vector<PatchCheck::Measures> PatchCheck::Measure(const Points& points,
  const Triangles& triangles, const std::vector<std::size_t>* sources) const
{
  std::vector<Measures> measures(this->GetNumberOfComponents());
  // Volumes are measured from a point of the component: far away digits would be lost.
  std::vector<const TriangleSoup::Point*> origins(measures.size(), nullptr);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const std::size_t component = this->Components[sources ? (*sources)[i] : i];
    const TriangleSoup::Point*& origin = origins[component];
    origin = origin ? origin : &points[triangles[i][0]];
    const Eigen::Vector3d a = ToVector(points[triangles[i][0]]) - ToVector(*origin);
    const Eigen::Vector3d b = ToVector(points[triangles[i][1]]) - ToVector(*origin);
    const Eigen::Vector3d c = ToVector(points[triangles[i][2]]) - ToVector(*origin);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    measures[component].Area += 0.5 * normal.norm();
    measures[component].Volume += a.dot(normal) / 6.0;
  }
  return measures;
}

//------------------------------------------------------------------------------
PatchCheck::Findings PatchCheck::Compare(const IsotropicRemesher::Result& patches,
  const Monitor& monitor)
{
  Findings findings;
  findings.Crossings =
    TriangleCrossings::Find(patches.Points, patches.Triangles, monitor.GetStage(0.0, 0.5));
  const auto touches = [](const Pair& pair) { return pair.OnlyTouches; };
  findings.Crossings.erase(
    std::remove_if(findings.Crossings.begin(), findings.Crossings.end(), touches),
    findings.Crossings.end());
  findings.NewCrossings = this->FindNew(patches, findings.Crossings, monitor.GetStage(0.5, 1.0));

  const std::vector<Measures> after =
    this->Measure(patches.Points, patches.Triangles, &patches.SourcesOfTriangles);
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    const Measures& before = this->Before[i];
    double left = before.Area > 0.0 ? after[i].Area / before.Area : 1.0;
    // Of a closed sheet without thickness rounding is all there is.
    const double smallest = 1e-9 * before.Area * std::sqrt(before.Area);
    if (before.IsClosed && std::abs(before.Volume) > smallest)
    {
      left = std::min(left, after[i].Volume / before.Volume);
    }
    findings.Losses.push_back(1.0 - left);
  }
  return findings;
}

//------------------------------------------------------------------------------
std::vector<Pair> PatchCheck::FindNew(const IsotropicRemesher::Result& patches,
  const std::vector<Pair>& pairs, const Monitor& monitor)
{
  if (pairs.empty())
  {
    return {};
  }
  if (!this->Meetings)
  {
    this->Meetings =
      TriangleCrossings::Find(this->Soup.Points, this->Soup.Triangles, monitor.GetStage(0.0, 0.5));
  }
  const auto getComponents = [this](std::size_t a, std::size_t b) {
    return std::minmax({ this->Components[a], this->Components[b] });
  };
  std::vector<bool> known(pairs.size(), false);
  TriangleCrossings::ForEachOverlap(GetPlaces(patches.Points, patches.Triangles, pairs, true),
    GetPlaces(this->Soup.Points, this->Soup.Triangles, *this->Meetings, false),
    monitor.GetStage(0.5, 1.0),
    [&](std::size_t now, std::size_t before)
    {
      const Pair& old = (*this->Meetings)[before];
      known[now] = known[now] ||
        getComponents(patches.SourcesOfTriangles[pairs[now].First],
          patches.SourcesOfTriangles[pairs[now].Second]) == getComponents(old.First, old.Second);
    });
  std::vector<Pair> found;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (!known[i])
    {
      found.push_back(pairs[i]);
    }
  }
  return found;
}
} // namespace LightTransport
