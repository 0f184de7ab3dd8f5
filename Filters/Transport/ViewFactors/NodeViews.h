// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How two nodes of a scene's tree are seen from each other: what holds for all pairs of their
/// patches, from boxes, cones of normals and the slabs across the cones' axes.
#ifndef NodeViews_h
#define NodeViews_h

#include "Scene/PatchScene.h"

#include <vector>

namespace LightTransport
{
class NodeViews
{
public:
  struct View
  {
    double Nearest = 0.0;  ///< between centroids, at least
    double Furthest = 0.0; ///< between centroids, at most
    ///@{ Heights of the points of one over the planes of the other, at most and at least.
    double HighestOfI = 0.0;
    double LowestOfI = 0.0;
    double HighestOfJ = 0.0;
    double LowestOfJ = 0.0;
    ///@}
    ///@{ Heights below these are none to any patch.
    double RoundingOfI = 0.0;
    double RoundingOfJ = 0.0;
    ///@}
    double Sine = 1.0; ///< of the angle between planes, at most

    bool MayFace() const
    {
      return this->HighestOfI > this->RoundingOfI && this->HighestOfJ > this->RoundingOfJ;
    }
    bool NoHorizonCrosses() const
    {
      return this->LowestOfI >= -this->RoundingOfI && this->LowestOfJ >= -this->RoundingOfJ;
    }
  };

  explicit NodeViews(const PatchScene& scene);

  View Get(int nodeI, int nodeJ) const;

private:
  /// What PatchTree::Node does not know: how far normals leave the axis of the cone (whose cosine
  /// cannot tell 1e-9 from 0), and the slab across the axis that holds all corners.
  struct Slab
  {
    double Chord = 0.0;
    double Sine = 0.0;
    double Low = 0.0;
    double High = 0.0;
    ///@{ The least tolerance of a plane (PatchPlane).
    double Rounding = 0.0;
    double Slope = 0.0;
    ///@}
  };
  struct Heights
  {
    double Lowest;
    double Highest;
  };

  Slab MakeSlab(const PatchTree::Node& node) const;
  Heights GetHeights(int over, int of, double extent) const;

  const PatchScene& Scene;
  std::vector<Slab> Slabs;
};
} // namespace LightTransport

#endif
