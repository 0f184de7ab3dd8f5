// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include "Shared/TransportMemory.h"

#include <cstdlib>
#include <string>

namespace LightTransport
{
namespace
{
/// Address space of Mesa's software renderer, with its compiler (some 0.6 GB), and room to work in.
constexpr double BytesOfContext = 1e9;
} // namespace

//------------------------------------------------------------------------------
Outcome OffScreenContext::Create(std::unique_ptr<OffScreenContext>& context)
{
  // Drivers end the process where memory is refused to them.
  if (!TransportMemory::IsWithinLimits(BytesOfContext))
  {
    return Outcome::Failed("OpenGL: a context needs " + TransportMemory::Format(BytesOfContext) +
      " of address space, and the limits of this process leave less: raise them (ulimit -v).");
  }
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
