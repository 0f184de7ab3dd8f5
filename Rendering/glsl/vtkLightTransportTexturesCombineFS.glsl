// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// a x + b y
uniform sampler2D x[GROUPS];
uniform sampler2D y[GROUPS];
uniform vec4 a[GROUPS];
uniform vec4 b[GROUPS];

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
#define STORE(g) result[g] = a[g] * texelFetch(x[g], place, 0) + b[g] * texelFetch(y[g], place, 0);
  FOR_ALL_GROUPS(STORE)
}
