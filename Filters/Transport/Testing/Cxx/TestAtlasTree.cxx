// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The cluster tree that follows the quadtree of an atlas: its nodes are the blocks of the atlas and
// go on within the charts, for one surface and for several, on one rank and on several; links
// between its clusters against the matrix of all pairs; what is refused, and why.
#include "OutcomeTesting.h"
#include "RadiosityTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#ifdef TEST_WITH_MESHING
#include "vtkFloatingPointExceptions.h"
#include "vtkPLYReader.h"
#include "vtkSurfaceAtlas.h"
#endif

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Range = std::pair<vtkIdType, vtkIdType>;

/// A square of an atlas, in parts of 1 / 512.
struct Block
{
  double X;
  double Y;
  double Size;
};

//------------------------------------------------------------------------------
// A parallelogram of n x n cells whose chart fills a block.
void AddChart(vtkPolyData* data, const Point& origin, const Point& u, const Point& v, int n,
  const Block& block)
{
  auto* atlas = vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("AtlasCoordinates"));
  const vtkIdType first = data->GetNumberOfPoints();
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      double point[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] = origin[axis] + u[axis] * i / n + v[axis] * j / n;
      }
      data->GetPoints()->InsertNextPoint(point);
      atlas->InsertNextTuple2((block.X + block.Size * i / n) / 512.0,
        (block.Y + block.Size * j / n) / 512.0);
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const vtkIdType corner = first + j * (n + 1) + i;
      const vtkIdType corners[4] = { corner, corner + 1, corner + n + 2, corner + n + 1 };
      data->GetPolys()->InsertNextCell(4, corners);
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeEmpty()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  data->SetPoints(points);
  data->SetPolys(vtkNew<vtkCellArray>());
  vtkNew<vtkDoubleArray> atlas;
  atlas->SetName("AtlasCoordinates");
  atlas->SetNumberOfComponents(2);
  data->GetPointData()->AddArray(atlas);
  return data;
}

/// Three quarters of the atlas, and three quarters of the fourth.
const std::vector<Block> RoomBlocks = { { 256, 0, 256 }, { 0, 256, 256 }, { 0, 0, 256 },
  { 384, 256, 128 }, { 256, 384, 128 }, { 384, 384, 128 } };

//------------------------------------------------------------------------------
/// A cube of edges `size` seen from inside, or from outside; a chart for each wall.
vtkSmartPointer<vtkPolyData> MakeBox(const Point& low, double size, int n, bool inward)
{
  auto room = MakeEmpty();
  for (int wall = 0; wall < 6; ++wall)
  {
    Point origin = low;
    Point u{}, v{};
    u[wall / 2] = 0.0;
    u[(wall / 2 + 1) % 3] = size;
    v[(wall / 2 + 2) % 3] = size;
    origin[wall / 2] += wall % 2 ? size : 0.0;
    // u x v points along the axis: inwards on the lower wall.
    const bool turned = (wall % 2 == 0) != inward;
    AddChart(room, origin, turned ? v : u, turned ? u : v, n, RoomBlocks[wall]);
  }
  return room;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Shuffle(vtkPolyData* data, unsigned int seed)
{
  std::vector<vtkIdType> order(data->GetNumberOfCells());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  for (const vtkIdType cell : order)
  {
    data->GetCellPoints(cell, corners);
    polygons->InsertNextCell(corners);
  }
  auto shuffled = vtkSmartPointer<vtkPolyData>::New();
  shuffled->ShallowCopy(data);
  shuffled->SetPolys(polygons);
  return shuffled;
}

//------------------------------------------------------------------------------
PatchScene Build(vtkDataObject* data)
{
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks(), PatchScene::Order::Atlas), "scene");
  return scene;
}

//------------------------------------------------------------------------------
// The middle of each cell in the atlas.
std::vector<std::array<double, 2>> GetPlaces(vtkPolyData* data)
{
  vtkDataArray* atlas = data->GetPointData()->GetArray("AtlasCoordinates");
  std::vector<std::array<double, 2>> places;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, corners);
    std::array<double, 2> place{};
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        place[axis] += 512.0 * atlas->GetComponent(corners->GetId(k), axis) /
          static_cast<double>(corners->GetNumberOfIds());
      }
    }
    places.push_back(place);
  }
  return places;
}

