// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// From a vector of the links to the map of what leaves: value x area, area.
uniform sampler2D texels; // row from 1 on, what its value is to be divided by, area
uniform sampler2D leaving;

void main()
{
  vec3 texel = texelFetch(texels, ivec2(gl_FragCoord.xy), 0).xyz;
  int row = int(texel.x) - 1;
  result[0] = row < 0 ? vec4(0.0) : vec4(texelFetch(leaving, GetPlace(row), 0).rgb * texel.y * texel.z, texel.z);
}
