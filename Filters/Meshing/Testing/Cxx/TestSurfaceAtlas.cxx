// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Atlases of meshes from files: arguments are their paths.
#include "SurfaceAtlasChecks.h"

namespace
{
struct Mesh
{
  const char* Name;
  int Resolution;
  atlasTest::Limits Limits;
};

const Mesh MESHES[] = {
  { "bunny", 512, { 1.1, 0.995, 1.0 } },
  { "anchor_dense", 512, { 1.17, 0.995, 1 } },
  { "blobby_3cc", 512, { 1.13, 0.995, 1 } },
  { "dragon_vrip_res3", 512, { 1.22, 0.98, 0.99 } },
  { "elephant", 512, { 1.18, 0.995, 1 } },
  { "fandisk", 512, { 1.15, 0.995, 1.0 } },
  { "femur", 512, { 1.2, 0.98, 1 } },
  { "homer", 512, { 1.16, 0.99, 1 } },
  { "knot1", 512, { 1.15, 0.99, 1.0 } },
  { "knot2", 512, { 1.15, 0.99, 1.0 } },
  { "lion-head", 512, { 1.16, 0.995, 1 } },
  { "mannequin-devil", 512, { 1.15, 0.995, 1.0 } },
  { "turbine", 512, { 1.36, 0.95, 1 } },
};

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Read(const std::string& path)
{
  vtkSmartPointer<vtkPolyData> surface = meshTest::ReadMesh(path);
  if (path.find("dragon") == std::string::npos)
  {
    return surface;
  }
  // As scanned it is no manifold.
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(surface);
  mesher->Update();
  return mesher->GetOutput();
}
} // namespace

//------------------------------------------------------------------------------
int TestSurfaceAtlas(int argc, char* argv[])
{
  meshTest::Checker check;
  for (int i = 1; i < argc; ++i)
  {
    const std::string path = argv[i];
    const Mesh* mesh = meshTest::FindByFile(MESHES, path);
    check.SetSubject(path);
    vtkSmartPointer<vtkPolyData> surface = Read(path);
    check.True(mesh != nullptr && surface->GetNumberOfCells() > 0, "a known mesh");
    if (mesh)
    {
      atlasTest::CheckAtlas(mesh->Name, surface, mesh->Resolution, mesh->Limits, check);
    }
  }
  return check.GetExitCode();
}
