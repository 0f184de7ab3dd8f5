// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardwareRenderer_h
#define HardwareRenderer_h

#include <string>

namespace LightTransport
{
/// Whether a name that OpenGL gives as GL_RENDERER belongs to a real GPU; false for an empty one.
bool IsHardwareRenderer(const std::string& renderer);
} // namespace LightTransport

#endif