//------------------------------------------------------------------------------
std::set<Range> GetRanges(const PatchScene& scene)
{
  std::set<Range> ranges;
  for (const PatchTree::Node& node : scene.GetTree().GetNodes())
  {
    ranges.emplace(node.First, node.Last);
  }
  return ranges;
}

//------------------------------------------------------------------------------
// The patches of a block: true where they are one range, which is then a node unless it is less
// than a leaf.
void CheckBlock(const PatchScene& scene, const std::set<Range>& nodes,
  const std::vector<std::array<double, 2>>& places, vtkIdType firstPolygon, const Block& block)
{
  std::vector<vtkIdType> patches;
  for (std::size_t cell = 0; cell < places.size(); ++cell)
  {
    const double x = places[cell][0] - block.X;
    const double y = places[cell][1] - block.Y;
    if (x >= 0.0 && y >= 0.0 && x < block.Size && y < block.Size)
    {
      patches.push_back(scene.GetPatch(firstPolygon + static_cast<vtkIdType>(cell)));
    }
  }
  if (patches.empty())
  {
    return;
  }
  const auto range = std::minmax_element(patches.begin(), patches.end());
  const Range expected(*range.first, *range.second + 1);
  Check(expected.second - expected.first == static_cast<vtkIdType>(patches.size()),
    "the patches of a block are next to each other");
  Check(patches.size() <= static_cast<std::size_t>(PatchTree::LeafSize) ||
      nodes.count(expected) == 1,
    "the block at " + std::to_string(block.X) + ", " + std::to_string(block.Y) + " of size " +
      std::to_string(block.Size) + " is a node");
}

//------------------------------------------------------------------------------
// All blocks of the quadtree down to `smallest`.
void CheckBlocks(const PatchScene& scene, vtkPolyData* data, vtkIdType firstPolygon,
  double smallest)
{
  const std::set<Range> nodes = GetRanges(scene);
  const auto places = GetPlaces(data);
  for (double size = 512.0; size >= smallest; size /= 2.0)
  {
    for (double x = 0.0; x < 512.0; x += size)
    {
      for (double y = 0.0; y < 512.0; y += size)
      {
        CheckBlock(scene, nodes, places, firstPolygon, { x, y, size });
      }
    }
  }
}

//------------------------------------------------------------------------------
void CheckShape(const PatchScene& scene)
{
  const auto& nodes = scene.GetTree().GetNodes();
  double area = 0.0;
  for (std::size_t index = 0; index < nodes.size(); ++index)
  {
    const PatchTree::Node& node = nodes[index];
    Check(node.Last > node.First, "no node is empty");
    if (node.IsLeaf())
    {
      Check(node.GetSize() <= PatchTree::LeafSize, "leaves are small");
      area += node.Area;
      continue;
    }
    const PatchTree::Node& left = nodes[node.Left];
    const PatchTree::Node& right = nodes[node.Left + 1];
    Check(left.First == node.First && left.Last == right.First && right.Last == node.Last &&
        left.Parent == static_cast<int>(index) && right.Parent == left.Parent,
      "children divide their parent");
  }
  CheckClose(area, nodes[0].Area, 1e-12, "the leaves hold the whole area");
}

//------------------------------------------------------------------------------
void TestCodes()
{
  std::mt19937 random(3);
  const auto draw = [&random]() { return random() / 4294967296.0; };
  bool good = true;
  for (int count = 0; count < 10000; ++count)
  {
    const double a[2] = { draw(), draw() };
    // Near each other, so that prefixes of all lengths occur.
    const double near = std::exp2(-30.0 * draw());
    const double b[2] = { std::min(a[0] + near * draw(), 1.0),
      std::min(a[1] + near * draw(), 1.0) };
    const std::uint64_t codes[2] = { PatchTree::GetCode(a[0], a[1]),
      PatchTree::GetCode(b[0], b[1]) };
    for (int depth = 0; depth <= PatchTree::AtlasBits; ++depth)
    {
      const double side = std::exp2(depth);
      const auto isSame = [&](int axis)
      {
        const auto place = [&](double at) { return std::min(std::floor(at * side), side - 1.0); };
        return place(a[axis]) == place(b[axis]);
      };
      const int bits = 2 * (PatchTree::AtlasBits - depth);
      good = good && (codes[0] >> bits == codes[1] >> bits) == (isSame(0) && isSame(1));
    }
  }
  Check(good, "codes have a prefix in common where places have a block in common");
  Check(PatchTree::GetCode(0.0, 0.9) < PatchTree::GetCode(0.5, 0.0), "x comes first");
  Check(PatchTree::GetCode(1.0, 1.0) >> (2 * PatchTree::AtlasBits) == 0, "bits of a code");
}

