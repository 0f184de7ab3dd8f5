// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Actors that are drawn in place of others, each with a plain surface of its own: a pass that needs
 * other points than the actor's, or its blocks one by one, leaves the actor's own surface as it is.
 */
#ifndef StandIns_h
#define StandIns_h

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <vector>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkProp;
class vtkWindow;

namespace LightTransport
{
class StandIns
{
public:
  /// Of a surface in the coordinates of its actor.
  static constexpr std::array<double, 16> Unmoved = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,
    1 };

  /// One for a block of an actor, which draws `surface`, in world coordinates of when the actor had
  /// `matrix`, where the actor is now.
  vtkActor* Get(vtkActor* actor, vtkPolyData* surface, const std::array<double, 16>& matrix,
    int block = 0);

  /// One that draws the vertices and lines of what a block of an actor draws, where the actor is;
  /// nullptr where there are none. Numbers of blocks are those of Get: use other stand-ins for it.
  vtkActor* GetLines(vtkActor* actor, vtkPolyData* surface, int block);

  bool Has(vtkProp* standIn) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  struct Pair
  {
    vtkWeakPointer<vtkActor> Actor;
    int Block = 0;
    vtkSmartPointer<vtkActor> StandIn;
    vtkSmartPointer<vtkPolyDataMapper> Mapper;
    vtkSmartPointer<vtkMatrix4x4> Move;
  };

  Pair& Find(vtkActor* actor, int block);

  std::vector<Pair> Pairs;
};
} // namespace LightTransport

#endif
