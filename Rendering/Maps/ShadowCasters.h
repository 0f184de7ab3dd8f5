// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The surfaces of a scene that cast shadows: of all visible actors, and visible blocks of
/// composite data, wherever the camera looks.
#ifndef ShadowCasters_h
#define ShadowCasters_h

#include "Maps/SceneLights.h"

#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace LightTransport
{
class BitHash;

class ShadowCasters
{
public:
  /// An actor, or a block of one.
  struct Caster
  {
    vtkWeakPointer<vtkActor> Actor;
    vtkWeakPointer<vtkPolyData> Surface;
    std::uint64_t Stamp = 0; ///< of its shape
    std::array<double, 16> Matrix = {};
    std::array<double, 6> Bounds = {}; ///< of the actor

    bool HasShapeOf(const Caster& other) const;
    /// In the caster's own coordinates.
    void VisitTriangles(const std::function<void(const std::array<Vector3, 3>&)>& visit) const;
  };

  /// They are brought up to date.
  void Find(vtkRenderer* renderer);

  const std::vector<Caster>& Get() const { return this->Casters; }

  /// Another number where they, or their places, are others.
  std::uint64_t GetStamp() const { return this->Stamp; }

  /// xmin, xmax, ... of all of them.
  const std::array<double, 6>& GetBounds() const { return this->Bounds; }

private:
  void Add(vtkActor* actor, BitHash& stamp);
  void AddBounds();

  std::vector<Caster> Casters;
  std::uint64_t Stamp = 0;
  std::array<double, 6> Bounds = {};
};
} // namespace LightTransport

#endif
