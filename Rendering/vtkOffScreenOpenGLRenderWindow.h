// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOffScreenOpenGLRenderWindow
 * @brief a render window whose OpenGL context needs no display
 *
 * The context comes from EGL (GPUs first, then Mesa's software renderer) or from OSMesa, with every
 * VTK from 9.1 on. Which one: the environment variable VTK_DEFAULT_OPENGL_WINDOW =
 * vtkEGLRenderWindow or vtkOSOpenGLRenderWindow, as in VTK 9.4 and later; unset, EGL if it works,
 * else OSMesa. VTK_DEFAULT_EGL_DEVICE_INDEX chooses one of several EGL devices.
 *
 * VTK up to 9.3 reaches OSMesa only when the process is started with
 * `LD_PRELOAD="libOSMesa.so.8 liblighttransport_osmesa_preload.so"`.
 *
 * Where no context can be had nothing aborts: IsAvailable() says so beforehand, Open() returns
 * false with the reason, and Render() reports one error and draws nothing.
 */
#ifndef vtkOffScreenOpenGLRenderWindow_h
#define vtkOffScreenOpenGLRenderWindow_h

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkLightTransportRenderingModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOffScreenOpenGLRenderWindow
  : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkOffScreenOpenGLRenderWindow* New();
  vtkTypeMacro(vtkOffScreenOpenGLRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * True when a context can be had in this process; `reason` otherwise says in one sentence why not
   * and what to install. The context made for the test is thrown away.
   */
  static bool IsAvailable(std::string& reason);
  static bool IsAvailable();
  ///@}

  /// Why no context can be had in this process; empty where one can.
  static std::string GetReasonWhyUnavailable();

  /**
   * From now on vtkRenderWindow::New() gives an off-screen window and
   * vtkRenderWindowInteractor::New() an interactor that waits for nobody, so that scripts written
   * for a screen run without one. Does nothing when called again, and nothing where no context can
   * be had; returns whether the registration is there. For scripts of one process: parallel
   * rendering composites the windows of all ranks and has not been tried with these.
   */
  static bool RegisterAsDefault();

  /**
   * Make the context, unless it is there already, and load OpenGL's functions. Returns false,
   * without an error message, when that cannot be done; `reason` then says why and what to install.
   * The context is current afterwards.
   */
  bool Open(std::string& reason);

  /// "EGL" or "OSMesa"; "none" before the context has been made.
  const char* GetBackendName();

  /// OpenGL's own name of the device, such as "llvmpipe (LLVM 15.0.6, 256 bits)"; empty before the
  /// context has been made.
  std::string GetDeviceName();

  /// True on a real GPU, false for software renderers (llvmpipe, softpipe, SWR, ...) and before the
  /// context has been made.
  bool IsHardware();

  void Initialize() override;
  void Finalize() override;
  void Start() override;
  void Render() override;
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  void PushContext() override;
  void PopContext() override;
  int SupportsOpenGL() override;
  vtkTypeBool IsDirect() override;
  void* GetGenericContext() override;
  void OpenGLInit() override;
  void OpenGLInitContext() override;

protected:
  vtkOffScreenOpenGLRenderWindow();
  ~vtkOffScreenOpenGLRenderWindow() override;

private:
  vtkOffScreenOpenGLRenderWindow(const vtkOffScreenOpenGLRenderWindow&) = delete;
  void operator=(const vtkOffScreenOpenGLRenderWindow&) = delete;

  struct OffScreenState;
  std::unique_ptr<OffScreenState> OffScreen;
};

#endif
