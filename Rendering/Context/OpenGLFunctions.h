// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * OpenGL's declarations, from the loader that the VTK at hand was built with: GLEW up to VTK 9.3,
 * glad from VTK 9.4 on.
 */
#ifndef OpenGLFunctions_h
#define OpenGLFunctions_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
