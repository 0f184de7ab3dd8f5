// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScatteringPass.h"

#include "Atlas/AtlasTexture.h"
#include "Maps/AtlasDrawing.h"
#include "Passes/RadianceShader.h"
#include "Shared/ArrayNames.h"
#include "Shared/Fresnel.h"
#include "vtkLightTransportPassesScatteringFS.h"
#include "vtkOpenGLAtlasTexture.h"
#include "vtkOpenGLScatteredMap.h"
#include "vtkOpenGLTransmittedMap.h"
#include "vtkSurfaceLighting.h"

#include "vtkActor.h"
#include "vtkObjectFactory.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTextureObject.h"
#include "vtkWeakPointer.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScatteringPass);

namespace
{
constexpr double LargestIndex = 10.0;

double GetMeanTransmittanceAt(double index)
{
  return 1.0 - Fresnel::GetMeanExternalReflectance(index);
}

//------------------------------------------------------------------------------
double GetIndex(vtkSubsurfaceScattering* material)
{
  double unused[3];
  double index = material->GetRefractiveIndex();
  vtkSubsurfaceScattering::GetMaterialProperties(material->GetMaterial(), unused, unused, index);
  return std::min(std::max(index, 1.0), LargestIndex);
}
} // namespace

/// An actor with a material, and its maps.
struct vtkSubsurfaceScatteringPass::Body
{
  vtkWeakPointer<vtkActor> Actor;
  vtkNew<vtkOpenGLTransmittedMap> Transmitted;
  vtkNew<vtkOpenGLScatteredMap> Scattered;
  double RefractiveIndex = 1.0;
  double MeanTransmittance = 1.0;
  bool IsMapped = false;

