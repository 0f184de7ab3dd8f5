// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/DeviceMemory.h"

#include "Context/HardwareRenderer.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

#include <vtksys/SystemInformation.hxx>

namespace LightTransport
{
namespace
{
/// GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, in KiB.
constexpr unsigned int AvailableVideoMemory = 0x9049;
constexpr double BytesPerKiB = 1024.0;
constexpr double BytesPerMiB = 1024.0 * 1024.0;
} // namespace

//------------------------------------------------------------------------------
double GetAvailableDeviceBytes(vtkOpenGLRenderWindow* window)
{
  if (!IsHardwareRenderer(window->GetState()->GetRenderer()))
  {
    vtksys::SystemInformation system;
    system.RunMemoryCheck();
    return BytesPerMiB * static_cast<double>(system.GetAvailablePhysicalMemory());
  }
  GLint kibibytes = -1;
  glGetIntegerv(AvailableVideoMemory, &kibibytes);
  // An error where the extension is missing.
  return DeviceErrors::Check() ? BytesPerKiB * kibibytes : -1.0;
}
} // namespace LightTransport
