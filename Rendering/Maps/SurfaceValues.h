// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// An array of a surface, in cells or points, as a table on the device.
#ifndef SurfaceValues_h
#define SurfaceValues_h

#include "Maps/TupleTable.h"
#include "Shared/Outcome.h"

#include <cstdint>
#include <string>
#include <utility>

class vtkDataArray;
class vtkPolyData;

namespace LightTransport
{
class SurfaceValues
{
public:
  /// Another number where the array of this name is another one.
  static std::uint64_t GetStamp(vtkPolyData* surface, const std::string& name);

  /// Takes the array of this name, of the triangles where they have one, else of the points; the
  /// same as before is left alone. `remedy` is what to do where there is none. In a DeviceSession.
  Outcome Update(FloatTextures& engine, vtkPolyData* surface, const std::string& name,
    const std::string& remedy);

  vtkTextureObject* GetTable() const { return this->Table.Get(); }
  bool AreOfPoints() const { return this->OfPoints; }
  int GetNumberOfComponents() const { return this->Components; }

private:
  /// Of cells, and of points.
  static std::pair<vtkDataArray*, vtkDataArray*> Find(vtkPolyData* surface,
    const std::string& name);

  TupleTable Table;
  std::uint64_t Stamp = 0;
  bool OfPoints = false;
  int Components = 0;
};
} // namespace LightTransport

#endif
