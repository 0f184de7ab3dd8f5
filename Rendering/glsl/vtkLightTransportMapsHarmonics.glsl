// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What an environment gives a surface with nothing in the way, by its normal: spherical harmonics up to degree 2, each with what of
// it enters.
uniform vec3 entering[9];

vec3 GetEntering(vec3 position, vec3 facet, vec3 normal)
{
  vec3 n = normal;
  vec3 sum = 0.28209479177387814 * entering[0];
  sum += 0.4886025119029199 * (n.y * entering[1] + n.z * entering[2] + n.x * entering[3]);
  sum += 1.0925484305920792 * (n.x * n.y * entering[4] + n.y * n.z * entering[5] + n.z * n.x * entering[7]);
  sum += 0.31539156525252005 * (3.0 * n.z * n.z - 1.0) * entering[6];
  sum += 0.5462742152960396 * (n.x * n.x - n.y * n.y) * entering[8];
  return max(sum, vec3(0.0));
}
