// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which corners of faces share a value at a point: at each point of a scene, faces that meet there
 * with normals closer than a feature angle and equal materials form one group; fronts and backs are
 * never in one. Groups are formed on the whole scene, over all blocks and ranks, so a point on a
 * border has the serial value. Faces without patches are in no group.
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

  /// The group of a corner of a polygon on one of its sides; -1 where that face has no patches.
  vtkIdType GetGroup(vtkIdType polygon, int side, vtkIdType corner) const;

  /// Which patches have which part in the mean of each group (GetMeans): those of group g are
  /// [starts[g], starts[g + 1]).
  void GetMembers(std::vector<vtkIdType>& starts, std::vector<vtkIdType>& patches,
    std::vector<double>& parts) const;

  /// The area-weighted means of the faces' values over each group: means[group * components +
  /// component].
  std::vector<double> GetMeans(const std::vector<double>& values, int components) const;

private:
  const PatchScene& Scene;
  std::vector<vtkIdType> Groups; ///< of each corner of each face
  vtkIdType NumberOfGroups = 0;
};
} // namespace LightTransport

#endif
