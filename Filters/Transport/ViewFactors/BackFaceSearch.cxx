// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/BackFaceSearch.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
BackFaceSearch::BackFaceSearch(const PatchScene& scene)
  : Tree(scene.GetTree()), Views(scene), MaySee(scene.GetNumberOfPatches(), false)
{
  this->Visit(0, 0);
}

//------------------------------------------------------------------------------
bool BackFaceSearch::IsSettled(int watcher) const
{
  const PatchTree::Node& node = this->Tree.GetNode(watcher);
  return std::all_of(this->MaySee.begin() + node.First, this->MaySee.begin() + node.Last,
    [](bool maySee) { return maySee; });
}

//------------------------------------------------------------------------------
// Down the larger of the two nodes first. Patches of a leaf are told alike.
void BackFaceSearch::Visit(int watcher, int other)
{
  const NodeViews::View view = this->Views.Get(watcher, other);
  const bool may = view.HighestOfJ > view.RoundingOfJ && view.LowestOfI < -view.RoundingOfI;
  if (!may || this->IsSettled(watcher))
  {
    return;
  }
  const PatchTree::Node& i = this->Tree.GetNode(watcher);
  const PatchTree::Node& j = this->Tree.GetNode(other);
  if (i.IsLeaf() && j.IsLeaf())
  {
    std::fill(this->MaySee.begin() + i.First, this->MaySee.begin() + i.Last, true);
  }
  else if (j.IsLeaf() || (!i.IsLeaf() && i.GetSize() >= j.GetSize()))
  {
    this->Visit(i.Left, other);
    this->Visit(i.Left + 1, other);
  }
  else
  {
    this->Visit(watcher, j.Left);
    this->Visit(watcher, j.Left + 1);
  }
}
} // namespace LightTransport
