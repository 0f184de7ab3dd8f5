// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/ShadowCasters.h"

#include "Passes/PlainMapper.h"
#include "Shared/BitHash.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
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
template <typename Visit>
void VisitSurfaces(vtkDataObject* data, const Visit& visit)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      visit(surface);
    }
    return;
  }
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    if (auto* surface = vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject()))
    {
      visit(surface);
    }
  }
}

//------------------------------------------------------------------------------
// Of the shape alone: arrays come and go.
std::uint64_t GetShapeStamp(vtkDataObject* data)
{
  BitHash hash;
  VisitSurfaces(data,
    [&](vtkPolyData* surface) {
      hash.AddObjects({ surface->GetPoints(), surface->GetPolys(), surface->GetStrips() });
    });
  return hash.Get();
}
} // namespace

//------------------------------------------------------------------------------
bool ShadowCasters::Caster::HasShapeOf(const Caster& other) const
{
  return this->Data == other.Data && this->Stamp == other.Stamp;
}

//------------------------------------------------------------------------------
void ShadowCasters::Caster::VisitTriangles(
  const std::function<void(const std::array<Vector3, 3>&)>& visit) const
{
  VisitSurfaces(this->Data,
    [&visit](vtkPolyData* surface)
    {
      vtkNew<vtkTriangleFilter> divider;
      divider->PassVertsOff();
      divider->PassLinesOff();
      divider->SetInputData(surface);
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
    });
}

//------------------------------------------------------------------------------
void ShadowCasters::Find(vtkRenderer* renderer)
{
  this->Casters.clear();
  BitHash stamp;
  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator place;
  actors->InitTraversal(place);
  while (vtkActor* actor = actors->GetNextActor(place))
  {
    if (!CastsShadows(actor))
    {
      continue;
    }
    actor->GetMapper()->Update();
    Caster caster;
    caster.Data = actor->GetMapper()->GetInputDataObject(0, 0);
    if (!caster.Data)
    {
      continue;
    }
    caster.Stamp = GetShapeStamp(caster.Data);
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
  this->Stamp = stamp.Get();
  this->AddBounds();
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
