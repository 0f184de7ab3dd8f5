// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// From the map of what enters to a vector of the links: the mean over each texel that is linked.
uniform sampler2D rows; // column and line of its texel, 1 where there is one
uniform sampler2D entering;
uniform int level; // where texels are as large as those that are linked
uniform int shift; // and how many times they have to be doubled where all are larger

void main()
{
  vec3 row = texelFetch(rows, ivec2(gl_FragCoord.xy), 0).xyz;
  vec4 value = texelFetch(entering, ivec2(row.xy) >> shift, level);
  result[0] = row.z > 0.0 && value.a > 0.0 ? vec4(value.rgb / value.a, 0.0) : vec4(0.0);
}
