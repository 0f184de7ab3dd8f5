// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportPass.h"

#include "vtkLightTransportPassesDecFS.h"
#include "vtkLightTransportPassesDecGS.h"
#include "vtkLightTransportPassesDecVS.h"
#include "vtkLightTransportPassesFacetNormalFS.h"
#include "vtkLightTransportPassesImplGS.h"
#include "vtkLightTransportPassesImplVS.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkWeakPointer.h"

#include <map>

namespace
{
const char* const Attribute = "lightTransportMC";

/// Put `text` before the first `tag` of a shader, which stays.
void InsertBefore(std::string& shader, const std::string& tag, const std::string& text)
{
  vtkShaderProgram::Substitute(shader, tag, text + "\n" + tag, false);
}
} // namespace

struct vtkTransportPass::Internals
{
  struct Drawing
  {
    vtkWeakPointer<vtkPolyDataMapper> Mapper;
    std::string ArrayName;
    int Components = 0;
  };
  /// The mappers that have been given the array, by address; entries of mappers that have died are
  /// dropped.
  std::map<const void*, Drawing> Drawings;
  vtkTimeStamp ShaderTime;
  bool Parallel = false;
  bool Warned = false;
};

//------------------------------------------------------------------------------
vtkTransportPass::vtkTransportPass(const std::string& arrayName)
  : ArrayName(arrayName), DelegatePass(vtkSmartPointer<vtkRenderStepsPass>::New()),
    Self(new Internals)
{
}

//------------------------------------------------------------------------------
vtkTransportPass::~vtkTransportPass()
{
  this->DetachArrays();
}

//------------------------------------------------------------------------------
void vtkTransportPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "OutputEncoding: " << this->OutputEncoding << "\n";
  os << indent << "DelegatePass: " << this->DelegatePass.Get() << "\n";
}

