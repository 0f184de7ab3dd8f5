// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SharedWindow_h
#define SharedWindow_h

#include "Shared/Outcome.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"

namespace LightTransport
{
/**
 * The off-screen window that all filters of this process share. It is made for the first user and
 * goes with the last. A failure says why no context can be had.
 */
Outcome GetSharedWindow(vtkSmartPointer<vtkOpenGLRenderWindow>& window);
} // namespace LightTransport

#endif
