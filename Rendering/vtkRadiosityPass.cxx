// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosityPass.h"

#include "Passes/RadianceShader.h"
#include "Passes/StandIns.h"
#include "Solving/ProgressiveSolution.h"
#include "vtkLightTransportPassesRadiosityFS.h"

#include "vtkActor.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <numeric>

using namespace LightTransport;

vtkStandardNewMacro(vtkRadiosityPass);

/// A renderer that has been drawn, and its solution.
struct vtkRadiosityPass::Scene
{
  vtkWeakPointer<vtkRenderer> Renderer;
  ProgressiveSolution Solution;
  LightTransport::StandIns StandIns;
  LightTransport::StandIns Lines; ///< and vertices, of what takes part
  bool IsGrouped = false;         ///< of the last frame
  bool IsActive = false;          ///< the texture
};

//------------------------------------------------------------------------------
vtkRadiosityPass::vtkRadiosityPass() : vtkTransportPass("Radiosity") {}

//------------------------------------------------------------------------------
vtkRadiosityPass::~vtkRadiosityPass() = default;

//------------------------------------------------------------------------------
const char* vtkRadiosityPass::GetFragmentShader()
{
  return ::vtkLightTransportPassesRadiosityFS;
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::SetRadiosity(vtkRadiosity* radiosity)
{
  if (this->Radiosity != radiosity)
  {
    this->Radiosity = radiosity;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRadiosity* vtkRadiosityPass::GetRadiosity()
{
  return this->Radiosity;
}

//------------------------------------------------------------------------------
vtkRadiosityPass::Scene& vtkRadiosityPass::FindScene(vtkRenderer* renderer)
{
  this->Scenes.erase(std::remove_if(this->Scenes.begin(), this->Scenes.end(),
                       [](const std::unique_ptr<Scene>& scene) { return !scene->Renderer; }),
    this->Scenes.end());
  const auto found = std::find_if(this->Scenes.begin(), this->Scenes.end(),
    [renderer](const std::unique_ptr<Scene>& scene) { return scene->Renderer.Get() == renderer; });
  if (found != this->Scenes.end())
  {
    return **found;
  }
  this->Scenes.push_back(std::make_unique<Scene>());
  this->Scenes.back()->Renderer = renderer;
  return *this->Scenes.back();
}

//------------------------------------------------------------------------------
bool vtkRadiosityPass::UpdateMaps(const vtkRenderState* state)
{
  this->Drawn = nullptr;
  if (!this->Radiosity)
  {
    return false;
  }
  const double begin = vtkTimerLog::GetUniversalTime();
  this->Drawn = &this->FindScene(state->GetRenderer());
  ProgressiveSolution& solution = this->Drawn->Solution;
  const ProgressiveSolution::Settings settings = { this->Radiosity, this->Shadows,
    this->AmbientTerm };
  const Outcome done = solution.Update(state->GetRenderer(), settings, this->FrameBudget);
  if (done.HasFailed() && !done.GetMessage().empty())
  {
    vtkErrorMacro(<< done.GetMessage());
  }
  for (const std::string& warning : solution.TakeWarnings())
  {
    vtkWarningMacro(<< warning);
  }
  const bool isGrouped = solution.GetGroups() != nullptr;
  if (isGrouped != this->Drawn->IsGrouped)
  {
    this->Drawn->IsGrouped = isGrouped;
    this->MapsModified();
  }
  this->SolvingSeconds = vtkTimerLog::GetUniversalTime() - begin;
  return true;
}

//------------------------------------------------------------------------------
// An actor whose points have moved is drawn as usual until there is an estimate for it.
void vtkRadiosityPass::ReplaceProps(const vtkRenderState*, std::vector<vtkProp*>& props)
{
  if (!this->Drawn)
  {
    return;
  }
  std::vector<vtkProp*> drawn;
  for (vtkProp* prop : props)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    const auto shown = actor && this->IsShown(actor) ? this->Drawn->Solution.FindShown(actor)
                                                     : std::vector<ProgressiveSolution::Shown>();
    if (shown.empty())
    {
      drawn.push_back(prop);
    }
    for (std::size_t block = 0; block < shown.size(); ++block)
    {
      const auto number = static_cast<int>(block);
      drawn.push_back(
        this->Drawn->StandIns.Get(actor, shown[block].Surface, shown[block].Matrix, number));
      if (vtkActor* lines = this->Drawn->Lines.GetLines(actor, shown[block].Source, number))
      {
        drawn.push_back(lines);
      }
    }
  }
  props.swap(drawn);
}

//------------------------------------------------------------------------------
RadianceShader::Source vtkRadiosityPass::GetSource(vtkProp* prop)
{
  if (!this->Drawn)
  {
    return RadianceShader::Source::Array;
  }
  if (!this->Drawn->StandIns.Has(prop))
  {
    return RadianceShader::Source::None;
  }
  return this->Drawn->IsGrouped ? RadianceShader::Source::Groups : RadianceShader::Source::Array;
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::SetMap(vtkShaderProgram* program, vtkProp*, RadianceShader::Uniforms&)
{
  vtkTextureObject* groups = this->Drawn->Solution.GetGroups();
  if (groups)
  {
    groups->Activate();
    this->Drawn->IsActive = true;
    program->SetUniformi("lightTransportGroups", groups->GetTextureUnit());
    program->SetUniformi("lightTransportGroupWidthBits", GroupMeans::WidthBits);
  }
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::LetGoOfMaps()
{
  if (this->Drawn && this->Drawn->IsActive)
  {
    this->Drawn->IsActive = false;
    if (vtkTextureObject* groups = this->Drawn->Solution.GetGroups())
    {
      groups->Deactivate();
    }
  }
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::SetShown(vtkActor* actor, bool shown)
{
  if (actor && this->IsShown(actor) != shown)
  {
    this->Others.erase(std::remove_if(this->Others.begin(), this->Others.end(),
                         [actor](const vtkWeakPointer<vtkActor>& other)
                         { return !other || other.Get() == actor; }),
      this->Others.end());
    if (!shown)
    {
      this->Others.emplace_back(actor);
    }
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkRadiosityPass::IsShown(vtkActor* actor)
{
  return std::none_of(this->Others.begin(), this->Others.end(),
    [actor](const vtkWeakPointer<vtkActor>& other) { return other.Get() == actor; });
}

//------------------------------------------------------------------------------
bool vtkRadiosityPass::IsConverged()
{
  return !this->Radiosity ||
    (!this->Scenes.empty() &&
      std::all_of(this->Scenes.begin(), this->Scenes.end(),
        [](const std::unique_ptr<Scene>& scene) { return scene->Solution.IsConverged(); }));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkRadiosityPass::GetOutput(vtkActor* actor, int block)
{
  for (const auto& scene : this->Scenes)
  {
    if (vtkPolyData* output = scene->Solution.GetOutput(actor, block))
    {
      return output;
    }
    if (const std::string errors = scene->Solution.TakeErrors(); !errors.empty())
    {
      vtkErrorMacro(<< errors);
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiosityPass::GetNumberOfLinkRuns()
{
  return std::accumulate(this->Scenes.begin(), this->Scenes.end(), vtkIdType(0),
    [](vtkIdType runs, const std::unique_ptr<Scene>& scene)
    { return runs + scene->Solution.GetNumberOfLinkRuns(); });
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiosityPass::GetNumberOfLightRuns()
{
  return std::accumulate(this->Scenes.begin(), this->Scenes.end(), vtkIdType(0),
    [](vtkIdType runs, const std::unique_ptr<Scene>& scene)
    { return runs + scene->Solution.GetNumberOfLightRuns(); });
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiosityPass::GetNumberOfSolverRuns()
{
  return std::accumulate(this->Scenes.begin(), this->Scenes.end(), vtkIdType(0),
    [](vtkIdType runs, const std::unique_ptr<Scene>& scene)
    { return runs + scene->Solution.GetNumberOfSolverRuns(); });
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiosityPass::GetNumberOfShots()
{
  return std::accumulate(this->Scenes.begin(), this->Scenes.end(), vtkIdType(0),
    [](vtkIdType shots, const std::unique_ptr<Scene>& scene)
    { return shots + scene->Solution.GetNumberOfShots(); });
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRadiosityPass::GetNumberOfBytesRead()
{
  return std::accumulate(this->Scenes.begin(), this->Scenes.end(), vtkTypeInt64(0),
    [](vtkTypeInt64 bytes, const std::unique_ptr<Scene>& scene)
    { return bytes + scene->Solution.GetNumberOfBytesRead(); });
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->LetGoOfMaps();
  this->Drawn = nullptr;
  for (const auto& scene : this->Scenes)
  {
    scene->Solution.ReleaseGraphicsResources();
    scene->StandIns.ReleaseGraphicsResources(window);
    scene->Lines.ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Radiosity: " << this->Radiosity.Get() << "\n";
  os << indent << "FrameBudget: " << this->FrameBudget << "\n";
  os << indent << "AmbientTerm: " << this->AmbientTerm << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "SolvingSeconds: " << this->SolvingSeconds << "\n";
}
