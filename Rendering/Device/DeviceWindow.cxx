// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/DeviceWindow.h"

#include "Context/CurrentOpenGLContext.h"
#include "Context/HardwareRenderer.h"
#include "Device/SharedWindow.h"

#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
void DeviceWindow::SetUserWindow(vtkRenderWindow* window)
{
  this->UserWindow = vtkOpenGLRenderWindow::SafeDownCast(window);
  this->UsesUserWindow = window != nullptr;
}

//------------------------------------------------------------------------------
bool DeviceWindow::IsUserWindow(vtkRenderWindow* window) const
{
  return window == this->UserWindow.Get() && this->UsesUserWindow == (window != nullptr);
}

//------------------------------------------------------------------------------
vtkOpenGLRenderWindow* DeviceWindow::Get() const
{
  return this->UsesUserWindow ? this->UserWindow.Get() : this->SharedWindow.Get();
}

//------------------------------------------------------------------------------
Outcome DeviceWindow::Open()
{
  if (Outcome open = this->OpenWindow(); !open)
  {
    return open;
  }
  // Making the context of a window on a screen may abort the process, so that is left to the
  // window's owner.
  const std::string renderer = this->Get()->GetState()->GetRenderer();
  if (renderer.empty())
  {
    return Outcome::Failed(
      "OpenGL: the render window has no context yet; let it render once first.");
  }
  this->Hardware = IsHardwareRenderer(renderer);
  this->DeviceName = "OpenGL (" + renderer + ")";
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome DeviceWindow::OpenWindow()
{
  if (!this->UsesUserWindow)
  {
    return this->SharedWindow ? Outcome::Done() : GetSharedWindow(this->SharedWindow);
  }
  if (!this->UserWindow)
  {
    return Outcome::Failed("OpenGL: the render window is gone, or not an OpenGL window.");
  }
  auto* offScreen = vtkOffScreenOpenGLRenderWindow::SafeDownCast(this->UserWindow);
  if (!offScreen)
  {
    return Outcome::Done();
  }
  const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
  std::string reason;
  const bool open = offScreen->Open(reason);
  before.Restore();
  return open ? Outcome::Done() : Outcome::Failed(reason);
}
} // namespace LightTransport
