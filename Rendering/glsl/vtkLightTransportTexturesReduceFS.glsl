// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Reduces blocks of 16 x 16 texels to one: the sum of x y, the sum of x, or the largest |x|.
uniform sampler2D x[GROUPS];
uniform sampler2D y[GROUPS];
uniform ivec2 size;

const int BLOCK = 16;

void main()
{
  ivec2 begin = ivec2(gl_FragCoord.xy) * BLOCK;
  ivec2 end = min(begin + BLOCK, size);
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int row = begin.y; row < end.y; ++row)
  {
    for (int column = begin.x; column < end.x; ++column)
    {
      ivec2 place = ivec2(column, row);
#if REDUCE_PRODUCT
#define ADD(g) AddCompensated(sum[g], lost[g], texelFetch(x[g], place, 0) * texelFetch(y[g], place, 0));
#elif REDUCE_SUM
#define ADD(g) AddCompensated(sum[g], lost[g], texelFetch(x[g], place, 0));
#else
// max() may lose a NaN: what is not finite is carried beside it.
#define ADD(g) { vec4 value = texelFetch(x[g], place, 0); sum[g] = max(sum[g], abs(value)); EXACT vec4 zero = value - value; lost[g] += zero; }
#endif
      FOR_ALL_GROUPS(ADD)
    }
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
