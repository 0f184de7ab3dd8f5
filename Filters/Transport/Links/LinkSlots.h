// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The slots of a vtkExchangeHierarchy over a scene, both ends of every link: the nodes of the
/// scene's tree, followed by the patches.
#ifndef LinkSlots_h
#define LinkSlots_h

#include "Scene/PatchScene.h"
#include "vtkExchangeHierarchy.h"

#include <algorithm>
#include <vector>

namespace LightTransport
{
class LinkSlots
{
public:
  using Node = vtkExchangeHierarchy::Node;

  /// The scene must outlive this.
  explicit LinkSlots(const PatchScene& scene)
    : Scene(scene), NumberOfNodes(static_cast<int>(scene.GetTree().GetNodes().size())),
      Leaves(scene.GetNumberOfPatches())
  {
    for (int index = 0; index < this->NumberOfNodes; ++index)
    {
      const PatchTree::Node& node = scene.GetTree().GetNode(index);
      if (node.IsLeaf())
      {
        std::fill(this->Leaves.begin() + node.First, this->Leaves.begin() + node.Last, index);
      }
    }
  }

  int GetNumberOfNodes() const { return this->NumberOfNodes; }
  int GetNumberOfSlots() const
  {
    return this->NumberOfNodes + static_cast<int>(this->Leaves.size());
  }

  bool IsPatch(int slot) const { return slot >= this->NumberOfNodes; }
  vtkIdType GetPatch(int slot) const { return slot - this->NumberOfNodes; }
  /// The node itself, or the leaf of a patch.
  int GetNode(int slot) const
  {
    return this->IsPatch(slot) ? this->Leaves[this->GetPatch(slot)] : slot;
  }
  double GetArea(int slot) const
  {
    return this->IsPatch(slot) ? this->Scene.GetAreas()[this->GetPatch(slot)]
                               : this->Scene.GetTree().GetNode(slot).Area;
  }
  /// The root is its own.
  int GetParent(int slot) const
  {
    return this->IsPatch(slot) ? this->Leaves[this->GetPatch(slot)]
                               : std::max(this->Scene.GetTree().GetNode(slot).Parent, 0);
  }
  /// The slots right below a node.
  Node GetChildren(int slot) const
  {
    const PatchTree::Node& node = this->Scene.GetTree().GetNode(slot);
    if (node.IsLeaf())
    {
      return { this->NumberOfNodes + static_cast<int>(node.First),
        this->NumberOfNodes + static_cast<int>(node.Last) };
    }
    return { node.Left, node.Left + 2 };
  }

  /// Of all nodes: the tree in the form of vtkExchangeHierarchy.
  std::vector<Node> GetNodes() const
  {
    std::vector<Node> nodes;
    nodes.reserve(this->NumberOfNodes);
    for (int node = 0; node < this->NumberOfNodes; ++node)
    {
      nodes.push_back(this->GetChildren(node));
    }
    return nodes;
  }

private:
  const PatchScene& Scene;
  int NumberOfNodes;
  std::vector<int> Leaves; ///< of each patch
};
} // namespace LightTransport

#endif
