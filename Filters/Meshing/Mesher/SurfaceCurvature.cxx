// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SurfaceCurvature.h"

#include "Mesher/PointVectors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// Curvature around a point within a part: the sum over edges, and the area it belongs to.
struct CurvatureSum
{
  Eigen::Matrix3d Tensor = Eigen::Matrix3d::Zero();
  double Area = 0.0;
};
} // namespace

//------------------------------------------------------------------------------
std::vector<double> SurfaceCurvature::Find(const SourceSurface& surface)
{
  std::map<std::pair<std::size_t, std::size_t>, CurvatureSum> sums;
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    const Eigen::Vector3d normal = ToVector(surface.GetNormal(i)).normalized();
    for (int j = 0; j < 3; ++j)
    {
      const std::size_t from = surface.Triangles[i][j];
      const std::size_t to = surface.Triangles[i][(j + 1) % 3];
      // A third of the area around a point is its own.
      sums[{ from, surface.Parts[i] }].Area += surface.GetArea(i) / 3.0;
      const std::size_t neighbour = surface.Neighbours[i][j];
      if (neighbour == SourceSurface::None || neighbour < i)
      {
        continue;
      }
      const Eigen::Vector3d other = ToVector(surface.GetNormal(neighbour)).normalized();
      const Eigen::Vector3d edge = ToVector(surface.Points[to]) - ToVector(surface.Points[from]);
      const double length = edge.norm();
      const Eigen::Vector3d along = edge / length;
      const double angle = std::atan2(normal.cross(other).dot(along), normal.dot(other));
      // Half of the edge belongs to each of its ends.
      const Eigen::Matrix3d tensor = 0.5 * angle * length * along * along.transpose();
      sums[{ from, surface.Parts[i] }].Tensor += tensor;
      sums[{ to, surface.Parts[i] }].Tensor += tensor;
    }
  }
  std::vector<double> curvatures(surface.Points.size(), 0.0);
  for (const auto& sum : sums)
  {
    const Eigen::Matrix3d tensor = sum.second.Tensor / sum.second.Area;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor, Eigen::EigenvaluesOnly);
    const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
    curvatures[sum.first.first] = std::max(curvatures[sum.first.first], largest);
  }
  return curvatures;
}
} // namespace LightTransport
