// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The table of view factors between groups: catalogue values, reciprocity, and what makes a group.
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/CellArrays.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/ViewFactorGroups.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkViewFactors.h"

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
constexpr double Parallel = 0.199824895698387;
constexpr double Perpendicular = 0.200043776075403;
// Single precision entries.
constexpr double Single = 2e-7;

//------------------------------------------------------------------------------
double GetEntry(vtkTable* table, const std::string& row, const std::string& column)
{
  auto* names = vtkStringArray::SafeDownCast(table->GetColumnByName("Group"));
  auto* values = vtkDoubleArray::SafeDownCast(table->GetColumnByName(column.c_str()));
  const vtkIdType index = names ? names->LookupValue(row) : -1;
  return Check(index >= 0 && values, "table entry " + row + ", " + column) ? values->GetValue(index)
                                                                           : vtkMath::Nan();
}

//------------------------------------------------------------------------------
struct Problem
{
  PatchScene Scene;
  ViewFactorGroups::Groups Groups;
  std::string Error;

  bool Gather(vtkDataObject* input, vtkMultiProcessController* controller = nullptr)
  {
    const Ranks ranks(controller);
    CheckDone(this->Scene.Build(input, ranks), "scene");
    const Outcome gathered =
      ViewFactorGroups::Gather(CellArrays(this->Scene, input, ranks), input, "Group", this->Groups);
    this->Error = gathered.GetMessage();
    return static_cast<bool>(gathered);
  }
};

//------------------------------------------------------------------------------
// The view factors of a scene without sky, all that misses fronts meets back faces.
Links ComputeLinks(const PatchScene& scene)
{
  ViewFactorStore store;
  CheckDone(store.Update(scene, { 1e-8, false, LinkMethod::Dense, 0.0 }, {}, Ranks(), Monitor()),
    "view factors");
  Links result;
  result.Matrix = store.GetLinks().Matrix;
  result.SkyFractions.assign(scene.GetNumberOfPatches(), 0.0);
  for (const double sum : store.GetLinks().RowSums)
  {
    result.BackFaceFractions.push_back(1.0 - sum);
  }
  return result;
}

//------------------------------------------------------------------------------
std::string Join(const std::vector<std::string>& names)
{
  std::string all;
  for (const std::string& name : names)
  {
    all += (all.empty() ? "" : "|") + name;
  }
  return all;
}

//------------------------------------------------------------------------------
void CheckRows(vtkTable* table, const std::vector<std::string>& names)
{
  for (const std::string& group : names)
  {
    double sum = GetEntry(table, group, "Sky") + GetEntry(table, group, "BackFace");
    for (const std::string& other : names)
    {
      sum += GetEntry(table, group, other);
      CheckClose(GetEntry(table, group, "Area") * GetEntry(table, group, other),
        GetEntry(table, other, "Area") * GetEntry(table, other, group), 1e-12, "reciprocity");
    }
    CheckClose(sum, 1.0, 1e-12, "row sum of " + group);
  }
}

//------------------------------------------------------------------------------
// A cube of edge 2 with a group for each face, numbered backwards and with gaps; more than one row
// of tiles.
void TestCube()
{
  Surface cube;
  constexpr int n = 7;
  cube.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, n, n);
  cube.AddGrid({ 0, 0, 2 }, { 0, 2, 0 }, { 2, 0, 0 }, n, n);
  cube.AddGrid({ 0, 0, 0 }, { 0, 0, 2 }, { 2, 0, 0 }, n, n);
  cube.AddGrid({ 0, 2, 0 }, { 2, 0, 0 }, { 0, 0, 2 }, n, n);
  cube.AddGrid({ 0, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, n, n);
  cube.AddGrid({ 2, 0, 0 }, { 0, 0, 2 }, { 0, 2, 0 }, n, n);
  auto data = cube.Get();
  vtkDoubleArray* ids = AddArray(data, "Group", { 0.0 });
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    ids->SetValue(cell, 20.0 - 10.0 * static_cast<double>(cell / (n * n)));
  }
  Problem problem;
  Check(problem.Gather(data), "groups of a cube");
  Check(Join(problem.Groups.Names) == "-30|-20|-10|0|10|20", "names of groups by an array");
  vtkNew<vtkTable> table;
  CheckDone(ViewFactorGroups::FillTable(ComputeLinks(problem.Scene), problem.Groups,
              problem.Scene.GetScale(), Ranks(), table),
    "table");
  Check(table->GetNumberOfRows() == 6 && table->GetNumberOfColumns() == 10, "size of the table");
  CheckRows(table, problem.Groups.Names);
  for (int from = 0; from < 6; ++from)
  {
    for (int to = 0; to < 6; ++to)
    {
      const double expected = from == to ? 0.0 : from / 2 == to / 2 ? Parallel : Perpendicular;
      CheckClose(GetEntry(table, problem.Groups.Names[from], problem.Groups.Names[to]), expected,
        Single, "view factor between faces");
    }
    CheckClose(GetEntry(table, problem.Groups.Names[from], "Area"), 4.0, 1e-12, "area of a face");
  }
}

