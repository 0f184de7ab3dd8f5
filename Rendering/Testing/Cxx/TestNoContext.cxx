// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where no OpenGL can be had (the test's environment hides EGL's drivers and does not preload
 * OSMesa), everything that wants a context says why and what to install, and the process goes on.
 */
#include "vtkOffScreenOpenGLRenderWindow.h"

#include "vtkExchangeMatrix.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkOpenGLLinkOperator.h"
#include "vtkPlaneSource.h"
#include "vtkRadiosity.h"
#include "vtkRenderer.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
bool ReasonSays(const char* backend, const char* remedy)
{
  setenv("VTK_DEFAULT_OPENGL_WINDOW", backend, 1);
  std::string reason;
  if (vtkOffScreenOpenGLRenderWindow::IsAvailable(reason))
  {
    std::cerr << "ERROR: a context can be had with " << backend << "\n";
    return false;
  }
  if (reason.find(remedy) == std::string::npos)
  {
    std::cerr << "ERROR: the reason is \"" << reason << "\", without " << remedy << "\n";
    return false;
  }
  return true;
}

/// A window without a context draws nothing, reads nothing, and reports one error.
bool WindowComplainsOnce()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  window->AddObserver(vtkCommand::ErrorEvent, observer);
  window->AddObserver(vtkCommand::WarningEvent, observer);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  bool good = observer->CheckErrorMessage("libegl1") == 0;
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(0, 0, 0, 0, 0, pixel, 0);
  window->Render();
  if (observer->GetError() || window->SupportsOpenGL() || window->IsHardware())
  {
    std::cerr << "ERROR: a second error, or OpenGL without a context\n";
    good = false;
  }
  return good;
}

/// The link operator tells filters under Auto why not, and reports an error to those that insist.
bool OperatorRefuses()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOpenGLLinkOperator> device;
  device->AddObserver(vtkCommand::ErrorEvent, observer);
  std::string reason;
  if (device->Open(reason) || device->IsHardware() || observer->GetError() ||
    reason.find("libegl1") == std::string::npos)
  {
    std::cerr << "ERROR: the operator opens, or complains, or gives no reason\n";
    return false;
  }
  vtkNew<vtkExchangeMatrix> exchange;
  exchange->Allocate({ 1.0, 1.0 }, 1);
  if (device->Initialize(exchange, 1))
  {
    std::cerr << "ERROR: the operator works without a context\n";
    return false;
  }
  return observer->CheckErrorMessage("libegl1") == 0;
}

/// Before any work, in the words that every solver has.
bool FilterRefuses()
{
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputConnection(plane->GetOutputPort());
  radiosity->SetSolverToSouthwell();
  radiosity->SetDeviceToOpenGL();
  radiosity->AddObserver(vtkCommand::ErrorEvent, observer);
  radiosity->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  radiosity->Update();
  const std::string message = observer->GetErrorMessage();
  const bool good = message.find("Device is OpenGL, but") != std::string::npos &&
    message.find("libegl1") != std::string::npos;
  if (!good)
  {
    std::cerr << "ERROR: Southwell on OpenGL says \"" << message << "\"\n";
  }
  return good;
}
} // namespace

//------------------------------------------------------------------------------
int TestNoContext(int, char*[])
{
  bool good = ReasonSays("vtkEGLRenderWindow", "libegl1");
#ifdef TEST_OSMESA_OUT_OF_REACH
  good = ReasonSays("", "libegl1") && good;
#endif
#ifdef TEST_OSMESA_NEEDS_PRELOAD
  good = ReasonSays("vtkOSOpenGLRenderWindow", "LD_PRELOAD") && good;
#endif
  setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow", 1);
  good = WindowComplainsOnce() && good;
  good = OperatorRefuses() && good;
  good = FilterRefuses() && good;
  if (vtkOffScreenOpenGLRenderWindow::RegisterAsDefault())
  {
    std::cerr << "ERROR: a window that cannot work became the default\n";
    good = false;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
