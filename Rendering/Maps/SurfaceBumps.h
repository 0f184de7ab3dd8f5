// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The normal texture of an actor, and where its surface has texture coordinates and tangents.
#ifndef SurfaceBumps_h
#define SurfaceBumps_h

#include "Maps/LightDrawing.h"
#include "Maps/TupleTable.h"
#include "Shared/Outcome.h"

#include <cstdint>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace LightTransport
{
class SurfaceBumps
{
public:
  /// 0 where an actor has none, or its surface no active texture coordinates or tangents; else
  /// another number where something of it has changed. Brings the texture's picture up to date.
  static std::uint64_t GetStamp(vtkActor* actor, vtkPolyData* surface);

  ///@{ In a DeviceSession; `stamp` is what GetStamp gave. Activate loads the texture, which is
  /// active until Deactivate.
  Outcome Update(FloatTextures& engine, vtkPolyData* surface, std::uint64_t stamp);
  LightDrawing::BumpMap Activate(vtkActor* actor, vtkRenderer* renderer) const;
  void Deactivate(vtkActor* actor, vtkRenderer* renderer) const;
  ///@}

private:
  TupleTable Tangents;
  std::uint64_t Stamp = 0;
};
} // namespace LightTransport

#endif
