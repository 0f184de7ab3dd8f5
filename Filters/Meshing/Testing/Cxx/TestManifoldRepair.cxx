// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The long steps of the repair, which are CGAL's, hear that nobody wants them any more.
#include "Common/Heartbeat.h"
#include "MeshTestTools.h"
#include "Mesher/ManifoldRepair.h"

using namespace LightTransport;

namespace
{
//------------------------------------------------------------------------------
// A tube around z whose rows of points are where a function says.
template <typename Function>
TriangleSoup MakeTube(std::size_t rows, std::size_t columns, const Function& place)
{
  TriangleSoup soup;
  for (std::size_t i = 0; i < rows; ++i)
  {
    for (std::size_t j = 0; j < columns; ++j)
    {
      soup.Points.push_back(place(static_cast<double>(i) / static_cast<double>(rows - 1),
        2.0 * vtkMath::Pi() * static_cast<double>(j) / static_cast<double>(columns)));
      soup.PointIds.push_back(static_cast<vtkIdType>(soup.PointIds.size()));
      soup.SplitPoints.push_back(false);
      const std::size_t a = i * columns + j;
      const std::size_t b = i * columns + (j + 1) % columns;
      if (i + 1 < rows)
      {
        soup.Triangles.push_back({ a, b, b + columns });
        soup.Triangles.push_back({ a, b + columns, a + columns });
      }
    }
  }
  soup.CellIds.assign(soup.Triangles.size(), 0);
  return soup;
}

//------------------------------------------------------------------------------
// Does work(monitor), and then asks it to stop at the first and in the middle of its reports.
template <typename Work>
void StopWork(meshTest::Checker& check, const std::string& name, int fewest, const Work& work)
{
  int all = 0;
  work(Monitor(
    [&all](double)
    {
      ++all;
      return true;
    }));
  check.True(all >= fewest, name + ": no more than " + std::to_string(all) + " reports");
  for (const int last : { 1, std::max(all / 2, 1) })
  {
    int reports = 0;
    bool isStopped = false;
    try
    {
      work(Monitor([&](double) { return ++reports < last; }));
    }
    catch (const Heartbeat::Stopped&)
    {
      isStopped = true;
    }
    check.True(isStopped && reports == last,
      name + ": stopped after " + std::to_string(reports) + " reports, not " +
        std::to_string(last));
  }
}

//------------------------------------------------------------------------------
// A hole whose border is not plane.
void StopFilling(meshTest::Checker& check)
{
  const TriangleSoup tube = MakeTube(3, 1000,
    [](double part, double angle)
    {
      const double wave = 0.2 * std::sin(7.0 * angle) + 0.1 * std::cos(23.0 * angle);
      return TriangleSoup::Point{ std::cos(angle), std::sin(angle), 20.0 * part + wave };
    });
  StopWork(check, "holes", 2,
    [&](const Monitor& monitor)
    {
      ManifoldRepair repair;
      check.True(static_cast<bool>(repair.Build(tube)), "the tube is a manifold");
      check.Equal(repair.FillHoles(2.0, monitor), 2, 0, "holes");
    });
}

//------------------------------------------------------------------------------
// A tube with a dent that goes through its other side.
void StopResolving(meshTest::Checker& check)
{
  const TriangleSoup tube = MakeTube(80, 60,
    [](double part, double angle)
    {
      const double dent = 2.2 * std::exp(-40.0 * (part - 0.5) * (part - 0.5)) *
        std::exp(-4.0 * (1.0 - std::cos(angle)));
      return TriangleSoup::Point{ std::cos(angle) - dent, std::sin(angle), 4.0 * part };
    });
  StopWork(check, "crossings", 100,
    [&](const Monitor& monitor)
    {
      ManifoldRepair repair;
      check.True(static_cast<bool>(repair.Build(tube)), "the tube is a manifold");
      ManifoldRepair::Intersections left;
      check.True(repair.FindSelfIntersections(monitor).NumberWithin > 100, "crossings");
      (void)repair.ResolveSelfIntersections(2.0, monitor, left);
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestManifoldRepair(int, char*[])
{
  meshTest::Checker check;
  StopFilling(check);
  StopResolving(check);
  return check.GetExitCode();
}
