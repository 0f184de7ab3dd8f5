// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Actors that are drawn in place of others, with a surface of their own: points where a crease
 * meets a smooth surface have several values, and the actor's own surface is left as it is.
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
  /// One for an actor, which draws `surface`, in world coordinates of when the actor had `matrix`,
  /// where the actor is now.
  vtkActor* Get(vtkActor* actor, vtkPolyData* surface, const std::array<double, 16>& matrix);

  bool Has(vtkProp* standIn) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  struct Pair
  {
    vtkWeakPointer<vtkActor> Actor;
    vtkSmartPointer<vtkActor> StandIn;
    vtkSmartPointer<vtkPolyDataMapper> Mapper;
    vtkSmartPointer<vtkMatrix4x4> Move;
  };

  Pair& Find(vtkActor* actor);

  std::vector<Pair> Pairs;
};
} // namespace LightTransport

#endif
