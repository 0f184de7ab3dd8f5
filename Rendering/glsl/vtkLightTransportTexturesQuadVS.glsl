//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec4 ndCoordIn;
in vec2 texCoordIn;

void main()
{
  // vtkOpenGLQuadHelper reports an attribute that the program does not use as an error, so each gives one coordinate.
  gl_Position = vec4(ndCoordIn.x, 2.0 * texCoordIn.y - 1.0, 0.0, 1.0);
}
