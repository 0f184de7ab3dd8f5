// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The sum over a piece of a row of links. Fragment (x, y) takes column x of the lines that the y-th line of pieces has in the texture
// of links. A texel holds two links: texel of the slot, value, twice. Or, with a kernel for each band, a link takes several texels below
// each other: texel of the slot, then the values of the KERNELS kernels, of which band b uses number b % KERNELS.
uniform sampler2D links[1];
uniform sampler2D lines[1];
uniform sampler2D sent[GROUPS];

// Texels summed plainly before their sum is added with compensation.
const int BLOCK = 16 * TEXELS_PER_LINK;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 range = texelFetch(lines[0], ivec2(0, place.y), 0);
  int begin = int(range.x);
  int end = begin + int(range.y);
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
  vec4 part[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int block = begin; block < end; block += BLOCK)
  {
#define CLEAR_PART(g) part[g] = vec4(0.0);
    FOR_ALL_GROUPS(CLEAR_PART)
    int last = min(block + BLOCK, end);
    for (int line = block; line < last; line += TEXELS_PER_LINK)
    {
#if LINKS_PER_TEXEL == 2
      vec4 pair = texelFetch(links[0], ivec2(place.x, line), 0);
      ivec2 first = GetPlace(int(pair.x));
      ivec2 second = GetPlace(int(pair.z));
#define ADD(g) part[g] += pair.y * texelFetch(sent[g], first, 0) + pair.w * texelFetch(sent[g], second, 0);
#else
      vec4 texels[TEXELS_PER_LINK];
      for (int texel = 0; texel < TEXELS_PER_LINK; ++texel)
      {
        texels[texel] = texelFetch(links[0], ivec2(place.x, line + texel), 0);
      }
      ivec2 slot = GetPlace(int(texels[0].x));
#define VALUE(b) texels[(1 + (b) % KERNELS) / 4][(1 + (b) % KERNELS) % 4]
#define ADD(g) \
      part[g] += vec4(VALUE(4 * g), VALUE(4 * g + 1), VALUE(4 * g + 2), VALUE(4 * g + 3)) * texelFetch(sent[g], slot, 0);
#endif
      FOR_ALL_GROUPS(ADD)
    }
#define ADD_PART(g) AddCompensated(sum[g], lost[g], part[g]);
    FOR_ALL_GROUPS(ADD_PART)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
