// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The mean of the patches of a smooth group.
uniform sampler2D ranges[1];
uniform sampler2D members[1];
uniform sampler2D values[1];
uniform vec4 scales;

void main()
{
  vec2 range = texelFetch(ranges[0], ivec2(gl_FragCoord.xy), 0).xy;
  vec4 sum = vec4(0.0);
  for (int member = int(range.x); member < int(range.y); ++member)
  {
    vec3 patchAndPart = texelFetch(members[0], GetPlace(member), 0).xyz;
    sum += patchAndPart.z * texelFetch(values[0], ivec2(patchAndPart.xy), 0);
  }
  result[0] = scales * sum;
}
