// Samples an atlas of charts that fill square blocks of texels (vtkOpenGLAtlasTexture), without reading a texel of another chart.
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause

// One level, which is whole. What bilinear filtering weighs lies within half a texel of that level around the place. The numbers
// are dyadic: at the border of the shrunk block the weight of the foreign texels is 0 exactly.
vec4 SampleAtlasLevel(sampler2D atlas, vec2 place, vec3 block, float level)
{
  float resolution = float(textureSize(atlas, 0).x);
  float border = 0.5 * float(1 << int(level));
  vec2 inside = clamp(place * resolution, block.xy + border, block.xy + block.z - border);
  return textureLod(atlas, inside / resolution, level);
}

// The mean of the values around a place of the atlas, weighted with the area of the surface, and the area of a texel there.
// place: atlas coordinates; block: of the chart, x, y and size in texels of level 0, size a power of two of which x and y are
// multiples; level: of detail. Levels above the chart's single texel are that texel.
vec4 SampleAtlas(sampler2D atlas, vec2 place, vec3 block, float level)
{
  float highest = round(log2(block.z));
  float within = clamp(level, 0.0, highest);
  float finer = floor(within);
  vec4 sum = SampleAtlasLevel(atlas, place, block, finer);
  if (within > finer)
  {
    sum = mix(sum, SampleAtlasLevel(atlas, place, block, finer + 1.0), within - finer);
  }
  return sum.a > 0.0 ? vec4(sum.rgb / sum.a, sum.a) : vec4(0.0);
}
