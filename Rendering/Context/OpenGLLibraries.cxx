// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/OpenGLLibraries.h"

#include <dlfcn.h>
#include <link.h>

#include <initializer_list>
#include <mutex>

namespace LightTransport
{
namespace
{
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

//------------------------------------------------------------------------------
bool LoadGLX(GLXLibrary& glx, const char* name)
{
  void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD);
  return library && Find(library, "glXGetCurrentContext", glx.GetCurrentContext) &&
    Find(library, "glXGetCurrentDisplay", glx.GetCurrentDisplay) &&
    Find(library, "glXGetCurrentDrawable", glx.GetCurrentDrawable) &&
    Find(library, "glXMakeCurrent", glx.MakeCurrent);
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
      loaded = loaded || LoadGLX(glx, name);
    }
  }
  return loaded ? &glx : nullptr;
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
  OpenGLProcedure (*getString)() = nullptr;
  OpenGLProcedure (*getProcAddress)(const unsigned char* name) = nullptr;
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
} // namespace LightTransport
