// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPatchTree.h"

#include "vtkPatchScene.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace
{
using Vector = vtkPatchTree::Vector;
using Box = std::pair<Vector, Vector>;

// Normals whose box has its centre this close to the origin point everywhere.
constexpr double NoDirection = 1e-6;

//------------------------------------------------------------------------------
// Where [first, last) is divided; first is a multiple of the unit of the division.
vtkIdType GetCut(vtkIdType first, vtkIdType last)
{
  const vtkIdType size = last - first;
  const vtkIdType unit =
    size > vtkPatchTree::BlockSize ? vtkPatchTree::BlockSize : vtkPatchTree::LeafSize;
  const vtkIdType units = (size + unit - 1) / unit;
  return first + (units + 1) / 2 * unit;
}

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
void SortRange(const std::vector<Vector>& centroids, std::vector<vtkIdType>& order, vtkIdType first,
  vtkIdType last)
{
  const auto begin = order.begin() + first;
  const auto end = order.begin() + last;
  if (last - first <= vtkPatchTree::LeafSize)
  {
    // nth_element leaves an order that differs between implementations.
    std::sort(begin, end);
    return;
  }
  Box box = MakeEmptyBox();
  std::for_each(begin, end, [&](vtkIdType patch) { Extend(box, centroids[patch]); });
  int axis = 0;
  (box.second - box.first).maxCoeff(&axis);
  const vtkIdType cut = GetCut(first, last);
  std::nth_element(begin, order.begin() + cut, end,
    [&](vtkIdType a, vtkIdType b)
    {
      const double left = centroids[a][axis];
      const double right = centroids[b][axis];
      return left < right || (left == right && a < b);
    });
  SortRange(centroids, order, first, cut);
  SortRange(centroids, order, cut, last);
}

//------------------------------------------------------------------------------
// Everything but the cone, from the patches of a leaf.
void FillLeaf(const vtkPatchScene& scene, vtkPatchTree::Node& node, Box& normals)
{
  Box corners = MakeEmptyBox();
  Box centroids = MakeEmptyBox();
  normals = MakeEmptyBox();
  for (vtkIdType patch = node.First; patch < node.Last; ++patch)
  {
    for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      Extend(corners, scene.GetCorner(patch, corner));
    }
    Extend(centroids, scene.GetCentroid(patch));
    Extend(normals, scene.GetNormal(patch));
    node.Radius = std::max(node.Radius, scene.GetRadius(patch));
    node.Area += scene.GetAreas()[patch];
  }
  std::tie(node.Lower, node.Upper) = corners;
  std::tie(node.CentroidLower, node.CentroidUpper) = centroids;
}

//------------------------------------------------------------------------------
void Join(const vtkPatchTree::Node& left, const vtkPatchTree::Node& right, vtkPatchTree::Node& node)
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
void FillCone(const vtkPatchScene& scene, const Box& normals, vtkPatchTree::Node& node)
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
    node.ConeCosine = std::min(node.ConeCosine, scene.GetNormal(patch).dot(node.ConeAxis));
  }
}

//------------------------------------------------------------------------------
void FillNodes(const vtkPatchScene& scene, std::vector<vtkPatchTree::Node>& nodes)
{
  std::vector<Box> normals(nodes.size());
  // Children come after their parents.
  for (std::size_t index = nodes.size(); index-- > 0;)
  {
    vtkPatchTree::Node& node = nodes[index];
    if (node.IsLeaf())
    {
      FillLeaf(scene, node, normals[index]);
    }
    else
    {
      Join(nodes[node.Left], nodes[node.Left + 1], node);
      normals[index] = normals[node.Left];
      Extend(normals[index], normals[node.Left + 1].first);
      Extend(normals[index], normals[node.Left + 1].second);
    }
    FillCone(scene, normals[index], node);
  }
}
} // namespace

//------------------------------------------------------------------------------
std::vector<vtkIdType> vtkPatchTree::Sort(const std::vector<Vector>& centroids)
{
  std::vector<vtkIdType> order(centroids.size());
  std::iota(order.begin(), order.end(), 0);
  SortRange(centroids, order, 0, static_cast<vtkIdType>(order.size()));
  return order;
}

//------------------------------------------------------------------------------
void vtkPatchTree::Build(const vtkPatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->Nodes.assign(1, Node());
  this->Nodes[0].Last = patches;
  this->Blocks.assign((patches + BlockSize - 1) / BlockSize, 0);
  for (std::size_t index = 0; index < this->Nodes.size(); ++index)
  {
    const vtkIdType first = this->Nodes[index].First;
    const vtkIdType last = this->Nodes[index].Last;
    const int parent = this->Nodes[index].Parent;
    if (last - first <= BlockSize && (parent < 0 || this->Nodes[parent].GetSize() > BlockSize))
    {
      this->Blocks[first / BlockSize] = static_cast<int>(index);
    }
    if (last - first > LeafSize)
    {
      this->Nodes[index].Left = static_cast<int>(this->Nodes.size());
      Node child;
      child.Parent = static_cast<int>(index);
      child.First = first;
      child.Last = GetCut(first, last);
      this->Nodes.push_back(child);
      child.First = child.Last;
      child.Last = last;
      this->Nodes.push_back(child);
    }
  }
  FillNodes(scene, this->Nodes);
}