//------------------------------------------------------------------------------
void TestNodes()
{
  auto room = Shuffle(MakeBox({ 0, 0, 0 }, 1.0, 12, true), 5);
  const PatchScene scene = Build(room);
  CheckShape(scene);
  const std::set<Range> nodes = GetRanges(scene);
  for (const Block& chart : RoomBlocks)
  {
    CheckBlock(scene, nodes, GetPlaces(room), 0, chart);
  }
  CheckBlocks(scene, room, 0, 8.0);
  // A chart is one wall: one normal.
  const PatchTree& tree = scene.GetTree();
  Check(std::count_if(tree.GetNodes().begin(), tree.GetNodes().end(),
          [](const PatchTree::Node& node)
          { return node.GetSize() == 144 && node.ConeCosine > 1.0 - 1e-12; }) == 6,
    "a node for each wall");

  // The same atlas in any order of cells gives the same tree.
  const PatchScene other = Build(Shuffle(room, 6));
  Check(GetRanges(other) == nodes, "the tree does not depend on the order of the cells");
  PatchScene spatial;
  CheckDone(spatial.Build(room, Ranks()), "scene");
  Check(spatial.GetFingerprint() != scene.GetFingerprint(), "the tree is part of the fingerprint");
}

//------------------------------------------------------------------------------
void TestEqualCodes()
{
  PatchTree tree;
  const std::vector<vtkIdType> order = tree.Sort(std::vector<std::uint64_t>(1000, 7));
  Check(std::is_sorted(order.begin(), order.end()), "equal codes stay in their order");
  Check(std::all_of(tree.GetNodes().begin(), tree.GetNodes().end(),
          [](const PatchTree::Node& node)
          { return !node.IsLeaf() || node.GetSize() <= PatchTree::LeafSize; }),
    "equal codes are divided");
  Check(tree.GetNodes().size() < 1000, "evenly");
  Check(tree.Sort(std::vector<std::uint64_t>()).empty(), "no patches");
  // The highest bit of all.
  std::vector<std::uint64_t> codes(10, 0);
  codes[3] = ~std::uint64_t(0);
  Check(tree.Sort(codes).back() == 3 && tree.GetNode(2).First == 9, "64 bits");
}

