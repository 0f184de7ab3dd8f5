// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/PairHull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
// A plane through an edge and a corner nearer to its line than this part of the edge is none.
constexpr double Degenerate = 1e-9;
} // namespace

//------------------------------------------------------------------------------
void PairHull::Set(const Polygon& a, const Polygon& b, double rounding)
{
  this->Rounding = rounding;
  this->Sides.clear();
  this->AddSides(a, b);
  this->AddSides(b, a);
}

//------------------------------------------------------------------------------
// Around an edge all corners of the other polygon are within half a turn, since they are in front:
// the last of them, seen from the inside of the polygon, has all others on its inner side.
void PairHull::AddSides(const Polygon& edges, const Polygon& corners)
{
  for (int k = 0; k < edges.Count; ++k)
  {
    const Vector& begin = edges.Corners[k];
    const Vector edge = edges.Corners[(k + 1) % edges.Count] - begin;
    const double least = Degenerate * edge.squaredNorm();
    Vector outwards = Vector::Zero();
    for (int corner = 0; corner < corners.Count; ++corner)
    {
      const Vector offset = corners.Corners[corner] - begin;
      const Vector across = edge.cross(offset);
      if ((outwards.isZero() || outwards.dot(offset) > this->Rounding) && across.norm() > least)
      {
        outwards = across.normalized();
      }
    }
    const Side side = { outwards, outwards.dot(begin) };
    if (!outwards.isZero() && this->HasInside(side, edges) && this->HasInside(side, corners))
    {
      this->Sides.push_back(side);
    }
  }
}

//------------------------------------------------------------------------------
bool PairHull::HasInside(const Side& side, const Polygon& polygon) const
{
  return std::all_of(polygon.Corners.begin(), polygon.Corners.begin() + polygon.Count,
    [&](const Vector& corner) { return side.Normal.dot(corner) <= side.Offset + this->Rounding; });
}
} // namespace LightTransport
