// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceSession_h
#define DeviceSession_h

#include "Context/OpenGLContextGuard.h"
#include "vtkOpenGLState.h"

namespace LightTransport
{
/// Makes the context of a window current and sets the state that computing needs; the destructor
/// puts everything back.
class DeviceSession
{
public:
  explicit DeviceSession(vtkOpenGLRenderWindow* window);
  ~DeviceSession();
  DeviceSession(const DeviceSession&) = delete;
  void operator=(const DeviceSession&) = delete;

private:
  OpenGLContextGuard Context;
  vtkOpenGLState* State;
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable CullFace;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglEnableDisable ScissorTest;
  vtkOpenGLState::ScopedglEnableDisable StencilTest;
};
} // namespace LightTransport

#endif
