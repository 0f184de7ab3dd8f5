// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/DeviceSession.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"

#include "vtkOpenGLRenderWindow.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
DeviceSession::DeviceSession(vtkOpenGLRenderWindow* window)
  : Context(window), State(window->GetState()), Viewport(this->State), ColorMask(this->State),
    Blend(this->State, GL_BLEND), CullFace(this->State, GL_CULL_FACE),
    DepthTest(this->State, GL_DEPTH_TEST), ScissorTest(this->State, GL_SCISSOR_TEST),
    StencilTest(this->State, GL_STENCIL_TEST)
{
  DeviceErrors::Clear();
  this->State->PushFramebufferBindings();
  for (unsigned int name :
    { GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_STENCIL_TEST })
  {
    this->State->vtkglDisable(name);
  }
  this->State->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

//------------------------------------------------------------------------------
DeviceSession::~DeviceSession()
{
  this->State->PopFramebufferBindings();
}
} // namespace LightTransport
