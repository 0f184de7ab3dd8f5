// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * An OpenGL context (core profile, 3.2 or later) that needs no display, with a 16 x 16 surface:
 * nothing is drawn to the surface, but VTK asks for its properties.
 */
#ifndef OffScreenContext_h
#define OffScreenContext_h

#include "Context/OpenGLLibraries.h"
#include "Shared/Outcome.h"

#include <memory>

namespace LightTransport
{
class OffScreenContext
{
public:
  /// Width and height of the surface.
  static constexpr int SurfaceSize = 16;

  /**
   * Make a context with the backend that the environment variable VTK_DEFAULT_OPENGL_WINDOW names
   * (vtkEGLRenderWindow, vtkOSOpenGLRenderWindow), else EGL, else OSMesa. A failure says why not
   * and what to install.
   */
  static Outcome Create(std::unique_ptr<OffScreenContext>& context);

  virtual ~OffScreenContext() = default;
  OffScreenContext(const OffScreenContext&) = delete;
  void operator=(const OffScreenContext&) = delete;

  virtual const char* GetBackendName() const = 0;
  virtual void* GetHandle() const = 0;
  virtual bool MakeCurrent() = 0;
  virtual bool IsCurrent() const = 0;
  virtual OpenGLProcedure GetProcAddress(const char* name) const = 0;

protected:
  OffScreenContext() = default;

  static Outcome CreateEGL(std::unique_ptr<OffScreenContext>& context);
  static Outcome CreateOSMesa(std::unique_ptr<OffScreenContext>& context);
};
} // namespace LightTransport

#endif
