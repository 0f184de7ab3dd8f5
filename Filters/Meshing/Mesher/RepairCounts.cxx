// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/RepairCounts.h"

#include <algorithm>
#include <sstream>

namespace LightTransport
{
//------------------------------------------------------------------------------
void RepairCounts::AddNote(const std::string& note)
{
  if (std::find(this->Notes.begin(), this->Notes.end(), note) == this->Notes.end())
  {
    this->Notes.push_back(note);
  }
}

//------------------------------------------------------------------------------
// Surfaces that only touch are no defect: alone they are not worth a line.
std::string RepairCounts::Describe() const
{
  std::ostringstream text;
  const auto describe = [&text](vtkIdType number, const char* what)
  {
    if (number > 0)
    {
      text << (text.tellp() > 0 ? ", " : "The surface was repaired: ") << number << ' ' << what;
    }
  };
  describe(this->NumberOfDroppedTriangles, "triangles dropped");
  describe(this->NumberOfReversedTriangles, "triangles turned over");
  describe(this->NumberOfWeldedPoints, "points welded");
  describe(this->NumberOfSplitEdges, "edges split at corners that lie on them");
  describe(this->NumberOfFilledHoles, "holes filled");
  describe(this->NumberResolved, "self-intersections resolved");
  if (text.tellp() > 0)
  {
    describe(this->NumberOfSplitPoints, "points kept apart where surfaces only touch");
    text << ". ";
  }
  for (const std::string& note : this->Notes)
  {
    text << note << ' ';
  }
  std::string line = text.str();
  if (!line.empty())
  {
    line.pop_back();
  }
  return line;
}

//------------------------------------------------------------------------------
void RepairCounts::Add(const RepairCounts& other)
{
  for (const auto number : { &RepairCounts::NumberOfDroppedTriangles,
         &RepairCounts::NumberOfReversedTriangles, &RepairCounts::NumberOfSplitPoints,
         &RepairCounts::NumberOfWeldedPoints, &RepairCounts::NumberOfSplitEdges,
         &RepairCounts::NumberOfSeamEdges, &RepairCounts::NumberOfSkippedPolygons,
         &RepairCounts::NumberOfFilledHoles, &RepairCounts::NumberOfSelfIntersections,
         &RepairCounts::NumberOfIntersectionsBetweenComponents, &RepairCounts::NumberResolved })
  {
    this->*number += other.*number;
  }
  for (const std::string& note : other.Notes)
  {
    this->AddNote(note);
  }
}
} // namespace LightTransport
