// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SurfaceRepair.h"

#include "Mesher/ManifoldRepair.h"
#include "Mesher/SoupRepair.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace LightTransport
{
namespace
{
using SurfaceRepair::Settings;

// Self-intersections that are tried to be resolved: so many, and a part of the triangles.
constexpr double MostIntersections = 100.0;
constexpr double PartOfTriangles = 0.1;

//------------------------------------------------------------------------------
Outcome CheckDefects(const TriangleSoup& soup)
{
  const std::string defects = soup.DescribeDefects();
  return defects.empty()
    ? Outcome::Done()
    : Outcome::Failed("The surface has " + defects + ": switch Repair on or repair it first.");
}

//------------------------------------------------------------------------------
void NoteCrossingPolygons(const TriangleSoup& soup, RepairCounts& counts)
{
  const std::vector<vtkIdType>& cells = soup.CrossingCells;
  counts.NumberOfSkippedPolygons = static_cast<vtkIdType>(cells.size());
  if (cells.empty())
  {
    return;
  }
  std::ostringstream text;
  text << cells.size() << " polygons were left out, for their border crosses itself: cells";
  const std::size_t mostNames = 10;
  for (std::size_t i = 0; i < std::min(cells.size(), mostNames); ++i)
  {
    text << (i > 0 ? ", " : " ") << cells[i];
  }
  text << (cells.size() > mostNames ? " ..." : "")
       << ". Mend the border, or cut it into triangles.";
  counts.AddNote(text.str());
}

//------------------------------------------------------------------------------
// Welding may leave triangles without area, and what they leave open is to be joined.
Outcome JoinTriangles(SoupRepair& triangles, const Monitor& monitor)
{
  const int mostPasses = 4;
  for (int pass = 0; pass < mostPasses; ++pass)
  {
    if (Outcome joined = triangles.Join(monitor); !joined)
    {
      return joined;
    }
    if (triangles.DropDegenerateTriangles() == 0)
    {
      break;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome RepairDefects(const Settings& settings, const Monitor& monitor, TriangleSoup& soup,
  RepairCounts& counts)
{
  NoteCrossingPolygons(soup, counts);
  SoupRepair triangles(soup, settings.WeldTolerance, counts);
  triangles.DropDegenerateTriangles();
  triangles.DropCopies();
  if (Outcome joined = JoinTriangles(triangles, monitor.GetStage(0.0, 0.5)); !joined)
  {
    return joined;
  }
  const double size = SurfaceRepair::ChooseHoleSize(settings.HoleSize, soup);
  auto surface = std::make_unique<ManifoldRepair>();
  if (Outcome built = surface->Build(soup); !built)
  {
    return built;
  }
  // Where a crumb is gone, what else met there can be joined, which may leave others.
  const int mostPasses = 5;
  vtkIdType crumbs = surface->DropCrumbs(size);
  for (int pass = 0; pass < mostPasses && crumbs > 0; ++pass)
  {
    counts.NumberOfDroppedTriangles += crumbs;
    surface->Write(soup);
    if (Outcome joined = JoinTriangles(triangles, monitor.GetStage(0.5, 0.75)); !joined)
    {
      return joined;
    }
    surface = std::make_unique<ManifoldRepair>();
    if (Outcome built = surface->Build(soup); !built)
    {
      return built;
    }
    crumbs = surface->DropCrumbs(size);
  }
  counts.NumberOfDroppedTriangles += crumbs;
  counts.NumberOfFilledHoles =
    settings.FillHoles ? surface->FillHoles(size, monitor.GetStage(0.75, 0.9)) : 0;
  if (counts.NumberOfFilledHoles + crumbs > 0)
  {
    surface->Write(soup);
    // A crack without width has been filled with triangles without area.
    RepairCounts others;
    SoupRepair filled(soup, settings.WeldTolerance, others);
    if (filled.DropDegenerateTriangles() > 0)
    {
      return JoinTriangles(filled, monitor.GetStage(0.9, 1.0));
    }
  }
  return monitor.Check(1.0);
}

//------------------------------------------------------------------------------
std::string Describe(const ManifoldRepair::Intersections& found,
  const ManifoldRepair::Intersections& left)
{
  std::ostringstream text;
  text << "The surface intersects itself: " << found.NumberWithin
       << " pairs of triangles of one connected component do";
  if (left.NumberWithin < found.NumberWithin)
  {
    text << ", and " << left.NumberWithin << " of them could not be resolved";
  }
  text << ", the first near (" << left.Place[0] << ", " << left.Place[1] << ", " << left.Place[2]
       << "), of the input's cells " << left.CellIds[0] << " and " << left.CellIds[1] << ". ";
  return text.str();
}

//------------------------------------------------------------------------------
Outcome TreatSelfIntersections(const Settings& settings, const Monitor& monitor, TriangleSoup& soup,
  RepairCounts& counts)
{
  ManifoldRepair surface;
  if (Outcome built = surface.Build(soup); !built)
  {
    return built;
  }
  const ManifoldRepair::Intersections found =
    surface.FindSelfIntersections(monitor.GetStage(0.0, 0.5));
  counts.NumberOfSelfIntersections = found.NumberWithin;
  counts.NumberOfIntersectionsBetweenComponents = found.NumberBetween;
  if (!monitor.Report(0.5))
  {
    return Outcome::Aborted();
  }
  if (found.NumberWithin == 0 || settings.SelfIntersections == SurfaceRepair::Intersections::Keep)
  {
    return Outcome::Done();
  }
  if (!settings.Repair || settings.SelfIntersections == SurfaceRepair::Intersections::Refuse)
  {
    return Outcome::Failed(Describe(found, found) +
      "Set SelfIntersections to Resolve (with Repair on) or Keep, or repair the surface first.");
  }
  // Local repair is for few of them: elsewhere it takes long, and fails.
  const auto most = static_cast<vtkIdType>(
    MostIntersections + PartOfTriangles * static_cast<double>(soup.Triangles.size()));
  if (found.NumberWithin > most)
  {
    return Outcome::Failed(Describe(found, found) + "More than " + std::to_string(most) +
      " are not resolved: set SelfIntersections to Keep, or repair the surface first.");
  }
  ManifoldRepair::Intersections left;
  if (Outcome resolved = surface.ResolveSelfIntersections(
        SurfaceRepair::ChooseHoleSize(settings.HoleSize, soup), monitor.GetStage(0.5, 1.0), left);
      !resolved)
  {
    return resolved;
  }
  if (left.NumberWithin > 0)
  {
    return Outcome::Failed(Describe(found, left) +
      "Set SelfIntersections to Keep, give a larger HoleSize, or repair the surface first.");
  }
  surface.Write(soup);
  counts.NumberResolved = found.NumberWithin;
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
double SurfaceRepair::ChooseHoleSize(double wanted, const TriangleSoup& soup)
{
  const double partsOfDiagonal = 100.0;
  return wanted > 0.0 ? wanted : soup.GetDiagonal() / partsOfDiagonal;
}

//------------------------------------------------------------------------------
Outcome SurfaceRepair::Run(const Settings& settings, const Monitor& monitor, TriangleSoup& soup,
  RepairCounts& counts)
{
  if (Outcome defects = settings.Repair
        ? RepairDefects(settings, monitor.GetStage(0.0, 0.5), soup, counts)
        : CheckDefects(soup);
      !defects)
  {
    return defects;
  }
  if (Outcome treated = TreatSelfIntersections(settings, monitor.GetStage(0.5, 1.0), soup, counts);
      !treated)
  {
    return treated;
  }
  return monitor.Check(1.0);
}
} // namespace LightTransport
