// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What patches send: weight x, into the lines of the patches, which begin at firstLine.
uniform sampler2D rows[1];
uniform sampler2D vector[GROUPS];
uniform int firstLine;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  float weight = texelFetch(rows[0], place, 0).w;
  ivec2 patchPlace = ivec2(place.x, place.y - firstLine);
#define STORE(g) result[g] = weight * texelFetch(vector[g], patchPlace, 0);
  FOR_ALL_GROUPS(STORE)
}
