// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Light from an array of the surface, in the vertex shader: the product of a tuple, of 4 VALUE_ENTRIES components, with weights.
uniform sampler2D values;
uniform int areOfPoints; // else of triangles
uniform vec3 weights[4 * VALUE_ENTRIES];

vec3 GetEntering(vec3 position, vec3 facet, vec3 normal)
{
  int tuple = areOfPoints != 0 ? int(share.z + 0.5) : gl_VertexID / 3;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < VALUE_ENTRIES; ++k)
  {
    vec4 value = GetEntry(values, tuple * VALUE_ENTRIES + k);
    sum += value.x * weights[4 * k] + value.y * weights[4 * k + 1] + value.z * weights[4 * k + 2] + value.w * weights[4 * k + 3];
  }
  return max(sum, vec3(0.0));
}
