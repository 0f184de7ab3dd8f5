// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/NodeViews.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Node = PatchTree::Node;
using Vector = PatchScene::Vector;

} // namespace

//------------------------------------------------------------------------------
NodeViews::NodeViews(const PatchScene& scene) : Scene(scene)
{
  for (const Node& node : scene.GetTree().GetNodes())
  {
    this->Slabs.push_back(this->MakeSlab(node));
  }
}

//------------------------------------------------------------------------------
NodeViews::Slab NodeViews::MakeSlab(const Node& node) const
{
  Slab slab;
  slab.Low = node.ConeAxis.dot(this->Scene.GetCorner(node.First, 0));
  slab.High = slab.Low;
  slab.Rounding = this->Scene.GetPlane(node.First).Rounding;
  slab.Slope = this->Scene.GetPlane(node.First).SlopeAlong;
  for (vtkIdType patch = node.First; patch < node.Last; ++patch)
  {
    const PatchPlane plane = this->Scene.GetPlane(patch);
    slab.Rounding = std::min(slab.Rounding, plane.Rounding);
    slab.Slope = std::min(slab.Slope, plane.SlopeAlong);
    slab.Chord = std::max(slab.Chord, (this->Scene.GetNormal(patch) - node.ConeAxis).norm());
    for (int corner = 0; corner < this->Scene.GetNumberOfCorners(patch); ++corner)
    {
      const double height = node.ConeAxis.dot(this->Scene.GetCorner(patch, corner));
      slab.Low = std::min(slab.Low, height);
      slab.High = std::max(slab.High, height);
    }
  }
  const double half = 0.25 * slab.Chord * slab.Chord;
  slab.Sine = half < 0.5 ? slab.Chord * std::sqrt(1.0 - half) : 1.0;
  return slab;
}

//------------------------------------------------------------------------------
// Heights of the points of one node over the planes of the other's patches, by the axis of the
// other's cone. Points of a plane parallel to it are known better by their slab than by their box.
NodeViews::Heights NodeViews::GetHeights(int over, int of, double extent) const
{
  const Node& nodeOver = this->Scene.GetTree().GetNode(over);
  const Node& nodeOf = this->Scene.GetTree().GetNode(of);
  const Slab& slabOver = this->Slabs[over];
  const Slab& slabOf = this->Slabs[of];
  const Vector& axis = nodeOver.ConeAxis;
  const double center = axis.dot(nodeOf.Lower + nodeOf.Upper) / 2.0;
  const double half = axis.cwiseAbs().dot(nodeOf.Upper - nodeOf.Lower) / 2.0;
  double low = center - half;
  double high = center + half;
  const bool same = axis.dot(nodeOf.ConeAxis) > 0.0;
  const Vector difference = same ? Vector(axis - nodeOf.ConeAxis) : Vector(axis + nodeOf.ConeAxis);
  // Scene coordinates are below 1.
  const double tilt = difference.norm();
  low = std::max(low, (same ? slabOf.Low : -slabOf.High) - tilt);
  high = std::min(high, (same ? slabOf.High : -slabOf.Low) + tilt);
  const double spread = slabOver.Chord * extent;
  return { low - slabOver.High - spread, high - slabOver.Low + slabOver.Sine * extent };
}

//------------------------------------------------------------------------------
NodeViews::View NodeViews::Get(int nodeI, int nodeJ) const
{
  const Node& a = this->Scene.GetTree().GetNode(nodeI);
  const Node& b = this->Scene.GetTree().GetNode(nodeJ);
  View view;
  const Vector gap =
    (a.CentroidLower - b.CentroidUpper).cwiseMax(b.CentroidLower - a.CentroidUpper);
  view.Nearest = gap.cwiseMax(0.0).norm();
  view.Furthest =
    (a.CentroidUpper - b.CentroidLower).cwiseMax(b.CentroidUpper - a.CentroidLower).norm();
  const double extent = (a.Upper - b.Lower).cwiseMax(b.Upper - a.Lower).norm();
  const Heights ofI = this->GetHeights(nodeJ, nodeI, extent);
  const Heights ofJ = this->GetHeights(nodeI, nodeJ, extent);
  view.HighestOfI = ofI.Highest;
  view.LowestOfI = ofI.Lowest;
  view.HighestOfJ = ofJ.Highest;
  view.LowestOfJ = ofJ.Lowest;
  view.RoundingOfI = this->Slabs[nodeJ].Rounding + this->Slabs[nodeJ].Slope * view.Nearest;
  view.RoundingOfJ = this->Slabs[nodeI].Rounding + this->Slabs[nodeI].Slope * view.Nearest;
  view.Sine = std::min(1.0,
    a.ConeAxis.cross(b.ConeAxis).norm() + this->Slabs[nodeI].Chord + this->Slabs[nodeJ].Chord);
  return view;
}
} // namespace LightTransport
