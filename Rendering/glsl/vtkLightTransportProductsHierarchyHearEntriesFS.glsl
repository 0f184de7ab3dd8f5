// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What the entries of the tiles of coded rows send, one tile after the other: rows then read it from one place, without looking up slots.
uniform usampler2D entries[1];
uniform sampler2D sent[GROUPS];

void main()
{
  ivec2 slot = GetPlace(int(texelFetch(entries[0], ivec2(gl_FragCoord.xy), 0).x));
#define STORE(g) result[g] = texelFetch(sent[g], slot, 0);
  FOR_ALL_GROUPS(STORE)
}
