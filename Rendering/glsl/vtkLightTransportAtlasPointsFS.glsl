// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Samples an atlas at one point per texel: x, y in atlas coordinates and the level, and the blocks of their charts.
uniform sampler2D atlas;
uniform sampler2D points;
uniform sampler2D blocks;

void main()
{
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 point = texelFetch(points, texel, 0).xyz;
  result[0] = SampleAtlas(atlas, point.xy, texelFetch(blocks, texel, 0).xyz, point.z);
}
