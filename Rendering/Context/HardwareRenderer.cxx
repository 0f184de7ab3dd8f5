// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Context/HardwareRenderer.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
bool IsHardwareRenderer(const std::string& renderer)
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
