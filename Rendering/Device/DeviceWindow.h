// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceWindow_h
#define DeviceWindow_h

#include "Shared/Outcome.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkRenderWindow;

namespace LightTransport
{
/// The window in whose context something computes: the user's, where one was given, or the
/// off-screen one that all share.
class DeviceWindow
{
public:
  ///@{
  /// A window of the user's, which is not kept alive; nullptr goes back to the shared one.
  void SetUserWindow(vtkRenderWindow* window);
  bool IsUserWindow(vtkRenderWindow* window) const;
  vtkOpenGLRenderWindow* GetUserWindow() const { return this->UserWindow; }
  ///@}

  /// Make sure that there is a context. A failure says why there is none and what to install.
  Outcome Open();

  /// Let go of the shared window.
  void Release() { this->SharedWindow = nullptr; }

  /// nullptr before Open and after the user's window has gone.
  vtkOpenGLRenderWindow* Get() const;

  /// "OpenGL", and after Open with the name of the device, such as "OpenGL (llvmpipe (LLVM 15.0.6,
  /// 256 bits))".
  const std::string& GetDeviceName() const { return this->DeviceName; }
  /// After Open: on a real GPU.
  bool IsHardware() const { return this->Hardware; }

private:
  Outcome OpenWindow();

  vtkWeakPointer<vtkOpenGLRenderWindow> UserWindow;
  bool UsesUserWindow = false;
  vtkSmartPointer<vtkOpenGLRenderWindow> SharedWindow;
  std::string DeviceName = "OpenGL";
  bool Hardware = false;
};
} // namespace LightTransport

#endif
