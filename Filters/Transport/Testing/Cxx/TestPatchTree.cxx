// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The tree over a scene against its definition, and that the order of the tree stays inside:
// arrays and numbers that users see are those of the input.
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/CellArrays.h"
#include "Scene/PatchScene.h"
#include "Scene/PatchTree.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = PatchTree::Vector;

//------------------------------------------------------------------------------
PatchScene Build(vtkDataObject* data)
{
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  return scene;
}

//------------------------------------------------------------------------------
// The cells of a surface in another order; the points stay.
vtkSmartPointer<vtkPolyData> Shuffle(vtkPolyData* data, unsigned int seed)
{
  std::vector<vtkIdType> order(data->GetNumberOfCells());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(seed);
  for (std::size_t k = order.size(); k > 1; --k)
  {
    std::swap(order[k - 1], order[random() % k]);
  }
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  for (const vtkIdType cell : order)
  {
    data->GetCellPoints(cell, corners);
    polygons->InsertNextCell(corners);
  }
  auto shuffled = vtkSmartPointer<vtkPolyData>::New();
  shuffled->SetPoints(data->GetPoints());
  shuffled->SetPolys(polygons);
  return shuffled;
}

//------------------------------------------------------------------------------
bool FacesManyWays(const PatchTree::Node& node)
{
  return node.ConeCosine < 0.95;
}

//------------------------------------------------------------------------------
// Where normals divide a cluster depth is lost, but only a few times on the way down.
int GetDepth(const PatchTree& tree, int index)
{
  int depth = 0;
  for (; tree.GetNode(index).Parent >= 0; index = tree.GetNode(index).Parent)
  {
    ++depth;
  }
  return depth;
}

//------------------------------------------------------------------------------
void CheckShape(const PatchTree& tree, vtkIdType patches)
{
  const std::vector<PatchTree::Node>& nodes = tree.GetNodes();
  Check(nodes[0].First == 0 && nodes[0].Last == patches && nodes[0].Parent == -1,
    "the root holds all patches");
  for (std::size_t index = 0; index < nodes.size(); ++index)
  {
    const PatchTree::Node& node = nodes[index];
    if (node.IsLeaf())
    {
      Check(node.GetSize() >= 1 && node.GetSize() <= PatchTree::LeafSize, "size of a leaf");
      continue;
    }
    const PatchTree::Node& left = nodes[node.Left];
    const PatchTree::Node& right = nodes[node.Left + 1];
    Check(node.GetSize() > PatchTree::LeafSize, "leaves are not divided");
    Check(left.First == node.First && left.Last == right.First && right.Last == node.Last,
      "children divide the range of their parent");
    Check(left.Parent == static_cast<int>(index) && right.Parent == left.Parent, "parents");
    const vtkIdType unit =
      node.GetSize() > PatchTree::BlockSize ? PatchTree::BlockSize : PatchTree::LeafSize;
    Check(left.Last % unit == 0, "ranges are cut at multiples of blocks and leaves");
    Check(FacesManyWays(node) || std::abs(left.GetSize() - right.GetSize()) <= 2 * unit,
      "what faces one way is cut in half");
  }
  const double halvings = std::log2(std::max(1.0, static_cast<double>(patches)));
  Check(GetDepth(tree, static_cast<int>(nodes.size()) - 1) <= halvings + 9, "the tree is flat");
  const vtkIdType blocks = (patches + PatchTree::BlockSize - 1) / PatchTree::BlockSize;
  for (vtkIdType block = 0; block < blocks; ++block)
  {
    const PatchTree::Node& node = tree.GetNode(tree.GetBlock(block));
    Check(node.First == block * PatchTree::BlockSize &&
        node.Last == std::min((block + 1) * PatchTree::BlockSize, patches),
      "a block is a node");
  }
}

//------------------------------------------------------------------------------
bool IsInside(const Vector& point, const Vector& lower, const Vector& upper)
{
  return (point.array() >= lower.array()).all() && (point.array() <= upper.array()).all();
}

