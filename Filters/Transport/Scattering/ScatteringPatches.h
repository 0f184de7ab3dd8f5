// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The patches of a scene in millimetres, as triangles that profiles are integrated over.
#ifndef ScatteringPatches_h
#define ScatteringPatches_h

#include "Scattering/ScatteringIntegrals.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
class PatchScene;

class ScatteringPatches
{
public:
  using Vector = Eigen::Vector3d;

  /// `scale` is the scene's unit of length in millimetres.
  ScatteringPatches(const PatchScene& scene, double scale);

  ///@{
  /// Add the integral over two patches, or twice the same one. An error of `tolerance` times the
  /// areas of two triangles is allowed for each pair of them.
  void AddPair(const ScatteringIntegrals& integrals, vtkIdType i, vtkIdType j, double tolerance,
    ScatteringIntegrals::Result& result) const;
  void AddSelf(const ScatteringIntegrals& integrals, vtkIdType i, double tolerance,
    ScatteringIntegrals::Result& result) const;
  ///@}

  /// What a pair at a distance may be wrong by over the areas of both: so much anyway, and where
  /// they are neighbours (closer than twice the sum of their radii) so much more of the smaller
  /// area.
  double GetTolerance(vtkIdType i, vtkIdType j, double distance, double perArea,
    double perNeighbour) const;

  /// Mean squared distance of a patch's points from its centroid.
  double GetMoment(vtkIdType patch) const;

  std::vector<Vector> Centroids;
  std::vector<double> Radii; ///< of spheres around the centroids that hold the patches
  std::vector<double> Areas;
  double TotalArea = 0.0;

private:
  using Triangle = ScatteringIntegrals::Triangle;

  std::vector<Triangle> Triangles;
  std::vector<vtkIdType> Offsets;
};
} // namespace LightTransport

#endif
