// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/SurfaceBumps.h"

#include "Shared/BitHash.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// The name that vtkProperty reserves.
vtkTexture* FindTexture(vtkActor* actor)
{
  return actor->GetProperty()->GetTexture("normalTex");
}
} // namespace

//------------------------------------------------------------------------------
std::uint64_t SurfaceBumps::GetStamp(vtkActor* actor, vtkPolyData* surface)
{
  vtkTexture* texture = FindTexture(actor);
  vtkDataArray* places = surface->GetPointData()->GetTCoords();
  vtkDataArray* tangents = surface->GetPointData()->GetTangents();
  if (!texture || !texture->GetInputAlgorithm() || !places || !tangents ||
    places->GetNumberOfComponents() < 2 || tangents->GetNumberOfComponents() != 3)
  {
    return 0;
  }
  texture->GetInputAlgorithm()->Update();
  BitHash stamp;
  stamp.AddObjects({ texture, texture->GetInput(), places, tangents });
  stamp.AddNumber(actor->GetProperty()->GetNormalScale());
  return stamp.Get();
}

//------------------------------------------------------------------------------
Outcome SurfaceBumps::Update(FloatTextures& engine, vtkPolyData* surface, std::uint64_t stamp)
{
  if (this->Stamp == stamp)
  {
    return Outcome::Done();
  }
  this->Stamp = 0;
  bool isFinite = true;
  std::vector<float> texels = TupleTable::Pack(
    { surface->GetPointData()->GetTCoords(), surface->GetPointData()->GetTangents() }, 0,
    surface->GetNumberOfPoints(), isFinite);
  if (!isFinite)
  {
    return Outcome::Failed("The surface has texture coordinates or tangents that are not finite: "
                           "correct them, or switch Bumps off.");
  }
  Outcome uploaded = this->Tangents.Upload(engine, std::move(texels));
  this->Stamp = uploaded ? stamp : 0;
  return uploaded;
}

//------------------------------------------------------------------------------
LightDrawing::BumpMap SurfaceBumps::Activate(vtkActor* actor, vtkRenderer* renderer) const
{
  vtkTexture* texture = FindTexture(actor);
  texture->Render(renderer);
  return { texture->GetTextureUnit(), actor->GetProperty()->GetNormalScale(),
    this->Tangents.Get() };
}

//------------------------------------------------------------------------------
void SurfaceBumps::Deactivate(vtkActor* actor, vtkRenderer* renderer) const
{
  FindTexture(actor)->PostRender(renderer);
}
} // namespace LightTransport
