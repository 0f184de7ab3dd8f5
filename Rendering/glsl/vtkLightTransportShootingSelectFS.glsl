// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The most power among the texels x, x + size.x, ... in both directions, and its patch: neighbours, which are alike, stay apart.
#if FIRST_STEP
uniform sampler2D unshot[GROUPS];
uniform sampler2D areas;
#else
uniform sampler2D found;
#endif
uniform ivec2 sourceSize;
uniform ivec2 size;

void main()
{
  vec2 best = vec2(0.0, -1.0);
  for (int row = int(gl_FragCoord.y); row < sourceSize.y; row += size.y)
  {
    for (int column = int(gl_FragCoord.x); column < sourceSize.x; column += size.x)
    {
      ivec2 place = ivec2(column, row);
#if FIRST_STEP
      vec4 sum = vec4(0.0);
#define ADD(g) sum += abs(texelFetch(unshot[g], place, 0));
      FOR_ALL_GROUPS(ADD)
      float power = dot(sum, vec4(1.0)) * texelFetch(areas, place, 0).x;
      vec2 candidate = vec2(power, row * sourceSize.x + column);
#else
      vec2 candidate = texelFetch(found, place, 0).xy;
#endif
      best = candidate.x > best.x ? candidate : best;
    }
  }
  result[0] = vec4(best, 0.0, 0.0);
}
