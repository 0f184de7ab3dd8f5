/* SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors */
/* SPDX-License-Identifier: BSD-3-Clause */

/*
 * For VTK up to 9.3, whose OpenGL loader asks GLX for functions: preloaded together with libOSMesa,
 * this library sends the question to OSMesa instead.
 *
 *   LD_PRELOAD="libOSMesa.so.8 liblighttransport_osmesa_preload.so" \
 *     VTK_DEFAULT_OPENGL_WINDOW=vtkOSOpenGLRenderWindow program
 */
typedef void (*Procedure)(void);

extern Procedure OSMesaGetProcAddress(const char* name);

Procedure glXGetProcAddress(const unsigned char* name);
Procedure glXGetProcAddressARB(const unsigned char* name);

Procedure glXGetProcAddress(const unsigned char* name)
{
  return OSMesaGetProcAddress((const char*)name);
}

Procedure glXGetProcAddressARB(const unsigned char* name)
{
  return OSMesaGetProcAddress((const char*)name);
}
