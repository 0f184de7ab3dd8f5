// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes a window's context current as long as the guard lives, then gives the calling thread back
 * the context it had, or none. So filters neither disturb a render window that is drawing nor hold
 * a context that another thread needs next.
 */
#ifndef vtkOpenGLContextGuard_h
#define vtkOpenGLContextGuard_h

#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkOpenGLPlatform.h"
#include "vtkSmartPointer.h"

#include <mutex>
#include <string>

class vtkOpenGLContextGuard
{
public:
  explicit vtkOpenGLContextGuard(vtkOpenGLRenderWindow* window)
    : Lock(vtkOpenGLContextGuard::GetMutex()), Before(vtkCurrentOpenGLContext::Get())
  {
    if (!window->IsCurrent())
    {
      vtkCurrentOpenGLContext::Release();
      window->MakeCurrent();
    }
  }
  ~vtkOpenGLContextGuard() { this->Before.Restore(); }
  vtkOpenGLContextGuard(const vtkOpenGLContextGuard&) = delete;
  void operator=(const vtkOpenGLContextGuard&) = delete;

  /// A context can be current in one thread only: users of the shared one wait for each other.
  static std::recursive_mutex& GetMutex();

private:
  const std::lock_guard<std::recursive_mutex> Lock;
  const vtkCurrentOpenGLContext Before;
};

/**
 * The off-screen window that all filters of this process share. It is made for the first user and
 * goes with the last. Returns nullptr with the reason when no context can be had.
 */
vtkSmartPointer<vtkOffScreenOpenGLRenderWindow> vtkGetSharedOffScreenWindow(std::string& reason);

#endif
