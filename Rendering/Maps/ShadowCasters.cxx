// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/ShadowCasters.h"

#include "Passes/BlockSurfaces.h"
#include "Passes/PlainMapper.h"
#include "Shared/BitHash.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCellArray.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
bool CastsShadows(vtkActor* actor)
{
  return actor->GetVisibility() && actor->GetMapper() &&
    actor->GetMapper()->GetNumberOfInputConnections(0) > 0 && DrawsItsInput(actor->GetMapper()) &&
    actor->GetProperty()->GetRepresentation() == VTK_SURFACE &&
    actor->GetProperty()->GetOpacity() > 0.0;
}

//------------------------------------------------------------------------------
// Of the shape alone: arrays come and go.
std::uint64_t GetShapeStamp(vtkPolyData* surface)
{
  BitHash hash;
  hash.AddObjects({ surface->GetPoints(), surface->GetPolys(), surface->GetStrips() });
  return hash.Get();
}

//------------------------------------------------------------------------------
/// Those of an actor that can be seen.
std::vector<vtkPolyData*> FindSurfaces(vtkMapper* mapper)
{
  std::vector<vtkPolyData*> surfaces;
  std::vector<BlockSurface> blocks;
  if (vtkPolyDataMapper* plain = FindPlainMapper(mapper))
  {
    plain->Update();
    surfaces.push_back(plain->GetInput());
  }
  else if (FindBlockSurfaces(mapper, blocks))
  {
    for (const BlockSurface& block : blocks)
    {
      if (block.IsVisible && !(block.HasOpacity && block.Opacity <= 0.0))
      {
        surfaces.push_back(block.Surface);
      }
    }
  }
  surfaces.erase(std::remove(surfaces.begin(), surfaces.end(), nullptr), surfaces.end());
  return surfaces;
}
} // namespace

//------------------------------------------------------------------------------
bool ShadowCasters::Caster::HasShapeOf(const Caster& other) const
{
  return this->Surface == other.Surface && this->Stamp == other.Stamp;
}

//------------------------------------------------------------------------------
void ShadowCasters::Caster::VisitTriangles(
  const std::function<void(const std::array<Vector3, 3>&)>& visit) const
{
  vtkNew<vtkTriangleFilter> divider;
  divider->PassVertsOff();
  divider->PassLinesOff();
  divider->SetInputData(this->Surface);
  divider->Update();
  vtkPolyData* triangles = divider->GetOutput();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType cell = 0; cell < triangles->GetNumberOfPolys(); ++cell)
  {
    triangles->GetPolys()->GetCellAtId(cell, count, ids);
    std::array<Vector3, 3> corners;
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
    {
      triangles->GetPoint(ids[corner], corners[corner].data());
    }
    visit(corners);
  }
}

//------------------------------------------------------------------------------
// An assembly that is invisible has parts that say that they are not.
void ShadowCasters::Find(vtkRenderer* renderer)
{
  this->Casters.clear();
  vtkNew<vtkActorCollection> actors;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator place;
  props->InitTraversal(place);
  while (vtkProp* prop = props->GetNextProp(place))
  {
    if (prop->GetVisibility())
    {
      prop->GetActors(actors);
    }
  }
  BitHash stamp;
  actors->InitTraversal(place);
  while (vtkActor* actor = actors->GetNextActor(place))
  {
    if (CastsShadows(actor))
    {
      this->Add(actor, stamp);
    }
  }
  this->Stamp = stamp.Get();
  this->AddBounds();
}

//------------------------------------------------------------------------------
void ShadowCasters::Add(vtkActor* actor, BitHash& stamp)
{
  for (vtkPolyData* surface : FindSurfaces(actor->GetMapper()))
  {
    Caster caster;
    caster.Actor = actor;
    caster.Surface = surface;
    caster.Stamp = GetShapeStamp(surface);
    actor->ComputeMatrix();
    std::copy_n(actor->GetMatrix()->GetData(), 16, caster.Matrix.begin());
    actor->GetBounds(caster.Bounds.data());
    stamp.Add(caster.Stamp);
    for (const double number : caster.Matrix)
    {
      stamp.AddNumber(number);
    }
    this->Casters.push_back(std::move(caster));
  }
}

//------------------------------------------------------------------------------
void ShadowCasters::AddBounds()
{
  vtkMath::UninitializeBounds(this->Bounds.data());
  for (const Caster& caster : this->Casters)
  {
    for (int axis = 0; axis < 3 && vtkMath::AreBoundsInitialized(caster.Bounds.data()); ++axis)
    {
      const bool isFirst = this->Bounds[2 * axis] > this->Bounds[2 * axis + 1];
      double& low = this->Bounds[2 * axis];
      double& high = this->Bounds[2 * axis + 1];
      low = isFirst ? caster.Bounds[2 * axis] : std::min(low, caster.Bounds[2 * axis]);
      high = isFirst ? caster.Bounds[2 * axis + 1] : std::max(high, caster.Bounds[2 * axis + 1]);
    }
  }
}
} // namespace LightTransport
