// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which corners of patches share a value at a point: at each point of a scene, patches that meet
 * there with normals closer than a feature angle and equal materials form one group. Groups are
 * formed on the whole scene, over all blocks and ranks, so a point on a border has the serial
 * value.
 */
#ifndef SmoothPoints_h
#define SmoothPoints_h

#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class PatchScene;

class SmoothPoints
{
public:
  /// `featureAngle` in degrees; `materials` has materialComponents values per patch, or none.
  SmoothPoints(const PatchScene& scene, double featureAngle,
    const std::vector<double>& materials = {}, int materialComponents = 0);

  /// The group of a corner, counted over all patches (PatchGeometry::GetOffsets).
  vtkIdType GetGroup(vtkIdType corner) const { return this->Groups[corner]; }

  /// The area-weighted means of the patches' values over each group: means[group * components +
  /// component].
  std::vector<double> GetMeans(const std::vector<double>& values, int components) const;

private:
  const PatchScene& Scene;
  std::vector<vtkIdType> Groups; ///< of each corner
  vtkIdType NumberOfGroups = 0;
};
} // namespace LightTransport

#endif
