// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the repair of a surface found and changed, in numbers.
#ifndef RepairCounts_h
#define RepairCounts_h

#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
struct RepairCounts
{
  vtkIdType NumberOfDroppedTriangles = 0;
  vtkIdType NumberOfReversedTriangles = 0;
  vtkIdType NumberOfSplitPoints = 0;
  vtkIdType NumberOfWeldedPoints = 0;
  vtkIdType NumberOfSplitEdges = 0;
  vtkIdType NumberOfSeamEdges = 0;
  vtkIdType NumberOfSkippedPolygons = 0;
  vtkIdType NumberOfFilledHoles = 0;
  vtkIdType NumberOfSelfIntersections = 0;
  vtkIdType NumberOfIntersectionsBetweenComponents = 0;
  /// How many of the self-intersections were resolved.
  vtkIdType NumberResolved = 0;
  /// What the numbers do not tell: sentences, each once.
  std::vector<std::string> Notes;
  void AddNote(const std::string& note);

  /// All that was changed, in one line; empty where nothing was.
  std::string Describe() const;

  /// Those of another surface.
  void Add(const RepairCounts& other);
};
} // namespace LightTransport

#endif
