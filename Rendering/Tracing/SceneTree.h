// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What casts shadows in a scene, on the device as shaders look for it along rays.
#ifndef SceneTree_h
#define SceneTree_h

#include "Maps/ShadowCasters.h"
#include "Maps/TupleTable.h"
#include "Shared/Outcome.h"
#include "Textures/FloatTextures.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

class vtkActor;
class vtkOpenGLRenderWindow;
class vtkPolyData;
class vtkRenderer;
class vtkShaderProgram;

namespace LightTransport
{
class SceneTree
{
public:
  SceneTree() = default;
  ~SceneTree() { this->Clear(); }
  SceneTree(const SceneTree&) = delete;
  void operator=(const SceneTree&) = delete;

  /// Brings it up to date, in the context of the renderer's window, which has one already. What
  /// failed is not tried again until something of the scene is another.
  Outcome Update(vtkRenderer* renderer);
  /// Drops all that is on the device.
  void Clear();

  bool IsThere() const { return this->IsOpen() && this->Table.Get(); }
  /// How often it has been made.
  vtkIdType GetNumberOfRuns() const { return this->NumberOfRuns; }

  /// What coordinates of shaders are relative to.
  const Vector3& GetOrigin() const { return this->Origin; }
  /// The diagonal of its bounds.
  double GetSize() const { return this->Size; }

  /// The number of what casts shadows of an actor with a surface; -1 where it casts none.
  int FindBody(vtkActor* actor, vtkPolyData* surface) const;

  ///@{ Let a program that is in use look into it until it is let go: fragments are those of the
  /// renderer that it was brought up to date for.
  void Activate(vtkShaderProgram* program);
  void Deactivate();
  ///@}

private:
  bool IsOpen() const { return this->Engine && this->Engine->IsAlive(); }
  using Corners = std::array<Vector3, 3>;
  void VisitTriangles(const std::function<void(const Corners&, int)>& visit) const;
  Outcome Refresh(vtkRenderer* renderer);
  Outcome Upload();

  std::unique_ptr<FloatTextures> Engine;
  ShadowCasters Casters;
  TupleTable Table;
  std::uint64_t Stamp = 0;
  bool IsTried = false;
  int NumberOfBoxes = 0;
  vtkIdType NumberOfRuns = 0;
  Vector3 Origin = {};
  std::array<float, 16> FromView = {};
  double Size = 0.0;
};
} // namespace LightTransport

#endif
