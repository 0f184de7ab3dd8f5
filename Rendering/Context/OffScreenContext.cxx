// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include <cstdlib>
#include <string>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome OffScreenContext::Create(std::unique_ptr<OffScreenContext>& context)
{
  const char* variable = std::getenv("VTK_DEFAULT_OPENGL_WINDOW");
  const std::string choice = variable ? variable : "";
  if (choice == "vtkEGLRenderWindow")
  {
    return OffScreenContext::CreateEGL(context);
  }
  if (choice == "vtkOSOpenGLRenderWindow")
  {
    return OffScreenContext::CreateOSMesa(context);
  }
  // Windows on a screen that VTK 9.4 knows by name: they say nothing about work off the screen.
  if (!choice.empty() && choice != "vtkXOpenGLRenderWindow" &&
    choice != "vtkWin32OpenGLRenderWindow" && choice != "vtkCocoaRenderWindow")
  {
    return Outcome::Failed("VTK_DEFAULT_OPENGL_WINDOW is \"" + choice +
      "\": set it to vtkEGLRenderWindow or vtkOSOpenGLRenderWindow, or unset it.");
  }
  const Outcome withEGL = OffScreenContext::CreateEGL(context);
  if (withEGL)
  {
    return withEGL;
  }
  const Outcome withOSMesa = OffScreenContext::CreateOSMesa(context);
  return withOSMesa ? withOSMesa
                    : Outcome::Failed(withEGL.GetMessage() + " " + withOSMesa.GetMessage());
}
} // namespace LightTransport
