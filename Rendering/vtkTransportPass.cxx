// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportPass.h"

#include "Passes/MappedArrays.h"
#include "Passes/RadianceShader.h"
#include "Shared/ArrayNames.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"

#include <algorithm>

using namespace LightTransport;

//------------------------------------------------------------------------------
vtkTransportPass::vtkTransportPass(const std::string& arrayName)
  : ArrayName(arrayName), DelegatePass(vtkSmartPointer<vtkRenderStepsPass>::New()),
    Arrays(new MappedArrays)
{
}

//------------------------------------------------------------------------------
vtkTransportPass::~vtkTransportPass() = default;

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
    this->Warned = false;
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
  this->Parallel = state->GetRenderer()->GetActiveCamera()->GetParallelProjection() != 0;
  const bool areMapsUsed = this->UpdateMaps(state);
  std::vector<vtkProp*> props(state->GetPropArray(),
    state->GetPropArray() + state->GetPropArrayCount());
  this->ReplaceProps(state, props);
  vtkRenderState drawn(state->GetRenderer());
  drawn.SetFrameBuffer(state->GetFrameBuffer());
  drawn.SetRequiredKeys(state->GetRequiredKeys());
  drawn.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
  this->MapArrays(&drawn, areMapsUsed);
  this->PreRender(&drawn);
  this->DelegatePass->Render(&drawn);
  this->LetGoOfMaps();
  this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
  this->PostRender(&drawn);
}

//------------------------------------------------------------------------------
void vtkTransportPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Arrays->Unmap();
  if (this->DelegatePass)
  {
    this->DelegatePass->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkTransportPass::MapArrays(const vtkRenderState* state, bool areMapsUsed)
{
  const auto getName = [this](vtkActor* actor) -> std::string
  {
    switch (this->GetSource(actor))
    {
      case RadianceShader::Source::Array:
        return this->ArrayName;
      case RadianceShader::Source::Groups:
        return ArrayNames::SmoothGroup;
      default:
        return {};
    }
  };
  const bool found = this->Arrays->Map(state, getName) || areMapsUsed;
  if (!found && !this->Warned)
  {
    vtkWarningMacro("No visible actor has a point array \""
      << this->ArrayName << "\" of 1 or 3 components: everything is drawn as usual. Run the filter "
      << "that computes it, or set ArrayName.");
  }
  this->Warned = !found;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTransportPass::GetShaderStageMTime()
{
  return std::max(this->Arrays->GetMTime(), this->MapsTime.GetMTime());
}

//------------------------------------------------------------------------------
RadianceShader::Source vtkTransportPass::GetSource(vtkProp*)
{
  return RadianceShader::Source::Array;
}

//------------------------------------------------------------------------------
RadianceShader::Source vtkTransportPass::FindSource(vtkAbstractMapper* mapper, vtkProp* prop)
{
  const RadianceShader::Source source = this->GetSource(prop);
  const bool needsArray =
    source == RadianceShader::Source::Array || source == RadianceShader::Source::Groups;
  return needsArray && this->Arrays->GetNumberOfComponents(mapper) == 0
    ? RadianceShader::Source::None
    : source;
}

//------------------------------------------------------------------------------
bool vtkTransportPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper,
  vtkProp* prop)
{
  if (this->FindSource(mapper, prop) != RadianceShader::Source::None)
  {
    RadianceShader::MarkPlaces(vertexShader, geometryShader, fragmentShader);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTransportPass::PostReplaceShaderValues(std::string& vertexShader, std::string&,
  std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop)
{
  const RadianceShader::Source source = this->FindSource(mapper, prop);
  if (source != RadianceShader::Source::None)
  {
    RadianceShader::FillPlaces(vertexShader, fragmentShader, this->GetFragmentShader(), source);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTransportPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper,
  vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  RadianceShader::Uniforms uniforms;
  uniforms.Components = this->Arrays->GetNumberOfComponents(mapper);
  const RadianceShader::Source source = this->FindSource(mapper, prop);
  if (source == RadianceShader::Source::None)
  {
    return true;
  }
  auto* actor = vtkActor::SafeDownCast(prop);
  uniforms.Parallel = this->Parallel;
  uniforms.EncodeSRGB = this->OutputEncoding == OUTPUT_ENCODING_SRGB;
  // VTK's physically based shading is the one that writes encoded colours.
  uniforms.ShadingIsEncoded = actor && actor->GetProperty()->GetInterpolation() == VTK_PBR &&
    actor->GetProperty()->GetLighting();
  uniforms.Exposure = this->Exposure;
  uniforms.RefractiveIndex = this->GetFresnelIndex();
  uniforms.MeanTransmittance = this->GetMeanTransmittance();
  if (source != RadianceShader::Source::Array)
  {
    this->SetMap(program, prop, uniforms);
  }
  RadianceShader::SetUniforms(program, uniforms);
  return true;
}
