// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What nodes send: the sum over their children.
uniform sampler2D children[1];
uniform sampler2D sent[GROUPS];

void main()
{
  vec4 range = texelFetch(children[0], ivec2(gl_FragCoord.xy), 0);
  int begin = int(range.x);
  int end = begin + int(range.y);
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int child = begin; child < end; ++child)
  {
    ivec2 place = GetPlace(child);
#define ADD(g) AddCompensated(sum[g], lost[g], texelFetch(sent[g], place, 0));
    FOR_ALL_GROUPS(ADD)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
