// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/StandIns.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
StandIns::Pair& StandIns::Find(vtkActor* actor, int block)
{
  this->Pairs.erase(std::remove_if(this->Pairs.begin(), this->Pairs.end(),
                      [](const Pair& pair) { return !pair.Actor; }),
    this->Pairs.end());
  const auto found = std::find_if(this->Pairs.begin(), this->Pairs.end(),
    [actor, block](const Pair& pair) { return pair.Actor.Get() == actor && pair.Block == block; });
  if (found != this->Pairs.end())
  {
    return *found;
  }
  Pair pair;
  pair.Actor = actor;
  pair.Block = block;
  pair.StandIn = vtkSmartPointer<vtkActor>::New();
  pair.Mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  pair.Mapper->ScalarVisibilityOff();
  pair.Move = vtkSmartPointer<vtkMatrix4x4>::New();
  pair.StandIn->SetMapper(pair.Mapper);
  pair.StandIn->SetPropertyKeys(vtkNew<vtkInformation>());
  this->Pairs.push_back(pair);
  return this->Pairs.back();
}

//------------------------------------------------------------------------------
// Keys are those of the actor: passes around leave theirs there.
vtkActor* StandIns::Get(vtkActor* actor, vtkPolyData* surface, const std::array<double, 16>& matrix,
  int block)
{
  Pair& pair = this->Find(actor, block);
  if (pair.Mapper->GetInput() != surface)
  {
    pair.Mapper->SetInputData(surface);
  }
  pair.StandIn->SetProperty(actor->GetProperty());
  pair.StandIn->SetBackfaceProperty(actor->GetBackfaceProperty());
  pair.StandIn->GetPropertyKeys()->Copy(actor->GetPropertyKeys());
  actor->ComputeMatrix();
  const double* now = actor->GetMatrix()->GetData();
  if (std::equal(matrix.begin(), matrix.end(), now))
  {
    pair.StandIn->SetUserMatrix(nullptr);
  }
  else
  {
    vtkNew<vtkMatrix4x4> before;
    before->DeepCopy(matrix.data());
    before->Invert();
    vtkMatrix4x4::Multiply4x4(actor->GetMatrix(), before, pair.Move);
    pair.StandIn->SetUserMatrix(pair.Move);
  }
  return pair.StandIn;
}

//------------------------------------------------------------------------------
// The same again where the cells are the same, so that it is not uploaded anew.
vtkActor* StandIns::GetLines(vtkActor* actor, vtkPolyData* surface, int block)
{
  if (surface->GetNumberOfVerts() + surface->GetNumberOfLines() == 0)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkPolyData> lines = this->Find(actor, block).Mapper->GetInput();
  if (!lines || lines->GetPoints() != surface->GetPoints() ||
    lines->GetVerts() != surface->GetVerts() || lines->GetLines() != surface->GetLines())
  {
    lines = vtkSmartPointer<vtkPolyData>::New();
    lines->SetPoints(surface->GetPoints());
    lines->SetVerts(surface->GetVerts());
    lines->SetLines(surface->GetLines());
  }
  return this->Get(actor, lines, Unmoved, block);
}

//------------------------------------------------------------------------------
bool StandIns::Has(vtkProp* standIn) const
{
  return std::any_of(this->Pairs.begin(), this->Pairs.end(),
    [standIn](const Pair& pair) { return pair.StandIn.Get() == standIn; });
}

//------------------------------------------------------------------------------
void StandIns::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const Pair& pair : this->Pairs)
  {
    pair.StandIn->ReleaseGraphicsResources(window);
  }
}
} // namespace LightTransport