//------------------------------------------------------------------------------
// Each surface has an atlas of its own.
void TestSurfaces()
{
  vtkNew<vtkMultiBlockDataSet> input;
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  vtkIdType size = 0;
  for (int k = 0; k < 3; ++k)
  {
    surfaces.push_back(MakeBox({ 2.0 * k, 0, 0 }, 1.0, 3 + 2 * k, true));
    // A block that is not there.
    input->SetBlock(k + (k == 2 ? 1 : 0), surfaces[k]);
    size += surfaces[k]->GetNumberOfCells();
  }
  const PatchScene scene = Build(input);
  Check(scene.GetNumberOfPatches() == size, "all patches are there");
  CheckShape(scene);
  vtkIdType first = 0;
  for (vtkPolyData* surface : surfaces)
  {
    CheckBlocks(scene, surface, first, 32.0);
    first += surface->GetNumberOfCells();
  }
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
// The clusters are the rows of the table "Charts".
void TestSurfaceAtlas()
{
  vtkFloatingPointExceptions::Disable(); // CGAL's predicates raise some on purpose
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputConnection(reader->GetOutputPort());
  atlas->TexelMapsOff();
  atlas->Update();
  vtkTable* charts = atlas->GetCharts();
  const PatchScene scene = Build(atlas->GetOutputDataObject(0));
  Check(charts->GetNumberOfRows() > 1 && scene.GetNumberOfPatches() > 1, "the atlas of a bunny");
  CheckShape(scene);
  const std::set<Range> nodes = GetRanges(scene);
  const auto places = GetPlaces(vtkPolyData::SafeDownCast(atlas->GetOutputDataObject(0)));
  for (vtkIdType row = 0; row < charts->GetNumberOfRows(); ++row)
  {
    CheckBlock(scene, nodes, places, 0,
      { charts->GetValueByName(row, "X").ToDouble(), charts->GetValueByName(row, "Y").ToDouble(),
        charts->GetValueByName(row, "Size").ToDouble() });
  }
}
#endif

//------------------------------------------------------------------------------
void TestRanks()
{
  auto whole = MakeBox({ 0, 0, 0 }, 1.0, 8, true);
  const PatchScene serial = Build(whole);
  const vtkIdType starts[4] = { 0, 100, 100, whole->GetNumberOfCells() };
  vtkSmartPointer<vtkPolyData> pieces[3];
  for (int rank = 0; rank < 3; ++rank)
  {
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = starts[rank]; cell < starts[rank + 1]; ++cell)
    {
      whole->GetCellPoints(cell, corners);
      polygons->InsertNextCell(corners);
    }
    pieces[rank] = vtkSmartPointer<vtkPolyData>::New();
    pieces[rank]->SetPoints(whole->GetPoints());
    pieces[rank]->GetPointData()->ShallowCopy(whole->GetPointData());
    pieces[rank]->SetPolys(polygons);
  }
  bool equal[3] = {};
  std::string errors[3];
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      PatchScene scene;
      const Ranks ranks(controller);
      equal[rank] = scene.Build(pieces[rank], ranks, PatchScene::Order::Atlas) &&
        scene.GetFingerprint() == serial.GetFingerprint() && GetRanges(scene) == GetRanges(serial);
      equal[rank] = PolygonGathering::HasAtlas(pieces[rank], ranks) && equal[rank];
      if (rank == 2)
      {
        pieces[rank]->GetPointData()->RemoveArray("AtlasCoordinates");
      }
      equal[rank] = !PolygonGathering::HasAtlas(pieces[rank], ranks) && equal[rank];
      errors[rank] = scene.Build(pieces[rank], ranks, PatchScene::Order::Atlas).GetMessage();
    });
  for (int rank = 0; rank < 3; ++rank)
  {
    Check(equal[rank], "the scene of rank " + std::to_string(rank));
    Check(errors[rank].find("has no point array \"AtlasCoordinates\"") != std::string::npos,
      "all ranks know that one has no atlas: " + errors[rank]);
  }
}

//------------------------------------------------------------------------------
/// A box in a room, each with an atlas.
vtkSmartPointer<vtkMultiBlockDataSet> MakeScene()
{
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  scene->SetBlock(0, MakeBox({ 0, 0, 0 }, 1.0, 12, true));
  scene->SetBlock(1, MakeBox({ 0.2, 0.3, 0.4 }, 0.3, 5, false));
  return scene;
}

/// A run of vtkRadiosity: the radiosity of all blocks one after another, empty after an error.
struct Solved
{
  Vector Radiosity;
  Vector Areas;
  std::string Tree;
  std::string Messages;
  double Links = 0.0;

  Solved(vtkRadiosity* filter, vtkMultiBlockDataSet* scene)
  {
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkTest::ErrorObserver> pipelineObserver;
    filter->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
    filter->SetInputData(scene);
    filter->Update();
    this->Messages = observer->GetErrorMessage();
    filter->RemoveAllObservers();
    filter->GetExecutive()->RemoveAllObservers();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    if (!this->Messages.empty() || !output)
    {
      return;
    }
    std::vector<double> radiosity, areas;
    for (unsigned int block = 0; block < output->GetNumberOfBlocks(); ++block)
    {
      auto* data = vtkPolyData::SafeDownCast(output->GetBlock(block));
      for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
      {
        radiosity.push_back(data->GetCellData()->GetArray("Radiosity")->GetComponent(cell, 0));
      }
      const std::vector<double> here = GetAreas(data);
      areas.insert(areas.end(), here.begin(), here.end());
    }
    this->Radiosity = ToVector(radiosity);
    this->Areas = ToVector(areas);
    auto* tree =
      vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("ClusterTreeUsed"));
    this->Tree = tree ? std::string(tree->GetValue(0)) : "";
    vtkDataArray* links = output->GetFieldData()->GetArray("NumberOfLinks");
    this->Links = links ? links->GetComponent(0, 0) : 0.0;
  }
};

