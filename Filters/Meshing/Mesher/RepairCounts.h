// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the repair of a surface found and changed, in numbers.
#ifndef RepairCounts_h
#define RepairCounts_h

#include "vtkType.h"

namespace LightTransport
{
struct RepairCounts
{
  vtkIdType NumberOfDroppedTriangles = 0;
  vtkIdType NumberOfReversedTriangles = 0;
  vtkIdType NumberOfSplitPoints = 0;
  vtkIdType NumberOfFilledHoles = 0;
  vtkIdType NumberOfSelfIntersections = 0;
  vtkIdType NumberOfIntersectionsBetweenComponents = 0;

  void Add(const RepairCounts& other)
  {
    this->NumberOfDroppedTriangles += other.NumberOfDroppedTriangles;
    this->NumberOfReversedTriangles += other.NumberOfReversedTriangles;
    this->NumberOfSplitPoints += other.NumberOfSplitPoints;
    this->NumberOfFilledHoles += other.NumberOfFilledHoles;
    this->NumberOfSelfIntersections += other.NumberOfSelfIntersections;
    this->NumberOfIntersectionsBetweenComponents += other.NumberOfIntersectionsBetweenComponents;
  }
};
} // namespace LightTransport

#endif
