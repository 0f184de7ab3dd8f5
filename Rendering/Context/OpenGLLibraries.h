// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The libraries that make OpenGL contexts, loaded at run time so that this module loads on machines
 * that lack them.
 */
#ifndef OpenGLLibraries_h
#define OpenGLLibraries_h

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace LightTransport
{
using OpenGLProcedure = void (*)();

/// libEGL's functions.
struct EGLLibrary
{
  /// nullptr where libEGL.so.1 is not installed.
  static const EGLLibrary* Get();

  decltype(&eglBindAPI) BindAPI = nullptr;
  decltype(&eglChooseConfig) ChooseConfig = nullptr;
  decltype(&eglCreateContext) CreateContext = nullptr;
  decltype(&eglCreatePbufferSurface) CreatePbufferSurface = nullptr;
  decltype(&eglDestroyContext) DestroyContext = nullptr;
  decltype(&eglDestroySurface) DestroySurface = nullptr;
  decltype(&eglGetCurrentContext) GetCurrentContext = nullptr;
  decltype(&eglGetCurrentDisplay) GetCurrentDisplay = nullptr;
  decltype(&eglGetCurrentSurface) GetCurrentSurface = nullptr;
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;
  decltype(&eglInitialize) Initialize = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglQueryAPI) QueryAPI = nullptr;
  decltype(&eglQueryString) QueryString = nullptr;
};

/// libGLX's functions.
struct GLXLibrary
{
  /// As this process has it already: nothing is loaded for it. nullptr as long as nobody has loaded
  /// it.
  static const GLXLibrary* Get();

  void* (*GetCurrentContext)() = nullptr;
  void* (*GetCurrentDisplay)() = nullptr;
  unsigned long (*GetCurrentDrawable)() = nullptr;
  int (*MakeCurrent)(void* display, unsigned long drawable, void* context) = nullptr;
};

/// libOSMesa's functions, declared here because few systems still have its header.
struct OSMesaLibrary
{
  using Context = void*;

  static constexpr int Format = 0x22;
  static constexpr int FormatRGBA = 0x1908;
  static constexpr int DepthBits = 0x30;
  static constexpr int StencilBits = 0x31;
  static constexpr int Profile = 0x33;
  static constexpr int CoreProfile = 0x34;
  static constexpr int MajorVersion = 0x36;
  static constexpr int MinorVersion = 0x37;

  /// nullptr where the library is not installed, or not loaded yet and `load` is false.
  static const OSMesaLibrary* Get(bool load);

  Context (*CreateContextAttribs)(const int* attributes, Context shared) = nullptr;
  void (*DestroyContext)(Context context) = nullptr;
  unsigned char (*MakeCurrent)(Context context, void* buffer, unsigned int type, int width,
    int height) = nullptr;
  Context (*GetCurrentContext)() = nullptr;
  unsigned char (*GetColorBuffer)(Context context, int* width, int* height, int* format,
    void** buffer) = nullptr;
  OpenGLProcedure (*GetProcAddress)(const char* name) = nullptr;

  /**
   * True when the OpenGL calls of this process arrive in this library, as they do when it was
   * preloaded together with liblighttransport_osmesa_preload.so.
   */
  bool IsPreloaded() const;
};
} // namespace LightTransport

#endif