//------------------------------------------------------------------------------
// One cell of the first surface is a lamp.
void SetLight(vtkMultiBlockDataSet* scene, double emission, double lamp, double reflectance)
{
  for (unsigned int block = 0; block < scene->GetNumberOfBlocks(); ++block)
  {
    auto* data = vtkPolyData::SafeDownCast(scene->GetBlock(block));
    AddArray(data, "Reflectance", { reflectance });
    AddArray(data, "Emission", { emission })
      ->SetValue(std::min<vtkIdType>(7, data->GetNumberOfCells() - 1),
        block == 0 ? lamp : emission);
  }
}

//------------------------------------------------------------------------------
void TestLinks()
{
  auto scene = MakeScene();
  SetLight(scene, 0.0, 10.0, 0.5);
  vtkNew<vtkRadiosity> dense;
  dense->SetLinkMethodToDense();
  dense->SetViewFactorTolerance(1e-3);
  // A matrix has no use for it.
  dense->SetClusterTreeToAtlas();
  const Solved exact(dense, scene);
  Check(exact.Radiosity.size() == 6 * 144 + 6 * 25 && exact.Tree.empty(), "the matrix");

  vtkNew<vtkRadiosity> filter;
  filter->SetLinkMethodToHierarchical();
  filter->SetClusterTreeToAtlas();
  double links = 0.0;
  for (const double tolerance : { 1e-1, 3e-2, 1e-2 })
  {
    filter->SetLinkTolerance(tolerance);
    const Solved found(filter, scene);
    if (!Check(found.Radiosity.size() == exact.Radiosity.size(), found.Messages))
    {
      return;
    }
    Check(found.Tree == "Atlas", "the tree of the atlas is used, not " + found.Tree);
    Check(found.Links > links, "more links for a smaller tolerance");
    links = found.Links;
    const Vector off = found.Radiosity - exact.Radiosity;
    const double error =
      std::sqrt(off.cwiseAbs2().dot(exact.Areas) / exact.Radiosity.cwiseAbs2().dot(exact.Areas));
    Check(error < 1.2 * tolerance && error > 0.0,
      "the radiosity keeps LinkTolerance: " + std::to_string(error));
    std::cout << "LinkTolerance " << tolerance << ": " << links << " links, error " << error
              << "\n";
  }
  filter->SetClusterTreeToSpatial();
  const Solved spatial(filter, scene);
  Check(spatial.Tree == "Spatial" && spatial.Links > 0.0 && spatial.Links != links,
    "another tree, other links");
  filter->SetClusterTreeToAuto();
  Check(Solved(filter, scene).Tree == "Atlas", "Auto takes atlases that are there");
  auto bare = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  bare->DeepCopy(scene);
  vtkPolyData::SafeDownCast(bare->GetBlock(1))->GetPointData()->RemoveArray("AtlasCoordinates");
  Check(Solved(filter, bare).Tree == "Spatial", "Auto where one surface has no atlas");

  // Of given view factors their own tree.
  vtkNew<vtkViewFactors> factors;
  factors->HierarchicalOn();
  factors->SetClusterTreeToAtlas();
  filter->SetViewFactors(factors);
  const Solved given(filter, scene);
  Check(given.Tree == "Atlas" && given.Links == links, "the tree of given view factors");
}

