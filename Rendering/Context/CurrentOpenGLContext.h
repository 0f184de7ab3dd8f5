// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CurrentOpenGLContext_h
#define CurrentOpenGLContext_h

#include "Context/OpenGLLibraries.h"

namespace LightTransport
{
/// The context that is current in the calling thread, whatever made it.
class CurrentOpenGLContext
{
public:
  static CurrentOpenGLContext Get();
  /// Make no context current.
  static void Release();
  /// Make this one current again, which may be none.
  void Restore() const;

private:
  bool operator==(const CurrentOpenGLContext& other) const;

  EGLenum EGLApi = EGL_NONE;
  EGLDisplay EGLOfDisplay = EGL_NO_DISPLAY;
  EGLSurface EGLDraw = EGL_NO_SURFACE;
  EGLSurface EGLRead = EGL_NO_SURFACE;
  EGLContext EGLOfContext = EGL_NO_CONTEXT;

  void* GLXDisplay = nullptr;
  unsigned long GLXDrawable = 0;
  void* GLXContext = nullptr;

  void* OSMesaContext = nullptr;
  void* OSMesaBuffer = nullptr;
  int OSMesaSize[2] = { 0, 0 };
};
} // namespace LightTransport

#endif
