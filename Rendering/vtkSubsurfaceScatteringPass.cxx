// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScatteringPass.h"

#include "Atlas/AtlasTexture.h"
#include "Maps/AtlasDrawing.h"
#include "Passes/BlockSurfaces.h"
#include "Passes/ExactShadows.h"
#include "Passes/MarchedScattering.h"
#include "Passes/RadianceShader.h"
#include "Passes/StandIns.h"
#include "Shared/ArrayNames.h"
#include "Shared/Attempt.h"
#include "Shared/Fresnel.h"
#include "Tracing/SceneTrees.h"
#include "vtkLightTransportPassesScatteringFS.h"
#include "vtkOpenGLAtlasTexture.h"
#include "vtkOpenGLScatteredMap.h"
#include "vtkOpenGLTransmittedMap.h"
#include "vtkSurfaceLighting.h"

#include "vtkActor.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTextureObject.h"
#include "vtkVersion.h"
#include "vtkWeakPointer.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScatteringPass);

namespace
{
constexpr double LargestIndex = 10.0;
constexpr Advice WithoutMemory = { "use surfaces of fewer triangles", "OpenGL gave up",
  "try a newer driver" };

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

/// An actor with a material, or a block of it, and its maps.
struct vtkSubsurfaceScatteringPass::Body
{
  vtkWeakPointer<vtkActor> Actor;
  int Block = 0;
  vtkWeakPointer<vtkActor>
    Drawn; ///< the actor, or what stands in for it; nullptr for a hidden block
  vtkNew<vtkOpenGLTransmittedMap> Transmitted;
  vtkNew<vtkOpenGLScatteredMap> Scattered;
  double RefractiveIndex = 1.0;
  double MeanTransmittance = 1.0;
  bool IsMapped = false;
  bool IsMarched = false;
  MarchedScattering::Medium Medium;
  std::string MediumProblem; ///< which has been told
  int Caster = -1;           ///< of the tree

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
    Lighting(vtkSmartPointer<vtkSurfaceLighting>::New()), Blocks(new StandIns),
    Trees(new SceneTrees), Shadowed(new ExactShadows), Marched(new MarchedScattering)
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
  os << indent << "DirectShadows: " << this->DirectShadows << "\n";
  os << indent << "SingleScattering: " << this->SingleScattering << "\n";
  os << indent << "SingleScatteringSteps: " << this->SingleScatteringSteps << "\n";
  os << indent << "ScatteredMapSize: " << this->ScatteredMapSize << "\n";
  os << indent << "NumberOfMaterials: " << this->GetNumberOfMaterials() << "\n";
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::Body* vtkSubsurfaceScatteringPass::FindBody(vtkProp* drawn)
{
  const auto found = std::find_if(this->Bodies.begin(), this->Bodies.end(),
    [drawn](const std::unique_ptr<Body>& body) { return body->Drawn.Get() == drawn; });
  return drawn && found != this->Bodies.end() ? found->get() : nullptr;
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::Body* vtkSubsurfaceScatteringPass::FindBody(vtkActor* actor, int block)
{
  const auto found = std::find_if(this->Bodies.begin(), this->Bodies.end(),
    [actor, block](const std::unique_ptr<Body>& body)
    { return body->Actor.Get() == actor && body->Block == block; });
  return actor && found != this->Bodies.end() ? found->get() : nullptr;
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::Body& vtkSubsurfaceScatteringPass::AddBody(vtkActor* actor, int block,
  vtkSubsurfaceScattering* material)
{
  Body* body = this->FindBody(actor, block);
  if (!body)
  {
    this->Bodies.push_back(std::make_unique<Body>());
    body = this->Bodies.back().get();
    body->Actor = actor;
    body->Block = block;
    body->Transmitted->ShareShadows(this->Bodies.front()->Transmitted);
  }
  body->Scattered->SetMaterial(material);
  return *body;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::RemoveBodies(vtkActor* actor, int firstBlock)
{
  this->Bodies.erase(std::remove_if(this->Bodies.begin(), this->Bodies.end(),
                       [actor, firstBlock](const std::unique_ptr<Body>& body)
                       { return body->Actor.Get() == actor && body->Block >= firstBlock; }),
    this->Bodies.end());
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::SetMaterial(vtkActor* actor, vtkSubsurfaceScattering* material)
{
  if (!actor || this->GetMaterial(actor) == material)
  {
    return;
  }
  this->RemoveBodies(actor, material ? 1 : 0);
  if (material)
  {
    this->AddBody(actor, 0, material).Drawn = actor;
  }
  this->MapsModified();
  this->Modified();
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering* vtkSubsurfaceScatteringPass::GetMaterial(vtkActor* actor)
{
  Body* body = this->FindBody(actor, 0);
  return body ? body->Scattered->GetMaterial() : nullptr;
}

//------------------------------------------------------------------------------
int vtkSubsurfaceScatteringPass::GetNumberOfMaterials()
{
  return static_cast<int>(std::count_if(this->Bodies.begin(), this->Bodies.end(),
    [](const std::unique_ptr<Body>& body) { return body->Actor && body->Block == 0; }));
}

//------------------------------------------------------------------------------
vtkOpenGLTransmittedMap* vtkSubsurfaceScatteringPass::GetTransmittedMap(vtkActor* actor, int block)
{
  Body* body = this->FindBody(actor, block);
  return body ? body->Transmitted.Get() : nullptr;
}

//------------------------------------------------------------------------------
vtkOpenGLScatteredMap* vtkSubsurfaceScatteringPass::GetScatteredMap(vtkActor* actor, int block)
{
  Body* body = this->FindBody(actor, block);
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
vtkIdType vtkSubsurfaceScatteringPass::GetNumberOfShadowRuns()
{
  return this->Trees->GetNumberOfRuns();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::TellOnce(const Outcome& done, std::string& told)
{
  if (done.HasFailed() && !done.GetMessage().empty() && done.GetMessage() != told)
  {
    vtkErrorMacro(<< done.GetMessage());
  }
  if (!done.HasFailed() || !done.GetMessage().empty())
  {
    told = done.GetMessage();
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::UpdateTree(vtkRenderer* renderer)
{
  const bool isMarched =
    this->SingleScattering != SINGLE_SCATTERING_OFF && this->Lighting->GetRendererLights();
  this->Tree = nullptr;
  this->WarnedOfUnshadowed = this->WarnedOfUnshadowed && this->DirectShadows;
  int lights = 0;
  if (this->DirectShadows || isMarched)
  {
    SceneTrees::Entry& entry = this->Trees->Get(renderer);
    Outcome done = Attempt([&]() { return entry.Tree.Update(renderer); }, WithoutMemory);
    this->Tree = entry.Tree.IsThere() ? &entry.Tree : nullptr;
    if (!this->Tree && !done.GetMessage().empty())
    {
      done = Outcome::Failed(std::string("Without ") +
        (this->DirectShadows ? "DirectShadows: " : "SingleScattering: ") + done.GetMessage());
    }
    if (this->Tree && this->DirectShadows)
    {
      done = this->Shadowed->Update(renderer, entry.Tree);
    }
    this->TellOnce(done, entry.Problem);
    if (this->Tree && isMarched)
    {
      this->TellOnce(this->Marched->Update(renderer, entry.Tree), entry.MarchProblem);
      lights = this->Marched->GetNumberOfLights();
    }
  }
  const bool areDrawn = this->Tree && this->DirectShadows;
  if (areDrawn != this->AreShadowsDrawn || lights != this->MarchedLights)
  {
    this->AreShadowsDrawn = areDrawn;
    this->MarchedLights = lights;
    this->MapsModified();
  }
}

//------------------------------------------------------------------------------
// What is added to a map needs that.
void vtkSubsurfaceScatteringPass::UpdateMarched(Body& body, bool isMapped)
{
  auto* mapper = body.Drawn ? vtkPolyDataMapper::SafeDownCast(body.Drawn->GetMapper()) : nullptr;
  body.Caster =
    this->MarchedLights > 0 && mapper ? this->Tree->FindBody(body.Actor, mapper->GetInput()) : -1;
  bool isMarched =
    body.Caster >= 0 && (isMapped || this->SingleScattering == SINGLE_SCATTERING_ONLY);
  if (isMarched)
  {
    const Outcome made = MarchedScattering::MakeMedium(body.Scattered->GetMaterial(),
      body.Actor->GetMatrix(), body.Medium);
    this->TellOnce(made, body.MediumProblem);
    isMarched = static_cast<bool>(made);
  }
  if (isMarched != body.IsMarched)
  {
    body.IsMarched = isMarched;
    this->MapsModified();
  }
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScatteringPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper,
  vtkProp* prop)
{
  if (this->AreShadowsDrawn)
  {
    ExactShadows::MarkPlace(fragmentShader);
  }
  return this->Superclass::PreReplaceShaderValues(vertexShader, geometryShader, fragmentShader,
    mapper, prop);
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScatteringPass::PostReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper,
  vtkProp* prop)
{
  if (this->AreShadowsDrawn)
  {
    bool& isFilled = this->Shadowable[vtkActor::SafeDownCast(prop)];
    isFilled = ExactShadows::FillPlace(fragmentShader) || isFilled;
  }
  this->Superclass::PostReplaceShaderValues(vertexShader, geometryShader, fragmentShader, mapper,
    prop);
  Body* body = this->FindBody(prop);
  if (body && body->IsMarched)
  {
    this->Marched->Write(fragmentShader);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScatteringPass::SetShaderParameters(vtkShaderProgram* program,
  vtkAbstractMapper* mapper, vtkProp* prop, vtkOpenGLVertexArrayObject* vao)
{
  if (this->Tree && ExactShadows::IsUsedBy(program))
  {
    this->Tree->Activate(program);
    this->IsTreeActive = true;
    this->Shadowed->SetUniforms(program);
  }
  return this->Superclass::SetShaderParameters(program, mapper, prop, vao);
}

//------------------------------------------------------------------------------
// Those of actors that are drawn in this frame; others wait.
bool vtkSubsurfaceScatteringPass::UpdateMaps(const vtkRenderState* state)
{
  this->RemoveBodies(nullptr, 0);
  this->UpdateTree(state->GetRenderer());
  bool isAnyThere = false;
  for (int index = 0; index < state->GetPropArrayCount(); ++index)
  {
    auto* actor = vtkActor::SafeDownCast(state->GetPropArray()[index]);
    if (!this->GetMaterial(actor))
    {
      continue;
    }
    isAnyThere = true;
    this->FindDrawn(actor);
    for (const std::unique_ptr<Body>& body : this->Bodies)
    {
      if (body->Actor != actor)
      {
        continue;
      }
      const bool isMapped = body->Drawn && this->SingleScattering != SINGLE_SCATTERING_ONLY &&
        this->Update(*body, state->GetRenderer());
      if (isMapped != body->IsMapped)
      {
        body->IsMapped = isMapped;
        this->MapsModified();
      }
      this->UpdateMarched(*body, isMapped);
    }
  }
  return isAnyThere || this->DirectShadows;
}

//------------------------------------------------------------------------------
// A body for each block, drawn by an actor that stands in for it.
void vtkSubsurfaceScatteringPass::FindDrawn(vtkActor* actor)
{
  std::vector<BlockSurface> blocks;
  if (!FindBlockSurfaces(actor->GetMapper(), blocks))
  {
    this->RemoveBodies(actor, 1);
    this->FindBody(actor, 0)->Drawn = actor;
    return;
  }
  this->RemoveBodies(actor, std::max(static_cast<int>(blocks.size()), 1));
  this->FindBody(actor, 0)->Drawn = nullptr;
  for (int index = 0; index < static_cast<int>(blocks.size()); ++index)
  {
    const BlockSurface& block = blocks[static_cast<std::size_t>(index)];
    Body& body = this->AddBody(actor, index, this->GetMaterial(actor));
    vtkActor* standIn = this->Blocks->Get(actor, block.Surface, StandIns::Unmoved, index);
    body.Drawn = block.IsVisible ? standIn : nullptr;
    if (block.HasOpacity || block.HasColor)
    {
      vtkNew<vtkProperty> property;
      property->DeepCopy(actor->GetProperty());
      property->SetOpacity(block.HasOpacity ? block.Opacity : property->GetOpacity());
      if (block.HasColor)
      {
        property->SetColor(block.Color[0], block.Color[1], block.Color[2]);
      }
      standIn->SetProperty(property);
    }
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::ReplaceProps(const vtkRenderState*, std::vector<vtkProp*>& props)
{
  std::vector<vtkProp*> drawn;
  for (vtkProp* prop : props)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    int block = 0;
    for (Body* body = this->FindBody(actor, block); body; body = this->FindBody(actor, ++block))
    {
      if (body->Drawn)
      {
        drawn.push_back(body->Drawn);
      }
    }
    if (block == 0)
    {
      drawn.push_back(prop);
    }
  }
  props.swap(drawn);
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
  return body.Transmitted->Update(body.Drawn, renderer) && body.Scattered->Update(body.Transmitted);
}

//------------------------------------------------------------------------------
RadianceShader::Source vtkSubsurfaceScatteringPass::GetSource(vtkProp* prop)
{
  Body* body = this->FindBody(prop);
  if (body && body->IsMapped)
  {
    return RadianceShader::Source::Map;
  }
  return body && body->IsMarched ? RadianceShader::Source::Empty : RadianceShader::Source::Array;
}

//------------------------------------------------------------------------------
// Active until another actor is drawn: mappers draw right after they have asked for this.
void vtkSubsurfaceScatteringPass::SetMap(vtkShaderProgram* program, vtkProp* prop,
  RadianceShader::Uniforms& uniforms)
{
  Body* body = this->FindBody(prop);
  if (body->IsMarched && this->Tree)
  {
    uniforms.RefractiveIndex = body->Medium.RefractiveIndex;
    this->Tree->Activate(program);
    this->IsTreeActive = true;
    this->Marched->SetUniforms(program, body->Medium, body->Caster, this->SingleScatteringSteps);
  }
  AtlasDrawing* drawing = body->IsMapped ? body->Transmitted->GetDrawing() : nullptr;
  if (!drawing)
  {
    return;
  }
  if (this->Bound != body)
  {
    this->LetGoOfBody();
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
  this->LetGoOfBody();
  if (this->IsTreeActive)
  {
    this->Tree->Deactivate();
    this->IsTreeActive = false;
  }
  this->WarnOfUnshadowed();
}

//------------------------------------------------------------------------------
// Of an actor's shaders those of its lines need not be lit.
void vtkSubsurfaceScatteringPass::WarnOfUnshadowed()
{
  const bool isAny = std::any_of(this->Shadowable.begin(), this->Shadowable.end(),
    [this](const auto& entry) { return !entry.second && this->Shadowed->IsShaded(entry.first); });
  this->Shadowable.clear();
  if (isAny && !this->WarnedOfUnshadowed)
  {
    this->WarnedOfUnshadowed = true;
    vtkWarningMacro("An actor is drawn without DirectShadows: its shaders have no light by the "
                    "names that VTK gives it. Take away what replaces the lighting in its shaders; "
                    "where nothing does, this VTK ("
      << vtkVersion::GetVTKVersion() << ") names it otherwise.");
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::LetGoOfBody()
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
  this->Trees->Release(window);
  this->Tree = nullptr;
  for (const auto& body : this->Bodies)
  {
    body->Transmitted->ReleaseGraphicsResources();
    body->Scattered->ReleaseGraphicsResources();
  }
  this->Blocks->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}
