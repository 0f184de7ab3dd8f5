// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SurfaceRepair.h"

#include "Mesher/ManifoldRepair.h"
#include "Mesher/SoupRepair.h"

#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
using SurfaceRepair::Settings;

//------------------------------------------------------------------------------
Outcome CheckDefects(const TriangleSoup& soup)
{
  const std::string defects = soup.DescribeDefects();
  return defects.empty()
    ? Outcome::Done()
    : Outcome::Failed("The surface has " + defects + ": switch Repair on or repair it first.");
}

//------------------------------------------------------------------------------
Outcome RepairDefects(const Settings& settings, const Monitor& monitor, TriangleSoup& soup,
  RepairCounts& counts)
{
  SoupRepair triangles(soup, counts);
  triangles.DropDegenerateTriangles();
  triangles.DropDuplicateTriangles();
  triangles.Orient();
  if (!monitor.Report(0.5))
  {
    return Outcome::Aborted();
  }

  const double size = SurfaceRepair::ChooseHoleSize(settings.HoleSize, soup);
  ManifoldRepair surface;
  if (Outcome built = surface.Build(soup); !built)
  {
    return built;
  }
  // Where a crumb is gone, what else met there can be joined.
  vtkIdType changes = surface.JoinBorders();
  const vtkIdType crumbs = surface.DropCrumbs(size);
  changes += crumbs + surface.JoinBorders();
  if (!monitor.Report(0.75))
  {
    return Outcome::Aborted();
  }
  const vtkIdType holes = settings.FillHoles ? surface.FillHoles(size) : 0;
  const vtkIdType dropped = counts.NumberOfDroppedTriangles + crumbs;
  if (changes + holes > 0)
  {
    surface.Write(soup);
    // A crack without width has been filled with triangles without area.
    triangles.DropDegenerateTriangles();
  }
  counts.NumberOfDroppedTriangles = dropped;
  counts.NumberOfFilledHoles = holes;
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
  const ManifoldRepair::Intersections found = surface.FindSelfIntersections();
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
