// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The last pass of Jacobi's iteration: what is emitted and what has been summed.
uniform sampler2D emission;
uniform sampler2D sum;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  gl_FragData[0] = texelFetch(emission, place, 0) + texelFetch(sum, place, 0);
}
