// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchScene.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <unordered_map>

namespace LightTransport
{
namespace
{
// A polygon whose corners leave its plane by more than this part of its radius (plus what single
// precision coordinates of the whole scene lose) is refused: view factors of a warped polygon are
// not defined.
constexpr double PlanarityTolerance = 1e-4;
constexpr double CoordinateTolerance = 1e-6;
// Name of the point array with the places of points in an atlas.
constexpr const char* AtlasName = "AtlasCoordinates";
// Below this part of the longest edge squared an area is rounding noise.
constexpr double AreaTolerance = 1e-13;

//------------------------------------------------------------------------------
// The polygonal leaves of a data object in a fixed order. Leaves of other types come as nullptr.
std::vector<vtkPolyData*> GetLeaves(vtkDataObject* object)
{
  std::vector<vtkPolyData*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      leaves.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
    }
  }
  else if (object)
  {
    leaves.push_back(vtkPolyData::SafeDownCast(object));
  }
  return leaves;
}

//------------------------------------------------------------------------------
// A number of each leaf that is the same on all ranks.
std::vector<vtkIdType> GetLeafNumbers(vtkDataObject* object)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(object);
  if (!composite)
  {
    return { 0 };
  }
  std::vector<vtkIdType> numbers;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    numbers.push_back(leaf->GetCurrentFlatIndex());
  }
  return numbers;
}

//------------------------------------------------------------------------------
vtkDataArray* FindAtlas(vtkPolyData* data, std::string& error)
{
  vtkDataArray* atlas = data->GetPointData()->GetArray(AtlasName);
  if (!atlas || atlas->GetNumberOfComponents() != 2)
  {
    error = std::string("A surface has no point array \"") + AtlasName +
      "\" with 2 components, which the cluster tree of the atlas needs: pass it through "
      "vtkSurfaceAtlas, or set ClusterTree to Spatial.";
    return nullptr;
  }
  return atlas;
}

//------------------------------------------------------------------------------
bool IsGhost(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  constexpr unsigned char skipped =
    vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  return ghosts && (ghosts->GetValue(cell) & skipped);
}

//------------------------------------------------------------------------------
vtkIdType FirstPolygonCell(vtkPolyData* data)
{
  return data->GetNumberOfVerts() + data->GetNumberOfLines();
}

//------------------------------------------------------------------------------
template <typename T>
std::vector<T> AllGather(vtkMultiProcessController* controller, const std::vector<T>& mine)
{
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return mine;
  }
  const int ranks = controller->GetNumberOfProcesses();
  const vtkIdType length = static_cast<vtkIdType>(mine.size());
  std::vector<vtkIdType> lengths(ranks), offsets(ranks);
  controller->AllGather(&length, lengths.data(), 1);
  std::partial_sum(lengths.begin(), lengths.end() - 1, offsets.begin() + 1);
  std::vector<T> all(offsets.back() + lengths.back());
  controller->AllGatherV(mine.data(), all.data(), length, lengths.data(), offsets.data());
  return all;
}