  void LetGo()
  {
    if (AtlasDrawing* drawing = this->Transmitted->GetDrawing())
    {
      drawing->GetPoints()->Deactivate();
    }
    this->Scattered->GetTexture()->Deactivate();
  }
};

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::vtkSubsurfaceScatteringPass()
  : vtkTransportPass(ArrayNames::ScatteredIrradiance),
    Lighting(vtkSmartPointer<vtkSurfaceLighting>::New())
{
  this->SetRefractiveIndex(1.3);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::~vtkSubsurfaceScatteringPass() = default;

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::SetRefractiveIndex(double index)
{
  const double clamped = std::min(std::max(index, 1.0), LargestIndex);
  if (this->RefractiveIndex != clamped)
  {
    this->RefractiveIndex = clamped;
    this->MeanTransmittance = GetMeanTransmittanceAt(clamped);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::SetLighting(vtkSurfaceLighting* lighting)
{
  if (lighting && this->Lighting != lighting)
  {
    this->Lighting = lighting;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkSurfaceLighting* vtkSubsurfaceScatteringPass::GetLighting()
{
  return this->Lighting;
}

//------------------------------------------------------------------------------
double vtkSubsurfaceScatteringPass::GetOutgoingWeight(double cosine, double refractiveIndex)
{
  const double index = std::min(std::max(refractiveIndex, 1.0), LargestIndex);
  const double clamped = std::min(std::max(cosine, 0.0), 1.0);
  // Without a boundary nothing is reflected, along the surface either.
  return index > 1.0 ? Fresnel::GetTransmittance(clamped, index) / GetMeanTransmittanceAt(index)
                     : 1.0;
}

//------------------------------------------------------------------------------
const char* vtkSubsurfaceScatteringPass::GetFragmentShader()
{
  return ::vtkLightTransportPassesScatteringFS;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
  os << indent << "Lighting: " << this->Lighting.Get() << "\n";
  os << indent << "IrradianceMapSize: " << this->IrradianceMapSize << "\n";
  os << indent << "IrradianceSamples: " << this->IrradianceSamples << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "ShadowMapSize: " << this->ShadowMapSize << "\n";
  os << indent << "ScatteredMapSize: " << this->ScatteredMapSize << "\n";
  os << indent << "NumberOfMaterials: " << this->Bodies.size() << "\n";
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::Body* vtkSubsurfaceScatteringPass::FindBody(vtkProp* actor)
{
  const auto found = std::find_if(this->Bodies.begin(), this->Bodies.end(),
    [actor](const std::unique_ptr<Body>& body) { return body->Actor.Get() == actor; });
  return actor && found != this->Bodies.end() ? found->get() : nullptr;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::SetMaterial(vtkActor* actor, vtkSubsurfaceScattering* material)
{
  Body* body = this->FindBody(actor);
  if (!actor || (material && body && body->Scattered->GetMaterial() == material) ||
    (!material && !body))
  {
    return;
  }
  if (!material)
  {
    this->Bodies.erase(std::find_if(this->Bodies.begin(), this->Bodies.end(),
      [body](const std::unique_ptr<Body>& other) { return other.get() == body; }));
  }
  else
  {
    if (!body)
    {
      this->Bodies.push_back(std::make_unique<Body>());
      body = this->Bodies.back().get();
      body->Actor = actor;
      body->Transmitted->ShareShadows(this->Bodies.front()->Transmitted);
    }
    body->Scattered->SetMaterial(material);
  }
  this->MapsModified();
  this->Modified();
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering* vtkSubsurfaceScatteringPass::GetMaterial(vtkActor* actor)
{
  Body* body = this->FindBody(actor);
  return body ? body->Scattered->GetMaterial() : nullptr;
}

//------------------------------------------------------------------------------
vtkOpenGLTransmittedMap* vtkSubsurfaceScatteringPass::GetTransmittedMap(vtkActor* actor)
{
  Body* body = this->FindBody(actor);
  return body ? body->Transmitted.Get() : nullptr;
}

//------------------------------------------------------------------------------
vtkOpenGLScatteredMap* vtkSubsurfaceScatteringPass::GetScatteredMap(vtkActor* actor)
{
  Body* body = this->FindBody(actor);
  return body ? body->Scattered.Get() : nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkSubsurfaceScatteringPass::GetNumberOfIrradianceRuns()
{
  vtkIdType runs = 0;
  for (const auto& body : this->Bodies)
  {
    runs += body->Transmitted->GetNumberOfRuns();
  }
  return runs;
}

//------------------------------------------------------------------------------
vtkIdType vtkSubsurfaceScatteringPass::GetNumberOfLinkRuns()
{
  vtkIdType runs = 0;
  for (const auto& body : this->Bodies)
  {
    runs += body->Scattered->GetNumberOfLinkRuns();
  }
  return runs;
}

//------------------------------------------------------------------------------
vtkIdType vtkSubsurfaceScatteringPass::GetNumberOfScatteringRuns()
{
  vtkIdType runs = 0;
  for (const auto& body : this->Bodies)
  {
    runs += body->Scattered->GetNumberOfScatteringRuns();
  }
  return runs;
}

//------------------------------------------------------------------------------
// Those of actors that are drawn in this frame; others wait.
bool vtkSubsurfaceScatteringPass::UpdateMaps(const vtkRenderState* state)
{
  this->Bodies.erase(std::remove_if(this->Bodies.begin(), this->Bodies.end(),
                       [](const std::unique_ptr<Body>& body) { return !body->Actor; }),
    this->Bodies.end());
  bool isAnyThere = false;
  for (int index = 0; index < state->GetPropArrayCount(); ++index)
  {
    Body* body = this->FindBody(state->GetPropArray()[index]);
    if (!body)
    {
      continue;
    }
    isAnyThere = true;
    const bool isMapped = this->Update(*body, state->GetRenderer());
    if (isMapped != body->IsMapped)
    {
      body->IsMapped = isMapped;
      this->MapsModified();
    }
  }
  return isAnyThere;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScatteringPass::Update(Body& body, vtkRenderer* renderer)
{
  const double index = GetIndex(body.Scattered->GetMaterial());
  if (index != body.RefractiveIndex)
  {
    body.RefractiveIndex = index;
    body.MeanTransmittance = GetMeanTransmittanceAt(index);
  }
  body.Transmitted->SetLighting(this->Lighting);
  body.Transmitted->SetResolution(this->IrradianceMapSize);
  body.Transmitted->SetSamples(this->IrradianceSamples);
  body.Transmitted->SetShadows(this->Shadows);
  body.Transmitted->SetShadowMapSize(this->ShadowMapSize);
  body.Transmitted->SetRefractiveIndex(index);
  body.Scattered->SetResolution(this->ScatteredMapSize);
  return body.Transmitted->Update(body.Actor, renderer) && body.Scattered->Update(body.Transmitted);
}

//------------------------------------------------------------------------------
RadianceShader::Source vtkSubsurfaceScatteringPass::GetSource(vtkProp* prop)
{
  Body* body = this->FindBody(prop);
  return body && body->IsMapped ? RadianceShader::Source::Map : RadianceShader::Source::Array;
}

//------------------------------------------------------------------------------
// Active until another actor is drawn: mappers draw right after they have asked for this.
void vtkSubsurfaceScatteringPass::SetMap(vtkShaderProgram* program, vtkProp* prop,
  RadianceShader::Uniforms& uniforms)
{
  Body* body = this->FindBody(prop);
  AtlasDrawing* drawing = body->Transmitted->GetDrawing();
  if (!drawing)
  {
    return;
  }
  if (this->Bound != body)
  {
    this->LetGoOfMaps();
    this->Bound = body;
  }
  uniforms.RefractiveIndex = body->RefractiveIndex;
  uniforms.MeanTransmittance = body->MeanTransmittance;
  vtkTextureObject* points = drawing->GetPoints();
  points->Activate();
  program->SetUniformi("lightTransportPoints", points->GetTextureUnit());
  program->SetUniformi("lightTransportPointWidthBits", TupleTable::WidthBits);
  body->Scattered->GetTexture()->Activate(program, "lightTransportMap");
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::LetGoOfMaps()
{
  if (this->Bound)
  {
    this->Bound->LetGo();
    this->Bound = nullptr;
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->LetGoOfMaps();
  for (const auto& body : this->Bodies)
  {
    body->Transmitted->ReleaseGraphicsResources();
    body->Scattered->ReleaseGraphicsResources();
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
