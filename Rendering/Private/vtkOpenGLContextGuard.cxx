// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLContextGuard.h"

#include "vtkWeakPointer.h"

#include <mutex>

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> vtkGetSharedOffScreenWindow(std::string& reason)
{
  static vtkWeakPointer<vtkOffScreenOpenGLRenderWindow> shared;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
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
