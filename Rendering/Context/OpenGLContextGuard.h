// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes a window's context current as long as the guard lives, then gives the calling thread back
 * the context it had, or none. So filters neither disturb a render window that is drawing nor hold
 * a context that another thread needs next.
 */
#ifndef OpenGLContextGuard_h
#define OpenGLContextGuard_h

#include "Context/CurrentOpenGLContext.h"

#include <mutex>

class vtkOpenGLRenderWindow;

namespace LightTransport
{
class OpenGLContextGuard
{
public:
  explicit OpenGLContextGuard(vtkOpenGLRenderWindow* window);
  ~OpenGLContextGuard() { this->Before.Restore(); }
  OpenGLContextGuard(const OpenGLContextGuard&) = delete;
  void operator=(const OpenGLContextGuard&) = delete;

  /// A context can be current in one thread only: users of the shared one wait for each other.
  static std::recursive_mutex& GetMutex();

private:
  const std::lock_guard<std::recursive_mutex> Lock;
  const CurrentOpenGLContext Before;
};
} // namespace LightTransport

#endif
