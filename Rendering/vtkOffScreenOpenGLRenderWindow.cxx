// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOffScreenOpenGLRenderWindow.h"

#include "Context/CurrentOpenGLContext.h"
#include "Context/HardwareRenderer.h"
#include "Context/OffScreenContext.h"
#include "Context/OpenGLFunctions.h"

#include "vtkGenericRenderWindowInteractor.h"
#include "vtkObjectFactory.h"
#include "vtkObjectFactoryCollection.h"
#include "vtkOpenGLState.h"
#include "vtkRendererCollection.h"
#include "vtkVersion.h"

#include <vector>

using namespace LightTransport;

#ifndef VTK_FUTURE_CONST
#define VTK_FUTURE_CONST
#endif

namespace
{
VTK_CREATE_CREATE_FUNCTION(vtkOffScreenOpenGLRenderWindow);
VTK_CREATE_CREATE_FUNCTION(vtkGenericRenderWindowInteractor);

/// Gives windows and interactors that need no display.
class OffScreenFactory : public vtkObjectFactory
{
public:
  static OffScreenFactory* New();
  vtkTypeMacro(OffScreenFactory, vtkObjectFactory);

  const char* GetVTKSourceVersion() VTK_FUTURE_CONST override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() VTK_FUTURE_CONST override { return "windows without a display"; }

protected:
  OffScreenFactory()
  {
    this->RegisterOverride("vtkRenderWindow", "vtkOffScreenOpenGLRenderWindow", "off-screen", 1,
      vtkObjectFactoryCreatevtkOffScreenOpenGLRenderWindow);
    this->RegisterOverride("vtkRenderWindowInteractor", "vtkGenericRenderWindowInteractor",
      "off-screen", 1, vtkObjectFactoryCreatevtkGenericRenderWindowInteractor);
  }
};
vtkStandardNewMacro(OffScreenFactory);

/// The first factory that answers wins, and this one comes last: the others are told to keep quiet.
void DisableOtherOverrides(const char* className)
{
  vtkObjectFactoryCollection* factories = vtkObjectFactory::GetRegisteredFactories();
  vtkCollectionSimpleIterator iterator;
  factories->InitTraversal(iterator);
  while (vtkObjectFactory* factory = factories->GetNextObjectFactory(iterator))
  {
    if (!OffScreenFactory::SafeDownCast(factory))
    {
      factory->Disable(className);
    }
  }
}
} // namespace

struct vtkOffScreenOpenGLRenderWindow::OffScreenState
{
  std::unique_ptr<OffScreenContext> Context;
  std::vector<CurrentOpenGLContext> PushedContexts;
  std::string DeviceName;
  bool Complained = false;
};

vtkStandardNewMacro(vtkOffScreenOpenGLRenderWindow);

//------------------------------------------------------------------------------
vtkOffScreenOpenGLRenderWindow::vtkOffScreenOpenGLRenderWindow() : OffScreen(new OffScreenState)
{
  this->SetOffScreenRendering(1);
  this->FrameBlitMode = NoBlit;
  this->Mapped = 1;
  this->ScreenSize[0] = 1920;
  this->ScreenSize[1] = 1080;
}

