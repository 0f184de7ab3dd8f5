// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasMetrics.h"

#include "Common/Heartbeat.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace LightTransport
{
namespace
{
struct Triangle
{
  double Area;
  double TextureArea;
  /// Squares of the mean and of the largest growth of lengths.
  double MeanSquare;
  double LargestSquare;
};

//------------------------------------------------------------------------------
Triangle Measure(vtkPolyData* surface, vtkDataArray* coordinates, const vtkIdType ids[3])
{
  Eigen::Vector3d points[3];
  Eigen::Vector2d texels[3];
  for (int i = 0; i < 3; ++i)
  {
    surface->GetPoint(ids[i], points[i].data());
    coordinates->GetTuple(ids[i], texels[i].data());
  }
  Eigen::Matrix<double, 3, 2> sides;
  sides << points[1] - points[0], points[2] - points[0];
  Eigen::Matrix2d texelSides;
  texelSides << texels[1] - texels[0], texels[2] - texels[0];
  const Eigen::Matrix<double, 3, 2> growth = sides * texelSides.inverse();
  const double a = growth.col(0).squaredNorm();
  const double b = growth.col(0).dot(growth.col(1));
  const double c = growth.col(1).squaredNorm();
  return { 0.5 * sides.col(0).cross(sides.col(1)).norm(), 0.5 * std::abs(texelSides.determinant()),
    0.5 * (a + c), 0.5 * (a + c + std::hypot(a - c, 2.0 * b)) };
}
} // namespace

//------------------------------------------------------------------------------
AtlasMetrics::AtlasMetrics(vtkPolyData* surface, vtkDataArray* textureCoordinates,
  const Monitor& monitor)
{
  Heartbeat heart(monitor);
  std::vector<Triangle> triangles;
  double area = 0.0;
  auto cells = vtk::TakeSmartPointer(surface->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    heart.Beat();
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(size, ids);
    triangles.push_back(Measure(surface, textureCoordinates, ids));
    area += triangles.back().Area;
    this->TexelUse += triangles.back().TextureArea;
  }
  const double evenSquare = area / this->TexelUse;
  for (const Triangle& triangle : triangles)
  {
    const double share = triangle.Area / area;
    this->L2Stretch += share * triangle.MeanSquare / evenSquare;
    this->LInfinityStretch =
      std::max(this->LInfinityStretch, std::sqrt(triangle.LargestSquare / evenSquare));
    const double density = triangle.TextureArea * evenSquare / triangle.Area;
    this->AreaDistortion += share * std::max(density, 1.0 / density);
  }
  this->L2Stretch = std::sqrt(this->L2Stretch);
}
} // namespace LightTransport
