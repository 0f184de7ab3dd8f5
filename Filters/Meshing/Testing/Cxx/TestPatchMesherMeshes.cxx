// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Patches of meshes as people have them: arguments are their paths. Default settings, but that
// self-intersections of meshes other than the dragon stay.
#include "PatchQuality.h"

#include <iomanip>

namespace
{
struct Mesh
{
  const char* Name;
  bool Closed;
  /// Least of the smallest angles but 1 %, and of their median, in degrees.
  double FirstPercentile;
  double Median;
  /// Largest distance, to or from the input, over the edge length.
  double Distance;
};

const Mesh MESHES[] = {
  { "bunny", true, 35, 48, 0.4 },
  { "anchor_dense", true, 22, 48, 0.3 },
  { "blobby_3cc", false, 34, 48, 0.3 },
  { "cheese", true, 20, 44, 0.25 },
  { "dragon_vrip_res3", true, 8, 45, 0.6 },
  { "elephant", true, 23, 48, 0.8 },
  { "fandisk", true, 27, 47, 0.25 },
  { "femur", true, 16, 44, 0.4 },
  { "homer", true, 28, 48, 1.0 },
  { "knot1", true, 34, 47, 0.2 },
  { "knot2", true, 21, 41, 0.4 },
  { "lion-head", false, 24, 48, 0.8 },
  { "mannequin-devil", false, 9, 46, 0.8 },
  { "turbine", true, 10, 46, 0.6 },
};

//------------------------------------------------------------------------------
void TestMesh(const Mesh& mesh, vtkPolyData* surface, meshTest::Checker& check)
{
  const std::string name = mesh.Name;
  const bool scan = name.find("dragon") != std::string::npos;
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(surface);
  mesher->SetSelfIntersections(
    scan ? vtkPatchMesher::SELF_INTERSECTIONS_RESOLVE : vtkPatchMesher::SELF_INTERSECTIONS_KEEP);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  check.True(patches->GetNumberOfCells() > 0, "patches");
  if (patches->GetNumberOfCells() == 0)
  {
    return;
  }
  const meshTest::Quality quality = meshTest::GetQuality(patches);
  const double length = meshTest::GetSummary(patches, "TargetEdgeLength");
  const double there = meshTest::GetDistance(patches, surface) / length;
  const double back = meshTest::GetDistance(surface, patches) / length;
  const meshTest::Edges edges = meshTest::GetEdges(patches);
  std::cout << std::setprecision(3) << name << ": triangles " << surface->GetNumberOfCells()
            << " to " << patches->GetNumberOfCells() << ", smallest angle " << quality.SmallestAngle
            << ", 1 % " << quality.FirstPercentile << ", median " << quality.Median
            << ", worst aspect ratio " << quality.LargestAspectRatio << ", distance / length "
            << there << " and " << back << "\n";
  check.True(quality.SmallestAngle > 0.0, "no triangle without area");
  check.True(quality.FirstPercentile >= mesh.FirstPercentile, "1 % of angles");
  check.True(quality.Median >= mesh.Median, "median of angles");
  check.True(std::max(there, back) <= mesh.Distance, "distance from the input");
  check.Equal(edges.Bad, 0, 0, "edges of more than two, or opposed, triangles");
  check.True(meshTest::IsClosed(patches) == mesh.Closed, "closed or open");
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherMeshes(int argc, char* argv[])
{
  meshTest::Checker check;
  for (int i = 1; i < argc; ++i)
  {
    const std::string path = argv[i];
    const Mesh* mesh = meshTest::FindByFile(MESHES, path);
    check.SetSubject(path);
    check.True(mesh != nullptr, "a known mesh");
    if (mesh)
    {
      TestMesh(*mesh, meshTest::ReadMesh(path), check);
    }
  }
  return check.GetExitCode();
}
