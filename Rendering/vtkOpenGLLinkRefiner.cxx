// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLLinkRefiner.h"

#include "Context/OpenGLContextGuard.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "Device/DeviceWindow.h"
#include "Refinement/LinkRefinementGL.h"
#include "Textures/FloatTextures.h"

#include "vtkObjectFactory.h"

#include <optional>
#include <utility>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLLinkRefiner);

struct vtkOpenGLLinkRefiner::DeviceParts
{
  DeviceWindow Window;

  ///@{ Both or none are there.
  std::unique_ptr<FloatTextures> Engine;
  std::unique_ptr<LinkRefinementGL> Refinement;
  ///@}

  bool IsAlive() const { return this->Engine && this->Engine->IsAlive(); }
  void Clear();
  Outcome Initialize(std::shared_ptr<const Body> body);
  Outcome Refine(vtkIdType first, vtkIdType last, std::vector<Part>& parts);
};

//------------------------------------------------------------------------------
void vtkOpenGLLinkRefiner::DeviceParts::Clear()
{
  if (this->IsAlive())
  {
    const OpenGLContextGuard guard(this->Window.Get());
    this->Refinement->Release();
  }
  this->Refinement.reset();
  this->Engine.reset();
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLLinkRefiner::DeviceParts::Initialize(std::shared_ptr<const Body> body)
{
  this->Engine = std::make_unique<FloatTextures>(this->Window.Get());
  this->Refinement = std::make_unique<LinkRefinementGL>(*this->Engine);
  if (!this->Engine->IsAlive())
  {
    return Outcome::Failed("it cannot make floating-point textures");
  }
  const DeviceSession session(this->Window.Get());
  Outcome made = this->Refinement->Initialize(std::move(body));
  return made ? DeviceErrors::Check() : made;
}

//------------------------------------------------------------------------------
Outcome vtkOpenGLLinkRefiner::DeviceParts::Refine(vtkIdType first, vtkIdType last,
  std::vector<Part>& parts)
{
  std::optional<DeviceSession> session(this->Window.Get());
  const auto pause = [&]()
  {
    session.reset();
    vtkDeviceLinkRefiner::Beat();
    session.emplace(this->Window.Get());
  };
  Outcome refined = this->Refinement->Refine(first, last, pause, parts);
  return refined ? DeviceErrors::Check() : refined;
}

//------------------------------------------------------------------------------
vtkOpenGLLinkRefiner::vtkOpenGLLinkRefiner() : Device(new DeviceParts) {}

//------------------------------------------------------------------------------
vtkOpenGLLinkRefiner::~vtkOpenGLLinkRefiner()
{
  this->Device->Clear();
}

//------------------------------------------------------------------------------
void vtkOpenGLLinkRefiner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->GetDeviceName() << "\n";
  os << indent << "NumberOfTests: " << this->GetNumberOfTests() << "\n";
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkRefiner::Open(std::string& reason)
{
  const Outcome open = this->Device->Window.Open();
  reason = open ? reason : open.GetMessage();
  return static_cast<bool>(open);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkRefiner::IsHardware()
{
  return this->Device->Window.IsHardware();
}

//------------------------------------------------------------------------------
const char* vtkOpenGLLinkRefiner::GetDeviceName()
{
  return this->Device->Window.GetDeviceName().c_str();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLLinkRefiner::GetNumberOfTests()
{
  return this->Device->Refinement ? this->Device->Refinement->GetNumberOfTests() : 0;
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkRefiner::Initialize(std::shared_ptr<const Body> body, std::string& reason)
{
  this->Device->Clear();
  Outcome made = this->Device->Window.Open();
  if (made)
  {
    made = this->Device->Initialize(std::move(body));
  }
  if (!made)
  {
    reason = made.GetMessage();
    this->Device->Clear();
  }
  return static_cast<bool>(made);
}

//------------------------------------------------------------------------------
bool vtkOpenGLLinkRefiner::Refine(vtkIdType first, vtkIdType last, std::vector<Part>& parts,
  std::string& reason)
{
  if (!this->Device->IsAlive())
  {
    reason = "there is no body, or its window has gone";
    return false;
  }
  const Outcome refined = this->Device->Refine(first, last, parts);
  reason = refined ? reason : refined.GetMessage();
  return static_cast<bool>(refined);
}
