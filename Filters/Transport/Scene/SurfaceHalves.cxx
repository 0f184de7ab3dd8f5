// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SurfaceHalves.h"

#include "Shared/Pulse.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace LightTransport
{
//------------------------------------------------------------------------------
SurfaceHalves::SurfaceHalves(const std::vector<Vector>& centroids,
  const std::vector<Vector>& normals, const std::vector<double>& areas,
  std::vector<vtkIdType>& order)
  : Centroids(centroids), Normals(normals), Areas(areas), Order(order), Places(order.size())
{
}

//------------------------------------------------------------------------------
SurfaceHalves::Point SurfaceHalves::GetPoint(vtkIdType patch) const
{
  Point point;
  point << this->Centroids[patch], this->Normals[patch];
  return point;
}

//------------------------------------------------------------------------------
SurfaceHalves::Point SurfaceHalves::FindAxis(vtkIdType first, vtkIdType last) const
{
  const Point origin = this->GetPoint(this->Order[first]);
  double area = 0.0;
  Point sum = Point::Zero();
  Eigen::Matrix<double, 6, 6> products = Eigen::Matrix<double, 6, 6>::Zero();
  for (vtkIdType k = first; k < last; ++k)
  {
    Pulse::Beat(k);
    const vtkIdType patch = this->Order[k];
    const Point point = this->GetPoint(patch) - origin;
    area += this->Areas[patch];
    sum += this->Areas[patch] * point;
    products += this->Areas[patch] * point * point.transpose();
  }
  products -= sum * sum.transpose() / area;
  const double radius = std::sqrt(products.topLeftCorner<3, 3>().trace() / area);
  Point weights = Point::Ones();
  weights.tail<3>() *= NormalWeight * radius;
  products = weights.asDiagonal() * products * weights.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(products);
  return weights.cwiseProduct(solver.eigenvectors().col(5));
}

//------------------------------------------------------------------------------
vtkIdType SurfaceHalves::Divide(vtkIdType first, vtkIdType last)
{
  const Point axis = this->FindAxis(first, last);
  double total = 0.0;
  for (vtkIdType k = first; k < last; ++k)
  {
    const vtkIdType patch = this->Order[k];
    this->Places[patch] = axis.dot(this->GetPoint(patch));
    total += this->Areas[patch];
  }
  std::size_t comparisons = 0;
  std::sort(this->Order.begin() + first, this->Order.begin() + last,
    [&](vtkIdType a, vtkIdType b)
    {
      Pulse::Beat(++comparisons);
      return std::tie(this->Places[a], a) < std::tie(this->Places[b], b);
    });
  double before = 0.0;
  vtkIdType cut = first;
  while (before < 0.5 * total && cut < last)
  {
    before += this->Areas[this->Order[cut++]];
  }
  return std::min(std::max(cut, first + 1), last - 1);
}
} // namespace LightTransport
