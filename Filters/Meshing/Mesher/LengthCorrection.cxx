// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/LengthCorrection.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
std::vector<std::size_t> GetComponentsOfPoints(const SourceSurface& surface,
  const PatchCheck& check)
{
  std::vector<std::size_t> components(surface.Points.size(), 0);
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    for (const std::size_t corner : surface.Triangles[i])
    {
      components[corner] = check.GetComponents()[i];
    }
  }
  return components;
}
} // namespace

//------------------------------------------------------------------------------
std::vector<bool> LengthCorrection::FindPoints(const SourceSurface& surface,
  const PatchCheck& check, const IsotropicRemesher::Result& patches,
  const std::vector<TriangleCrossings::Pair>& crossings, const Monitor& monitor)
{
  std::vector<bool> found(surface.Points.size(), false);
  std::vector<CGAL::Bbox_3> places;
  std::vector<std::size_t> componentOfPlace;
  for (const TriangleCrossings::Pair& pair : crossings)
  {
    for (const std::size_t patch : { pair.First, pair.Second })
    {
      const CGAL::Bbox_3 box = TriangleCrossings::GetBox(patches.Points, patches.Triangles[patch]);
      const double size = std::hypot(box.x_span(), box.y_span(), box.z_span());
      places.push_back(TriangleCrossings::Widen(box, 0.5 * size));
      const std::size_t source = patches.SourcesOfTriangles[patch];
      componentOfPlace.push_back(check.GetComponents()[source]);
      for (const std::size_t corner : surface.Triangles[source])
      {
        found[corner] = true;
      }
    }
  }
  std::vector<CGAL::Bbox_3> points;
  for (const SourceSurface::Point& p : surface.Points)
  {
    points.emplace_back(p[0], p[1], p[2], p[0], p[1], p[2]);
  }
  const std::vector<std::size_t> componentOfPoint = GetComponentsOfPoints(surface, check);
  TriangleCrossings::ForEachOverlap(places, points, monitor,
    [&](std::size_t place, std::size_t point)
    { found[point] = found[point] || componentOfPlace[place] == componentOfPoint[point]; });
  return found;
}

//------------------------------------------------------------------------------
std::vector<bool> LengthCorrection::FindPointsOfComponents(const SourceSurface& surface,
  const PatchCheck& check, const IsotropicRemesher::Result& patches,
  const std::vector<TriangleCrossings::Pair>& crossings)
{
  std::vector<bool> crosses(check.GetNumberOfComponents(), false);
  for (const TriangleCrossings::Pair& pair : crossings)
  {
    crosses[check.GetComponents()[patches.SourcesOfTriangles[pair.First]]] = true;
    crosses[check.GetComponents()[patches.SourcesOfTriangles[pair.Second]]] = true;
  }
  std::vector<bool> found;
  for (const std::size_t component : GetComponentsOfPoints(surface, check))
  {
    found.push_back(crosses[component]);
  }
  return found;
}

//------------------------------------------------------------------------------
void LengthCorrection::Halve(const std::vector<bool>& points, std::vector<double>& lengths)
{
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    lengths[i] *= points[i] ? 0.5 : 1.0;
  }
}

//------------------------------------------------------------------------------
bool LengthCorrection::ShortenInComponents(const SourceSurface& surface, const PatchCheck& check,
  const std::vector<double>& losses, double most, std::vector<double>& lengths)
{
  const std::vector<std::size_t> components = GetComponentsOfPoints(surface, check);
  const double mostPatches = 1000.0;
  bool any = false;
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    const double loss = losses[components[i]];
    const double area = check.GetArea(components[i]) / mostPatches;
    const double shortest = std::sqrt(4.0 / std::sqrt(3.0) * area);
    if (loss > most && lengths[i] > shortest)
    {
      // Losses go with the square of the length, while it is short.
      const double part = std::min(std::max(std::sqrt(0.5 * most / loss), 0.25), 0.7);
      lengths[i] = std::max(part * lengths[i], shortest);
      any = true;
    }
  }
  return any;
}
} // namespace LightTransport
