// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Work that is watched hears an abort, and every stage of an atlas asks.
#include "MeshTestTools.h"

#include "Atlas/AtlasQuadtree.h"
#include "Atlas/AtlasSurface.h"
#include "Atlas/SquareMap.h"
#include "Common/TriangleSoup.h"
#include "Common/Watch.h"

#include "vtkSphereSource.h"

#include <stdexcept>
#include <thread>
#include <vector>

using namespace LightTransport;

namespace
{
using meshTest::Checker;

//------------------------------------------------------------------------------
void TestReports(Checker& check)
{
  const std::thread::id here = std::this_thread::get_id();
  bool sameThread = true;
  std::vector<double> heard;
  const Monitor monitor(
    [&](double fraction)
    {
      sameThread = sameThread && std::this_thread::get_id() == here;
      heard.push_back(fraction);
      return true;
    });
  const Outcome outcome = Watch::Run(monitor,
    [&](Watch& watch)
    {
      for (int i = 0; i <= 10; ++i)
      {
        watch.Report(0.1 * i);
        check.Equal(heard.back(), 0.1 * i, 0.0, "what has been heard when Report() returns");
      }
      return Outcome::Failed("as it is");
    });
  check.True(sameThread, "the monitor is asked from the thread that called");
  check.True(outcome.GetMessage() == "as it is", "the outcome of the work");
}

//------------------------------------------------------------------------------
template <typename Work>
bool IsStopped(const Work& work)
{
  try
  {
    work();
  }
  catch (const Heartbeat::Stopped&)
  {
    return true;
  }
  return false;
}

//------------------------------------------------------------------------------
// The work goes on until it hears the abort: without one it would never end.
void TestAbort(Checker& check)
{
  int number = 0;
  const Monitor monitor([&](double) { return ++number < 3; });
  const auto workForEver = [](Watch& watch)
  {
    for (;;)
    {
      watch.Check();
    }
    return Outcome::Done();
  };
  check.True(IsStopped([&]() { (void)Watch::Run(monitor, workForEver); }), "the abort is heard");
  check.Equal(number, 3, 0, "reports, none of them after the abort");

  bool isThrown = false;
  try
  {
    (void)Watch::Run(Monitor(),
      [](Watch&) -> Outcome { throw std::runtime_error("thrown by the work"); });
  }
  catch (const std::runtime_error&)
  {
    isThrown = true;
  }
  check.True(isThrown, "what the work throws is thrown to the caller");
}

//------------------------------------------------------------------------------
void TestStages(Checker& check)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  TriangleSoup soup;
  check.True(static_cast<bool>(soup.Read(sphere->GetOutput())), "a soup");
  Watch stopped;
  stopped.Stop();
  AtlasSurface surface;
  check.True(IsStopped([&]() { (void)surface.Build(soup, stopped); }), "AtlasSurface");
  Watch watch;
  check.True(static_cast<bool>(surface.Build(soup, watch)), "a surface");
  AtlasQuadtree quadtree(surface, 64, 1.2);
  check.True(IsStopped([&]() { (void)quadtree.Build(stopped); }), "AtlasQuadtree");
  SquareMap::Disc disc;
  disc.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, 0 } };
  disc.Triangles = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
  disc.Sources = { 0, 1, 2, 3 };
  std::string problem;
  check.True(IsStopped([&]() { SquareMap().Map(disc, problem, stopped); }), "SquareMap");
}
} // namespace

//------------------------------------------------------------------------------
int TestWatch(int, char*[])
{
  Checker check;
  TestReports(check);
  TestAbort(check);
  TestStages(check);
  return check.GetExitCode();
}
