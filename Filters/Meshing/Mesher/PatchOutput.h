// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Turns a remeshed surface into data objects, one for each block of the input: see vtkPatchMesher
/// for the arrays.
#ifndef PatchOutput_h
#define PatchOutput_h

#include "Common/TriangleSoup.h"
#include "Mesher/IsotropicRemesher.h"
#include "Mesher/RemeshToTarget.h"
#include "Mesher/RepairCounts.h"
#include "Shared/Monitor.h"

class vtkFieldData;
class vtkPolyData;

namespace LightTransport
{
/// The patches that were made of one block.
struct PatchPart
{
  /// Of the triangles `first` to `last` (excluded) of the soup that the patches were made of; the
  /// sources count from there.
  PatchPart(const RemeshToTarget::Result& all, std::size_t first, std::size_t last);

  IsotropicRemesher::Result Patches;
  vtkIdType NumberOfCrossingsWithin = 0;
  /// Those of which this part has a patch.
  vtkIdType NumberOfCrossingsBetween = 0;
};

/// What is told of the patches in numbers.
struct PatchSummary
{
  vtkIdType NumberOfPatches = 0;
  RepairCounts Repairs;
  vtkIdType NumberOfCrossingsWithin = 0;
  vtkIdType NumberOfCrossingsBetween = 0;
  double Length = 0.0;

  void Add(const PatchSummary& other);
  void Write(vtkFieldData* fields) const;
};

/// Throws Heartbeat::Stopped when aborted.
class PatchOutput
{
public:
  /// `soup` was read from `input` and repaired, and `patches` was made of it.
  PatchOutput(vtkPolyData* input, const TriangleSoup& soup,
    const IsotropicRemesher::Result& patches, const Monitor& monitor);

  void WriteGeometry(bool flip, vtkPolyData* output) const;
  void WriteCellData(vtkPolyData* output) const;
  void WritePointData(vtkPolyData* output) const;

private:
  vtkPolyData* Input;
  const TriangleSoup& Soup;
  const IsotropicRemesher::Result& Patches;
  const Monitor& Watcher;
};
} // namespace LightTransport

#endif
