// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringPatches.h"

#include "Scene/PatchScene.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
constexpr double NeighbourReach = 2.0;
} // namespace

//------------------------------------------------------------------------------
ScatteringPatches::ScatteringPatches(const PatchScene& scene, double scale)
{
  const vtkIdType count = scene.GetNumberOfPatches();
  this->Offsets.reserve(count + 1);
  this->Offsets.push_back(0);
  for (vtkIdType patch = 0; patch < count; ++patch)
  {
    const auto corner = [&](int k) { return scale * scene.GetCorner(patch, k); };
    for (int k = 2; k < scene.GetNumberOfCorners(patch); ++k)
    {
      const Triangle triangle(corner(0), corner(k - 1), corner(k));
      // A corner in the middle of an edge leaves one without an area.
      if (triangle.Area > 0.0)
      {
        this->Triangles.push_back(triangle);
      }
    }
    this->Offsets.push_back(static_cast<vtkIdType>(this->Triangles.size()));
    this->Centroids.emplace_back(scale * scene.GetCentroid(patch));
    this->Radii.push_back(scale * scene.GetRadius(patch));
    this->Areas.push_back(scale * scale * scene.GetAreas()[patch]);
    this->TotalArea += this->Areas.back();
  }
}

//------------------------------------------------------------------------------
void ScatteringPatches::AddPair(const ScatteringIntegrals& integrals, vtkIdType i, vtkIdType j,
  double tolerance, ScatteringIntegrals::Result& result) const
{
  for (vtkIdType p = this->Offsets[i]; p < this->Offsets[i + 1]; ++p)
  {
    const Triangle& a = this->Triangles[p];
    for (vtkIdType q = this->Offsets[j]; q < this->Offsets[j + 1]; ++q)
    {
      const Triangle& b = this->Triangles[q];
      integrals.AddPair(a, b, tolerance * a.Area * b.Area, result);
    }
  }
}

//------------------------------------------------------------------------------
void ScatteringPatches::AddSelf(const ScatteringIntegrals& integrals, vtkIdType i, double tolerance,
  ScatteringIntegrals::Result& result) const
{
  ScatteringIntegrals::Result pairs;
  for (vtkIdType p = this->Offsets[i]; p < this->Offsets[i + 1]; ++p)
  {
    const Triangle& a = this->Triangles[p];
    integrals.AddSelf(a, result);
    for (vtkIdType q = this->Offsets[i]; q < p; ++q)
    {
      const Triangle& b = this->Triangles[q];
      integrals.AddPair(a, b, tolerance * a.Area * b.Area, pairs);
    }
  }
  result.Value += 2.0 * pairs.Value;
  result.Error += 2.0 * pairs.Error;
}

//------------------------------------------------------------------------------
double ScatteringPatches::GetTolerance(vtkIdType i, vtkIdType j, double distance, double perArea,
  double perNeighbour) const
{
  const double areas = this->Areas[i] * this->Areas[j];
  double tolerance = perArea * areas;
  if (distance < NeighbourReach * (this->Radii[i] + this->Radii[j]))
  {
    tolerance += perNeighbour * std::min(this->Areas[i], this->Areas[j]);
  }
  return tolerance / areas;
}

//------------------------------------------------------------------------------
double ScatteringPatches::GetMoment(vtkIdType patch) const
{
  double sum = 0.0;
  for (vtkIdType k = this->Offsets[patch]; k < this->Offsets[patch + 1]; ++k)
  {
    const Triangle& triangle = this->Triangles[k];
    sum += triangle.Area *
      (triangle.Moment + (triangle.Centroid - this->Centroids[patch]).squaredNorm());
  }
  return sum / this->Areas[patch];
}
} // namespace LightTransport