//------------------------------------------------------------------------------
struct CoordinateHash
{
  std::size_t operator()(const std::array<double, 3>& point) const
  {
    std::uint64_t bits[3];
    std::memcpy(bits, point.data(), sizeof(bits));
    std::uint64_t hash = 0;
    for (const std::uint64_t part : bits)
    {
      hash = (hash ^ part) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

//------------------------------------------------------------------------------
// The root of a set in a forest of parents, shortening the way there.
int FindRoot(std::vector<int>& parents, int item)
{
  while (parents[item] != item)
  {
    item = parents[item] = parents[parents[item]];
  }
  return item;
}
} // namespace

//------------------------------------------------------------------------------
bool PatchScene::Agree(vtkMultiProcessController* controller, bool ok, std::string& error)
{
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return ok;
  }
  std::vector<char> text(ok ? 0 : error.size() + 1);
  std::copy(error.begin(), ok ? error.begin() : error.end(), text.begin());
  const std::vector<char> all = AllGather(controller, text);
  if (all.empty())
  {
    return true;
  }
  // Texts end with a zero each; the first one is that of the lowest rank.
  error = all.data();
  return false;
}

//------------------------------------------------------------------------------
bool PatchScene::Build(vtkDataObject* input, vtkMultiProcessController* controller,
  std::string& error, Order order)
{
  *this = PatchScene();
  this->Controller = controller;
  this->OrderOfPatches = order;
  Raw raw;
  const bool ok = this->CollectLocal(input, raw, error) &&
    (order != Order::Atlas || this->CollectCodes(input, raw, error));
  if (!PatchScene::Agree(controller, ok, error))
  {
    return false;
  }
  const vtkIdType firstLocal = this->GatherRanks(raw);
  if (raw.Counts.empty())
  {
    error = "The input has no polygons: give a surface with at least one polygon.";
    return false;
  }
  if (std::set<vtkIdType>(raw.Surfaces.begin(), raw.Surfaces.end()).size() > MaximumSurfaces)
  {
    error = "The input has more than " + std::to_string(MaximumSurfaces) +
      " blocks, too many for the cluster tree of their atlases: set ClusterTree to Spatial.";
    return false;
  }
  if (!this->Normalize(raw, error))
  {
    return false;
  }
  this->SortPatches(raw, firstLocal);
  this->ComputeFingerprint(raw);
  this->MergePoints(raw);
  if (!this->ComputePatchGeometry(error))
  {
    return false;
  }
  this->Tree.FillNodes(*this);
  return true;
}

//------------------------------------------------------------------------------
bool PatchScene::HasAtlas(vtkDataObject* input, vtkMultiProcessController* controller)
{
  PatchScene scene;
  Raw raw;
  std::string error;
  const bool has = scene.CollectLocal(input, raw, error) && scene.CollectCodes(input, raw, error);
  return PatchScene::Agree(controller, has, error);
}

//------------------------------------------------------------------------------
bool PatchScene::CollectLocal(vtkDataObject* input, Raw& raw, std::string& error)
{
  const std::vector<vtkPolyData*> leaves = GetLeaves(input);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    vtkPolyData* data = leaves[block];
    if (!data)
    {
      error = "A block of the input is no polygonal data: extract its surface first.";
      return false;
    }
    if (data->GetNumberOfStrips() > 0)
    {
      error = "The input has triangle strips: pass it through vtkTriangleFilter first.";
      return false;
    }
    if (!this->CollectBlock(data, static_cast<int>(block), raw))
    {
      error = "The input has polygons whose points do not exist: check its connectivity.";
      return false;
    }
  }
  if (!std::all_of(raw.Coordinates.begin(), raw.Coordinates.end(),
        [](double value) { return std::isfinite(value); }))
  {
    error = "The input has point coordinates that are not finite (NaN or infinite): remove those "
            "points, for example with a threshold and vtkCleanPolyData.";
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool PatchScene::CollectBlock(vtkPolyData* data, int block, Raw& raw)
{
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    data->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  const vtkIdType first = FirstPolygonCell(data);
  vtkCellArray* polygons = data->GetPolys();
  vtkNew<vtkIdList> corners;
  for (vtkIdType polygon = 0; polygon < polygons->GetNumberOfCells(); ++polygon)
  {
    if (IsGhost(ghosts, first + polygon))
    {
      continue;
    }
    polygons->GetCellAtId(polygon, corners);
    this->LocalCells.push_back({ block, first + polygon });
    raw.Counts.push_back(corners->GetNumberOfIds());
    for (vtkIdType corner = 0; corner < corners->GetNumberOfIds(); ++corner)
    {
      const vtkIdType id = corners->GetId(corner);
      if (id < 0 || id >= data->GetNumberOfPoints())
      {
        return false;
      }
      double point[3];
      data->GetPoint(id, point);
      for (const double coordinate : point)
      {
        // Adding zero turns -0 into 0: equal coordinates then have equal bits.
        raw.Coordinates.push_back(coordinate + 0.0);
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The code of the mean of a patch's corners: blocks of a quadtree are convex.
bool PatchScene::CollectCodes(vtkDataObject* input, Raw& raw, std::string& error) const
{
  const std::vector<vtkPolyData*> leaves = GetLeaves(input);
  const std::vector<vtkIdType> numbers = GetLeafNumbers(input);
  vtkNew<vtkIdList> corners;
  int block = -1;
  vtkDataArray* atlas = nullptr;
  for (const LocalCell& local : this->LocalCells)
  {
    vtkPolyData* data = leaves[local.Block];
    if (local.Block != block)
    {
      block = local.Block;
      atlas = FindAtlas(data, error);
    }
    if (!atlas)
    {
      return false;
    }
    data->GetPolys()->GetCellAtId(local.Cell - FirstPolygonCell(data), corners);
    double middle[2] = { 0.0, 0.0 };
    for (vtkIdType corner = 0; corner < corners->GetNumberOfIds(); ++corner)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        middle[axis] += atlas->GetComponent(corners->GetId(corner), axis) /
          static_cast<double>(corners->GetNumberOfIds());
      }
    }
    if (!(std::min(middle[0], middle[1]) >= 0.0 && std::max(middle[0], middle[1]) <= 1.0))
    {
      error = std::string("The point array \"") + AtlasName + "\" places cell " +
        std::to_string(local.Cell) +
        " outside of the unit square: make it with vtkSurfaceAtlas, or set ClusterTree to Spatial.";
      return false;
    }
    raw.Codes.push_back(PatchTree::GetCode(middle[0], middle[1]));
    raw.Surfaces.push_back(numbers[block]);
  }
  return true;
}

//------------------------------------------------------------------------------
vtkIdType PatchScene::GatherRanks(Raw& raw)
{
  const std::vector<vtkIdType> mine{ static_cast<vtkIdType>(raw.Counts.size()) };
  const std::vector<vtkIdType> patches = AllGather(this->Controller, mine);
  const int rank = patches.size() > 1 ? this->Controller->GetLocalProcessId() : 0;
  raw.Counts = AllGather(this->Controller, raw.Counts);
  raw.Coordinates = AllGather(this->Controller, raw.Coordinates);
  raw.Codes = AllGather(this->Controller, raw.Codes);
  raw.Surfaces = AllGather(this->Controller, raw.Surfaces);
  return std::accumulate(patches.begin(), patches.begin() + rank, static_cast<vtkIdType>(0));
}

//------------------------------------------------------------------------------
bool PatchScene::Normalize(const Raw& raw, std::string& error)
{
  Vector low = Vector::Constant(std::numeric_limits<double>::max());
  Vector high = -low;
  for (std::size_t corner = 0; corner < raw.Coordinates.size(); corner += 3)
  {
    const Vector point(&raw.Coordinates[corner]);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  this->Center = 0.5 * low + 0.5 * high;
  this->Scale = (high - low).stableNorm();
  if (!std::isfinite(this->Scale) || this->Scale < std::numeric_limits<double>::min())
  {
    std::ostringstream text;
    text << "The input's bounding box has diagonal " << this->Scale
         << ": scale it to a size that double precision can hold.";
    error = text.str();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
// The order comes from the scaled scene: in the input's unit a mean of corners could overflow.
void PatchScene::SortPatches(Raw& raw, vtkIdType firstLocal)
{
  const std::size_t patches = raw.Counts.size();
  std::vector<vtkIdType> starts(patches + 1, 0);
  std::partial_sum(raw.Counts.begin(), raw.Counts.end(), starts.begin() + 1);
  std::vector<Vector> centers(patches, Vector::Zero());
  std::vector<Vector> normals(patches, Vector::Zero());
  for (std::size_t polygon = 0; polygon < patches; ++polygon)
  {
    const auto getPoint = [&](vtkIdType corner) -> Vector
    { return (Vector(&raw.Coordinates[3 * corner]) - this->Center) / this->Scale; };
    const vtkIdType first = starts[polygon];
    for (vtkIdType corner = first; corner < starts[polygon + 1]; ++corner)
    {
      centers[polygon] += getPoint(corner) / raw.Counts[polygon];
      const vtkIdType next = corner + 1 < starts[polygon + 1] ? corner + 1 : first;
      normals[polygon] +=
        (getPoint(corner) - getPoint(first)).cross(getPoint(next) - getPoint(first));
    }
    normals[polygon].normalize();
  }
  AddSurfaces(centers, raw);
  this->Polygons = this->OrderOfPatches == Order::Atlas ? this->Tree.Sort(raw.Codes)
                                                        : this->Tree.Sort(centers, normals);
  this->Patches.resize(patches);
  this->Offsets.assign(1, 0);
  std::vector<double> coordinates;
  coordinates.reserve(raw.Coordinates.size());
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    const vtkIdType polygon = this->Polygons[patch];
    this->Patches[polygon] = static_cast<vtkIdType>(patch);
    this->Offsets.push_back(this->Offsets.back() + raw.Counts[polygon]);
    coordinates.insert(coordinates.end(), raw.Coordinates.begin() + 3 * starts[polygon],
      raw.Coordinates.begin() + 3 * starts[polygon + 1]);
  }
  raw.Coordinates.swap(coordinates);
  const auto local = this->Patches.begin() + firstLocal;
  this->LocalPatches.assign(local, local + static_cast<vtkIdType>(this->LocalCells.size()));
}

//------------------------------------------------------------------------------
// On top of the codes: surfaces that are near each other in space are so in the order.
void PatchScene::AddSurfaces(const std::vector<Vector>& centers, Raw& raw)
{
  std::map<vtkIdType, std::pair<Vector, double>> sums;
  for (std::size_t polygon = 0; polygon < raw.Surfaces.size(); ++polygon)
  {
    auto& sum =
      sums.emplace(raw.Surfaces[polygon], std::make_pair(Vector(0.0, 0.0, 0.0), 0.0)).first->second;
    sum.first += centers[polygon];
    sum.second += 1.0;
  }
  std::vector<vtkIdType> surfaces;
  std::vector<Vector> middles;
  for (const auto& sum : sums)
  {
    surfaces.push_back(sum.first);
    middles.push_back(sum.second.first / sum.second.second);
  }
  PatchTree tree;
  const std::vector<vtkIdType> order =
    tree.Sort(middles, std::vector<Vector>(middles.size(), Vector::UnitZ()));
  std::map<vtkIdType, std::uint64_t> places;
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    places[surfaces[order[place]]] = place;
  }
  for (std::size_t polygon = 0; polygon < raw.Surfaces.size(); ++polygon)
  {
    raw.Codes[polygon] |= places[raw.Surfaces[polygon]] << (2 * PatchTree::AtlasBits);
  }
}

//------------------------------------------------------------------------------
void PatchScene::MergePoints(const Raw& raw)
{
  std::unordered_map<std::array<double, 3>, vtkIdType, CoordinateHash> known;
  known.reserve(raw.Coordinates.size() / 6);
  for (std::size_t corner = 0; corner < raw.Coordinates.size(); corner += 3)
  {
    const std::array<double, 3> key{ raw.Coordinates[corner], raw.Coordinates[corner + 1],
      raw.Coordinates[corner + 2] };
    const auto inserted = known.emplace(key, static_cast<vtkIdType>(this->Points.size()));
    if (inserted.second)
    {
      this->Points.push_back((Vector(key.data()) - this->Center) / this->Scale);
    }
    this->Corners.push_back(inserted.first->second);
  }
}

//------------------------------------------------------------------------------
bool PatchScene::ComputePatchGeometry(std::string& error)
{
  const vtkIdType patches = static_cast<vtkIdType>(this->Offsets.size()) - 1;
  this->Areas.resize(patches);
  this->Normals.resize(patches);
  this->Centroids.resize(patches);
  this->Radii.resize(patches);
  for (vtkIdType polygon = 0; polygon < patches; ++polygon)
  {
    const char* problem = this->ComputeOnePatch(this->Patches[polygon]);
    if (problem)
    {
      error = "Polygon " + std::to_string(polygon) + " " + problem;
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
const char* PatchScene::ComputeOnePatch(vtkIdType patch)
{
  const int corners = this->GetNumberOfCorners(patch);
  if (corners < 3)
  {
    return "has fewer than 3 corners: remove degenerate cells (vtkCleanPolyData, or vtkPatchMesher "
           "with Repair on).";
  }
  if (corners > MaximumCorners)
  {
    return "has more than 30 corners: pass the input through vtkTriangleFilter first.";
  }
  const Vector& origin = this->GetCorner(patch, 0);
  Vector twiceArea = Vector::Zero();
  double longest = 0.0;
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector a = this->GetCorner(patch, corner) - origin;
    const Vector b = this->GetCorner(patch, (corner + 1) % corners) - origin;
    twiceArea += a.cross(b);
    longest = std::max(longest, (b - a).squaredNorm());
  }
  const double area = 0.5 * twiceArea.norm();
  if (area <= AreaTolerance * longest)
  {
    return "has no area: remove degenerate cells (vtkCleanPolyData, or vtkPatchMesher with Repair "
           "on).";
  }
  const Vector normal = twiceArea.normalized();
  Vector moment = Vector::Zero();
  for (int corner = 1; corner + 1 < corners; ++corner)
  {
    const Vector a = this->GetCorner(patch, corner) - origin;
    const Vector b = this->GetCorner(patch, corner + 1) - origin;
    moment += 0.5 * a.cross(b).dot(normal) * (a + b) / 3.0;
  }
  const Vector centroid = origin + moment / area;
  double radius = 0.0;
  for (int corner = 0; corner < corners; ++corner)
  {
    radius = std::max(radius, (this->GetCorner(patch, corner) - centroid).norm());
  }
  this->Areas[patch] = area;
  this->Normals[patch] = normal;
  this->Centroids[patch] = centroid;
  this->Radii[patch] = radius;
  return this->CheckShape(patch);
}

//------------------------------------------------------------------------------
const char* PatchScene::CheckShape(vtkIdType patch) const
{
  const int corners = this->GetNumberOfCorners(patch);
  if (corners == 3)
  {
    return nullptr;
  }
  const Vector& normal = this->Normals[patch];
  const Vector& first = this->GetCorner(patch, 0);
  const double tolerance = PlanarityTolerance * this->Radii[patch] + CoordinateTolerance;
  for (int corner = 0; corner < corners; ++corner)
  {
    const Vector& a = this->GetCorner(patch, corner);
    const Vector& b = this->GetCorner(patch, (corner + 1) % corners);
    const Vector& c = this->GetCorner(patch, (corner + 2) % corners);
    if (std::abs((a - this->Centroids[patch]).dot(normal)) > tolerance)
    {
      return "is not planar: pass the input through vtkTriangleFilter first.";
    }
    const double turn = (b - a).cross(c - b).dot(normal);
    // A star turns the same way at all corners, but winds around more than once.
    const double fan = (a - first).cross(b - first).dot(normal);
    if (turn < -tolerance * ((b - a).norm() + (c - b).norm()) ||
      fan < -tolerance * ((a - first).norm() + (b - first).norm()))
    {
      return "is not convex: pass the input through vtkTriangleFilter first.";
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
void PatchScene::ComputeFingerprint(const Raw& raw)
{
  std::uint64_t hash = 0xCBF29CE484222325ull;
  const auto add = [&hash](std::uint64_t bits)
  {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  };
  for (const vtkIdType count : raw.Counts)
  {
    add(static_cast<std::uint64_t>(count));
  }
  for (const double coordinate : raw.Coordinates)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    add(bits);
  }
  // Where rounding decides, another compiler may sort in another way: what was computed for one
  // order must not be taken for the other.
  for (const vtkIdType polygon : this->Polygons)
  {
    add(static_cast<std::uint64_t>(polygon));
  }
  // The spatial tree follows from the order of the patches.
  if (this->OrderOfPatches == Order::Atlas)
  {
    for (const PatchTree::Node& node : this->Tree.GetNodes())
    {
      add(static_cast<std::uint64_t>(node.Last));
    }
  }
  this->Fingerprint = hash;
}

//------------------------------------------------------------------------------
bool PatchScene::AreTouching(vtkIdType i, vtkIdType j) const
{
  const vtkIdType* const endI = this->GetCorners(i) + this->GetNumberOfCorners(i);
  const vtkIdType* const endJ = this->GetCorners(j) + this->GetNumberOfCorners(j);
  return std::find_first_of(this->GetCorners(i), endI, this->GetCorners(j), endJ) != endI;
}

//------------------------------------------------------------------------------
bool PatchScene::GatherCellArray(vtkDataObject* input, const std::string& name, bool required,
  std::vector<double>& values, int& components, std::string& error) const
{
  std::vector<double> mine;
  int found = 0; // 0: no local patches, -1: missing, otherwise the number of components
  bool ok = this->ReadLocalArray(input, name, mine, found, error);
  if (!PatchScene::Agree(this->Controller, ok, error))
  {
    return false;
  }
  const std::vector<int> all = AllGather(this->Controller, std::vector<int>{ found });
  components = 0;
  bool missing = false;
  for (const int rank : all)
  {
    missing = missing || rank < 0;
    ok = ok && (rank <= 0 || components == 0 || rank == components);
    components = std::max(components, rank);
  }
  if (missing && components == 0)
  {
    values.clear();
    error = required ? "The input has no cell array \"" + name + "\"." : "";
    return !required;
  }
  if (missing || !ok)
  {
    error = "The cell array \"" + name +
      "\" is missing or has another number of components in some blocks: give it to all of them.";
    return false;
  }
  values = this->GatherTuples(mine, components);
  return true;
}

//------------------------------------------------------------------------------
std::vector<double> PatchScene::GatherBlockValues(const std::vector<double>& blockValues) const
{
  std::vector<double> mine;
  for (const LocalCell& local : this->LocalCells)
  {
    mine.push_back(blockValues[local.Block]);
  }
  return this->GatherTuples(mine, 1);
}

//------------------------------------------------------------------------------
std::vector<double> PatchScene::GatherTuples(const std::vector<double>& mine, int components) const
{
  const std::vector<double> all = AllGather(this->Controller, mine);
  std::vector<double> values(all.size());
  for (std::size_t polygon = 0; polygon < this->Patches.size(); ++polygon)
  {
    std::copy_n(all.begin() + polygon * components, components,
      values.begin() + this->Patches[polygon] * components);
  }
  return values;
}

//------------------------------------------------------------------------------
bool PatchScene::ReadLocalArray(vtkDataObject* input, const std::string& name,
  std::vector<double>& values, int& components, std::string& error) const
{
  const std::vector<vtkPolyData*> leaves = GetLeaves(input);
  int block = -1;
  vtkDataArray* array = nullptr;
  for (const LocalCell& local : this->LocalCells)
  {
    if (local.Block != block)
    {
      block = local.Block;
      array = this->FindArray(leaves[block], name, error);
      if (!error.empty())
      {
        return false;
      }
      const int here = array ? array->GetNumberOfComponents() : -1;
      if (components != 0 && here != components)
      {
        error = "The cell array \"" + name +
          "\" is missing or has another number of components in some blocks: give it to all of "
          "them.";
        return false;
      }
      components = here;
    }
    for (int component = 0; component < components; ++component)
    {
      const double value = array->GetComponent(local.Cell, component);
      if (!std::isfinite(value))
      {
        error = "The cell array \"" + name + "\" has a value that is not finite at cell " +
          std::to_string(local.Cell) + ": replace it, for example with vtkArrayCalculator.";
        return false;
      }
      values.push_back(value);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
vtkDataArray* PatchScene::FindArray(vtkPolyData* data, const std::string& name,
  std::string& error) const
{
  vtkAbstractArray* array = data->GetCellData()->GetAbstractArray(name.c_str());
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  if (array && !numbers)
  {
    error = "The cell array \"" + name + "\" is not numeric.";
  }
  else if (!array && data->GetPointData()->HasArray(name.c_str()))
  {
    error = "\"" + name +
      "\" is a point array and a cell array is needed: pass the input through "
      "vtkPointDataToCellData.";
  }
  return numbers;
}

//------------------------------------------------------------------------------
void PatchScene::BuildSmoothPoints(double featureAngle, const std::vector<double>& materials,
  int materialComponents)
{
  const vtkIdType points = static_cast<vtkIdType>(this->Points.size());
  std::vector<vtkIdType> starts(points + 1, 0);
  for (const vtkIdType point : this->Corners)
  {
    ++starts[point + 1];
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::pair<vtkIdType, vtkIdType>> uses(this->Corners.size()); // patch, corner
  std::vector<vtkIdType> next(starts.begin(), starts.end() - 1);
  for (vtkIdType patch = 0; patch < this->GetNumberOfPatches(); ++patch)
  {
    for (vtkIdType corner = this->Offsets[patch]; corner < this->Offsets[patch + 1]; ++corner)
    {
      uses[next[this->Corners[corner]]++] = { patch, corner };
    }
  }

  const double cosine = std::cos(vtkMath::RadiansFromDegrees(featureAngle));
  const auto joined = [&](vtkIdType a, vtkIdType b)
  {
    return this->Normals[a].dot(this->Normals[b]) >= cosine &&
      std::equal(materials.begin() + a * materialComponents,
        materials.begin() + (a + 1) * materialComponents,
        materials.begin() + b * materialComponents);
  };
  this->CornerGroups.assign(this->Corners.size(), 0);
  this->NumberOfGroups = 0;
  for (vtkIdType point = 0; point < points; ++point)
  {
    const int count = static_cast<int>(starts[point + 1] - starts[point]);
    const auto* use = &uses[starts[point]];
    std::vector<int> parents(count);
    std::iota(parents.begin(), parents.end(), 0);
    for (int a = 0; a < count; ++a)
    {
      for (int b = 0; b < a; ++b)
      {
        if (joined(use[a].first, use[b].first))
        {
          parents[FindRoot(parents, a)] = FindRoot(parents, b);
        }
      }
    }
    std::vector<vtkIdType> groups(count, -1);
    for (int a = 0; a < count; ++a)
    {
      vtkIdType& group = groups[FindRoot(parents, a)];
      group = group < 0 ? this->NumberOfGroups++ : group;
      this->CornerGroups[use[a].second] = group;
    }
  }
}

//------------------------------------------------------------------------------
void PatchScene::CopyStructure(vtkDataObject* input, vtkDataObject* output)
{
  const std::vector<vtkPolyData*> leaves = GetLeaves(input);
  this->BlockPointGroups.assign(leaves.size(), {});
  std::vector<vtkIdType> firstLocal(leaves.size() + 1, 0);
  for (const LocalCell& local : this->LocalCells)
  {
    ++firstLocal[local.Block + 1];
  }
  std::partial_sum(firstLocal.begin(), firstLocal.end(), firstLocal.begin());

  auto* compositeIn = vtkCompositeDataSet::SafeDownCast(input);
  if (!compositeIn)
  {
    this->CopyBlock(leaves[0], 0, 0, vtkPolyData::SafeDownCast(output));
    return;
  }
  auto* compositeOut = vtkCompositeDataSet::SafeDownCast(output);
  compositeOut->CopyStructure(compositeIn);
  compositeOut->GetFieldData()->ShallowCopy(compositeIn->GetFieldData());
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(compositeIn->NewIterator());
  int block = 0;
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem(), ++block)
  {
    vtkNew<vtkPolyData> copy;
    this->CopyBlock(leaves[block], block, firstLocal[block], copy);
    compositeOut->SetDataSet(leaf, copy);
  }
}

//------------------------------------------------------------------------------
// The first smooth group that meets a point keeps it; every further one gets a copy of its own at
// the end.
void PatchScene::CopyBlock(vtkPolyData* input, int block, vtkIdType firstLocal, vtkPolyData* output)
{
  output->ShallowCopy(input);
  std::vector<vtkIdType>& groups = this->BlockPointGroups[block];
  groups.assign(input->GetNumberOfPoints(), -1);
  std::vector<vtkIdType> sources; // of the points added
  std::unordered_map<vtkIdType, vtkIdType> added;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  auto local = static_cast<std::size_t>(firstLocal);
  const vtkIdType first = FirstPolygonCell(input);
  for (vtkIdType polygon = 0; polygon < input->GetPolys()->GetNumberOfCells(); ++polygon)
  {
    input->GetPolys()->GetCellAtId(polygon, corners);
    const bool isPatch = local < this->LocalCells.size() &&
      this->LocalCells[local].Block == block && this->LocalCells[local].Cell == first + polygon;
    for (vtkIdType corner = 0; isPatch && corner < corners->GetNumberOfIds(); ++corner)
    {
      const vtkIdType patch = this->LocalPatches[local];
      const vtkIdType group = this->CornerGroups[this->Offsets[patch] + corner];
      const vtkIdType point = corners->GetId(corner);
      if (groups[point] < 0)
      {
        groups[point] = group;
      }
      if (groups[point] == group)
      {
        continue;
      }
      const auto inserted = added.emplace(group, static_cast<vtkIdType>(groups.size()));
      if (inserted.second)
      {
        groups.push_back(group);
        sources.push_back(point);
      }
      corners->SetId(corner, inserted.first->second);
    }
    local += isPatch ? 1 : 0;
    polygons->InsertNextCell(corners);
  }
  if (!sources.empty())
  {
    AppendPoints(input, sources, output);
    output->SetPolys(polygons);
  }
}

//------------------------------------------------------------------------------
void PatchScene::AppendPoints(vtkPolyData* input, const std::vector<vtkIdType>& sources,
  vtkPolyData* output)
{
  const vtkIdType old = input->GetNumberOfPoints();
  const vtkIdType total = old + static_cast<vtkIdType>(sources.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints()->GetDataType());
  points->SetNumberOfPoints(total);
  vtkPointData* from = input->GetPointData();
  vtkPointData* to = output->GetPointData();
  to->Initialize();
  to->CopyAllOn();
  to->CopyAllocate(from, total);
  for (vtkIdType point = 0; point < total; ++point)
  {
    const vtkIdType source = point < old ? point : sources[point - old];
    points->SetPoint(point, input->GetPoint(source));
    to->CopyData(from, source, point);
  }
  output->SetPoints(points);
}

//------------------------------------------------------------------------------
void PatchScene::AddCellArray(vtkDataObject* output, const std::string& name,
  const std::vector<double>& values, int components) const
{
  std::vector<vtkDoubleArray*> arrays;
  for (vtkPolyData* data : GetLeaves(output))
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(data->GetNumberOfCells());
    array->Fill(0.0);
    data->GetCellData()->AddArray(array);
    arrays.push_back(array);
  }
  for (std::size_t k = 0; k < this->LocalCells.size(); ++k)
  {
    const LocalCell& local = this->LocalCells[k];
    arrays[local.Block]->SetTypedTuple(local.Cell, &values[this->LocalPatches[k] * components]);
  }
}

//------------------------------------------------------------------------------
void PatchScene::AddPointArray(vtkDataObject* output, const std::string& name,
  const std::vector<double>& values, int components) const
{
  std::vector<double> means(this->NumberOfGroups * components, 0.0);
  std::vector<double> weights(this->NumberOfGroups, 0.0);
  for (vtkIdType patch = 0; patch < this->GetNumberOfPatches(); ++patch)
  {
    for (vtkIdType corner = this->Offsets[patch]; corner < this->Offsets[patch + 1]; ++corner)
    {
      const vtkIdType group = this->CornerGroups[corner];
      weights[group] += this->Areas[patch];
      for (int component = 0; component < components; ++component)
      {
        means[group * components + component] +=
          this->Areas[patch] * values[patch * components + component];
      }
    }
  }
  const std::vector<vtkPolyData*> leaves = GetLeaves(output);
  for (std::size_t block = 0; block < leaves.size(); ++block)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(leaves[block]->GetNumberOfPoints());
    array->Fill(0.0);
    const std::vector<vtkIdType>& groups = this->BlockPointGroups[block];
    for (std::size_t point = 0; point < groups.size(); ++point)
    {
      for (int component = 0; groups[point] >= 0 && component < components; ++component)
      {
        array->SetTypedComponent(static_cast<vtkIdType>(point), component,
          means[groups[point] * components + component] / weights[groups[point]]);
      }
    }
    leaves[block]->GetPointData()->AddArray(array);
  }
}

//------------------------------------------------------------------------------
void PatchScene::AddArray(vtkDataObject* output, const std::string& name,
  const std::vector<double>& values, int components) const
{
  this->AddCellArray(output, name, values, components);
  this->AddPointArray(output, name, values, components);
}
} // namespace LightTransport