//------------------------------------------------------------------------------
void vtkTransportPass::SetArrayName(const std::string& name)
{
  if (this->ArrayName != name)
  {
    this->ArrayName = name;
    this->Self->Warned = false;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkTransportPass::SetDelegatePass(vtkRenderPass* pass)
{
  if (this->DelegatePass != pass)
  {
    this->DelegatePass = pass;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderPass* vtkTransportPass::GetDelegatePass()
{
  return this->DelegatePass;
}

//------------------------------------------------------------------------------
void vtkTransportPass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("Nothing is drawn: there is no delegate pass.");
    return;
  }
  this->Self->Parallel = state->GetRenderer()->GetActiveCamera()->GetParallelProjection() != 0;
  this->AttachArrays(state);
  this->PreRender(state);
  this->DelegatePass->Render(state);
  this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
  this->PostRender(state);
}

//------------------------------------------------------------------------------
void vtkTransportPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->DetachArrays();
  if (this->DelegatePass)
  {
    this->DelegatePass->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
int vtkTransportPass::FindComponents(vtkPolyDataMapper* mapper)
{
  if (mapper->IsA("vtkCompositePolyDataMapper") || mapper->IsA("vtkCompositePolyDataMapper2") ||
    mapper->GetNumberOfInputConnections(0) == 0)
  {
    return 0;
  }
  mapper->Update();
  vtkPolyData* input = mapper->GetInput();
  vtkDataArray* array = input ? input->GetPointData()->GetArray(this->ArrayName.c_str()) : nullptr;
  const int components = array ? array->GetNumberOfComponents() : 0;
  return components == 1 || components == 3 || components == 4 ? components : 0;
}

//------------------------------------------------------------------------------
void vtkTransportPass::AttachArrays(const vtkRenderState* state)
{
  auto& drawings = this->Self->Drawings;
  for (auto entry = drawings.begin(); entry != drawings.end();)
  {
    entry = entry->second.Mapper ? std::next(entry) : drawings.erase(entry);
  }
  bool found = false;
  for (int index = 0; index < state->GetPropArrayCount(); ++index)
  {
    auto* actor = vtkActor::SafeDownCast(state->GetPropArray()[index]);
    auto* mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    if (!mapper)
    {
      continue;
    }
    const int components = this->FindComponents(mapper);
    found = found || components > 0;
    Internals::Drawing& drawing = drawings[mapper];
    if (components == drawing.Components && drawing.ArrayName == this->ArrayName)
    {
      continue;
    }
    // Mapping an array makes the mapper upload everything anew, so it is done once.
    if (drawing.Components > 0)
    {
      mapper->RemoveVertexAttributeMapping(Attribute);
    }
    if (components > 0)
    {
      mapper->MapDataArrayToVertexAttribute(Attribute, this->ArrayName.c_str(),
        vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
    }
    drawing = { mapper, this->ArrayName, components };
    this->Self->ShaderTime.Modified();
  }
  if (!found && !this->Self->Warned)
  {
    vtkWarningMacro("No visible actor has a point array \""
      << this->ArrayName << "\" of 1 or 3 components: everything is drawn as usual. Run the filter "
      << "that computes it, or set ArrayName.");
  }
  this->Self->Warned = !found;
}

//------------------------------------------------------------------------------
void vtkTransportPass::DetachArrays()
{
  for (auto& entry : this->Self->Drawings)
  {
    if (entry.second.Mapper && entry.second.Components > 0)
    {
      entry.second.Mapper->RemoveVertexAttributeMapping(Attribute);
    }
  }
  this->Self->Drawings.clear();
  this->Self->ShaderTime.Modified();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTransportPass::GetShaderStageMTime()
{
  return this->Self->ShaderTime.GetMTime();
}

//------------------------------------------------------------------------------
bool vtkTransportPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp*)
{
  const auto drawing = this->Self->Drawings.find(mapper);
  if (drawing == this->Self->Drawings.end() || drawing->second.Components == 0)
  {
    return true;
  }
  // Only places are marked here: what is written there depends on what the mapper writes around
  // them.
  InsertBefore(vertexShader, "//VTK::PositionVC::Dec", "//VTK::LightTransport::Dec");
  InsertBefore(vertexShader, "//VTK::PositionVC::Impl", "//VTK::LightTransport::Impl");
  InsertBefore(geometryShader, "//VTK::PositionVC::Dec", vtkLightTransportPassesDecGS);
  InsertBefore(geometryShader, "//VTK::PositionVC::Impl", vtkLightTransportPassesImplGS);
  InsertBefore(fragmentShader, "//VTK::PositionVC::Dec", "//VTK::LightTransport::Dec");
  InsertBefore(fragmentShader, "//VTK::DepthPeeling::Impl", "//VTK::LightTransport::Impl");
  return true;
}

//------------------------------------------------------------------------------
bool vtkTransportPass::PostReplaceShaderValues(std::string& vertexShader, std::string&,
  std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp*)
{
  const auto drawing = this->Self->Drawings.find(mapper);
  if (drawing == this->Self->Drawings.end() || drawing->second.Components == 0)
  {
    return true;
  }
  std::string declarations = vtkLightTransportPassesDecVS;
  if (vertexShader.find("uniform mat4 MCVCMatrix;") == std::string::npos)
  {
    declarations += "uniform mat4 MCVCMatrix;\n";
  }
  vtkShaderProgram::Substitute(vertexShader, "//VTK::LightTransport::Dec", declarations);
  vtkShaderProgram::Substitute(vertexShader, "//VTK::LightTransport::Impl",
    vtkLightTransportPassesImplVS);

  const bool hasNormal = fragmentShader.find("vec3 normalVCVSOutput =") != std::string::npos;
  std::string step = hasNormal ? "  vec3 lightTransportNormal = normalVCVSOutput;\n"
                               : vtkLightTransportPassesFacetNormalFS;
  step += this->GetFragmentShader();
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::LightTransport::Dec",
    vtkLightTransportPassesDecFS);
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::LightTransport::Impl", step);
  return true;
}

//------------------------------------------------------------------------------
bool vtkTransportPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper,
  vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  const auto drawing = this->Self->Drawings.find(mapper);
  if (drawing == this->Self->Drawings.end() || drawing->second.Components == 0)
  {
    return true;
  }
  auto* actor = vtkActor::SafeDownCast(prop);
  // VTK's physically based shading is the one that writes encoded colours.
  const bool encoded = actor && actor->GetProperty()->GetInterpolation() == VTK_PBR &&
    actor->GetProperty()->GetLighting();
  const std::map<const char*, int> integers = { { "lightTransportComponents",
                                                  drawing->second.Components },
    { "lightTransportParallel", this->Self->Parallel ? 1 : 0 },
    { "lightTransportEncodeSRGB", this->OutputEncoding == OUTPUT_ENCODING_SRGB ? 1 : 0 },
    { "lightTransportShadingIsEncoded", encoded ? 1 : 0 } };
  for (const auto& uniform : integers)
  {
    program->SetUniformi(uniform.first, uniform.second);
  }
  program->SetUniformf("lightTransportExposure", static_cast<float>(this->Exposure));
  program->SetUniformf("lightTransportRefractiveIndex",
    static_cast<float>(this->GetFresnelIndex()));
  program->SetUniformf("lightTransportTransmittance",
    static_cast<float>(this->GetMeanTransmittance()));
  return true;
}
