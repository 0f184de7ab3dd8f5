// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The sum over the links of a patch with what most patches are linked with (CommonLinks.h): what that sends is constant, the values of
// the KERNELS kernels are texels below each other, of four links each. Band b uses kernel b % KERNELS. Lines begin at firstLine of what
// is drawn into. TEXELS, those of a kernel, is a constant so that compilers unroll the loop where it is short: software renderers then
// read what is sent once for all fragments.
uniform sampler2D values[1];
uniform int firstLine;

layout(std140) uniform Common
{
  vec4 sent[MOST_LINKS];
} links[GROUPS];

// Texels of a kernel summed plainly before their sum is added with compensation.
const int BLOCK = 8;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy) - ivec2(0, firstLine);
  int line = place.y * TEXELS * KERNELS;
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
  vec4 part[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int block = 0; block < TEXELS; block += BLOCK)
  {
#define CLEAR_PART(g) part[g] = vec4(0.0);
    FOR_ALL_GROUPS(CLEAR_PART)
    int last = min(block + BLOCK, TEXELS);
    for (int texel = block; texel < last; ++texel)
    {
      vec4 value[KERNELS];
      for (int kernel = 0; kernel < KERNELS; ++kernel, ++line)
      {
        value[kernel] = texelFetch(values[0], ivec2(place.x, line), 0);
      }
      int link = 4 * texel;
#define VALUES(g, l) vec4(value[(4 * g) % KERNELS][l], value[(4 * g + 1) % KERNELS][l], value[(4 * g + 2) % KERNELS][l], value[(4 * g + 3) % KERNELS][l])
#define ADD(g) \
      part[g] += VALUES(g, 0) * links[g].sent[link] + VALUES(g, 1) * links[g].sent[link + 1] + \
        VALUES(g, 2) * links[g].sent[link + 2] + VALUES(g, 3) * links[g].sent[link + 3];
      FOR_ALL_GROUPS(ADD)
    }
#define ADD_PART(g) AddCompensated(sum[g], lost[g], part[g]);
    FOR_ALL_GROUPS(ADD_PART)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
