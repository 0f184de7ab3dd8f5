// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShootingScene_h
#define ShootingScene_h

#include "Shooting/HemisphereItems.h"
#include "vtkDeviceShooter.h"

#include <array>
#include <vector>

namespace LightTransport
{
/// Patches as they are drawn and shot from: centred, with a diagonal of 1, areas as fractions of
/// the whole.
class ShootingScene
{
public:
  explicit ShootingScene(const vtkDeviceShooter::Patches& patches);

  int GetNumberOfPatches() const { return static_cast<int>(this->Areas.size()); }
  const std::vector<double>& GetAreas() const { return this->Areas; }
  int GetNumberOfTriangles(int patch) const;

  /// Puts the triangles of all patches on the device. `resolution` as in HemisphereItems.
  Outcome Upload(HemisphereItems& items, int resolution) const;

  /// Adds eye points of a patch to `eyes`: the centroids of the equal parts that dividing the edges
  /// of its triangles gives. `number` counts all eye points so far.
  void AddEyes(int patch, int divisions, vtkTypeInt64 number,
    std::vector<HemisphereItems::Eye>& eyes) const;

private:
  using Vector = std::array<double, 3>;

  void SetPoints(const std::vector<double>& coordinates);
  std::vector<double> GetTriangleShares(int patch) const;

  std::vector<Vector> Points;
  std::vector<vtkIdType> Offsets;
  std::vector<vtkIdType> Corners;
  std::vector<double> Normals;
  std::vector<double> Areas;
  std::vector<double> Roundings;
  std::vector<double> Slopes;
};
} // namespace LightTransport

#endif
