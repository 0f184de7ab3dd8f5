// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Faces that lie on others which face the same way are left out, and all else is as without them.
#include "RadiosityTesting.h"
#include "Scene/PatchScene.h"

#include <random>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
/// What a scene says of a mesh that has been turned, moved and perhaps rounded.
struct Found
{
  Found(const Surface& surface, int turn, bool isSingle, int sides = 1, double shift = 0.0)
  {
    std::mt19937 random(turn);
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized();
    auto data = surface.Get();
    vtkNew<vtkPoints> points;
    points->SetDataType(isSingle ? VTK_FLOAT : VTK_DOUBLE);
    for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
    {
      Eigen::Vector3d place(data->GetPoint(point));
      place = turn > 0 ? rotation * place : place;
      points->InsertNextPoint(place[0] + shift, place[1] + shift, place[2]);
    }
    data->SetPoints(points);
    const Outcome built = this->Scene.Build(data, Ranks(), PatchScene::Order::Spatial, sides);
    Check(static_cast<bool>(built), built.GetMessage());
  }

  std::vector<vtkIdType> GetFlagged() const
  {
    std::vector<vtkIdType> flagged;
    for (std::size_t face = 0; face < this->Scene.GetProblems().size(); ++face)
    {
      if (this->Scene.GetProblems()[face] & SceneFaces::COINCIDENT)
      {
        flagged.push_back(static_cast<vtkIdType>(face));
      }
    }
    return flagged;
  }

  bool Warns(const std::string& text) const
  {
    const std::vector<std::string>& warnings = this->Scene.GetWarnings();
    return std::any_of(warnings.begin(), warnings.end(),
      [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
  }

  PatchScene Scene;
};

using Ids = std::vector<vtkIdType>;

//------------------------------------------------------------------------------
std::string Describe(const std::string& what, int turn, bool isSingle)
{
  return what + ", turn " + std::to_string(turn) + (isSingle ? " in single precision" : "");
}

//------------------------------------------------------------------------------
template <typename Work>
void ForAllPoses(Work&& work)
{
  for (int turn = 0; turn <= 20; ++turn)
  {
    work(turn, false);
    work(turn, true);
  }
}

//------------------------------------------------------------------------------
void TestNone(int turn, bool isSingle)
{
  Surface room;
  for (int side = 0; side < 2; ++side)
  {
    const double x = side;
    room.AddGrid({ x, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 7 - side, 5 + side);
    room.AddGrid({ x, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 3 + 2 * side, 4);
  }
  // A wall that two rooms share, meshed differently on its sides.
  room.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 3, 3);
  room.AddGrid({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 4, 5);
  const Found found(room, turn, isSingle);
  Check(found.GetFlagged().empty() && found.Scene.GetWarnings().empty(),
    Describe("a party wall is nothing to warn of", turn, isSingle));
  Surface sheets;
  sheets.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  sheets.AddGrid({ 0, 0, 1e-4 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  Check(Found(sheets, turn, isSingle, 2).GetFlagged().empty(),
    Describe("sheets near each other are two", turn, isSingle));
}

//------------------------------------------------------------------------------
void TestWhole(int turn, bool isSingle)
{
  Surface twice;
  twice.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 2);
  twice.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 2);
  twice.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Found same(twice, turn, isSingle);
  Check(same.GetFlagged() == Ids({ 6, 7, 8, 9, 10, 11 }), Describe("a copy", turn, isSingle));
  Check(same.Scene.GetNumberOfPatches() == 7, "a copy is left out");

  // Tiles first: they cover the whole. Whole first: it covers the tiles.
  Surface tiles;
  tiles.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 3);
  tiles.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  tiles.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 1);
  tiles.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Found covered(tiles, turn, isSingle);
  Check(covered.GetFlagged() == Ids({ 12, 13, 14 }), Describe("tiles", turn, isSingle));
  Check(covered.Scene.GetNumberOfPatches() == 13 && covered.Scene.GetPatch(12) < 0,
    Describe("what is covered is left out", turn, isSingle));
  Check(covered.Warns("3 polygons (12, 13, 14) on others"), "a warning");
}

//------------------------------------------------------------------------------
void TestPart(int turn, bool isSingle)
{
  Surface overlapping;
  overlapping.AddPolygon(
    { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } });
  overlapping.AddPolygon({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 }, { 1.5, 1.5, 0 }, { 0.5, 1.5, 0 } });
  overlapping.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 } });
  const Found found(overlapping, turn, isSingle);
  Check(found.GetFlagged() == Ids({ 1 }), Describe("a part", turn, isSingle));
  Check(found.Scene.GetPatch(1) >= 0, "stays");
  Check(found.Warns("an area of 0.75 counts twice"), Describe("of this area", turn, isSingle));
}

//------------------------------------------------------------------------------
// A mesh of both windings has backs where there are fronts.
void TestBacks()
{
  Surface sheet;
  sheet.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  sheet.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } });
  sheet.AddPolygon({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } });
  const Found found(sheet, 0, false, 2);
  Check(found.GetFlagged() == Ids({ 3, 4 }), "backs of both windings");
  Check(found.Scene.GetNumberOfPatches() == 4, "are left out");
  Check(found.Warns("Backs of 2 polygons (0, 1) on others"), "with a warning");
  const Found map(sheet, 0, false, 2, 6e5);
  Check(map.GetFlagged() == Ids({ 3, 4 }), "on a map");
}

//------------------------------------------------------------------------------
// All walls of a room twice: the copies have nothing, the others all.
void TestRadiosity()
{
  auto room = MakeRoom(2);
  auto twice = vtkSmartPointer<vtkPolyData>::New();
  twice->DeepCopy(room);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    room->GetCellPoints(cell, ids);
    twice->GetPolys()->InsertNextCell(ids);
  }
  for (vtkPolyData* data : { room.Get(), twice.Get() })
  {
    AddArray(data, "Reflectance", { 0.5 });
    AddArray(data, "Emission", { 0.0 })->SetValue(0, 1.0);
  }
  const Run one(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-9);
  const Run other(twice, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-9);
  for (std::size_t cell = 0; cell < other.Radiosity.size(); ++cell)
  {
    const std::size_t count = one.Radiosity.size();
    CheckClose(other.Radiosity[cell], cell < count ? one.Radiosity[cell] : 0.0, 1e-12,
      "radiosity of a room whose walls are there twice");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestCoincidentFaces(int, char*[])
{
  ForAllPoses(TestNone);
  ForAllPoses(TestWhole);
  ForAllPoses(TestPart);
  TestBacks();
  TestRadiosity();
  return Result();
}
