// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SoupLocator.h"

#include "Shared/OutputMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// Weights of the corners for a point in (or, by rounding, next to) a triangle.
TriangleSoup::Point GetWeights(const TriangleSoup& soup, const TriangleSoup::Triangle& triangle,
  const TriangleSoup::Point& point)
{
  const TriangleSoup::Point normal = soup.GetNormal(triangle);
  const double scale = vtkMath::Dot(normal.data(), normal.data());
  TriangleSoup::Point weights;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    TriangleSoup::Point u;
    TriangleSoup::Point v;
    TriangleSoup::Point cross;
    vtkMath::Subtract(soup.Points[triangle[(i + 1) % 3]].data(), point.data(), u.data());
    vtkMath::Subtract(soup.Points[triangle[(i + 2) % 3]].data(), point.data(), v.data());
    vtkMath::Cross(u.data(), v.data(), cross.data());
    weights[i] = std::max(vtkMath::Dot(cross.data(), normal.data()) / scale, 0.0);
    sum += weights[i];
  }
  if (!(sum > 0.0) || !std::isfinite(sum))
  {
    return { 1.0, 0.0, 0.0 };
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}
} // namespace

//------------------------------------------------------------------------------
SoupLocator::SoupLocator(const TriangleSoup& soup) : Soup(soup)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  const auto size = static_cast<vtkIdType>(soup.Triangles.size());
  ZeroedArray::Fill(points->GetData(), 3 * size);
  OutputMemory::Allocate(size, 3 * size, cells);
  vtkIdType next = 0;
  for (const TriangleSoup::Triangle& triangle : soup.Triangles)
  {
    vtkIdType ids[3];
    for (int i = 0; i < 3; ++i)
    {
      ids[i] = next++;
      points->SetPoint(ids[i], soup.Points[triangle[i]].data());
    }
    cells->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  this->Locator->SetDataSet(surface);
  this->Locator->BuildLocator();
}

//------------------------------------------------------------------------------
SoupLocator::Place SoupLocator::Find(const TriangleSoup::Point& position, double reach)
{
  TriangleSoup::Point from = position;
  TriangleSoup::Point closest = position;
  vtkIdType cell = 0;
  int subId;
  double distance2;
  // The locator's own search without a radius looks at the bins of the whole surface.
  const double growth = 4.0;
  while (!this->Locator->FindClosestPointWithinRadius(from.data(), reach, closest.data(),
           this->Cell, cell, subId, distance2) &&
    std::isfinite(reach))
  {
    reach *= growth;
  }
  const std::size_t triangle = static_cast<std::size_t>(cell);
  return { triangle, GetWeights(this->Soup, this->Soup.Triangles[triangle], closest) };
}
} // namespace LightTransport
