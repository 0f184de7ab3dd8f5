// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OpenGLPlatform.h"

#include <dlfcn.h>
#include <link.h>

#include <mutex>

namespace LightTransport
{
namespace
{
constexpr unsigned int UnsignedByte = 0x1401; // GL_UNSIGNED_BYTE

/// Look a function up; false when the library lacks it.
template <typename Function>
bool Find(void* library, const char* name, Function& function)
{
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

/// Whether libraries have been loaded since `count` was set, which this sets. To ask for one that
/// is not there searches the disk, which takes longer than a small product.
bool AreLibrariesNew(unsigned long long& count)
{
  unsigned long long now = 0;
  dl_iterate_phdr(
    [](dl_phdr_info* library, std::size_t, void* loads)
    {
      *static_cast<unsigned long long*>(loads) = library->dlpi_adds;
      return 1;
    },
    &now);
  const bool areNew = now != count;
  count = now;
  return areNew;
}

/// GLX as this process has it already: nothing is loaded for it.
struct GLXLibrary
{
  void* (*GetCurrentContext)() = nullptr;
  void* (*GetCurrentDisplay)() = nullptr;
  unsigned long (*GetCurrentDrawable)() = nullptr;
  int (*MakeCurrent)(void* display, unsigned long drawable, void* context) = nullptr;

  /// nullptr as long as nobody has loaded it.
  static const GLXLibrary* Get();

private:
  bool Load(void* library)
  {
    return library && Find(library, "glXGetCurrentContext", this->GetCurrentContext) &&
      Find(library, "glXGetCurrentDisplay", this->GetCurrentDisplay) &&
      Find(library, "glXGetCurrentDrawable", this->GetCurrentDrawable) &&
      Find(library, "glXMakeCurrent", this->MakeCurrent);
  }
};

//------------------------------------------------------------------------------
const GLXLibrary* GLXLibrary::Get()
{
  static GLXLibrary glx;
  static bool loaded = false;
  static unsigned long long count = 0;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (!loaded && AreLibrariesNew(count))
  {
    for (const char* name : { "libGL.so.1", "libGLX.so.0" })
    {
      loaded = loaded || glx.Load(dlopen(name, RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD));
    }
  }
  return loaded ? &glx : nullptr;
}

//------------------------------------------------------------------------------
bool LoadEGL(EGLLibrary& egl)
{
  void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  return library && Find(library, "eglBindAPI", egl.BindAPI) &&
    Find(library, "eglChooseConfig", egl.ChooseConfig) &&
    Find(library, "eglCreateContext", egl.CreateContext) &&
    Find(library, "eglCreatePbufferSurface", egl.CreatePbufferSurface) &&
    Find(library, "eglDestroyContext", egl.DestroyContext) &&
    Find(library, "eglDestroySurface", egl.DestroySurface) &&
    Find(library, "eglGetCurrentContext", egl.GetCurrentContext) &&
    Find(library, "eglGetCurrentDisplay", egl.GetCurrentDisplay) &&
    Find(library, "eglGetCurrentSurface", egl.GetCurrentSurface) &&
    Find(library, "eglGetProcAddress", egl.GetProcAddress) &&
    Find(library, "eglInitialize", egl.Initialize) &&
    Find(library, "eglMakeCurrent", egl.MakeCurrent) &&
    Find(library, "eglQueryAPI", egl.QueryAPI) && Find(library, "eglQueryString", egl.QueryString);
}

//------------------------------------------------------------------------------
bool LoadOSMesa(OSMesaLibrary& mesa, int mode)
{
  void* library = nullptr;
  for (const char* name : { "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so" })
  {
    library = library ? library : dlopen(name, RTLD_LAZY | RTLD_LOCAL | mode);
  }
  return library && Find(library, "OSMesaCreateContextAttribs", mesa.CreateContextAttribs) &&
    Find(library, "OSMesaDestroyContext", mesa.DestroyContext) &&
    Find(library, "OSMesaMakeCurrent", mesa.MakeCurrent) &&
    Find(library, "OSMesaGetCurrentContext", mesa.GetCurrentContext) &&
    Find(library, "OSMesaGetColorBuffer", mesa.GetColorBuffer) &&
    Find(library, "OSMesaGetProcAddress", mesa.GetProcAddress);
}
} // namespace

//------------------------------------------------------------------------------
const EGLLibrary* EGLLibrary::Get()
{
  static EGLLibrary library;
  static const bool loaded = LoadEGL(library);
  return loaded ? &library : nullptr;
}

//------------------------------------------------------------------------------
const OSMesaLibrary* OSMesaLibrary::Get(bool load)
{
  static OSMesaLibrary library;
  static bool loaded = false;
  static unsigned long long count = 0;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (!loaded && (load || AreLibrariesNew(count)))
  {
    loaded = LoadOSMesa(library, load ? 0 : RTLD_NOLOAD);
  }
  return loaded ? &library : nullptr;
}

//------------------------------------------------------------------------------
bool OSMesaLibrary::IsPreloaded() const
{
  vtkOpenGLProcedure (*getString)() = nullptr;
  vtkOpenGLProcedure (*getProcAddress)(const unsigned char* name) = nullptr;
  if (!Find(RTLD_DEFAULT, "glGetString", getString) ||
    !Find(RTLD_DEFAULT, "glXGetProcAddressARB", getProcAddress))
  {
    return false;
  }
  Dl_info ofCalls = {};
  Dl_info ofLibrary = {};
  dladdr(reinterpret_cast<void*>(getString), &ofCalls);
  dladdr(reinterpret_cast<void*>(this->CreateContextAttribs), &ofLibrary);
  const auto* name = reinterpret_cast<const unsigned char*>("glCreateShader");
  return ofCalls.dli_fbase == ofLibrary.dli_fbase &&
    getProcAddress(name) == this->GetProcAddress("glCreateShader");
}

//------------------------------------------------------------------------------
bool CurrentOpenGLContext::operator==(const CurrentOpenGLContext& other) const
{
  return this->EGLOfContext == other.EGLOfContext && this->EGLDraw == other.EGLDraw &&
    this->EGLRead == other.EGLRead && this->GLXContext == other.GLXContext &&
    this->GLXDrawable == other.GLXDrawable && this->OSMesaContext == other.OSMesaContext &&
    this->OSMesaBuffer == other.OSMesaBuffer;
}

//------------------------------------------------------------------------------
CurrentOpenGLContext CurrentOpenGLContext::Get()
{
  CurrentOpenGLContext current;
  if (const EGLLibrary* egl = EGLLibrary::Get())
  {
    current.EGLApi = egl->QueryAPI();
    current.EGLOfContext = egl->GetCurrentContext();
    current.EGLOfDisplay = egl->GetCurrentDisplay();
    current.EGLDraw = egl->GetCurrentSurface(EGL_DRAW);
    current.EGLRead = egl->GetCurrentSurface(EGL_READ);
  }
  if (const GLXLibrary* glx = GLXLibrary::Get())
  {
    current.GLXContext = glx->GetCurrentContext();
    current.GLXDisplay = glx->GetCurrentDisplay();
    current.GLXDrawable = glx->GetCurrentDrawable();
  }
  if (const OSMesaLibrary* mesa = OSMesaLibrary::Get(false))
  {
    current.OSMesaContext = mesa->GetCurrentContext();
    int format;
    if (current.OSMesaContext)
    {
      mesa->GetColorBuffer(current.OSMesaContext, &current.OSMesaSize[0], &current.OSMesaSize[1],
        &format, &current.OSMesaBuffer);
    }
  }
  return current;
}

//------------------------------------------------------------------------------
void CurrentOpenGLContext::Release()
{
  const CurrentOpenGLContext current = CurrentOpenGLContext::Get();
  if (current.EGLOfContext != EGL_NO_CONTEXT)
  {
    EGLLibrary::Get()->MakeCurrent(current.EGLOfDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE,
      EGL_NO_CONTEXT);
  }
  if (current.GLXContext)
  {
    GLXLibrary::Get()->MakeCurrent(current.GLXDisplay, 0, nullptr);
  }
  if (current.OSMesaContext)
  {
    OSMesaLibrary::Get(false)->MakeCurrent(nullptr, nullptr, UnsignedByte, 0, 0);
  }
}

//------------------------------------------------------------------------------
void CurrentOpenGLContext::Restore() const
{
  if (*this == CurrentOpenGLContext::Get())
  {
    return;
  }
  // The vendor-neutral dispatcher refuses to switch from one window system to another while a
  // context is current.
  CurrentOpenGLContext::Release();
  if (this->EGLApi != EGL_NONE)
  {
    EGLLibrary::Get()->BindAPI(this->EGLApi);
  }
  if (this->EGLOfContext != EGL_NO_CONTEXT)
  {
    EGLLibrary::Get()->MakeCurrent(this->EGLOfDisplay, this->EGLDraw, this->EGLRead,
      this->EGLOfContext);
  }
  if (this->GLXContext)
  {
    GLXLibrary::Get()->MakeCurrent(this->GLXDisplay, this->GLXDrawable, this->GLXContext);
  }
  if (this->OSMesaContext)
  {
    OSMesaLibrary::Get(false)->MakeCurrent(this->OSMesaContext, this->OSMesaBuffer, UnsignedByte,
      this->OSMesaSize[0], this->OSMesaSize[1]);
  }
}

//------------------------------------------------------------------------------
bool vtkOpenGLDeviceIsHardware(const std::string& renderer)
{
  for (const char* software : { "llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer",
         "SwiftShader", "GDI Generic", "Microsoft Basic Render" })
  {
    if (renderer.find(software) != std::string::npos)
    {
      return false;
    }
  }
  return !renderer.empty();
}
} // namespace LightTransport
