// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/Polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Vector = Polygon::Vector;

//------------------------------------------------------------------------------
// Between the segments from `a` along `u` and from `b` along `v` (Ericson, Real-Time Collision
// Detection, 5.1.9).
double GetSquaredDistance(const Vector& a, const Vector& u, const Vector& b, const Vector& v)
{
  const auto clamp = [](double value) { return std::min(std::max(value, 0.0), 1.0); };
  const auto divide = [](double value, double by) { return by > 0.0 ? value / by : 0.0; };
  const Vector offset = a - b;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double along = v.dot(offset);
  const double back = u.dot(offset);
  double s = clamp(divide(uv * along - back * vv, uu * vv - uv * uv));
  double t = divide(uv * s + along, vv);
  if (t < 0.0 || t > 1.0)
  {
    t = clamp(t);
    s = clamp(divide(uv * t - back, uu));
  }
  return (offset + s * u - t * v).squaredNorm();
}

//------------------------------------------------------------------------------
// Whether a point is over the inside of a polygon, no higher than `distance`.
bool IsOver(const Polygon& polygon, const Vector& point, double distance)
{
  if (std::abs((point - polygon.Corners[0]).dot(polygon.Normal)) >= distance)
  {
    return false;
  }
  for (int corner = 0; corner < polygon.Count; ++corner)
  {
    const Vector edge = polygon.Corners[(corner + 1) % polygon.Count] - polygon.Corners[corner];
    if (edge.cross(point - polygon.Corners[corner]).dot(polygon.Normal) < 0.0)
    {
      return false;
    }
  }
  return true;
}
} // namespace

//------------------------------------------------------------------------------
void Polygon::Set(const PatchGeometry& patches, vtkIdType patch)
{
  this->Count = patches.GetNumberOfCorners(patch);
  this->Normal = patches.GetNormal(patch);
  for (int corner = 0; corner < this->Count; ++corner)
  {
    this->Corners[corner] = patches.GetCorner(patch, corner);
  }
}

//------------------------------------------------------------------------------
bool Polygon::Clip(const PatchPlane& plane)
{
  std::array<double, MaximumCorners + 2> heights;
  bool front = false;
  bool behind = false;
  for (int corner = 0; corner < this->Count; ++corner)
  {
    heights[corner] = plane.GetCertainHeight(this->Corners[corner]);
    front = front || heights[corner] > 0.0;
    behind = behind || heights[corner] < 0.0;
  }
  if (!front || !behind)
  {
    return front;
  }
  Polygon clipped;
  clipped.Normal = this->Normal;
  for (int corner = 0; corner < this->Count; ++corner)
  {
    const int next = (corner + 1) % this->Count;
    if (heights[corner] >= 0.0)
    {
      clipped.Corners[clipped.Count++] = this->Corners[corner];
    }
    if (heights[corner] * heights[next] < 0.0)
    {
      const double part = heights[corner] / (heights[corner] - heights[next]);
      clipped.Corners[clipped.Count++] =
        this->Corners[corner] + part * (this->Corners[next] - this->Corners[corner]);
    }
  }
  *this = clipped;
  return this->Count > 2;
}

//------------------------------------------------------------------------------
bool Polygon::SetToClippedPair(const PatchGeometry& patches, vtkIdType i, vtkIdType j, Polygon& a,
  Polygon& b)
{
  a.Set(patches, i);
  b.Set(patches, j);
  return b.Clip(patches.GetPlane(i)) && a.Clip(patches.GetPlane(j));
}

//------------------------------------------------------------------------------
// Where neither passes through the other the nearest points are on two edges, or one is a corner.
bool Polygon::IsCloser(const Polygon& other, double distance) const
{
  for (int i = 0; i < this->Count; ++i)
  {
    const Vector edge = this->Corners[(i + 1) % this->Count] - this->Corners[i];
    for (int j = 0; j < other.Count; ++j)
    {
      const Vector across = other.Corners[(j + 1) % other.Count] - other.Corners[j];
      if (GetSquaredDistance(this->Corners[i], edge, other.Corners[j], across) <
        distance * distance)
      {
        return true;
      }
    }
  }
  const auto isOver = [distance](const Polygon& polygon, const Polygon& corners)
  {
    return std::any_of(corners.Corners.begin(), corners.Corners.begin() + corners.Count,
      [&](const Vector& corner) { return IsOver(polygon, corner, distance); });
  };
  return isOver(*this, other) || isOver(other, *this);
}

//------------------------------------------------------------------------------
Polygon::Vector Polygon::GetMiddle() const
{
  Vector sum = Vector::Zero();
  for (int corner = 0; corner < this->Count; ++corner)
  {
    sum += this->Corners[corner];
  }
  return sum / this->Count;
}

//------------------------------------------------------------------------------
double Polygon::GetArea() const
{
  Vector twice = Vector::Zero();
  for (int corner = 1; corner + 1 < this->Count; ++corner)
  {
    twice += (this->Corners[corner] - this->Corners[0])
               .cross(this->Corners[corner + 1] - this->Corners[0]);
  }
  return 0.5 * twice.norm();
}
} // namespace LightTransport