//------------------------------------------------------------------------------
void CheckBounds(const PatchScene& scene)
{
  for (const PatchTree::Node& node : scene.GetTree().GetNodes())
  {
    Vector lower = node.Upper, upper = node.Lower;
    double area = 0.0, radius = 0.0, cosine = 1.0;
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
      {
        lower = lower.cwiseMin(scene.GetCorner(patch, corner));
        upper = upper.cwiseMax(scene.GetCorner(patch, corner));
      }
      Check(IsInside(scene.GetCentroid(patch), node.CentroidLower, node.CentroidUpper),
        "centroids are in the box of centroids");
      area += scene.GetAreas()[patch];
      radius = std::max(radius, scene.GetRadius(patch));
      cosine = std::min(cosine, scene.GetNormal(patch).dot(node.ConeAxis));
    }
    Check(lower == node.Lower && upper == node.Upper, "the box is that of the corners");
    Check(radius == node.Radius, "the radius is the largest one");
    Check(node.ConeCosine == cosine || node.ConeCosine == -1.0, "the cone holds the normals");
    CheckClose(node.Area, area, 1e-12, "areas add up");
  }
}

//------------------------------------------------------------------------------
void TestTree()
{
  for (const int n : { 1, 2, 3, 7, 13, 20 })
  {
    auto room = Shuffle(MakeRoom(n), n);
    const PatchScene scene = Build(room);
    CheckShape(scene.GetTree(), 6 * n * n);
    CheckBounds(scene);
  }
  Surface sphere;
  AddSphere(sphere, 1.0, 3, false);
  const PatchScene scene = Build(Shuffle(sphere.Get(), 1));
  CheckShape(scene.GetTree(), 1280);
  CheckBounds(scene);
  for (vtkIdType block = 0; block < 5; ++block)
  {
    // A fifth of a sphere: its normals stay on one side, and it does not reach across.
    const PatchTree::Node& node = scene.GetTree().GetNode(scene.GetTree().GetBlock(block));
    Check(node.ConeCosine > 0.0, "the patches of a block are near each other");
  }
}

//------------------------------------------------------------------------------
void TestCones()
{
  // Normals over a quarter of a circle: the narrowest cone is 45 degrees around its middle.
  Surface strip;
  for (int k = 0; k <= 2; ++k)
  {
    const double angle = vtkMath::RadiansFromDegrees(45.0 * k);
    const double x = std::cos(angle), z = std::sin(angle);
    strip.AddPolygon({ { x, 0, z }, { x - z, 0, z + x }, { x - z, 1, z + x }, { x, 1, z } });
  }
  const PatchScene scene = Build(strip.Get());
  const PatchTree::Node& root = scene.GetTree().GetNode(0);
  CheckClose(root.ConeCosine, std::sqrt(0.5), 1e-12, "cone of a quarter of a circle");
  const PatchScene room = Build(MakeRoom(1));
  Check(room.GetTree().GetNode(0).ConeCosine == -1.0, "the walls of a room face everywhere");
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> Sort(const std::vector<Vector>& centroids)
{
  PatchTree tree;
  return tree.Sort(centroids, std::vector<Vector>(centroids.size(), Vector::UnitX()));
}

//------------------------------------------------------------------------------
// Two sheets face to face, in one place: told apart by where they face, to a unit.
void TestNormals()
{
  std::vector<Vector> centroids, normals;
  for (int k = 0; k < 600; ++k)
  {
    centroids.emplace_back(k % 30, k / 30, 0.0);
    normals.push_back(k % 2 == 0 ? Vector::UnitZ() : Vector(-Vector::UnitZ()));
  }
  PatchTree tree;
  const std::vector<vtkIdType> order = tree.Sort(centroids, normals);
  const vtkIdType cut = tree.GetNodes()[1].Last;
  Check(cut == PatchTree::BlockSize, "the block nearest to half");
  Check(std::all_of(order.begin(), order.begin() + cut,
          [&](vtkIdType patch) { return normals[patch].z() < 0.0; }),
    "the first block faces one way");
}

//------------------------------------------------------------------------------
void TestOrder()
{
  std::vector<Vector> centroids;
  std::mt19937 random(7);
  for (int k = 0; k < 3000; ++k)
  {
    // Many equal coordinates and equal points.
    const auto draw = [&random]() { return static_cast<double>(random() % 10); };
    centroids.emplace_back(draw(), draw(), draw());
  }
  const std::vector<vtkIdType> order = Sort(centroids);
  std::vector<vtkIdType> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<vtkIdType> all(centroids.size());
  std::iota(all.begin(), all.end(), 0);
  Check(sorted == all, "the order is a permutation");
  Check(order == Sort(centroids), "the same points give the same order");
  const std::vector<vtkIdType> equal = Sort(std::vector<Vector>(700, Vector::Ones()));
  Check(std::is_sorted(equal.begin(), equal.end()), "equal centroids stay in their order");
  Check(Sort({}).empty(), "no patches");
}

//------------------------------------------------------------------------------
// A value that each cell can be told by.
double GetTag(vtkPolyData* data, vtkIdType cell)
{
  vtkNew<vtkIdList> corners;
  data->GetCellPoints(cell, corners);
  double tag = 0.0;
  for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
  {
    double point[3];
    data->GetPoint(corners->GetId(k), point);
    tag += point[0] + 10.0 * point[1] + 100.0 * point[2];
  }
  return tag;
}

//------------------------------------------------------------------------------
double GetTag(const PatchScene& scene, vtkIdType patch)
{
  double tag = 0.0;
  for (int k = 0; k < scene.GetNumberOfCorners(patch); ++k)
  {
    const Vector point = scene.GetCenter() + scene.GetScale() * scene.GetCorner(patch, k);
    tag += point.dot(Vector(1.0, 10.0, 100.0));
  }
  return tag;
}

//------------------------------------------------------------------------------
void AddTags(vtkPolyData* data)
{
  vtkDoubleArray* tags = AddArray(data, "Tag", { 0.0, 0.0 });
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const double tag = GetTag(data, cell);
    tags->SetTuple2(cell, tag, -tag);
  }
}

