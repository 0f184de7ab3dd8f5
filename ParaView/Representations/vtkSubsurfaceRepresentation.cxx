// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceRepresentation.h"

#include "vtkSubsurfaceScattering.h"
#include "vtkSubsurfaceScatteringPass.h"

#include "vtkCameraPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkLightsPass.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOverlayPass.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"

#include <algorithm>

vtkStandardNewMacro(vtkSubsurfaceRepresentation);

/// One for all bodies of a view: in place of what ParaView draws with after it has set the camera,
/// which is the renderer's own way and looks at no pass.
class vtkSubsurfaceRepresentation::ViewPass : public vtkSubsurfaceScatteringPass
{
public:
  static ViewPass* New() { VTK_STANDARD_NEW_BODY(ViewPass); }
  vtkTypeMacro(ViewPass, vtkSubsurfaceScatteringPass);

  /// That of the renderer, which is put there where there is none. nullptr where the renderer has
  /// passes that are not known.
  static ViewPass* Get(vtkRenderer* renderer);

  /// Puts back what was there before.
  void Leave(vtkRenderer* renderer);

private:
  vtkWeakPointer<vtkCameraPass> Camera;
  vtkSmartPointer<vtkRenderPass> Replaced;
};

namespace
{
constexpr double ShortestPath = 1e-3;
constexpr double LongestPath = 1e3;
constexpr double LargestAlbedo = 0.99999;

//------------------------------------------------------------------------------
bool IsRenderedInParts()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

//------------------------------------------------------------------------------
vtkRenderPass* GetNext(vtkRenderPass* pass)
{
  auto* camera = vtkCameraPass::SafeDownCast(pass);
  auto* image = vtkImageProcessingPass::SafeDownCast(pass);
  vtkRenderPass* ofImage = image ? image->GetDelegatePass() : nullptr;
  return camera ? camera->GetDelegatePass() : ofImage;
}
} // namespace

