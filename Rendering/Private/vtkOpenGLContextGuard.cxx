// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLContextGuard.h"

#include "vtkWeakPointer.h"

//------------------------------------------------------------------------------
std::recursive_mutex& vtkOpenGLContextGuard::GetMutex()
{
  static std::recursive_mutex mutex;
  return mutex;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> vtkGetSharedOffScreenWindow(std::string& reason)
{
  static vtkWeakPointer<vtkOffScreenOpenGLRenderWindow> shared;
  const std::lock_guard<std::recursive_mutex> lock(vtkOpenGLContextGuard::GetMutex());
  vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> window = shared.Get();
  if (!window)
  {
    window = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
    const vtkCurrentOpenGLContext before = vtkCurrentOpenGLContext::Get();
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
