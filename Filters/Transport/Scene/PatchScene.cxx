// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchScene.h"

#include "Scene/CoincidentFaces.h"
#include "Scene/ScenePieces.h"
#include "Shared/BitHash.h"
#include "Shared/Pulse.h"

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
#include <string>
#include <unordered_map>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

// The step between coordinates in single precision over what they may be off (PolygonGathering),
// and the part of the median patch's size from which on it is told of.
constexpr double SpacingPerRounding = 4.0 / 3.0;
constexpr double CoarseSpacing = 0.01;

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
Outcome FailWithoutArea(const std::vector<std::string>& reasons)
{
  std::string text = "The input has no polygons with an area: give a surface that has one.";
  for (const std::string& reason : reasons)
  {
    text += " " + reason;
  }
  return Outcome::Failed(text);
}

//------------------------------------------------------------------------------
// On top of the codes: surfaces that are near each other in space are so in the order.
void AddSurfaces(const std::vector<Vector>& centers, const std::vector<vtkIdType>& surfaces,
  std::vector<std::uint64_t>& codes)
{
  std::map<vtkIdType, std::pair<Vector, double>> sums;
  for (std::size_t piece = 0; piece < surfaces.size(); ++piece)
  {
    auto& sum =
      sums.emplace(surfaces[piece], std::make_pair(Vector(0.0, 0.0, 0.0), 0.0)).first->second;
    sum.first += centers[piece];
    sum.second += 1.0;
  }
  std::vector<vtkIdType> numbers;
  std::vector<Vector> middles;
  for (const auto& sum : sums)
  {
    numbers.push_back(sum.first);
    middles.push_back(sum.second.first / sum.second.second);
  }
  PatchTree tree;
  const std::vector<vtkIdType> order =
    tree.Sort(middles, std::vector<Vector>(middles.size(), Vector::UnitZ()));
  std::map<vtkIdType, std::uint64_t> places;
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    places[numbers[order[place]]] = place;
  }
  for (std::size_t piece = 0; piece < surfaces.size(); ++piece)
  {
    codes[piece] |= places[surfaces[piece]] << (2 * PatchTree::AtlasBits);
  }
}

} // namespace