//------------------------------------------------------------------------------
// Plates of different size, two groups on one of them, and one group on parts of both: sums, not
// means, over receivers, and means over senders.
void TestUnequalGroups()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 2);
  plates.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  auto data = plates.Get();
  vtkDoubleArray* ids = AddArray(data, "Group", { 1.0 });
  ids->SetValue(8, 2.0);
  Problem problem;
  vtkNew<vtkTable> table;
  Check(problem.Gather(data), "two plates");
  Links result = ComputeLinks(problem.Scene);
  result.SkyFractions.swap(result.BackFaceFractions);
  CheckDone(
    ViewFactorGroups::FillTable(result, problem.Groups, problem.Scene.GetScale(), Ranks(), table),
    "table");
  CheckRows(table, { "1", "2" });
  CheckClose(GetEntry(table, "1", "2"), Parallel, Single, "from parts to a whole");
  CheckClose(GetEntry(table, "2", "1"), Parallel, Single, "from a whole to parts");
  CheckClose(GetEntry(table, "1", "Sky"), 1.0 - Parallel, Single, "sky of a group");
  CheckClose(GetEntry(table, "1", "BackFace"), 0.0, 1e-15, "no back faces");

  ids->SetValue(0, 2.0);
  problem.Gather(data);
  CheckDone(
    ViewFactorGroups::FillTable(result, problem.Groups, problem.Scene.GetScale(), Ranks(), table),
    "table");
  CheckRows(table, { "1", "2" });
  const vtkIdType first = problem.Scene.GetPatch(0), whole = problem.Scene.GetPatch(8);
  const double inside = 2.0 * result.Matrix->GetValue(first, whole) /
    (result.Matrix->GetAreas()[first] + result.Matrix->GetAreas()[whole]);
  CheckClose(GetEntry(table, "2", "2"), inside, 1e-12, "a group that sees itself");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakePlate(double height)
{
  Surface plate;
  plate.AddGrid({ 0, 0, height }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 1);
  return plate.Get();
}

//------------------------------------------------------------------------------
// Names from metadata, numbers where there is none, blocks that are empty or share a name.
void TestBlocks()
{
  Problem problem;
  Check(problem.Gather(MakePlate(0)) && Join(problem.Groups.Names) == "All",
    "data that is not composite");

  vtkNew<vtkMultiBlockDataSet> inner, blocks;
  const auto name = [](vtkMultiBlockDataSet* parent, unsigned int block, const char* text)
  { parent->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), text); };
  inner->SetBlock(0, MakePlate(0));
  inner->SetBlock(1, MakePlate(1));
  name(inner, 1, "wall");
  blocks->SetBlock(0, MakePlate(2));
  name(blocks, 0, "wall");
  blocks->SetBlock(2, inner);
  blocks->SetBlock(3, MakePlate(3));
  name(blocks, 3, "Area");
  Check(problem.Gather(blocks), "blocks");
  Check(Join(problem.Groups.Names) == "wall|Block 2|wall (2)|Area (2)",
    "names of blocks: " + Join(problem.Groups.Names));
  for (vtkIdType polygon = 0; polygon < 8; ++polygon)
  {
    Check(problem.Groups.OfPatches[problem.Scene.GetPatch(polygon)] == polygon / 2,
      "patches of blocks");
  }

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, MakePlate(0));
  collection->SetPartition(0, 1, MakePlate(1));
  collection->SetPartition(1, 0, MakePlate(2));
  collection->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "roof");
  Check(problem.Gather(collection) && Join(problem.Groups.Names) == "Block 0|roof",
    "pieces of one block belong together: " + Join(problem.Groups.Names));
  Check(problem.Gather(collection->GetPartitionedDataSet(0)) && Join(problem.Groups.Names) == "All",
    "pieces of one data set");
}

