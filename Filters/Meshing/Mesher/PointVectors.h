// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Points as Eigen's vectors.
#ifndef PointVectors_h
#define PointVectors_h

#include "Mesher/SourceSurface.h"

#include <Eigen/Core>

namespace LightTransport
{
//------------------------------------------------------------------------------
inline Eigen::Vector3d ToVector(const SourceSurface::Point& point)
{
  return Eigen::Vector3d(point[0], point[1], point[2]);
}
} // namespace LightTransport

#endif