//------------------------------------------------------------------------------
void TestClosedScene()
{
  auto scene = MakeScene();
  SetLight(scene, 0.4, 0.4, 0.6);
  for (const bool bright : { false, true })
  {
    vtkNew<vtkRadiosity> filter;
    filter->SetLinkMethodToHierarchical();
    filter->SetLinkTolerance(3e-2);
    filter->SetClusterTreeToAtlas();
    filter->SetRefineByBrightness(bright);
    filter->SetTolerance(1e-8);
    const Solved found(filter, scene);
    if (Check(found.Radiosity.size() > 0, found.Messages))
    {
      CheckClose(found.Radiosity.minCoeff(), 1.0, 1e-5, "even light, at least");
      CheckClose(found.Radiosity.maxCoeff(), 1.0, 1e-5, "even light, at most");
    }
  }
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(scene);
  factors->HierarchicalOn();
  factors->SetLinkTolerance(3e-2);
  factors->SetClusterTreeToAtlas();
  factors->Update();
  ViewFactorStore store;
  CheckDone(store.Update(Build(scene), { 0.0, false, LinkMethod::Hierarchical, 3e-2 }, {}, Ranks(),
              Monitor()),
    "links");
  for (const double sum : store.GetLinks().RowSums)
  {
    CheckClose(sum, 1.0, 1e-5, "rows of a closed scene");
  }
  double off = 0.0;
  const vtkIdType cells = 6 * 144 + 6 * 25;
  for (vtkIdType i = 0; i < cells; i += 37)
  {
    double sum = 0.0;
    for (vtkIdType j = 0; j < cells; ++j)
    {
      sum += factors->GetViewFactor(i, j);
    }
    off = std::max(off, std::abs(sum - 1.0));
  }
  Check(off < 1e-5, "view factors by the numbers of the input's polygons");
}

//------------------------------------------------------------------------------
void CheckRefused(vtkMultiBlockDataSet* scene, const std::string& message)
{
  vtkNew<vtkRadiosity> filter;
  filter->SetLinkMethodToHierarchical();
  filter->SetClusterTreeToAtlas();
  const Solved run(filter, scene);
  Check(run.Messages.find(message) != std::string::npos && run.Radiosity.size() == 0,
    "\"" + message + "\" in: \"" + run.Messages + "\"");
  vtkNew<vtkViewFactors> factors;
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> pipelineObserver;
  factors->AddObserver(vtkCommand::ErrorEvent, observer);
  factors->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
  factors->SetInputData(scene);
  factors->HierarchicalOn();
  factors->SetClusterTreeToAtlas();
  factors->Update();
  Check(observer->CheckErrorMessage(message) == 0, message);
}

//------------------------------------------------------------------------------
void TestErrors()
{
  auto scene = MakeScene();
  SetLight(scene, 1.0, 1.0, 0.5);
  auto* box = vtkPolyData::SafeDownCast(scene->GetBlock(1));
  const vtkSmartPointer<vtkDataArray> atlas = box->GetPointData()->GetArray("AtlasCoordinates");
  for (const double outside : { 2.0, -1.0, vtkMath::Nan(), vtkMath::Inf() })
  {
    vtkNew<vtkDoubleArray> wrong;
    wrong->DeepCopy(atlas);
    wrong->Fill(outside);
    box->GetPointData()->AddArray(wrong);
    CheckRefused(scene, "places cell 0 outside of the unit square");
  }
  vtkNew<vtkDoubleArray> grey;
  grey->SetName("AtlasCoordinates");
  grey->SetNumberOfTuples(box->GetNumberOfPoints());
  grey->Fill(0.5);
  box->GetPointData()->AddArray(grey);
  CheckRefused(scene, "\"AtlasCoordinates\" with 2 components");
  box->GetPointData()->RemoveArray("AtlasCoordinates");
  CheckRefused(scene, "pass it through vtkSurfaceAtlas, or set ClusterTree to Spatial");

  auto many = MakeScene();
  for (unsigned int k = 0; k <= 4096; ++k)
  {
    many->SetBlock(k, MakeBox({ 2.0 * k, 0, 0 }, 1.0, 1, false));
  }
  SetLight(many, 1.0, 1.0, 0.5);
  CheckRefused(many, "more than 4096 blocks");

  // A tree without blocks of 256 patches is none for a matrix.
  const PatchScene ordered = Build(MakeScene());
  const Outcome refused = ViewFactorStore().Update(ordered,
    { 1e-3, false, LinkMethod::Dense, 1e-2 }, {}, Ranks(), Monitor());
  Check(refused.HasFailed() && refused.GetMessage().find("Hierarchical") != std::string::npos,
    "a matrix in the order of an atlas");
}
} // namespace

//------------------------------------------------------------------------------
int TestAtlasTree(int, char*[])
{
  TestCodes();
  TestNodes();
  TestEqualCodes();
  TestSurfaces();
#ifdef TEST_WITH_MESHING
  TestSurfaceAtlas();
#endif
  TestRanks();
  TestLinks();
  TestClosedScene();
  TestErrors();
  return Result();
}