//------------------------------------------------------------------------------
vtkOffScreenOpenGLRenderWindow::~vtkOffScreenOpenGLRenderWindow()
{
  this->Finalize();
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
  {
    renderer->SetRenderWindow(nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BackendName: " << this->GetBackendName() << "\n";
  os << indent << "DeviceName: " << this->OffScreen->DeviceName << "\n";
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::IsAvailable(std::string& reason)
{
  std::unique_ptr<OffScreenContext> context;
  const Outcome created = OffScreenContext::Create(context);
  reason = created ? reason : created.GetMessage();
  return static_cast<bool>(created);
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::IsAvailable()
{
  return vtkOffScreenOpenGLRenderWindow::GetReasonWhyUnavailable().empty();
}

//------------------------------------------------------------------------------
std::string vtkOffScreenOpenGLRenderWindow::GetReasonWhyUnavailable()
{
  std::string reason;
  vtkOffScreenOpenGLRenderWindow::IsAvailable(reason);
  return reason;
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::RegisterAsDefault()
{
  static bool registered = false;
  if (!registered && vtkOffScreenOpenGLRenderWindow::IsAvailable())
  {
    registered = true;
    vtkNew<OffScreenFactory> factory;
    vtkObjectFactory::RegisterFactory(factory);
    DisableOtherOverrides("vtkRenderWindow");
    DisableOtherOverrides("vtkRenderWindowInteractor");
  }
  return registered;
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::Open(std::string& reason)
{
  Outcome created = Outcome::Done();
  if (!this->OffScreen->Context)
  {
    created = OffScreenContext::Create(this->OffScreen->Context);
  }
  if (!created || !this->OffScreen->Context->MakeCurrent())
  {
    reason = created ? "OpenGL: the context cannot be made current." : created.GetMessage();
    return false;
  }
  if (!this->Initialized)
  {
    this->OpenGLInitContext();
    if (!this->Initialized)
    {
      reason = "OpenGL: version 3.2 or later is needed (Debian: apt install libgl1-mesa-dri).";
      return false;
    }
    this->OpenGLInitState();
  }
  const auto* device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  this->OffScreen->DeviceName = device ? device : "";
  return true;
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::OpenGLInitContext()
{
  if (this->Initialized || !this->OffScreen->Context)
  {
    return;
  }
#ifdef GLEW_OK
  // GLEW loads all functions and then complains that there is no X display: its answer says nothing
  // here.
  glewInit();
  this->GlewInitValid = GLEW_VERSION_3_2 == GL_TRUE;
  this->Initialized = this->GlewInitValid;
  this->ContextCreationTime.Modified();
#else
  this->SetOpenGLSymbolLoader([](void* context, const char* name) -> VTKOpenGLAPIProc
    { return static_cast<OffScreenContext*>(context)->GetProcAddress(name); },
    this->OffScreen->Context.get());
  this->Superclass::OpenGLInitContext();
#endif
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::OpenGLInit()
{
  std::string reason;
  if (!this->Open(reason) && !this->OffScreen->Complained)
  {
    this->OffScreen->Complained = true;
    vtkErrorMacro("No OpenGL context: " << reason);
  }
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::Initialize()
{
  this->OpenGLInit();
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::Finalize()
{
  if (!this->OffScreen->Context)
  {
    return;
  }
  const bool wasCurrent = this->IsCurrent();
  const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
  this->MakeCurrent();
  this->ReleaseGraphicsResources(this);
  this->OffScreen->Context.reset();
  this->OffScreen->DeviceName.clear();
  if (!wasCurrent)
  {
    before.Restore();
  }
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::Start()
{
  this->OpenGLInit();
  if (this->Initialized)
  {
    this->Superclass::Start();
  }
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::Render()
{
  this->OpenGLInit();
  this->ReadyForRendering = this->Initialized;
  this->Superclass::Render();
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::MakeCurrent()
{
  if (this->OffScreen->Context)
  {
    this->OffScreen->Context->MakeCurrent();
  }
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    CurrentOpenGLContext::Release();
  }
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::IsCurrent()
{
  return this->OffScreen->Context && this->OffScreen->Context->IsCurrent();
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::PushContext()
{
  this->OffScreen->PushedContexts.push_back(CurrentOpenGLContext::Get());
  this->MakeCurrent();
}

//------------------------------------------------------------------------------
void vtkOffScreenOpenGLRenderWindow::PopContext()
{
  if (!this->OffScreen->PushedContexts.empty())
  {
    this->OffScreen->PushedContexts.back().Restore();
    this->OffScreen->PushedContexts.pop_back();
  }
}

//------------------------------------------------------------------------------
int vtkOffScreenOpenGLRenderWindow::SupportsOpenGL()
{
  std::string reason;
  return this->Open(reason) ? 1 : 0;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkOffScreenOpenGLRenderWindow::IsDirect()
{
  return this->IsHardware() ? 1 : 0;
}

//------------------------------------------------------------------------------
void* vtkOffScreenOpenGLRenderWindow::GetGenericContext()
{
  return this->OffScreen->Context ? this->OffScreen->Context->GetHandle() : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkOffScreenOpenGLRenderWindow::GetBackendName()
{
  return this->OffScreen->Context ? this->OffScreen->Context->GetBackendName() : "none";
}

//------------------------------------------------------------------------------
std::string vtkOffScreenOpenGLRenderWindow::GetDeviceName()
{
  return this->OffScreen->DeviceName;
}

//------------------------------------------------------------------------------
bool vtkOffScreenOpenGLRenderWindow::IsHardware()
{
  return IsHardwareRenderer(this->OffScreen->DeviceName);
}
