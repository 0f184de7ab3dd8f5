// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ScenePieces.h"

#include "Scene/PatchGeometry.h"
#include "Scene/PolygonList.h"
#include "Scene/SceneFaces.h"
#include "Shared/Pulse.h"

#include <set>
#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
ScenePieces::ScenePieces(const std::vector<vtkIdType>& starts, const std::vector<Vector>& corners,
  double rounding)
  : Problems(starts.size() - 1, 0)
{
  std::vector<Vector> places;
  for (std::size_t polygon = 0; polygon < this->Problems.size(); ++polygon)
  {
    Pulse::Beat(polygon);
    places.assign(corners.begin() + starts[polygon], corners.begin() + starts[polygon + 1]);
    this->Add(static_cast<vtkIdType>(polygon), starts[polygon],
      PolygonCutting::Cut(places, PatchGeometry::MaximumCorners, rounding));
  }
}

//------------------------------------------------------------------------------
void ScenePieces::Add(vtkIdType polygon, vtkIdType start, const PolygonCutting::Pieces& pieces)
{
  switch (pieces.Is)
  {
    case PolygonCutting::Shape::WithoutArea:
      this->WithoutArea.push_back(polygon);
      this->Problems[polygon] |= SceneFaces::WITHOUT_AREA;
      break;
    case PolygonCutting::Shape::Crossing:
      this->Crossing.push_back(polygon);
      this->Problems[polygon] |= SceneFaces::WITHOUT_AREA;
      break;
    case PolygonCutting::Shape::Warped:
      this->Warped.push_back(polygon);
      this->Problems[polygon] |= SceneFaces::NOT_PLANE;
      break;
    default:
      break;
  }
  const bool inOnePlane = pieces.Is == PolygonCutting::Shape::Cut;
  for (const std::vector<int>& piece : pieces.Corners)
  {
    this->Faces.push_back(polygon);
    for (const int corner : piece)
    {
      this->Corners.push_back(start + corner);
    }
    this->Offsets.push_back(static_cast<vtkIdType>(this->Corners.size()));
    this->Planes.push_back(inOnePlane ? pieces.Normal : Vector(0.0, 0.0, 0.0));
  }
}

//------------------------------------------------------------------------------
void ScenePieces::AddBacks()
{
  const auto polygons = static_cast<vtkIdType>(this->Problems.size());
  const vtkIdType fronts = this->GetNumber();
  for (vtkIdType piece = 0; piece < fronts; ++piece)
  {
    Pulse::Beat(piece);
    this->Faces.push_back(polygons + this->Faces[piece]);
    for (vtkIdType corner = this->Offsets[piece + 1]; corner-- > this->Offsets[piece];)
    {
      this->Corners.push_back(this->Corners[corner]);
    }
    this->Offsets.push_back(static_cast<vtkIdType>(this->Corners.size()));
    this->Planes.emplace_back(-this->Planes[piece]);
  }
  for (vtkIdType polygon = 0; polygon < polygons; ++polygon)
  {
    this->Problems.push_back(this->Problems[polygon]);
  }
}

//------------------------------------------------------------------------------
void ScenePieces::Remove(const std::vector<vtkIdType>& faces)
{
  const std::set<vtkIdType> removed(faces.begin(), faces.end());
  ScenePieces kept = *this;
  kept.Faces.clear();
  kept.Offsets.assign(1, 0);
  kept.Corners.clear();
  kept.Planes.clear();
  for (vtkIdType piece = 0; piece < this->GetNumber(); ++piece)
  {
    Pulse::Beat(piece);
    if (removed.count(this->Faces[piece]) == 0)
    {
      kept.Faces.push_back(this->Faces[piece]);
      kept.Corners.insert(kept.Corners.end(), this->Corners.begin() + this->Offsets[piece],
        this->Corners.begin() + this->Offsets[piece + 1]);
      kept.Offsets.push_back(static_cast<vtkIdType>(kept.Corners.size()));
      kept.Planes.push_back(this->Planes[piece]);
    }
  }
  *this = std::move(kept);
}

//------------------------------------------------------------------------------
std::vector<std::string> ScenePieces::GetWarnings() const
{
  std::vector<std::string> warnings;
  if (!this->WithoutArea.empty())
  {
    warnings.push_back(PolygonList::Format(this->WithoutArea,
      " without area: left out, with results of 0. Remove degenerate cells, for example with "
      "vtkCleanPolyData, or vtkPatchMesher with Repair on."));
  }
  if (!this->Crossing.empty())
  {
    warnings.push_back(PolygonList::Format(this->Crossing,
      " with a border that crosses itself: left out, with results of 0. Mend the border, or cut "
      "it into triangles."));
  }
  if (!this->Warped.empty())
  {
    warnings.push_back(PolygonList::Format(this->Warped,
      " not plane: cut into triangles, results are the means of these. For results of each "
      "triangle pass the input through vtkTriangleFilter."));
  }
  return warnings;
}
} // namespace LightTransport
