// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/UnoccludedPairs.h"

#include "Scene/PatchTree.h"
#include "ViewFactors/BlockFiller.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
//------------------------------------------------------------------------------
UnoccludedPairs::UnoccludedPairs(const PatchScene& scene, double tolerance)
  : Scene(scene), Views(scene), Rules(scene), Pairs(scene, this->Rules, tolerance)
{
}

//------------------------------------------------------------------------------
bool UnoccludedPairs::MayFace(int nodeI, int nodeJ) const
{
  return this->Views.Get(nodeI, nodeJ).MayFace();
}

//------------------------------------------------------------------------------
double UnoccludedPairs::GetKernelBound(int nodeI, int nodeJ) const
{
  const NodeViews::View view = this->Views.Get(nodeI, nodeJ);
  if (!view.MayFace())
  {
    return 0.0;
  }
  const PatchTree::Node& a = this->Scene.GetTree().GetNode(nodeI);
  const PatchTree::Node& b = this->Scene.GetTree().GetNode(nodeJ);
  const PatchScene::Vector gap = (a.Lower - b.Upper).cwiseMax(b.Lower - a.Upper).cwiseMax(0.0);
  const double squared = gap.squaredNorm();
  const double distance = std::sqrt(squared);
  const double cosines = std::min(view.HighestOfI, distance) * std::min(view.HighestOfJ, distance);
  return squared > 0.0 ? cosines / (vtkMath::Pi() * squared * squared)
                       : std::numeric_limits<double>::infinity();
}

//------------------------------------------------------------------------------
void UnoccludedPairs::Fill(int nodeI, int nodeJ, float* values, vtkIdType stride, double* errorsI,
  double* errorsJ, Counters& counters) const
{
  const PatchTree& tree = this->Scene.GetTree();
  BlockFiller filler(this->Scene, this->Views, this->Rules, this->Pairs,
    { tree.GetNode(nodeI).First, tree.GetNode(nodeJ).First, values, stride, errorsI, errorsJ,
      counters });
  filler.Fill(nodeI, nodeJ);
}

//------------------------------------------------------------------------------
PairIntegrals::Estimate UnoccludedPairs::Compute(vtkIdType i, vtkIdType j) const
{
  // In one order, so that exchanging the two changes not even the rounding.
  const vtkIdType first = std::min(i, j);
  const vtkIdType second = std::max(i, j);
  return this->Pairs.Follow(first, second, this->Pairs.MakePlan(first, second));
}
} // namespace LightTransport
