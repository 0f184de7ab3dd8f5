// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include <cstdlib>

namespace LightTransport
{
//------------------------------------------------------------------------------
std::unique_ptr<OffScreenContext> OffScreenContext::Create(std::string& reason)
{
  const char* variable = std::getenv("VTK_DEFAULT_OPENGL_WINDOW");
  const std::string choice = variable ? variable : "";
  if (choice == "vtkEGLRenderWindow")
  {
    return OffScreenContext::CreateEGL(reason);
  }
  if (choice == "vtkOSOpenGLRenderWindow")
  {
    return OffScreenContext::CreateOSMesa(reason);
  }
  // Windows on a screen that VTK 9.4 knows by name: they say nothing about work off the screen.
  if (!choice.empty() && choice != "vtkXOpenGLRenderWindow" &&
    choice != "vtkWin32OpenGLRenderWindow" && choice != "vtkCocoaRenderWindow")
  {
    reason = "VTK_DEFAULT_OPENGL_WINDOW is \"" + choice +
      "\": set it to vtkEGLRenderWindow or vtkOSOpenGLRenderWindow, or unset it.";
    return nullptr;
  }
  std::string reasonEGL;
  auto context = OffScreenContext::CreateEGL(reasonEGL);
  if (!context)
  {
    std::string reasonOSMesa;
    context = OffScreenContext::CreateOSMesa(reasonOSMesa);
    reason = context ? "" : reasonEGL + " " + reasonOSMesa;
  }
  return context;
}
} // namespace LightTransport
