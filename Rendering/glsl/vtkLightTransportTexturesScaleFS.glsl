// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// x y, element by element
uniform sampler2D x[GROUPS];
uniform sampler2D y[GROUPS];

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
#define STORE(g) result[g] = texelFetch(x[g], place, 0) * texelFetch(y[g], place, 0);
  FOR_ALL_GROUPS(STORE)
}
