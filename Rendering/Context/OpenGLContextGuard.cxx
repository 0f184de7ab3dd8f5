// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OpenGLContextGuard.h"

#include "vtkOpenGLRenderWindow.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
OpenGLContextGuard::OpenGLContextGuard(vtkOpenGLRenderWindow* window)
  : Lock(OpenGLContextGuard::GetMutex()), Before(CurrentOpenGLContext::Get())
{
  if (!window->IsCurrent())
  {
    CurrentOpenGLContext::Release();
    window->MakeCurrent();
  }
}

//------------------------------------------------------------------------------
std::recursive_mutex& OpenGLContextGuard::GetMutex()
{
  static std::recursive_mutex mutex;
  return mutex;
}
} // namespace LightTransport
