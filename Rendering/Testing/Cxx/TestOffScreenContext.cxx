// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A context without a display: it can be had, draws the right pixels, can be made again, leaves
 * other contexts alone, and becomes the default window when asked.
 */
#include "LightTransportTesting.h"
#include "vtkOffScreenOpenGLRenderWindow.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <iostream>

namespace
{
using LightTransportTesting::Check;
bool PixelIs(vtkRenderWindow* window, int x, int y, int red, int green, int blue)
{
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(x, y, x, y, 0, pixel);
  if (pixel->GetNumberOfTuples() != 1)
  {
    return Check(false, "no pixel could be read");
  }
  const int found[3] = { pixel->GetValue(0), pixel->GetValue(1), pixel->GetValue(2) };
  if (std::abs(found[0] - red) > 1 || std::abs(found[1] - green) > 1 ||
    std::abs(found[2] - blue) > 1)
  {
    std::cerr << "ERROR: pixel " << x << " " << y << " is " << found[0] << " " << found[1] << " "
              << found[2] << ", not " << red << " " << green << " " << blue << "\n";
    return false;
  }
  return true;
}

/// A square of a known colour that covers the middle of the window.
bool DrawsSquare(vtkRenderWindow* window)
{
  vtkNew<vtkPlaneSource> square;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(square->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.0, 1.0, 0.2);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.2, 0.4, 0.6);
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetParallelProjection(true);
  renderer->GetActiveCamera()->SetParallelScale(1.0);
  window->SetMultiSamples(0);
  window->SetSize(60, 40);
  window->AddRenderer(renderer);
  window->Render();
  const bool drawn = PixelIs(window, 30, 20, 0, 255, 51) && PixelIs(window, 2, 2, 51, 102, 153) &&
    PixelIs(window, 57, 37, 51, 102, 153);
  window->RemoveRenderer(renderer);
  return drawn;
}

bool TestBackend()
{
  std::string reason;
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  bool good = Check(vtkOffScreenOpenGLRenderWindow::IsAvailable(reason), reason.c_str()) &&
    Check(std::string(window->GetBackendName()) == "none", "a context before Open()") &&
    Check(window->Open(reason), reason.c_str());
  const char* wish = std::getenv("VTK_DEFAULT_OPENGL_WINDOW");
  if (wish)
  {
    const std::string expected = std::string(wish) == "vtkEGLRenderWindow" ? "EGL" : "OSMesa";
    good =
      Check(window->GetBackendName() == expected, "the backend is not the one asked for") && good;
  }
  const bool software = window->GetDeviceName().find("llvmpipe") != std::string::npos ||
    window->GetDeviceName().find("softpipe") != std::string::npos;
  std::cout << window->GetBackendName() << ", " << window->GetDeviceName() << "\n";
  return Check(!window->GetDeviceName().empty(), "no device name") &&
    Check(window->IsHardware() != software, "a software renderer passes for a GPU") && good;
}

/// Two windows at once, then each again after the other has gone.
bool TestSeveralWindows()
{
  auto first = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  auto second = vtkSmartPointer<vtkOffScreenOpenGLRenderWindow>::New();
  bool good = DrawsSquare(first) && DrawsSquare(second) && DrawsSquare(first);
  first = nullptr;
  good = DrawsSquare(second) && good;
  second->Finalize();
  good = Check(std::string(second->GetBackendName()) == "none", "Finalize keeps the context") &&
    DrawsSquare(second) && good;
  return good;
}

bool TestCurrentContext()
{
  std::string reason;
  vtkNew<vtkOffScreenOpenGLRenderWindow> first;
  vtkNew<vtkOffScreenOpenGLRenderWindow> second;
  first->Open(reason);
  second->Open(reason);
  first->MakeCurrent();
  bool good = Check(first->IsCurrent() && !second->IsCurrent(), "MakeCurrent has no effect");
  second->PushContext();
  good = Check(second->IsCurrent() && !first->IsCurrent(), "PushContext has no effect") && good;
  vtkOffScreenOpenGLRenderWindow::IsAvailable(reason);
  good = Check(second->IsCurrent(), "IsAvailable takes the current context away") && good;
  second->PopContext();
  good = Check(first->IsCurrent(), "PopContext does not bring the context back") && good;
  second->Finalize();
  good = Check(first->IsCurrent(), "closing a window takes another's context away") && good;
  first->ReleaseCurrent();
  return Check(!first->IsCurrent(), "ReleaseCurrent has no effect") && good;
}

bool TestRegisterAsDefault()
{
  bool good = Check(vtkOffScreenOpenGLRenderWindow::RegisterAsDefault(), "not registered") &&
    Check(vtkOffScreenOpenGLRenderWindow::RegisterAsDefault(), "not registered again");
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderWindowInteractor> interactor;
  return Check(window->IsA("vtkOffScreenOpenGLRenderWindow"), "vtkRenderWindow is another") &&
    Check(interactor->IsA("vtkGenericRenderWindowInteractor"), "the interactor is another") &&
    DrawsSquare(window) && good;
}

bool TestUnknownBackend()
{
  setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkNoSuchRenderWindow", 1);
  std::string reason;
  bool good =
    Check(!vtkOffScreenOpenGLRenderWindow::IsAvailable(reason), "nonsense is available") &&
    Check(reason.find("vtkNoSuchRenderWindow") != std::string::npos, "the reason names no culprit");
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkOffScreenOpenGLRenderWindow> window;
  window->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  good = observer->CheckErrorMessage("vtkNoSuchRenderWindow") == 0 && good;
  window->Render();
  return Check(!observer->GetError(), "the same error twice") && good;
}
} // namespace

//------------------------------------------------------------------------------
int TestOffScreenContext(int, char*[])
{
  bool good = TestBackend();
  good = TestSeveralWindows() && good;
  good = TestCurrentContext() && good;
  good = TestRegisterAsDefault() && good;
  good = TestUnknownBackend() && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
