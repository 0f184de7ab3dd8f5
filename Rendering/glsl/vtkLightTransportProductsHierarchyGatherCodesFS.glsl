// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The sum over a coded row of links (CodedLayout.h). Slots begin at firstLine of what is drawn into.
uniform usampler2D rows[1];
uniform usampler2D tiles[1];
uniform usampler2D bytes[1];
uniform sampler2D book[1];
uniform sampler2D heard[GROUPS];
uniform int firstLine;

const uint NO_TILE = 0xFFFFFu;

// Of one texel: its links are summed plainly before their sum is added with compensation.
vec4 part[GROUPS];

void AddLink(int entry, uint code)
{
  ivec2 place = GetPlace(entry);
#define ADD(g) part[g] += texelFetch(book[0], ivec2(int(code), g), 0) * texelFetch(heard[g], place, 0);
  FOR_ALL_GROUPS(ADD)
}

void main()
{
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  uvec4 row = texelFetch(rows[0], ivec2(gl_FragCoord.xy) - ivec2(0, firstLine), 0);
  int texel = int(row.x);
  int tile = int(row.y & NO_TILE);
  int pairs = int(row.y >> 20);
  bool goesOn = uint(tile) != NO_TILE;
  while (goesOn)
  {
    uvec4 source = texelFetch(tiles[0], GetPlace(tile), 0);
    int first = int(source.x);
    int endOfCodes = texel + int(source.y & 255u);
    int end = endOfCodes + pairs;
    for (int entry = first; texel < end; ++texel)
    {
      uvec4 words = texelFetch(bytes[0], GetPlace(texel), 0);
#define CLEAR_PART(g) part[g] = vec4(0.0);
      FOR_ALL_GROUPS(CLEAR_PART)
      if (texel < endOfCodes)
      {
        for (int word = 0; word < 4; ++word, words = words.yzwx)
        {
          AddLink(entry, words.x & 255u);
          AddLink(entry + 1, (words.x >> 8) & 255u);
          AddLink(entry + 2, (words.x >> 16) & 255u);
          AddLink(entry + 3, words.x >> 24);
          entry += 4;
        }
      }
      else
      {
        for (int word = 0; word < 4; ++word, words = words.yzwx)
        {
          AddLink(first + int(words.x & 255u), (words.x >> 8) & 255u);
          AddLink(first + int((words.x >> 16) & 255u), words.x >> 24);
        }
      }
#define ADD_PART(g) AddCompensated(sum[g], lost[g], part[g]);
      FOR_ALL_GROUPS(ADD_PART)
    }
    goesOn = (source.y & 256u) != 0u;
    if (goesOn)
    {
      ++tile;
      pairs = int(texelFetch(bytes[0], GetPlace(texel), 0).x);
      ++texel;
    }
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
