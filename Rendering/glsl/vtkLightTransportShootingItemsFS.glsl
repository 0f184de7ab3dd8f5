//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
uniform sampler2D patches;
uniform int width;
uniform float backRounding;

void main()
{
  // The number of the patch from 1 on, negative where its back is seen.
  float patchNumber = texelFetch(patches, ivec2(gl_PrimitiveID % width, gl_PrimitiveID / width), 0).x;
  gl_FragData[0] = vec4(gl_FrontFacing ? patchNumber : -patchNumber, 0.0, 0.0, 1.0);
  // The distance along the axis: what perspective makes of it has no digits left far away.
  // Of two sides in one place the front is seen.
  gl_FragDepth = 1.0 / gl_FragCoord.w + (gl_FrontFacing ? 0.0 : backRounding);
}