//------------------------------------------------------------------------------
vtkSubsurfaceRepresentation::ViewPass* vtkSubsurfaceRepresentation::ViewPass::Get(
  vtkRenderer* renderer)
{
  vtkCameraPass* camera = nullptr;
  for (vtkRenderPass* pass = renderer->GetPass(); pass; pass = GetNext(pass))
  {
    if (auto* own = ViewPass::SafeDownCast(pass))
    {
      return own;
    }
    auto* found = vtkCameraPass::SafeDownCast(pass);
    camera = found ? found : camera;
  }
  if (renderer->GetPass() && !camera)
  {
    return nullptr;
  }
  vtkNew<ViewPass> own;
  if (camera)
  {
    own->Camera = camera;
    own->Replaced = camera->GetDelegatePass();
    vtkNew<vtkRenderPassCollection> steps;
    steps->AddItem(vtkNew<vtkLightsPass>());
    steps->AddItem(vtkNew<vtkOpaquePass>());
    steps->AddItem(vtkNew<vtkTranslucentPass>());
    steps->AddItem(vtkNew<vtkVolumetricPass>());
    steps->AddItem(vtkNew<vtkOverlayPass>());
    vtkNew<vtkSequencePass> sequence;
    sequence->SetPasses(steps);
    own->SetDelegatePass(sequence);
    camera->SetDelegatePass(own);
  }
  else
  {
    renderer->SetPass(own);
  }
  return own;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::ViewPass::Leave(vtkRenderer* renderer)
{
  if (this->Camera && this->Camera->GetDelegatePass() == this)
  {
    this->Camera->SetDelegatePass(this->Replaced);
  }
  else if (renderer && renderer->GetPass() == this)
  {
    renderer->SetPass(nullptr);
  }
}

//------------------------------------------------------------------------------
vtkSubsurfaceRepresentation::vtkSubsurfaceRepresentation()
{
  this->Scattering->SetLinkMethodToAdaptive();
  this->SetCoefficients();
}

//------------------------------------------------------------------------------
vtkSubsurfaceRepresentation::~vtkSubsurfaceRepresentation()
{
  this->Detach();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MeanFreePath: " << this->MeanFreePath << "\n";
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "AlbedoColor: " << this->AlbedoColor[0] << " " << this->AlbedoColor[1] << " "
     << this->AlbedoColor[2] << "\n";
  os << indent << "IrradianceMapSize: " << this->IrradianceMapSize << "\n";
  os << indent << "ScatteredMapSize: " << this->ScatteredMapSize << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "CastShadows: " << this->CastShadows << "\n";
  os << indent << "DirectShadows: " << this->DirectShadows << "\n";
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetMeanFreePath(double length)
{
  this->MeanFreePath = std::min(std::max(length, ShortestPath), LongestPath);
  this->SetCoefficients();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetAlbedo(double albedo)
{
  this->Albedo = std::min(std::max(albedo, 0.0), LargestAlbedo);
  this->SetCoefficients();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetAlbedoColor(double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  std::transform(color, color + 3, this->AlbedoColor,
    [](double value) { return std::min(std::max(value, 0.0), 1.0); });
  this->SetCoefficients();
}

//------------------------------------------------------------------------------
// What changes nothing leaves the filter's time as it is, and with it the links.
void vtkSubsurfaceRepresentation::SetCoefficients()
{
  double scattering[3];
  double absorption[3];
  for (int band = 0; band < 3; ++band)
  {
    const double albedo = this->Albedo * this->AlbedoColor[band];
    scattering[band] = albedo / this->MeanFreePath;
    absorption[band] = (1.0 - albedo) / this->MeanFreePath;
  }
  this->Scattering->SetScatteringCoefficient(scattering);
  this->Scattering->SetAbsorptionCoefficient(absorption);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetMillimetersPerUnit(double millimeters)
{
  this->Scattering->SetMillimetersPerUnit(millimeters);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetRefractiveIndex(double index)
{
  this->Scattering->SetRefractiveIndex(index);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetNumberOfLinks(int links)
{
  this->Scattering->SetNumberOfLinks(links);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetIrradianceMapSize(int size)
{
  this->IrradianceMapSize = size;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetScatteredMapSize(int size)
{
  this->ScatteredMapSize = size;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetExposure(double exposure)
{
  this->Exposure = exposure;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetCastShadows(bool shadows)
{
  this->CastShadows = shadows;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetDirectShadows(bool shadows)
{
  this->DirectShadows = shadows;
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass* vtkSubsurfaceRepresentation::GetPass()
{
  return this->Pass;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  this->Renderer = renderView ? renderView->GetRenderer() : nullptr;
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceRepresentation::RemoveFromView(vtkView* view)
{
  this->Detach();
  this->Renderer = nullptr;
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  if (!visible)
  {
    this->Detach();
  }
}

//------------------------------------------------------------------------------
int vtkSubsurfaceRepresentation::ProcessViewRequest(vtkInformationRequestKey* request,
  vtkInformation* input, vtkInformation* output)
{
  const int done = this->Superclass::ProcessViewRequest(request, input, output);
  if (done && request == vtkPVView::REQUEST_RENDER())
  {
    this->Attach();
  }
  return done;
}

//------------------------------------------------------------------------------
// Each time: the view sets its own passes anew where settings change.
void vtkSubsurfaceRepresentation::Attach()
{
  if (!this->Renderer || !this->GetVisibility())
  {
    return;
  }
  if (IsRenderedInParts())
  {
    this->Detach();
    this->WarnOnce(
      "Drawn as usual: several ranks have a part of the surface each. Apply the filter "
      "Subsurface Scattering, and color by its array.");
    return;
  }
  ViewPass* pass = ViewPass::Get(this->Renderer);
  if (!pass)
  {
    this->Detach();
    this->WarnOnce("Drawn as usual: the view has render passes of its own. Switch them off.");
    return;
  }
  this->Pass = pass;
  pass->SetIrradianceMapSize(this->IrradianceMapSize);
  pass->SetScatteredMapSize(this->ScatteredMapSize);
  pass->SetExposure(this->Exposure);
  pass->SetShadows(this->CastShadows);
  pass->SetDirectShadows(this->DirectShadows);
  pass->SetMaterial(this->Actor, this->Scattering);
  this->TakeColors();
}

//------------------------------------------------------------------------------
// Light that has been scattered takes their place, until the surface is drawn as usual again.
void vtkSubsurfaceRepresentation::TakeColors()
{
  const double ambient = this->Property->GetAmbient();
  const double diffuse = this->Property->GetDiffuse();
  this->UsualAmbient = ambient > 0.0 ? ambient : this->UsualAmbient;
  this->UsualDiffuse = diffuse > 0.0 ? diffuse : this->UsualDiffuse;
  this->Property->SetAmbient(0.0);
  this->Property->SetDiffuse(0.0);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceRepresentation::WarnOnce(const char* message)
{
  if (!this->HasWarned)
  {
    vtkWarningMacro(<< message);
  }
  this->HasWarned = true;
}

//------------------------------------------------------------------------------
// The last one leaves the view as it was.
void vtkSubsurfaceRepresentation::Detach()
{
  if (!this->Pass)
  {
    return;
  }
  this->Pass->SetMaterial(this->Actor, nullptr);
  if (this->Pass->GetNumberOfMaterials() == 0)
  {
    this->Pass->Leave(this->Renderer);
  }
  this->Pass = nullptr;
  this->Property->SetAmbient(this->UsualAmbient);
  this->Property->SetDiffuse(this->UsualDiffuse);
}
