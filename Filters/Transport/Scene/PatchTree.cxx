// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PatchTree.h"

#include "Scene/PatchGeometry.h"
#include "Scene/SurfaceHalves.h"
#include "Shared/Pulse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = PatchTree::Vector;
using Box = std::pair<Vector, Vector>;

// Patches are divided by where they face while their normals are wider apart than this (along an
// axis), and by place otherwise.
constexpr double WideNormals = 0.7;

// Normals whose box has its centre this close to the origin point everywhere.
constexpr double NoDirection = 1e-6;

// Places closer than this part of a range are one: a scene that is moved keeps its tree, where
// rounding would part the rows of a grid.
constexpr double PlacesAcross = 0x1.0p20;

//------------------------------------------------------------------------------
Box MakeEmptyBox()
{
  const Vector most = Vector::Constant(std::numeric_limits<double>::max());
  return { most, -most };
}

//------------------------------------------------------------------------------
void Extend(Box& box, const Vector& point)
{
  box.first = box.first.cwiseMin(point);
  box.second = box.second.cwiseMax(point);
}

//------------------------------------------------------------------------------
// Divides ranges of patches; the tree is what the divisions leave behind.
class Sorter
{
public:
  Sorter(const std::vector<Vector>& centroids, const std::vector<Vector>& normals,
    std::vector<vtkIdType>& order)
    : Centroids(centroids), Normals(normals), Order(order)
  {
  }

  // Where [first, last) is cut; the patches before are then those of the left child.
  vtkIdType Divide(vtkIdType first, vtkIdType last)
  {
    const auto begin = this->Order.begin() + first;
    const auto end = this->Order.begin() + last;
    Box places = MakeEmptyBox();
    Box normals = MakeEmptyBox();
    std::for_each(begin, end,
      [&](vtkIdType patch)
      {
        Extend(places, this->Centroids[patch]);
        Extend(normals, this->Normals[patch]);
      });
    int axis = 0;
    int normalAxis = 0;
    // Single precision: what is the same but for rounding is the same.
    (places.second - places.first).cast<float>().maxCoeff(&axis);
    const double spread = (normals.second - normals.first).cast<float>().maxCoeff(&normalAxis);
    const vtkIdType unit =
      last - first > PatchTree::BlockSize ? PatchTree::BlockSize : PatchTree::LeafSize;
    const vtkIdType units = (last - first + unit - 1) / unit;
    vtkIdType cut = first + (units + 1) / 2 * unit;
    double middle = -2.0;
    if (spread > WideNormals)
    {
      middle = 0.5 * (normals.first[normalAxis] + normals.second[normalAxis]);
      const vtkIdType below = std::count_if(begin, end,
        [&](vtkIdType patch) { return this->Normals[patch][normalAxis] < middle; });
      cut = first + std::min(std::max<vtkIdType>((below + unit / 2) / unit, 1), units - 1) * unit;
    }
    const double low = places.first[axis];
    const double step = (places.second[axis] - low) / PlacesAcross;
    const auto getPlace = [&](vtkIdType patch)
    { return step > 0.0 ? std::round((this->Centroids[patch][axis] - low) / step) : 0.0; };
    // What does not fit into whole units goes by its place.
    const auto isBefore = [&](vtkIdType a, vtkIdType b)
    {
      Pulse::Beat(++this->Comparisons);
      const bool above[2] = { this->Normals[a][normalAxis] >= middle,
        this->Normals[b][normalAxis] >= middle };
      const double at[2] = { getPlace(a), getPlace(b) };
      return std::tie(above[0], at[0], a) < std::tie(above[1], at[1], b);
    };
    std::nth_element(begin, this->Order.begin() + cut, end, isBefore);
    return cut;
  }

  // nth_element leaves an order that differs between implementations.
  void Finish(vtkIdType first, vtkIdType last)
  {
    std::sort(this->Order.begin() + first, this->Order.begin() + last);
  }

private:
  const std::vector<Vector>& Centroids;
  const std::vector<Vector>& Normals;
  std::vector<vtkIdType>& Order;
  std::size_t Comparisons = 0;
};

