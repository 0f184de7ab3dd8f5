// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// A pass of Jacobi's iteration as hardware of 2003 could do it: 254 products without a loop, added to the sum of the passes before.
uniform sampler2D matrix;   // row i, column j at (j, i)
uniform sampler2D radiosity;
uniform sampler2D sum;
uniform int first;          // column

#define TERM(j) s += texelFetch(matrix, ivec2(j, row), 0).r * texelFetch(radiosity, ivec2(j, 0), 0).r;
#define FOUR(j) TERM(j) TERM(j + 1) TERM(j + 2) TERM(j + 3)
#define SIXTEEN(j) FOUR(j) FOUR(j + 4) FOUR(j + 8) FOUR(j + 12)
#define SIXTYFOUR(j) SIXTEEN(j) SIXTEEN(j + 16) SIXTEEN(j + 32) SIXTEEN(j + 48)

void main()
{
  int row = int(gl_FragCoord.x);
  float s = texelFetch(sum, ivec2(row, 0), 0).r;
  SIXTYFOUR(first)
  SIXTYFOUR(first + 64)
  SIXTYFOUR(first + 128)
  SIXTEEN(first + 192)
  SIXTEEN(first + 208)
  SIXTEEN(first + 224)
  FOUR(first + 240)
  FOUR(first + 244)
  FOUR(first + 248)
  TERM(first + 252)
  TERM(first + 253)
  gl_FragData[0] = vec4(s);
}