//------------------------------------------------------------------------------
void TestErrors()
{
  Problem problem;
  auto plate = MakePlate(0);
  const auto expect = [&](const char* part)
  {
    Check(!problem.Gather(plate) && problem.Error.find(part) != std::string::npos &&
        problem.Error.find("\"Group\"") != std::string::npos,
      std::string(part) + ": " + problem.Error);
    plate->GetCellData()->RemoveArray("Group");
    problem.Error.clear();
  };
  AddArray(plate, "Group", { 0.5 });
  expect("integer");
  AddArray(plate, "Group", { 1e300 });
  expect("integer");
  AddArray(plate, "Group", { 1.0, 2.0 });
  expect("one component");
  AddArray(plate, "Group", { vtkMath::Nan() });
  expect("not finite");
  Surface many;
  many.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 50, 41);
  plate = many.Get();
  vtkDoubleArray* ids = AddArray(plate, "Group", { 0.0 });
  for (vtkIdType cell = 0; cell < 2050; ++cell)
  {
    ids->SetValue(cell, static_cast<double>(cell));
  }
  expect("2050 groups");
}

//------------------------------------------------------------------------------
// Each rank has other blocks and a part of the matrix; all find the table of one rank.
void TestRanks()
{
  constexpr int ranks = 3, n = 9;
  const auto makeBlocks = [](int rank)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    auto room = MakeRoom(n);
    for (unsigned int face = 0; face < 6; ++face)
    {
      Surface side;
      for (vtkIdType cell = face * n * n; cell < (face + 1) * n * n; ++cell)
      {
        std::vector<Point> corners(4);
        for (int corner = 0; corner < 4; ++corner)
        {
          room->GetPoint(room->GetCell(cell)->GetPointId(corner), corners[corner].data());
        }
        side.AddPolygon(corners);
      }
      blocks->SetNumberOfBlocks(6);
      blocks->GetMetaData(face)->Set(vtkCompositeDataSet::NAME(),
        std::string("face" + std::to_string(face)).c_str());
      if (rank < 0 || static_cast<int>(face / 2) == rank)
      {
        blocks->SetBlock(face, side.Get());
      }
    }
    return blocks;
  };
  Problem whole;
  whole.Gather(makeBlocks(-1));
  const Links expected = ComputeLinks(whole.Scene);
  vtkNew<vtkTable> expectedTable;
  CheckDone(ViewFactorGroups::FillTable(expected, whole.Groups, whole.Scene.GetScale(), Ranks(),
              expectedTable),
    "table");
  CheckClose(GetEntry(expectedTable, "face2", "face3"), Parallel, Single, "blocks of one rank");
  std::vector<vtkSmartPointer<vtkTable>> tables(ranks);
  RunRanks(ranks,
    [&](vtkMultiProcessController* controller, int rank)
    {
      Problem problem;
      problem.Gather(makeBlocks(rank), controller);
      Links part = expected;
      part.Matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
      part.Matrix->Allocate(problem.Scene.GetAreas(), 1, rank, ranks);
      for (vtkExchangeMatrix::Tile& tile : part.Matrix->GetTiles())
      {
        const auto& all = expected.Matrix->GetTiles();
        const auto& source = all[expected.Matrix->GetTileIndex(tile.Row, tile.Column)];
        std::copy_n(source.Values, vtkExchangeMatrix::TileSize * vtkExchangeMatrix::TileSize,
          tile.Values);
      }
      tables[rank] = vtkSmartPointer<vtkTable>::New();
      CheckDone(ViewFactorGroups::FillTable(part, problem.Groups, problem.Scene.GetScale(),
                  Ranks(controller), tables[rank]),
        "table");
    });
  for (vtkTable* table : tables)
  {
    for (const std::string& from : whole.Groups.Names)
    {
      for (const std::string& to : whole.Groups.Names)
      {
        CheckClose(GetEntry(table, from, to), GetEntry(expectedTable, from, to), 1e-12,
          "table on several ranks");
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactorGroups(int, char*[])
{
  TestCube();
  TestUnequalGroups();
  TestBlocks();
  TestErrors();
  TestRanks();
  return Result();
}
