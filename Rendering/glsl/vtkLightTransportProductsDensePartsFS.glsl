// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// One range of columns of the product of a matrix tile with a vector. Fragment (x, y) computes ROWS rows, which share what is fetched
// of the vector, from row (y / splits) * WIDTH + x * ROWS on, over the (y % splits)-th range of columns.
// MATRIX_GROUPS: 1 where all bands share one kernel (SHARED_KERNEL), else textures with four of the KERNELS kernels each, of which
// band b uses number b % KERNELS.
uniform sampler2D matrix[MATRIX_GROUPS];
uniform sampler2D vector[GROUPS];
uniform int splits;
uniform int numberOfRows;
uniform int firstRow;
uniform int firstColumn;
uniform int numberOfTexels;
uniform int texelsPerSplit;

// Texels summed plainly before their sum is added with compensation.
const int BLOCK = 16;

// The matrix texel of a row; rows beyond the last one repeat it and are dropped at the end.
#define LINKS(g, r) texelFetch(matrix[g], ivec2(texel, min(row + r, numberOfRows - 1) - firstRow), 0)

// Outputs, like samplers, may be indexed by constants alone.
#define STORE_ROW(g, r) result[r * GROUPS + g] = row + r < numberOfRows ? sum[r * GROUPS + g] + lost[r * GROUPS + g] : vec4(0.0);
#if ROWS > 1
#define STORE_ROW_1(g) STORE_ROW(g, 1)
#else
#define STORE_ROW_1(g)
#endif
#if ROWS > 2
#define STORE_ROWS_2_AND_3(g) STORE_ROW(g, 2) STORE_ROW(g, 3)
#else
#define STORE_ROWS_2_AND_3(g)
#endif
#define STORE(g) STORE_ROW(g, 0) STORE_ROW_1(g) STORE_ROWS_2_AND_3(g)

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  int row = (place.y / splits) * WIDTH + place.x * ROWS;
  int begin = (place.y % splits) * texelsPerSplit;
  int end = row < numberOfRows ? min(begin + texelsPerSplit, numberOfTexels) : begin;
  vec4 sum[ROWS * GROUPS];
  vec4 lost[ROWS * GROUPS];
  vec4 part[ROWS * GROUPS];
  for (int index = 0; index < ROWS * GROUPS; ++index)
  {
    sum[index] = vec4(0.0);
    lost[index] = vec4(0.0);
  }
  for (int block = begin; block < end; block += BLOCK)
  {
    for (int index = 0; index < ROWS * GROUPS; ++index)
    {
      part[index] = vec4(0.0);
    }
    int last = min(block + BLOCK, end);
    for (int texel = block; texel < last; ++texel)
    {
#if SHARED_KERNEL
      // A texel holds four columns; the vector's rows hold a multiple of four patches.
      ivec2 at = GetPlace(firstColumn + 4 * texel);
      vec4 links[ROWS];
      for (int r = 0; r < ROWS; ++r)
      {
        links[r] = LINKS(0, r);
      }
#define ADD(g) \
      { \
        vec4 x0 = texelFetch(vector[g], at, 0); \
        vec4 x1 = texelFetch(vector[g], at + ivec2(1, 0), 0); \
        vec4 x2 = texelFetch(vector[g], at + ivec2(2, 0), 0); \
        vec4 x3 = texelFetch(vector[g], at + ivec2(3, 0), 0); \
        for (int r = 0; r < ROWS; ++r) \
        { \
          part[r * GROUPS + g] += (links[r].x * x0 + links[r].y * x1) + (links[r].z * x2 + links[r].w * x3); \
        } \
      }
#else
      // A texel holds one column of four kernels.
      ivec2 at = GetPlace(firstColumn + texel);
      vec4 links[ROWS * MATRIX_GROUPS];
#define FETCH(g) \
      for (int r = 0; r < ROWS && g < MATRIX_GROUPS; ++r) \
      { \
        links[r * MATRIX_GROUPS + min(g, MATRIX_GROUPS - 1)] = LINKS(min(g, MATRIX_GROUPS - 1), r); \
      }
      FOR_ALL_GROUPS(FETCH)
#define VALUE(r, b) links[r * MATRIX_GROUPS + (b) % KERNELS / 4][(b) % KERNELS % 4]
#define ADD(g) \
      { \
        vec4 x = texelFetch(vector[g], at, 0); \
        for (int r = 0; r < ROWS; ++r) \
        { \
          part[r * GROUPS + g] += vec4(VALUE(r, 4 * g), VALUE(r, 4 * g + 1), VALUE(r, 4 * g + 2), VALUE(r, 4 * g + 3)) * x; \
        } \
      }
#endif
      FOR_ALL_GROUPS(ADD)
    }
    for (int index = 0; index < ROWS * GROUPS; ++index)
    {
      AddCompensated(sum[index], lost[index], part[index]);
    }
  }
  FOR_ALL_GROUPS(STORE)
}
