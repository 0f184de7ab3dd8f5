// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of long triangles: how many triangles the mesher makes of each at first, and how good
// the patches are in the end.
#include "LongTriangles.h"
#include "PatchQuality.h"

#include "Mesher/IsotropicRemesher.h"

#include "vtkPatchMesher.h"

#include <iostream>
#include <string>

using namespace LightTransport;

namespace
{
using meshTest::Checker;
using Surface = vtkSmartPointer<vtkPolyData>;

//------------------------------------------------------------------------------
// How many triangles the edges are split into before any is collapsed.
double CountPrepared(vtkPolyData* surface, double length)
{
  TriangleSoup soup;
  if (!soup.Read(surface, true, Monitor()))
  {
    return 0.0;
  }
  IsotropicRemesher remesher;
  remesher.Build(soup, std::vector<int>(soup.Triangles.size(), 0), 60.0);
  remesher.SetLengths(std::vector<double>(remesher.GetSurface().Points.size(), length));
  remesher.Prepare(1.0, 0.3, Monitor());
  return static_cast<double>(remesher.GetSources().Triangles.size());
}

//------------------------------------------------------------------------------
// A triangle whose long sides are cut into k pieces becomes a ladder of 2 k - 1 triangles; where
// edges are short beside the rim sides are cut into a few more.
void TestLadders(Checker& check)
{
  for (const int sides : { 64, 256 })
  {
    check.SetSubject("rod of " + std::to_string(sides) + " sides");
    const double least = 2.0 * sides * (2.0 * 64.0 - 1.0);
    const double prepared = CountPrepared(meshTest::MakeRod(sides, 20.0), 0.4);
    check.True(prepared >= least && prepared <= 1.3 * least,
      std::to_string(prepared) + " triangles of " + std::to_string(least));
  }
  for (const int sides : { 500, 1000, 2000 })
  {
    check.SetSubject("fan of " + std::to_string(sides) + " triangles");
    const double least = sides * (2.0 * 16.0 - 1.0);
    const double prepared = CountPrepared(meshTest::MakeFan(sides), 0.0566);
    check.True(prepared >= least && prepared <= 1.5 * least,
      std::to_string(prepared) + " triangles of " + std::to_string(least));
  }
}

//------------------------------------------------------------------------------
void CheckPatches(const std::string& name, vtkPolyData* surface, int most, double median,
  double lost, Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(surface);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  const meshTest::Quality quality = meshTest::GetQuality(patches);
  std::cout << name << ": " << patches->GetNumberOfCells() << " patches, smallest angle "
            << quality.SmallestAngle << ", of 1 % " << quality.FirstPercentile << ", median "
            << quality.Median << ", worst aspect ratio " << quality.LargestAspectRatio << "\n";
  check.SetSubject(name);
  check.True(patches->GetNumberOfCells() <= most,
    std::to_string(patches->GetNumberOfCells()) + " patches");
  check.True(quality.SmallestAngle > 19.0, "smallest angle");
  check.True(quality.FirstPercentile > 22.0, "1 % of the angles");
  check.True(quality.Median > median, "median of the angles");
  check.True(quality.LargestAspectRatio < 3.0, "aspect ratio");
  const double area = meshTest::GetArea(surface);
  check.Equal(meshTest::GetArea(patches), area, lost * area, "area");
  check.Equal(static_cast<double>(meshTest::GetEdges(patches).Borders.size()),
    static_cast<double>(meshTest::GetEdges(surface).Borders.size()), 0.0, "edges at borders");
  check.Equal(meshTest::GetEdges(patches).Bad, 0, 0, "bad edges");
  check.Equal(meshTest::GetSummary(patches, "NumberOfSelfIntersections"), 0.0, 0.0, "crossings");
}

//------------------------------------------------------------------------------
void TestPatches(Checker& check)
{
  CheckPatches("rod 20:2 of 16 sides", meshTest::MakeRod(16, 20.0), 2500, 40.0, 0.015, check);
  CheckPatches("rod 20:2 of 64 sides", meshTest::MakeRod(64, 20.0), 3000, 40.0, 0.01, check);
  CheckPatches("rod 20:2 of 256 sides", meshTest::MakeRod(256, 20.0), 7000, 40.0, 0.01, check);
  CheckPatches("rod 100:2 of 64 sides", meshTest::MakeRod(64, 100.0), 4500, 40.0, 0.02, check);
  CheckPatches("rod 2:2 of 64 sides", meshTest::MakeRod(64, 2.0), 8000, 40.0, 1e-3, check);
  CheckPatches("fan of 500", meshTest::MakeFan(500), 3500, 40.0, 1e-12, check);
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherLong(int, char*[])
{
  Checker check;
  TestLadders(check);
  TestPatches(check);
  return check.GetExitCode();
}
