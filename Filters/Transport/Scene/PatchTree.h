// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A binary tree over the patches of a scene, as plain data: every node is a contiguous range of
 * patches (the scene keeps its patches in the order of this tree), with a box, a cone of normals
 * and an area.
 *
 * The spatial tree is balanced. Patches that face different ways are divided first, at most a few
 * times on any way down, so that a cluster sends and receives as one surface does; patches that
 * face the same way are cut in half along the longest axis of the box of their centroids. Ranges
 * longer than BlockSize are cut at a multiple of BlockSize, so that every block of BlockSize
 * patches (a row of tiles of an exchange matrix) is a node; shorter ones at a multiple of LeafSize.
 *
 * The tree of a surface is for clusters that receive and send diffuse light as one: a range is
 * halved by area, across the direction in which its patches differ most, by their places and a
 * little by where they face. It has no blocks of BlockSize patches either.
 *
 * The tree of an atlas follows codes, the patches' places along a space-filling curve: a node is
 * the range of all codes with one prefix, so that each block of the atlas's quadtree that holds
 * patches (down to LeafSize of them) is a node, and prefixes that divide nothing are left out. It
 * is as deep as the codes make it and has no blocks of BlockSize patches: links between clusters
 * need none, matrices do.
 */
#ifndef PatchTree_h
#define PatchTree_h

#include "vtkType.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace LightTransport
{
class PatchGeometry;

class PatchTree
{
public:
  using Vector = Eigen::Vector3d;

  /// Patches of a block: vtkExchangeMatrix::TileSize.
  static constexpr vtkIdType BlockSize = 256;
  /// Patches of a leaf, at most.
  static constexpr vtkIdType LeafSize = 4;

  struct Node
  {
    vtkIdType First = 0; ///< patches [First, Last)
    vtkIdType Last = 0;
    int Parent = -1;
    int Left = -1; ///< child, -1 at a leaf; the other child is Left + 1
    /// Box of all corners.
    Vector Lower = Vector::Zero();
    Vector Upper = Vector::Zero();
    /// Box of all centroids, and the largest radius of a patch around its centroid.
    Vector CentroidLower = Vector::Zero();
    Vector CentroidUpper = Vector::Zero();
    double Radius = 0.0;
    /// All normals n have n . ConeAxis >= ConeCosine; -1 where they point everywhere.
    Vector ConeAxis = Vector::UnitZ();
    double ConeCosine = -1.0;
    double Area = 0.0;

    bool IsLeaf() const { return this->Left < 0; }
    vtkIdType GetSize() const { return this->Last - this->First; }
  };

  ///@{
  /// Make the shape of the tree: the spatial one, that of a surface, or that of codes. Returns its
  /// order: patch k of the sorted scene is patch order[k] of the unsorted one.
  std::vector<vtkIdType> Sort(const std::vector<Vector>& centroids,
    const std::vector<Vector>& normals);
  std::vector<vtkIdType> Sort(const std::vector<Vector>& centroids,
    const std::vector<Vector>& normals, const std::vector<double>& areas);
  std::vector<vtkIdType> Sort(const std::vector<std::uint64_t>& codes);
  ///@}

  ///@{ The last patches of the left children, by which a tree of other patches, as many, gets the
  /// same shape. Regrow's has no GetBlock.
  std::vector<vtkIdType> GetCuts() const;
  void Regrow(vtkIdType patches, const std::vector<vtkIdType>& cuts);
  ///@}

  /// Place of a point of the unit square along the curve that visits the nodes of a quadtree one
  /// after another (Morton 1966): the bits of x and y in turn, AtlasBits of each. x comes first, as
  /// vtkSurfaceAtlas puts the halves of a piece beside each other and their halves on top.
  static constexpr int AtlasBits = 26;
  static std::uint64_t GetCode(double x, double y);

  /// Boxes, cones and areas, of patches that are in the order of Sort.
  void FillNodes(const PatchGeometry& patches);

  /// Node 0 is the root.
  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  const Node& GetNode(int node) const { return this->Nodes[node]; }
  /// The node of patches [BlockSize * block, BlockSize * (block + 1)); of the spatial tree only.
  int GetBlock(vtkIdType block) const { return this->Blocks[block]; }

private:
  template <typename Divide, typename Finish>
  void Grow(vtkIdType patches, const Divide& divide, const Finish& finish);

  std::vector<Node> Nodes;
  std::vector<int> Blocks;
};
} // namespace LightTransport

#endif
