// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/SharedWindow.h"

#include "Context/OpenGLContextGuard.h"

#include "vtkOffScreenOpenGLRenderWindow.h"
#include "vtkWeakPointer.h"

#include <string>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome GetSharedWindow(vtkSmartPointer<vtkOpenGLRenderWindow>& window)
{
  static vtkWeakPointer<vtkOpenGLRenderWindow> shared;
  const std::lock_guard<std::recursive_mutex> lock(OpenGLContextGuard::GetMutex());
  window = shared.Get();
  if (window)
  {
    return Outcome::Done();
  }
  auto opened = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
  std::string reason;
  const bool open = opened->Open(reason);
  before.Restore();
  if (!open)
  {
    return Outcome::Failed(reason);
  }
  window = opened;
  shared = opened;
  return Outcome::Done();
}
} // namespace LightTransport