//------------------------------------------------------------------------------
void CheckArrays(vtkPolyData* data, double tolerance)
{
  vtkDataArray* before = data->GetCellData()->GetArray("Tag");
  vtkDataArray* after = data->GetCellData()->GetArray("Copy");
  bool equal = before && after && after->GetNumberOfComponents() == 2;
  for (vtkIdType cell = 0; equal && cell < data->GetNumberOfCells(); ++cell)
  {
    equal = before->GetComponent(cell, 0) == after->GetComponent(cell, 0) &&
      before->GetComponent(cell, 1) == after->GetComponent(cell, 1);
  }
  Check(equal, "cell arrays come back in the input's order");
  // One value on all cells of a flat wall: its points have the same one.
  vtkDataArray* points = data->GetPointData()->GetArray("Wall");
  vtkDataArray* cells = data->GetCellData()->GetArray("Wall");
  Check(points && cells, "point and cell arrays");
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; points && cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      CheckClose(points->GetComponent(corners->GetId(k), 0), cells->GetComponent(cell, 0),
        tolerance, "point values of a wall");
    }
  }
}

//------------------------------------------------------------------------------
// A number for each direction of a normal.
std::vector<double> GetWalls(const PatchScene& scene)
{
  std::vector<double> walls;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    walls.push_back(scene.GetNormal(patch).dot(Vector(1.0, 2.0, 3.0)));
  }
  return walls;
}

