// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceMemory_h
#define DeviceMemory_h

class vtkOpenGLRenderWindow;

namespace LightTransport
{
/// Bytes that can still be allocated in the context of a window, which is current: the GPU's, where
/// its driver tells, or the machine's for software renderers. Negative where nobody knows.
double GetAvailableDeviceBytes(vtkOpenGLRenderWindow* window);
} // namespace LightTransport

#endif
