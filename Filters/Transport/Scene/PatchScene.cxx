// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchScene.h"

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

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

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
// On top of the codes: surfaces that are near each other in space are so in the order.
void AddSurfaces(const std::vector<Vector>& centers, GatheredPolygons& polygons)
{
  std::map<vtkIdType, std::pair<Vector, double>> sums;
  for (std::size_t polygon = 0; polygon < polygons.Surfaces.size(); ++polygon)
  {
    auto& sum = sums.emplace(polygons.Surfaces[polygon], std::make_pair(Vector(0.0, 0.0, 0.0), 0.0))
                  .first->second;
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
  for (std::size_t polygon = 0; polygon < polygons.Surfaces.size(); ++polygon)
  {
    polygons.Codes[polygon] |= places[polygons.Surfaces[polygon]] << (2 * PatchTree::AtlasBits);
  }
}
} // namespace

//------------------------------------------------------------------------------
Outcome PatchScene::Build(vtkDataObject* input, const Ranks& ranks, Order order)
{
  *this = PatchScene();
  this->OrderOfPatches = order;
  GatheredPolygons polygons;
  if (Outcome gathered = PolygonGathering::Gather(input, ranks, order == Order::Atlas, polygons);
      !gathered)
  {
    return gathered;
  }
  if (polygons.Counts.empty())
  {
    return Outcome::Failed("The input has no polygons: give a surface with at least one polygon.");
  }
  if (std::set<vtkIdType>(polygons.Surfaces.begin(), polygons.Surfaces.end()).size() >
    MaximumSurfaces)
  {
    return Outcome::Failed("The input has more than " + std::to_string(MaximumSurfaces) +
      " blocks, too many for the cluster tree of their atlases: set ClusterTree to Spatial.");
  }
  if (Outcome normalized = this->Normalize(polygons); !normalized)
  {
    return normalized;
  }
  this->LocalCells = polygons.LocalCells;
  this->SortPatches(polygons);
  this->ComputeFingerprint(polygons);
  this->MergePoints(polygons);
  if (Outcome computed = this->ComputePatches(); !computed)
  {
    return computed;
  }
  this->Tree.FillNodes(*this);
  return Outcome::Done();
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
// The order comes from the scaled scene: in the input's unit a mean of corners could overflow.
void PatchScene::SortPatches(GatheredPolygons& polygons)
{
  const std::size_t patches = polygons.Counts.size();
  std::vector<vtkIdType> starts(patches + 1, 0);
  std::partial_sum(polygons.Counts.begin(), polygons.Counts.end(), starts.begin() + 1);
  std::vector<Vector> centers(patches, Vector::Zero());
  std::vector<Vector> normals(patches, Vector::Zero());
  for (std::size_t polygon = 0; polygon < patches; ++polygon)
  {
    const auto getPoint = [&](vtkIdType corner) -> Vector
    { return (Vector(&polygons.Coordinates[3 * corner]) - this->Center) / this->Scale; };
    const vtkIdType first = starts[polygon];
    for (vtkIdType corner = first; corner < starts[polygon + 1]; ++corner)
    {
      centers[polygon] += getPoint(corner) / polygons.Counts[polygon];
      const vtkIdType next = corner + 1 < starts[polygon + 1] ? corner + 1 : first;
      normals[polygon] +=
        (getPoint(corner) - getPoint(first)).cross(getPoint(next) - getPoint(first));
    }
    normals[polygon].normalize();
  }
  AddSurfaces(centers, polygons);
  this->Polygons = this->OrderOfPatches == Order::Atlas ? this->Tree.Sort(polygons.Codes)
                                                        : this->Tree.Sort(centers, normals);
  this->Patches.resize(patches);
  this->Offsets.assign(1, 0);
  std::vector<double> coordinates;
  coordinates.reserve(polygons.Coordinates.size());
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    const vtkIdType polygon = this->Polygons[patch];
    this->Patches[polygon] = static_cast<vtkIdType>(patch);
    this->Offsets.push_back(this->Offsets.back() + polygons.Counts[polygon]);
    coordinates.insert(coordinates.end(), polygons.Coordinates.begin() + 3 * starts[polygon],
      polygons.Coordinates.begin() + 3 * starts[polygon + 1]);
  }
  polygons.Coordinates.swap(coordinates);
  const auto local = this->Patches.begin() + polygons.FirstLocal;
  this->LocalPatches.assign(local, local + static_cast<vtkIdType>(this->LocalCells.size()));
}

//------------------------------------------------------------------------------
void PatchScene::MergePoints(const GatheredPolygons& polygons)
{
  std::unordered_map<std::array<double, 3>, vtkIdType, CoordinateHash> known;
  known.reserve(polygons.Coordinates.size() / 6);
  for (std::size_t corner = 0; corner < polygons.Coordinates.size(); corner += 3)
  {
    const std::array<double, 3> key{ polygons.Coordinates[corner], polygons.Coordinates[corner + 1],
      polygons.Coordinates[corner + 2] };
    const auto inserted = known.emplace(key, static_cast<vtkIdType>(this->Points.size()));
    if (inserted.second)
    {
      this->Points.push_back((Vector(key.data()) - this->Center) / this->Scale);
    }
    this->Corners.push_back(inserted.first->second);
  }
}

//------------------------------------------------------------------------------
Outcome PatchScene::ComputePatches()
{
  this->AllocatePatches();
  for (std::size_t polygon = 0; polygon < this->Patches.size(); ++polygon)
  {
    if (const char* problem = this->ComputePatch(this->Patches[polygon]))
    {
      return Outcome::Failed("Polygon " + std::to_string(polygon) + " " + problem);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void PatchScene::ComputeFingerprint(const GatheredPolygons& polygons)
{
  std::uint64_t hash = 0xCBF29CE484222325ull;
  const auto add = [&hash](std::uint64_t bits)
  {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  };
  for (const vtkIdType count : polygons.Counts)
  {
    add(static_cast<std::uint64_t>(count));
  }
  for (const double coordinate : polygons.Coordinates)
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
} // namespace LightTransport
