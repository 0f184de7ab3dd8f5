// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How good the triangles of a mesh are, and how far it is from another.
#ifndef PatchQuality_h
#define PatchQuality_h

#include "MeshTestTools.h"

#include "vtkGenericCell.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <vector>

namespace meshTest
{
struct Quality
{
  double SmallestAngle = 180.0;
  double FirstPercentile = 0.0;
  double Median = 0.0;
  /// Longest side over twice the radius of the incircle times sqrt(3): 1 for equilateral triangles.
  double LargestAspectRatio = 0.0;
};

//------------------------------------------------------------------------------
inline Quality GetQuality(vtkPolyData* mesh)
{
  Quality quality;
  std::vector<double> angles;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    mesh->GetCellPoints(cell, size, ids);
    double smallest = 180.0;
    double longest = 0.0;
    double perimeter = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      Vector u;
      Vector v;
      const Vector p = meshTest::GetPoint(mesh, ids[i]);
      vtkMath::Subtract(meshTest::GetPoint(mesh, ids[(i + 1) % 3]).data(), p.data(), u.data());
      vtkMath::Subtract(meshTest::GetPoint(mesh, ids[(i + 2) % 3]).data(), p.data(), v.data());
      smallest = std::min(smallest,
        vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(u.data(), v.data())));
      longest = std::max(longest, vtkMath::Norm(u.data()));
      perimeter += vtkMath::Norm(u.data());
    }
    const double area = vtkMath::Norm(meshTest::GetAreaVector(mesh, cell).data());
    quality.LargestAspectRatio =
      std::max(quality.LargestAspectRatio, longest * perimeter / (4.0 * std::sqrt(3.0) * area));
    angles.push_back(smallest);
  }
  std::sort(angles.begin(), angles.end());
  quality.SmallestAngle = angles.front();
  quality.FirstPercentile = angles[angles.size() / 100];
  quality.Median = angles[angles.size() / 2];
  return quality;
}

//------------------------------------------------------------------------------
// The largest distance from one mesh to another, measured at points, centers of sides and of cells.
inline double GetDistance(vtkPolyData* from, vtkPolyData* to)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(to);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  double largest2 = 0.0;
  const auto measure = [&](const Vector& a, const Vector& b, const Vector& c)
  {
    Vector middle;
    Vector closest;
    for (int i = 0; i < 3; ++i)
    {
      middle[i] = (a[i] + b[i] + c[i]) / 3.0;
    }
    vtkIdType id;
    int subId;
    double distance2;
    locator->FindClosestPoint(middle.data(), closest.data(), cell, id, subId, distance2);
    largest2 = std::max(largest2, distance2);
  };
  for (vtkIdType i = 0; i < from->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    from->GetCellPoints(i, size, ids);
    const Vector a = meshTest::GetPoint(from, ids[0]);
    const Vector b = meshTest::GetPoint(from, ids[1]);
    const Vector c = meshTest::GetPoint(from, ids[2]);
    for (const Vector& corner : { a, b, c })
    {
      measure(corner, corner, corner);
    }
    measure(a, b, c);
  }
  return std::sqrt(largest2);
}
} // namespace meshTest

#endif
