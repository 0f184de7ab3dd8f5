// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Turns a remeshed surface into a data object: see vtkPatchMesher for the arrays.
#ifndef PatchOutput_h
#define PatchOutput_h

#include "Common/TriangleSoup.h"
#include "Mesher/IsotropicRemesher.h"
#include "Mesher/RepairCounts.h"

class vtkPolyData;

namespace LightTransport
{
class PatchOutput
{
public:
  /// `soup` was read from `input` and repaired, and `patches` was made of it.
  PatchOutput(vtkPolyData* input, const TriangleSoup& soup,
    const IsotropicRemesher::Result& patches);

  void WriteGeometry(bool flip, vtkPolyData* output) const;
  void WriteCellData(vtkPolyData* output) const;
  void WritePointData(vtkPolyData* output) const;
  /// `length` is the target edge length that was used.
  void WriteSummary(const RepairCounts& counts, double length, vtkPolyData* output) const;

private:
  vtkPolyData* Input;
  const TriangleSoup& Soup;
  const IsotropicRemesher::Result& Patches;
};
} // namespace LightTransport

#endif
