// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// A pass of Gauss and Seidel's iteration: one patch, with the newest radiosity of all others.
uniform sampler2D matrix;   // row i, column j at (j, i)
uniform sampler2D radiosity;
uniform sampler2D emission;
uniform int columns;

void main()
{
  int row = int(gl_FragCoord.x);
  float s = texelFetch(emission, ivec2(row, 0), 0).r;
  for (int j = 0; j < columns; ++j)
  {
    s += texelFetch(matrix, ivec2(j, row), 0).r * texelFetch(radiosity, ivec2(j, 0), 0).r;
  }
  gl_FragData[0] = vec4(s);
}
