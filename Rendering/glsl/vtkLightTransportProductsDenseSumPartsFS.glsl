// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The sum of a row's partial products, and of the sum so far where the matrix has several tiles side by side.
uniform sampler2D parts[ROWS * GROUPS];
#if ACCUMULATE
uniform sampler2D previous[GROUPS];
#endif
uniform int splits;

#define PART_ROW(g, r) texelFetch(parts[r * GROUPS + g], from, 0)
#if ROWS == 1
#define PART(g) PART_ROW(g, 0)
#elif ROWS == 2
#define PART(g) (row == 0 ? PART_ROW(g, 0) : PART_ROW(g, 1))
#else
#define PART(g) (row == 0 ? PART_ROW(g, 0) : row == 1 ? PART_ROW(g, 1) : row == 2 ? PART_ROW(g, 2) : PART_ROW(g, 3))
#endif

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  int row = place.x % ROWS;
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#if ACCUMULATE
#define BEGIN(g) sum[g] = texelFetch(previous[g], place, 0); lost[g] = vec4(0.0);
#else
#define BEGIN(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
#endif
  FOR_ALL_GROUPS(BEGIN)
  for (int split = 0; split < splits; ++split)
  {
    ivec2 from = ivec2(place.x / ROWS, place.y * splits + split);
#define ADD(g) AddCompensated(sum[g], lost[g], PART(g));
    FOR_ALL_GROUPS(ADD)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