//------------------------------------------------------------------------------
// Everything but the cone, from the patches of a leaf.
void FillLeaf(const PatchGeometry& patches, PatchTree::Node& node, Box& normals)
{
  Box corners = MakeEmptyBox();
  Box centroids = MakeEmptyBox();
  normals = MakeEmptyBox();
  for (vtkIdType patch = node.First; patch < node.Last; ++patch)
  {
    for (int corner = 0; corner < patches.GetNumberOfCorners(patch); ++corner)
    {
      Extend(corners, patches.GetCorner(patch, corner));
    }
    Extend(centroids, patches.GetCentroid(patch));
    Extend(normals, patches.GetNormal(patch));
    node.Radius = std::max(node.Radius, patches.GetRadius(patch));
    node.Area += patches.GetAreas()[patch];
  }
  std::tie(node.Lower, node.Upper) = corners;
  std::tie(node.CentroidLower, node.CentroidUpper) = centroids;
}

//------------------------------------------------------------------------------
void Join(const PatchTree::Node& left, const PatchTree::Node& right, PatchTree::Node& node)
{
  node.Lower = left.Lower.cwiseMin(right.Lower);
  node.Upper = left.Upper.cwiseMax(right.Upper);
  node.CentroidLower = left.CentroidLower.cwiseMin(right.CentroidLower);
  node.CentroidUpper = left.CentroidUpper.cwiseMax(right.CentroidUpper);
  node.Radius = std::max(left.Radius, right.Radius);
  node.Area = left.Area + right.Area;
}

//------------------------------------------------------------------------------
// Around the centre of the box of the normals. All patches are looked at, not the cones of the
// children: cones around cones would widen from level to level.
void FillCone(const PatchGeometry& patches, const Box& normals, PatchTree::Node& node)
{
  const Vector centre = 0.5 * (normals.first + normals.second);
  if (centre.norm() < NoDirection)
  {
    return;
  }
  node.ConeAxis = centre.normalized();
  node.ConeCosine = 1.0;
  for (vtkIdType patch = node.First; patch < node.Last; ++patch)
  {
    node.ConeCosine = std::min(node.ConeCosine, patches.GetNormal(patch).dot(node.ConeAxis));
  }
}

//------------------------------------------------------------------------------
// All bits below the highest one that is set.
std::uint64_t GetLowerBits(std::uint64_t bits)
{
  for (int step = 1; step < 64; step *= 2)
  {
    bits |= bits >> step;
  }
  return bits >> 1;
}

//------------------------------------------------------------------------------
void FillAllNodes(const PatchGeometry& patches, std::vector<PatchTree::Node>& nodes)
{
  std::vector<Box> normals(nodes.size());
  // Children come after their parents.
  for (std::size_t index = nodes.size(); index-- > 0;)
  {
    Pulse::Beat();
    PatchTree::Node& node = nodes[index];
    if (node.IsLeaf())
    {
      FillLeaf(patches, node, normals[index]);
    }
    else
    {
      Join(nodes[node.Left], nodes[node.Left + 1], node);
      normals[index] = normals[node.Left];
      Extend(normals[index], normals[node.Left + 1].first);
      Extend(normals[index], normals[node.Left + 1].second);
    }
    FillCone(patches, normals[index], node);
  }
}
} // namespace

