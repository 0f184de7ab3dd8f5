// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OpenGLContextGuard.h"

#include "vtkWeakPointer.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
std::recursive_mutex& OpenGLContextGuard::GetMutex()
{
  static std::recursive_mutex mutex;
  return mutex;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> vtkGetSharedOffScreenWindow(std::string& reason)
{
  static vtkWeakPointer<vtkOffScreenOpenGLRenderWindow> shared;
  const std::lock_guard<std::recursive_mutex> lock(OpenGLContextGuard::GetMutex());
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> window = shared.Get();
  if (!window)
  {
    window = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
    const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
    const bool open = window->Open(reason);
    before.Restore();
    if (!open)
    {
      return nullptr;
    }
    shared = window;
  }
  return window;
}
} // namespace LightTransport
