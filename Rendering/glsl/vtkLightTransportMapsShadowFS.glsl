// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Distances along the axis of a light: those of perspective that begins near have no digits left for the other end of a scene.
//VTK::System::Dec
in float depth;

void main()
{
  gl_FragDepth = depth;
}
