// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OffScreenContext.h"

#include "Context/CurrentOpenGLContext.h"
#include "Context/OpenGLFunctions.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace LightTransport
{
namespace
{
constexpr const char* Remedy =
  " (Debian: apt install libegl1 libgl1-mesa-dri, or the driver of your GPU).";

/**
 * A context on one EGL display. Displays are never terminated: EGL hands out the same one to
 * everybody in the process who asks for the same device, and terminating it would destroy their
 * contexts too.
 */
class ContextEGL : public OffScreenContext
{
public:
  explicit ContextEGL(const EGLLibrary& egl) : EGL(egl) {}
  ~ContextEGL() override;

  bool Open(EGLDisplay display);

  const char* GetBackendName() const override { return "EGL"; }
  void* GetHandle() const override { return this->Context; }
  bool MakeCurrent() override;
  bool IsCurrent() const override;
  OpenGLProcedure GetProcAddress(const char* name) const override
  {
    return this->EGL.GetProcAddress(name);
  }

private:
  const EGLLibrary& EGL;
  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLSurface Surface = EGL_NO_SURFACE;
  EGLContext Context = EGL_NO_CONTEXT;
};

//------------------------------------------------------------------------------
ContextEGL::~ContextEGL()
{
  if (this->IsCurrent())
  {
    CurrentOpenGLContext::Release();
  }
  if (this->Surface != EGL_NO_SURFACE)
  {
    this->EGL.DestroySurface(this->Display, this->Surface);
  }
  if (this->Context != EGL_NO_CONTEXT)
  {
    this->EGL.DestroyContext(this->Display, this->Context);
  }
}

//------------------------------------------------------------------------------
bool ContextEGL::Open(EGLDisplay display)
{
  EGLint major;
  EGLint minor;
  if (display == EGL_NO_DISPLAY || !this->EGL.Initialize(display, &major, &minor) ||
    !this->EGL.BindAPI(EGL_OPENGL_API))
  {
    return false;
  }
  this->Display = display;
  const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
    EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_NONE };
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (!this->EGL.ChooseConfig(display, wanted, &config, 1, &found) || found < 1)
  {
    return false;
  }
  const EGLint version[] = { EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  this->Context = this->EGL.CreateContext(display, config, EGL_NO_CONTEXT, version);
  const EGLint size[] = { EGL_WIDTH, SurfaceSize, EGL_HEIGHT, SurfaceSize, EGL_NONE };
  this->Surface = this->EGL.CreatePbufferSurface(display, config, size);
  if (this->Context == EGL_NO_CONTEXT || this->Surface == EGL_NO_SURFACE)
  {
    return false;
  }
  const CurrentOpenGLContext before = CurrentOpenGLContext::Get();
  const bool usable = this->MakeCurrent();
  before.Restore();
  return usable;
}

//------------------------------------------------------------------------------
bool ContextEGL::MakeCurrent()
{
  if (this->IsCurrent())
  {
    return true;
  }
  CurrentOpenGLContext::Release();
  this->EGL.BindAPI(EGL_OPENGL_API);
  return this->EGL.MakeCurrent(this->Display, this->Surface, this->Surface, this->Context) ==
    EGL_TRUE;
}

//------------------------------------------------------------------------------
bool ContextEGL::IsCurrent() const
{
  return this->Context != EGL_NO_CONTEXT && this->EGL.GetCurrentContext() == this->Context &&
    this->EGL.GetCurrentSurface(EGL_DRAW) == this->Surface;
}

//------------------------------------------------------------------------------
bool Contains(const char* extensions, const char* name)
{
  return extensions && std::string(extensions).find(name) != std::string::npos;
}

/// The EGL devices of this machine, GPUs before software; only one where the environment chooses it
/// by its index.
std::vector<EGLDeviceEXT> ListDevices(const EGLLibrary& egl)
{
  const auto queryDevices =
    reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.GetProcAddress("eglQueryDevicesEXT"));
  const auto queryString =
    reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.GetProcAddress("eglQueryDeviceStringEXT"));
  EGLint count = 0;
  if (!queryDevices || !queryString || !queryDevices(0, nullptr, &count) || count < 1)
  {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  queryDevices(count, devices.data(), &count);
  devices.resize(static_cast<std::size_t>(count));

  for (const char* variable : { "VTK_DEFAULT_EGL_DEVICE_INDEX", "VTK_EGL_DEVICE_INDEX" })
  {
    const char* text = std::getenv(variable);
    const long index = text ? std::strtol(text, nullptr, 10) : -1;
    if (index >= 0 && index < count)
    {
      return { devices[static_cast<std::size_t>(index)] };
    }
  }
  std::stable_partition(devices.begin(), devices.end(),
    [queryString](EGLDeviceEXT device)
    { return !Contains(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software"); });
  return devices;
}

//------------------------------------------------------------------------------
std::unique_ptr<OffScreenContext> TryDisplay(const EGLLibrary& egl, EGLDisplay display)
{
  auto context = std::make_unique<ContextEGL>(egl);
  if (!context->Open(display))
  {
    return nullptr;
  }
  return context;
}

//------------------------------------------------------------------------------
/// nullptr where no device offers what is needed.
std::unique_ptr<OffScreenContext> TryDisplays(const EGLLibrary& egl)
{
  const auto getDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
    egl.GetProcAddress("eglGetPlatformDisplayEXT"));
  const char* extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::unique_ptr<OffScreenContext> context;
  if (getDisplay && Contains(extensions, "EGL_EXT_platform_device"))
  {
    for (EGLDeviceEXT device : ListDevices(egl))
    {
      context = context ? std::move(context)
                        : TryDisplay(egl, getDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  }
  if (!context && getDisplay && Contains(extensions, "EGL_MESA_platform_surfaceless"))
  {
    context =
      TryDisplay(egl, getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return context;
}
} // namespace

//------------------------------------------------------------------------------
Outcome OffScreenContext::CreateEGL(std::unique_ptr<OffScreenContext>& context)
{
  const EGLLibrary* egl = EGLLibrary::Get();
  if (!egl)
  {
    return Outcome::Failed(std::string("EGL: libEGL.so.1 cannot be loaded") + Remedy);
  }
#ifdef GLEW_OK
  const OSMesaLibrary* mesa = OSMesaLibrary::Get(false);
  if (mesa && mesa->IsPreloaded())
  {
    return Outcome::Failed("EGL: OSMesa is preloaded and would receive the OpenGL calls meant for "
                           "EGL; start the process without LD_PRELOAD.");
  }
#endif
  context = TryDisplays(*egl);
  if (!context)
  {
    return Outcome::Failed(
      std::string("EGL: no device offers OpenGL 3.2 without a display") + Remedy);
  }
  return Outcome::Done();
}
} // namespace LightTransport
