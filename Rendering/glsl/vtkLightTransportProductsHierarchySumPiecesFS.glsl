// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What slots receive: the sum over the pieces of their row, and with PARENTS what the parent received, which is kept behind the pieces:
// 16 textures are all that OpenGL 3.2 promises. With CODED also the sum of the coded row, kept from codedLine on. With PATCHES the
// result is theirs, weighted, and their lines begin at firstLine; with COMMON also the sums of each round of common links, kept from
// commonLine on.
uniform sampler2D rows[1];
uniform sampler2D parts[GROUPS];
#if PATCHES
uniform int firstLine;
#else
const int firstLine = 0;
#endif

#if CODED
uniform int codedLine;
#endif
#if COMMON
uniform int commonLine;
uniform int commonRounds;
uniform int linesOfRound;
#endif

void main()
{
  vec4 row = texelFetch(rows[0], ivec2(gl_FragCoord.xy) + ivec2(0, firstLine), 0);
  int begin = int(row.x);
  int end = begin + int(row.y);
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#if PARENTS
  ivec2 parent = GetPlace(int(max(row.z, 0.0)));
#define BEGIN(g) sum[g] = row.z < 0.0 ? vec4(0.0) : texelFetch(parts[g], parent, 0); lost[g] = vec4(0.0);
#else
#define BEGIN(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
#endif
  FOR_ALL_GROUPS(BEGIN)
  for (int piece = begin; piece < end; ++piece)
  {
    ivec2 place = GetPlace(piece);
#define ADD(g) AddCompensated(sum[g], lost[g], texelFetch(parts[g], place, 0));
    FOR_ALL_GROUPS(ADD)
  }
#if CODED
  ivec2 codedPlace = ivec2(gl_FragCoord.xy) + ivec2(0, firstLine + codedLine);
#define ADD_CODED(g) AddCompensated(sum[g], lost[g], texelFetch(parts[g], codedPlace, 0));
  FOR_ALL_GROUPS(ADD_CODED)
#endif
#if COMMON
  for (int round = 0; round < commonRounds; ++round)
  {
    ivec2 commonPlace = ivec2(gl_FragCoord.xy) + ivec2(0, commonLine + round * linesOfRound);
#define ADD_COMMON(g) AddCompensated(sum[g], lost[g], texelFetch(parts[g], commonPlace, 0));
    FOR_ALL_GROUPS(ADD_COMMON)
  }
#endif
#if PATCHES
#define STORE(g) result[g] = row.w * (sum[g] + lost[g]);
#else
#define STORE(g) result[g] = sum[g] + lost[g];
#endif
  FOR_ALL_GROUPS(STORE)
}