//------------------------------------------------------------------------------
void CheckRoundTrip(vtkDataObject* input, vtkDataObject* output,
  const std::vector<vtkPolyData*>& blocks)
{
  PatchScene scene = Build(input);
  std::vector<double> values;
  int components = 0;
  CheckDone(CellArrays(scene, input, Ranks()).Read("Tag", true, values, components), "array");
  Check(components == 2, "the array is gathered");
  vtkIdType polygon = 0;
  for (vtkPolyData* block : blocks)
  {
    for (vtkIdType cell = 0; cell < block->GetNumberOfCells(); ++cell, ++polygon)
    {
      const vtkIdType patch = scene.GetPatch(polygon);
      Check(scene.GetPolygon(patch) == polygon, "polygons and patches are inverse");
      Check(scene.GetLocalPatches()[polygon] == patch, "local patches");
      CheckClose(GetTag(scene, patch), GetTag(block, cell), 1e-12, "the patch is the polygon");
      Check(values[2 * patch] == GetTag(block, cell) && values[2 * patch + 1] == -values[2 * patch],
        "the values of a patch are those of its polygon");
    }
  }
  Check(polygon == scene.GetNumberOfPatches(), "every polygon is a patch");
  const SmoothPoints points(scene, 60.0);
  const SceneOutput arrays(scene, &points, input, output);
  arrays.AddArray("Copy", values, components);
  arrays.AddArray("Wall", GetWalls(scene), 1);
}

//------------------------------------------------------------------------------
void TestArrays()
{
  auto room = Shuffle(MakeRoom(8), 3);
  AddTags(room);
  vtkNew<vtkPolyData> output;
  CheckRoundTrip(room, output, { room });
  CheckArrays(output, 1e-12);
  Check(Build(room).GetFingerprint() != Build(Shuffle(room, 4)).GetFingerprint(),
    "another order is another input");
}

//------------------------------------------------------------------------------
void TestBlocks()
{
  vtkNew<vtkMultiBlockDataSet> input;
  std::vector<vtkPolyData*> blocks;
  for (int k = 0; k < 3; ++k)
  {
    auto room = Shuffle(MakeRoom(3 + k), k);
    for (vtkIdType point = 0; point < room->GetNumberOfPoints(); ++point)
    {
      const double* place = room->GetPoint(point);
      room->GetPoints()->SetPoint(point, place[0] + 2.0 * k, place[1], place[2]);
    }
    AddTags(room);
    input->SetBlock(k, room);
    blocks.push_back(room);
  }
  vtkNew<vtkMultiBlockDataSet> output;
  CheckRoundTrip(input, output, blocks);
  for (int k = 0; k < 3; ++k)
  {
    CheckArrays(vtkPolyData::SafeDownCast(output->GetBlock(k)), 1e-12);
  }
}

//------------------------------------------------------------------------------
// The pieces of one surface on three ranks, one of them empty: all hold the scene of the whole.
void TestRanks()
{
  auto whole = Shuffle(MakeRoom(8), 5);
  AddTags(whole);
  const PatchScene serial = Build(whole);
  vtkSmartPointer<vtkPolyData> pieces[3];
  const vtkIdType starts[4] = { 0, 150, 150, whole->GetNumberOfCells() };
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
    pieces[rank]->SetPolys(polygons);
    AddTags(pieces[rank]);
  }
  bool equal[3] = {};
  vtkNew<vtkPolyData> outputs[3];
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      PatchScene scene;
      std::vector<double> values;
      int components = 0;
      const Ranks ranks(controller);
      equal[rank] = scene.Build(pieces[rank], ranks) &&
        CellArrays(scene, pieces[rank], ranks).Read("Tag", true, values, components) &&
        scene.GetFingerprint() == serial.GetFingerprint() && scene.GetAreas() == serial.GetAreas();
      for (vtkIdType cell = starts[rank]; equal[rank] && cell < starts[rank + 1]; ++cell)
      {
        equal[rank] = scene.GetPatch(cell) == serial.GetPatch(cell) &&
          scene.GetLocalPatches()[cell - starts[rank]] == serial.GetPatch(cell);
      }
      const SmoothPoints points(scene, 60.0);
      const SceneOutput arrays(scene, &points, pieces[rank], outputs[rank]);
      arrays.AddArray("Copy", values, components);
      arrays.AddArray("Wall", GetWalls(scene), 1);
    });
  for (int rank = 0; rank < 3; ++rank)
  {
    Check(equal[rank], "the scene of rank " + std::to_string(rank));
    CheckArrays(outputs[rank], 1e-12);
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchTree(int, char*[])
{
  TestTree();
  TestCones();
  TestOrder();
  TestNormals();
  TestArrays();
  TestBlocks();
  TestRanks();
  return Result();
}