//------------------------------------------------------------------------------
// Breadth first: `divide` tells where a range is cut, `finish` what is left of one in a leaf.
template <typename Divide, typename Finish>
void PatchTree::Grow(vtkIdType patches, const Divide& divide, const Finish& finish)
{
  this->Nodes.assign(1, Node());
  this->Nodes[0].Last = patches;
  for (std::size_t index = 0; index < this->Nodes.size(); ++index)
  {
    Pulse::Beat();
    const vtkIdType first = this->Nodes[index].First;
    const vtkIdType last = this->Nodes[index].Last;
    if (last - first <= LeafSize)
    {
      finish(first, last);
      continue;
    }
    this->Nodes[index].Left = static_cast<int>(this->Nodes.size());
    Node child;
    child.Parent = static_cast<int>(index);
    child.First = first;
    child.Last = divide(first, last);
    this->Nodes.push_back(child);
    child.First = child.Last;
    child.Last = last;
    this->Nodes.push_back(child);
  }
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> PatchTree::Sort(const std::vector<Vector>& centroids,
  const std::vector<Vector>& normals)
{
  const auto patches = static_cast<vtkIdType>(centroids.size());
  std::vector<vtkIdType> order(patches);
  std::iota(order.begin(), order.end(), 0);
  Sorter sorter(centroids, normals, order);
  this->Grow(
    patches, [&](vtkIdType first, vtkIdType last) { return sorter.Divide(first, last); },
    [&](vtkIdType first, vtkIdType last) { sorter.Finish(first, last); });
  this->Blocks.assign(std::max<vtkIdType>((patches + BlockSize - 1) / BlockSize, 1), 0);
  for (std::size_t index = 0; index < this->Nodes.size(); ++index)
  {
    const Node& node = this->Nodes[index];
    if (node.GetSize() <= BlockSize &&
      (node.Parent < 0 || this->Nodes[node.Parent].GetSize() > BlockSize))
    {
      this->Blocks[node.First / BlockSize] = static_cast<int>(index);
    }
  }
  return order;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> PatchTree::Sort(const std::vector<Vector>& centroids,
  const std::vector<Vector>& normals, const std::vector<double>& areas)
{
  std::vector<vtkIdType> order(centroids.size());
  std::iota(order.begin(), order.end(), 0);
  SurfaceHalves halves(centroids, normals, areas, order);
  this->Grow(
    static_cast<vtkIdType>(order.size()),
    [&](vtkIdType first, vtkIdType last) { return halves.Divide(first, last); },
    [](vtkIdType, vtkIdType) {});
  this->Blocks.clear();
  return order;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> PatchTree::Sort(const std::vector<std::uint64_t>& codes)
{
  const auto patches = static_cast<vtkIdType>(codes.size());
  std::vector<vtkIdType> order(patches);
  std::iota(order.begin(), order.end(), 0);
  std::size_t comparisons = 0;
  std::sort(order.begin(), order.end(),
    [&](vtkIdType a, vtkIdType b)
    {
      Pulse::Beat(++comparisons);
      return std::tie(codes[a], a) < std::tie(codes[b], b);
    });
  const auto divide = [&](vtkIdType first, vtkIdType last)
  {
    const std::uint64_t different = codes[order[first]] ^ codes[order[last - 1]];
    if (different == 0)
    {
      return first + (last - first) / 2;
    }
    const std::uint64_t above = codes[order[last - 1]] & ~GetLowerBits(different);
    const auto cut = std::partition_point(order.begin() + first, order.begin() + last,
      [&](vtkIdType patch) { return codes[patch] < above; });
    return static_cast<vtkIdType>(cut - order.begin());
  };
  this->Grow(patches, divide, [](vtkIdType, vtkIdType) {});
  this->Blocks.clear();
  return order;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> PatchTree::GetCuts() const
{
  std::vector<vtkIdType> cuts;
  for (const Node& node : this->Nodes)
  {
    if (!node.IsLeaf())
    {
      cuts.push_back(this->Nodes[node.Left].Last);
    }
  }
  return cuts;
}

//------------------------------------------------------------------------------
void PatchTree::Regrow(vtkIdType patches, const std::vector<vtkIdType>& cuts)
{
  auto cut = cuts.begin();
  this->Grow(
    patches, [&](vtkIdType, vtkIdType) { return *cut++; }, [](vtkIdType, vtkIdType) {});
  this->Blocks.clear();
}

//------------------------------------------------------------------------------
std::uint64_t PatchTree::GetCode(double x, double y)
{
  std::uint64_t code = 0;
  constexpr double side = static_cast<double>(std::int64_t(1) << AtlasBits);
  const double places[2] = { x, y };
  for (const double place : places)
  {
    const auto cell = static_cast<std::uint64_t>(std::min(std::max(place * side, 0.0), side - 1.0));
    code <<= 1;
    for (int bit = 0; bit < AtlasBits; ++bit)
    {
      code |= (cell >> bit & 1) << (2 * bit);
    }
  }
  return code;
}

//------------------------------------------------------------------------------
void PatchTree::FillNodes(const PatchGeometry& patches)
{
  FillAllNodes(patches, this->Nodes);
}
} // namespace LightTransport
