// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/CurrentOpenGLContext.h"

namespace LightTransport
{
namespace
{
constexpr unsigned int UnsignedByte = 0x1401; // GL_UNSIGNED_BYTE
} // namespace

//------------------------------------------------------------------------------
bool CurrentOpenGLContext::operator==(const CurrentOpenGLContext& other) const
{
  return this->EGLOfContext == other.EGLOfContext && this->EGLDraw == other.EGLDraw &&
    this->EGLRead == other.EGLRead && this->GLXContext == other.GLXContext &&
    this->GLXDrawable == other.GLXDrawable && this->OSMesaContext == other.OSMesaContext &&
    this->OSMesaBuffer == other.OSMesaBuffer;
}

//------------------------------------------------------------------------------
CurrentOpenGLContext CurrentOpenGLContext::Get()
{
  CurrentOpenGLContext current;
  if (const EGLLibrary* egl = EGLLibrary::Get())
  {
    current.EGLApi = egl->QueryAPI();
    current.EGLOfContext = egl->GetCurrentContext();
    current.EGLOfDisplay = egl->GetCurrentDisplay();
    current.EGLDraw = egl->GetCurrentSurface(EGL_DRAW);
    current.EGLRead = egl->GetCurrentSurface(EGL_READ);
  }
  if (const GLXLibrary* glx = GLXLibrary::Get())
  {
    current.GLXContext = glx->GetCurrentContext();
    current.GLXDisplay = glx->GetCurrentDisplay();
    current.GLXDrawable = glx->GetCurrentDrawable();
  }
  if (const OSMesaLibrary* mesa = OSMesaLibrary::Get(false))
  {
    current.OSMesaContext = mesa->GetCurrentContext();
    int format;
    if (current.OSMesaContext)
    {
      mesa->GetColorBuffer(current.OSMesaContext, &current.OSMesaSize[0], &current.OSMesaSize[1],
        &format, &current.OSMesaBuffer);
    }
  }
  return current;
}

//------------------------------------------------------------------------------
void CurrentOpenGLContext::Release()
{
  const CurrentOpenGLContext current = CurrentOpenGLContext::Get();
  if (current.EGLOfContext != EGL_NO_CONTEXT)
  {
    EGLLibrary::Get()->MakeCurrent(current.EGLOfDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE,
      EGL_NO_CONTEXT);
  }
  if (current.GLXContext)
  {
    GLXLibrary::Get()->MakeCurrent(current.GLXDisplay, 0, nullptr);
  }
  if (current.OSMesaContext)
  {
    OSMesaLibrary::Get(false)->MakeCurrent(nullptr, nullptr, UnsignedByte, 0, 0);
  }
}

//------------------------------------------------------------------------------
void CurrentOpenGLContext::Restore() const
{
  if (*this == CurrentOpenGLContext::Get())
  {
    return;
  }
  // The vendor-neutral dispatcher refuses to switch from one window system to another while a
  // context is current.
  CurrentOpenGLContext::Release();
  if (this->EGLApi != EGL_NONE)
  {
    EGLLibrary::Get()->BindAPI(this->EGLApi);
  }
  if (this->EGLOfContext != EGL_NO_CONTEXT)
  {
    EGLLibrary::Get()->MakeCurrent(this->EGLOfDisplay, this->EGLDraw, this->EGLRead,
      this->EGLOfContext);
  }
  if (this->GLXContext)
  {
    GLXLibrary::Get()->MakeCurrent(this->GLXDisplay, this->GLXDrawable, this->GLXContext);
  }
  if (this->OSMesaContext)
  {
    OSMesaLibrary::Get(false)->MakeCurrent(this->OSMesaContext, this->OSMesaBuffer, UnsignedByte,
      this->OSMesaSize[0], this->OSMesaSize[1]);
  }
}
} // namespace LightTransport