//------------------------------------------------------------------------------
Outcome PatchScene::Build(vtkDataObject* input, const Ranks& ranks, Order order, int numberOfSides,
  bool takesTexels, std::shared_ptr<const PatchArrangement> kept)
{
  *this = PatchScene();
  this->OrderOfPatches = order;
  this->Kept = std::move(kept);
  GatheredPolygons polygons;
  if (Outcome gathered =
        PolygonGathering::Gather(input, ranks, order == Order::Atlas, takesTexels, polygons);
      !gathered)
  {
    return gathered;
  }
  if (polygons.Counts.empty())
  {
    return Outcome::Failed(polygons.AreTexels
        ? "The texel image has no texels with surface (ChartId from 0, Area above 0): make it of "
          "the surface with vtkSurfaceToAtlas."
        : "The input has no polygons: give a surface with at least one polygon.");
  }
  const std::set<vtkIdType> surfaces(polygons.Surfaces.begin(), polygons.Surfaces.end());
  if (surfaces.size() * numberOfSides > MaximumSurfaces)
  {
    return Outcome::Failed("The input has more than " +
      std::to_string(MaximumSurfaces / numberOfSides) +
      " blocks, too many for the cluster tree of their atlases: set ClusterTree to Spatial.");
  }
  if (Outcome normalized = this->Normalize(polygons); !normalized)
  {
    return normalized;
  }
  this->OfTexels = polygons.AreTexels;
  this->LocalCells = polygons.LocalCells;
  this->CopiedCells = polygons.CopiedCells;
  this->FirstLocal = polygons.FirstLocal;
  const std::vector<Vector> corners = this->MakeCorners(polygons);
  ScenePieces pieces(this->PlaceOffsets, corners, this->CoordinateRounding.norm());
  this->Warnings = pieces.GetWarnings();
  if (pieces.GetNumber() == 0)
  {
    return FailWithoutArea(this->Warnings);
  }
  if (numberOfSides == 2)
  {
    pieces.AddBacks();
  }
  this->Problems = pieces.Problems;
  this->Arrange(polygons, corners, pieces);
  if (!this->OfTexels)
  {
    this->Prune(polygons, corners, pieces);
  }
  this->WarnOfSpacing();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
std::vector<Vector> PatchScene::MakeCorners(const GatheredPolygons& polygons)
{
  this->PlaceOffsets.assign(polygons.Counts.size() + 1, 0);
  std::partial_sum(polygons.Counts.begin(), polygons.Counts.end(), this->PlaceOffsets.begin() + 1);
  std::vector<Vector> corners;
  corners.reserve(polygons.Coordinates.size() / 3);
  for (std::size_t corner = 0; corner < polygons.Coordinates.size(); corner += 3)
  {
    Pulse::Beat(corner);
    corners.push_back((Vector(&polygons.Coordinates[corner]) - this->Center) / this->Scale);
  }
  return corners;
}

//------------------------------------------------------------------------------
// What is there twice is found in a scene that is whole, and then left out of it.
void PatchScene::Prune(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
  ScenePieces& pieces)
{
  const CoincidentFaces coincident(*this);
  for (const std::vector<vtkIdType>& faces :
    { coincident.GetCovered(), coincident.GetOverlapping() })
  {
    for (const vtkIdType face : faces)
    {
      this->Problems[face] |= SceneFaces::COINCIDENT;
    }
  }
  const std::vector<std::string> warnings = coincident.GetWarnings();
  this->Warnings.insert(this->Warnings.end(), warnings.begin(), warnings.end());
  if (!coincident.GetCovered().empty())
  {
    pieces.Remove(coincident.GetCovered());
    this->Arrange(polygons, corners, pieces);
  }
}

//------------------------------------------------------------------------------
// Coarse coordinates are taken as they are.
void PatchScene::WarnOfSpacing()
{
  std::vector<double> areas = this->GetAreas();
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  const double size = std::sqrt(*middle);
  const double spacing = SpacingPerRounding * this->CoordinateRounding.maxCoeff();
  if (spacing > CoarseSpacing * size)
  {
    std::ostringstream text;
    text.precision(2);
    text << "The points are stored in steps of up to " << spacing * this->Scale
         << ", more than 1 % of the size of the median patch (" << size * this->Scale
         << "): results are those of the rounded coordinates. Store them in double precision, or "
            "move the scene to the origin first.";
    this->Warnings.push_back(text.str());
  }
}

//------------------------------------------------------------------------------
Outcome PatchScene::Normalize(const GatheredPolygons& polygons)
{
  Vector low = Vector::Constant(std::numeric_limits<double>::max());
  Vector high = -low;
  for (std::size_t corner = 0; corner < polygons.Coordinates.size(); corner += 3)
  {
    const Vector point(&polygons.Coordinates[corner]);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (!((high - low).array() > 0.0).any())
  {
    return FailWithoutArea({});
  }
  this->Center = 0.5 * low + 0.5 * high;
  this->Scale = (high - low).stableNorm();
  if (!std::isfinite(this->Scale) || this->Scale < std::numeric_limits<double>::min())
  {
    std::ostringstream text;
    text << "The input's bounding box has diagonal " << this->Scale
         << ": scale it to a size that double precision can hold.";
    return Outcome::Failed(text.str());
  }
  this->CoordinateRounding =
    polygons.Precision * low.cwiseAbs().cwiseMax(high.cwiseAbs()) / this->Scale;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void PatchScene::Arrange(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
  const ScenePieces& pieces)
{
  const std::vector<vtkIdType> order = this->ArrangePieces(polygons, corners, pieces);
  this->MergePoints(polygons, corners, pieces, order);
  this->ComputeFingerprint(polygons, pieces, order);
  this->AllocatePatches();
  std::vector<vtkIdType> faces;
  for (std::size_t patch = 0; patch < order.size(); ++patch)
  {
    Pulse::Beat(patch);
    const Vector& plane = pieces.Planes[order[patch]];
    this->ComputePatch(static_cast<vtkIdType>(patch), plane.isZero() ? nullptr : &plane);
    faces.push_back(pieces.Faces[order[patch]]);
  }
  const std::size_t count = polygons.Counts.size();
  this->Faces = SceneFaces(static_cast<vtkIdType>(count),
    static_cast<int>(pieces.Problems.size() / count), faces, this->GetAreas());
  this->Tree.FillNodes(*this);
}

//------------------------------------------------------------------------------
// The order comes from the scaled scene: in the input's unit a mean of corners could overflow.
std::vector<vtkIdType> PatchScene::SortPieces(const GatheredPolygons& polygons,
  const std::vector<Vector>& corners, const ScenePieces& pieces)
{
  const vtkIdType count = pieces.GetNumber();
  std::vector<Vector> centers(count, Vector::Zero());
  std::vector<Vector> normals(count, Vector::Zero());
  std::vector<double> areas(count);
  for (vtkIdType piece = 0; piece < count; ++piece)
  {
    Pulse::Beat(piece);
    const vtkIdType first = pieces.Offsets[piece];
    const Vector& origin = corners[pieces.Corners[first]];
    for (vtkIdType corner = first; corner < pieces.Offsets[piece + 1]; ++corner)
    {
      const vtkIdType next = corner + 1 < pieces.Offsets[piece + 1] ? corner + 1 : first;
      const Vector& place = corners[pieces.Corners[corner]];
      centers[piece] += place / pieces.GetCount(piece);
      normals[piece] += (place - origin).cross(corners[pieces.Corners[next]] - origin);
    }
    areas[piece] = 0.5 * normals[piece].norm();
    normals[piece].normalize();
  }
  if (this->OrderOfPatches != Order::Atlas)
  {
    return this->OrderOfPatches == Order::Spatial ? this->Tree.Sort(centers, normals)
                                                  : this->Tree.Sort(centers, normals, areas);
  }
  std::vector<std::uint64_t> codes;
  std::vector<vtkIdType> surfaces;
  // The backs of a surface are a surface of their own.
  const vtkIdType behind =
    1 + *std::max_element(polygons.Surfaces.begin(), polygons.Surfaces.end());
  const auto numberOfPolygons = static_cast<vtkIdType>(polygons.Counts.size());
  for (const vtkIdType face : pieces.Faces)
  {
    codes.push_back(polygons.Codes[face % numberOfPolygons]);
    surfaces.push_back(
      polygons.Surfaces[face % numberOfPolygons] + (face < numberOfPolygons ? 0 : behind));
  }
  AddSurfaces(centers, surfaces, codes);
  return this->Tree.Sort(codes);
}

//------------------------------------------------------------------------------
// Points of patches come first, in the order of these; then those that no patch has.
void PatchScene::MergePoints(const GatheredPolygons& polygons, const std::vector<Vector>& corners,
  const ScenePieces& pieces, const std::vector<vtkIdType>& order)
{
  std::unordered_map<std::array<double, 3>, vtkIdType, CoordinateHash> known;
  known.reserve(corners.size() / 2);
  const auto getPlace = [&](vtkIdType corner)
  {
    const double* place = &polygons.Coordinates[3 * corner];
    return known
      .emplace(std::array<double, 3>{ place[0], place[1], place[2] },
        static_cast<vtkIdType>(known.size()))
      .first->second;
  };
  this->Points.clear();
  this->Corners.clear();
  this->Offsets.assign(1, 0);
  for (const vtkIdType piece : order)
  {
    Pulse::Beat(this->Offsets.size());
    for (vtkIdType k = pieces.Offsets[piece]; k < pieces.Offsets[piece + 1]; ++k)
    {
      const vtkIdType corner = pieces.Corners[k];
      this->Corners.push_back(getPlace(corner));
      if (known.size() > this->Points.size())
      {
        this->Points.push_back(corners[corner]);
      }
    }
    this->Offsets.push_back(static_cast<vtkIdType>(this->Corners.size()));
  }
  this->Places.resize(corners.size());
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
  {
    Pulse::Beat(corner);
    this->Places[corner] = getPlace(static_cast<vtkIdType>(corner));
  }
  this->NumberOfPlaces = static_cast<vtkIdType>(known.size());
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> PatchScene::GetLocalPatches() const
{
  std::vector<vtkIdType> patches;
  const auto count = static_cast<vtkIdType>(this->LocalCells.size());
  for (int side = 0; side < this->Faces.GetNumberOfSides(); ++side)
  {
    const vtkIdType first = this->FirstLocal + side * this->Faces.GetNumberOfPolygons();
    for (vtkIdType face = first; face < first + count; ++face)
    {
      const SceneFaces::Range range = this->Faces.GetPatches(face);
      patches.insert(patches.end(), range.begin(), range.end());
    }
  }
  return patches;
}

//------------------------------------------------------------------------------
void PatchScene::ComputeFingerprint(const GatheredPolygons& polygons, const ScenePieces& pieces,
  const std::vector<vtkIdType>& order)
{
  BitHash hash;
  for (vtkIdType piece = 0; piece < pieces.GetNumber(); ++piece)
  {
    hash.Add(static_cast<std::uint64_t>(pieces.GetCount(piece)));
  }
  for (const vtkIdType piece : order)
  {
    Pulse::Beat(piece);
    for (vtkIdType k = pieces.Offsets[piece]; k < pieces.Offsets[piece + 1]; ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        hash.AddNumber(polygons.Coordinates[3 * pieces.Corners[k] + axis]);
      }
    }
  }
  // Where rounding decides, another compiler may sort in another way: what was computed for one
  // order must not be taken for the other.
  hash.AddAll(order);
  // The spatial tree follows from the order of the patches.
  if (this->OrderOfPatches != Order::Spatial)
  {
    for (const PatchTree::Node& node : this->Tree.GetNodes())
    {
      hash.Add(static_cast<std::uint64_t>(node.Last));
    }
  }
  this->Fingerprint = hash.Get();
}

//------------------------------------------------------------------------------
// As before, where there was one of the same pieces.
std::vector<vtkIdType> PatchScene::ArrangePieces(const GatheredPolygons& polygons,
  const std::vector<Vector>& corners, const ScenePieces& pieces)
{
  if (this->OrderOfPatches != Order::Surface)
  {
    return this->SortPieces(polygons, corners, pieces);
  }
  BitHash hash;
  hash.Add(polygons.Topology);
  hash.AddAll(pieces.Faces);
  hash.AddAll(pieces.Offsets);
  hash.AddAll(pieces.Corners);
  if (this->Kept && this->Kept->Topology == hash.Get())
  {
    this->Arrangement = this->Kept;
    this->Tree.Regrow(pieces.GetNumber(), this->Kept->Cuts);
    return this->Kept->Pieces;
  }
  auto arrangement = std::make_shared<PatchArrangement>();
  arrangement->Topology = hash.Get();
  arrangement->Pieces = this->SortPieces(polygons, corners, pieces);
  arrangement->Cuts = this->Tree.GetCuts();
  this->Arrangement = std::move(arrangement);
  return this->Arrangement->Pieces;
}
} // namespace LightTransport
