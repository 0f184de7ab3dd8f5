// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/PatchOutput.h"

#include "Common/Heartbeat.h"
#include "Mesher/SourceSurface.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/OutputMemory.h"
#include "Shared/ZeroedArray.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
PatchPart::PatchPart(const RemeshToTarget::Result& all, std::size_t first, std::size_t last)
{
  const IsotropicRemesher::Result& patches = all.Patches;
  const auto isMine = [&](std::size_t patch) {
    return patches.SourcesOfTriangles[patch] >= first && patches.SourcesOfTriangles[patch] < last;
  };
  std::vector<std::size_t> indices(patches.Points.size(), SourceSurface::None);
  for (std::size_t i = 0; i < patches.Triangles.size(); ++i)
  {
    if (!isMine(i))
    {
      continue;
    }
    TriangleSoup::Triangle triangle = patches.Triangles[i];
    for (std::size_t& corner : triangle)
    {
      if (indices[corner] == SourceSurface::None)
      {
        indices[corner] = this->Patches.Points.size();
        this->Patches.Points.push_back(patches.Points[corner]);
        this->Patches.SourcesOfPoints.push_back(patches.SourcesOfPoints[corner] - first);
      }
      corner = indices[corner];
    }
    this->Patches.Triangles.push_back(triangle);
    this->Patches.SourcesOfTriangles.push_back(patches.SourcesOfTriangles[i] - first);
  }
  for (const auto& pair : all.CrossingsWithin)
  {
    this->NumberOfCrossingsWithin += isMine(pair.first);
  }
  for (const auto& pair : all.CrossingsBetween)
  {
    this->NumberOfCrossingsBetween += isMine(pair.first) || isMine(pair.second);
  }
}

//------------------------------------------------------------------------------
void PatchSummary::Add(const PatchSummary& other)
{
  this->NumberOfPatches += other.NumberOfPatches;
  this->Repairs.Add(other.Repairs);
  this->NumberOfCrossingsWithin += other.NumberOfCrossingsWithin;
  this->NumberOfCrossingsBetween += other.NumberOfCrossingsBetween;
  this->Length = other.Length;
}

//------------------------------------------------------------------------------
void PatchSummary::Write(vtkFieldData* fields) const
{
  const auto add = [fields](const char* name, vtkIdType number)
  { FieldValues::AddAs<vtkIdTypeArray>(fields, name, { number }); };
  const RepairCounts& counts = this->Repairs;
  add("NumberOfPatches", this->NumberOfPatches);
  add("NumberOfDroppedTriangles", counts.NumberOfDroppedTriangles);
  add("NumberOfReversedTriangles", counts.NumberOfReversedTriangles);
  add("NumberOfSplitPoints", counts.NumberOfSplitPoints);
  add("NumberOfWeldedPoints", counts.NumberOfWeldedPoints);
  add("NumberOfSplitEdges", counts.NumberOfSplitEdges);
  add("NumberOfSeamEdges", counts.NumberOfSeamEdges);
  add("NumberOfSkippedPolygons", counts.NumberOfSkippedPolygons);
  add("NumberOfFilledHoles", counts.NumberOfFilledHoles);
  add("NumberOfInputSelfIntersections", counts.NumberOfSelfIntersections);
  add("NumberOfSelfIntersections", this->NumberOfCrossingsWithin);
  add("NumberOfIntersectionsBetweenComponents", this->NumberOfCrossingsBetween);
  FieldValues::Add(fields, "TargetEdgeLength", this->Length);
}

//------------------------------------------------------------------------------
PatchOutput::PatchOutput(vtkPolyData* input, const TriangleSoup& soup,
  const IsotropicRemesher::Result& patches, const Monitor& monitor)
  : Input(input), Soup(soup), Patches(patches), Watcher(monitor)
{
}

//------------------------------------------------------------------------------
void PatchOutput::WriteGeometry(bool flip, vtkPolyData* output) const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  ZeroedArray::Fill(points->GetData(), static_cast<vtkIdType>(this->Patches.Points.size()));
  for (std::size_t i = 0; i < this->Patches.Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), this->Patches.Points[i].data());
  }
  vtkNew<vtkCellArray> cells;
  const auto size = static_cast<vtkIdType>(this->Patches.Triangles.size());
  OutputMemory::Allocate(size, 3 * size, cells);
  for (const TriangleSoup::Triangle& triangle : this->Patches.Triangles)
  {
    const vtkIdType ids[3] = { static_cast<vtkIdType>(triangle[0]),
      static_cast<vtkIdType>(triangle[flip ? 2 : 1]),
      static_cast<vtkIdType>(triangle[flip ? 1 : 2]) };
    cells->InsertNextCell(3, ids);
  }
  output->SetPoints(points);
  output->SetPolys(cells);
}

//------------------------------------------------------------------------------
void PatchOutput::WriteCellData(vtkPolyData* output) const
{
  vtkCellData* from = this->Input->GetCellData();
  vtkCellData* to = output->GetCellData();
  const vtkIdType size = static_cast<vtkIdType>(this->Patches.Triangles.size());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(ArrayNames::OriginalCellIds);
  ZeroedArray::Fill(ids, size);
  to->CopyAllOn();
  OutputMemory::AllocateCopies(from, size, to);
  Heartbeat heart(this->Watcher);
  for (vtkIdType i = 0; i < size; ++i)
  {
    heart.Beat();
    const vtkIdType cell = this->Soup.CellIds[this->Patches.SourcesOfTriangles[i]];
    to->CopyData(from, cell, i);
    ids->SetValue(i, cell);
  }
  // Several patches come from one cell, so its id is no longer global; and no patch is a ghost.
  to->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  to->AddArray(ids);
}

//------------------------------------------------------------------------------
void PatchOutput::WritePointData(vtkPolyData* output) const
{
  vtkPointData* from = this->Input->GetPointData();
  vtkPointData* to = output->GetPointData();
  if (from->GetNumberOfArrays() == 0)
  {
    return;
  }
  to->CopyNormalsOff();
  to->CopyTangentsOff();
  to->CopyTCoordsOff();
  OutputMemory::AllocateMeans(from, static_cast<vtkIdType>(this->Patches.Points.size()), to);
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(3);
  Heartbeat heart(this->Watcher);
  for (std::size_t i = 0; i < this->Patches.Points.size(); ++i)
  {
    heart.Beat();
    const TriangleSoup::Triangle& source = this->Soup.Triangles[this->Patches.SourcesOfPoints[i]];
    SourceSurface::Place place = SourceSurface::GetClosest(this->Soup.Points[source[0]],
      this->Soup.Points[source[1]], this->Soup.Points[source[2]], this->Patches.Points[i]);
    for (int j = 0; j < 3; ++j)
    {
      ids->SetId(j, this->Soup.PointIds[source[j]]);
    }
    to->InterpolatePoint(from, static_cast<vtkIdType>(i), ids, place.Weights.data());
  }
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
}
} // namespace LightTransport
