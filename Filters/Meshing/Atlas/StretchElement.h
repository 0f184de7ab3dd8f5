// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A triangle's part of the squared stretch, 1/2 area (1/s^2 + 1/t^2) with the singular values s >=
 * t of the map from the surface to the square, and its derivatives by the corners' coordinates. The
 * Hessian lacks its one negative eigenvalue, that of the mode which is a rotation for s = t (Smith,
 * de Goes and Kim, "Analytic Eigensystems for Isotropic Distortion Energies", 2019).
 */
#ifndef StretchElement_h
#define StretchElement_h

#include "Atlas/StepSolver.h"

#include <Eigen/Geometry>

#include <cmath>

namespace LightTransport
{
class StretchElement
{
public:
  using Hessian = StepSolver<6>::Hessian;
  using Gradient = StepSolver<6>::Gradient;

  StretchElement(const Eigen::Matrix<double, 2, 3>& shapeGradients,
    const Eigen::Matrix<double, 2, 3>& uv, double area)
  {
    const Eigen::Matrix2d map = uv * shapeGradients.transpose();
    const double e = 0.5 * (map(0, 0) + map(1, 1));
    const double f = 0.5 * (map(0, 0) - map(1, 1));
    const double g = 0.5 * (map(1, 0) + map(0, 1));
    const double h = 0.5 * (map(1, 0) - map(0, 1));
    const double turn = std::atan2(h, e);
    const double lean = std::atan2(g, f);
    const double s = std::hypot(e, h) + std::hypot(f, g);
    const double t = map.determinant() / s;

    const Eigen::Matrix2d left = Eigen::Rotation2Dd(0.5 * (turn + lean)).toRotationMatrix();
    const Eigen::Matrix<double, 2, 3> right =
      Eigen::Rotation2Dd(0.5 * (turn - lean)).toRotationMatrix() * shapeGradients;
    const Gradient major = GetMode(left, Eigen::Vector2d(1.0, 0.0).asDiagonal() * right);
    const Gradient minor = GetMode(left, Eigen::Vector2d(0.0, 1.0).asDiagonal() * right);
    const Gradient shear = GetMode(left, right.colwise().reverse());
    this->Slope = -area * (major / (s * s * s) + minor / (t * t * t));
    this->Curvature = (3.0 * area / (s * s * s * s)) * major * major.transpose() +
      (3.0 * area / (t * t * t * t)) * minor * minor.transpose() +
      (0.5 * area * (s * s + s * t + t * t) / (s * t * s * t * s * t)) * shear * shear.transpose();
  }

  Hessian Curvature;
  Gradient Slope;

private:
  static Gradient GetMode(const Eigen::Matrix2d& left, const Eigen::Matrix<double, 2, 3>& right)
  {
    const Eigen::Matrix<double, 2, 3> mode = left * right;
    return Eigen::Map<const Gradient>(mode.data());
  }
};
} // namespace LightTransport

#endif
