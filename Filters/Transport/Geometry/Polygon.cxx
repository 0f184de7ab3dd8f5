// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/Polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
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
