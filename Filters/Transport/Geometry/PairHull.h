// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The convex hull of two polygons, each in front of the plane of the other, as the planes that go
 * through an edge of one and a corner of the other with both on one side: what is beyond one of
 * them is certainly not between the two polygons, where a shaft of few directions (ShaftCuller) is
 * wider.
 */
#ifndef PairHull_h
#define PairHull_h

#include "Geometry/Polygon.h"

#include <vector>

namespace LightTransport
{
class PairHull
{
public:
  using Vector = Polygon::Vector;

  /// Heights over a plane below `rounding` are none.
  void Set(const Polygon& a, const Polygon& b, double rounding);

  /// Whether `count` points, which getCorner gives, are beyond one of the planes or on it.
  template <typename GetCorner>
  bool IsBeyond(int count, const GetCorner& getCorner) const
  {
    for (const Side& side : this->Sides)
    {
      bool isBeyond = true;
      for (int corner = 0; corner < count && isBeyond; ++corner)
      {
        isBeyond = side.Normal.dot(getCorner(corner)) >= side.Offset - this->Rounding;
      }
      if (isBeyond)
      {
        return true;
      }
    }
    return false;
  }

private:
  struct Side
  {
    Vector Normal; ///< outwards
    double Offset;
  };

  void AddSides(const Polygon& edges, const Polygon& corners);
  bool HasInside(const Side& side, const Polygon& polygon) const;

  double Rounding = 0.0;
  std::vector<Side> Sides;
};
} // namespace LightTransport

#endif
