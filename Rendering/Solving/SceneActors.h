// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The actors of a renderer that take part in a radiosity solution, as one scene: which they are,
 * what they are made of, and numbers that tell when any of that has changed.
 */
#ifndef SceneActors_h
#define SceneActors_h

#include "Passes/BlockSurfaces.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkActor;
class vtkLight;
class vtkMultiBlockDataSet;
class vtkPolyData;
class vtkRenderer;

namespace LightTransport
{
class SceneActors
{
public:
  /// A surface of an actor: one, or a block of composite data.
  struct Member
  {
    vtkWeakPointer<vtkActor> Actor;
    int Block = 0;
    bool HasColor = false; ///< of its own, in place of the property's
    std::array<double, 3> Color = {};
    vtkSmartPointer<vtkPolyData> Surface; ///< what its mapper draws
    std::uint64_t Shape = 0;              ///< another number when points or polygons change
    std::array<double, 16> Matrix = {};
  };

  /// Names of the cell arrays that say what actors are made of.
  struct Names
  {
    std::string Emission;
    std::string Reflectance;
  };

  /// Looks for those that take part: visible, opaque, lit, drawn as surfaces, with polygons, also
  /// in blocks. `refusals` gets a line for each that is kept from it by its mapper or its blocks.
  void Find(vtkRenderer* renderer, const Names& names, std::vector<std::string>& refusals);

  const std::vector<Member>& GetMembers() const { return this->Members; }

  /// Whether they are surfaces of the very same actors, whatever these are made of.
  bool AreOfActorsOf(const SceneActors& other) const;

  ///@{ Other numbers where points, polygons or places have changed; what actors are made of; lights
  /// of the renderer that are scene lights, and on.
  std::uint64_t GetShapeKey() const { return this->ShapeKey; }
  std::uint64_t GetMaterialKey() const { return this->MaterialKey; }
  std::uint64_t GetLightKey() const { return this->LightKey; }
  ///@}

  /// One block of each, in world coordinates: its polygons with the cell arrays "Emission" and
  /// "Reflectance" of 3 components, and the point arrays. nullptr where something is wrong, which
  /// `problem` tells.
  vtkSmartPointer<vtkMultiBlockDataSet> MakeScene(std::string& problem) const;

  /// Copies, which nobody changes.
  std::vector<vtkSmartPointer<vtkLight>> CopyLights() const;

private:
  bool AddBlocks(vtkActor* actor);
  void Add(vtkActor* actor, const BlockSurface& block, int number);
  vtkSmartPointer<vtkPolyData> MakeBlock(const Member& member, std::string& problem) const;

  Names ArrayNames;
  std::vector<Member> Members;
  std::vector<vtkSmartPointer<vtkLight>> Lights;
  std::uint64_t ShapeKey = 0;
  std::uint64_t MaterialKey = 0;
  std::uint64_t LightKey = 0;
};
} // namespace LightTransport

#endif
