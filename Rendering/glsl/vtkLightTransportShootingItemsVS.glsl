//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause

// Instance 3 k + f draws the scene as eye point k sees it through face f, into the square (f, k) of the item buffer.
//VTK::LightTransport::Define

in vec3 position;

// Of each eye point: its position, then three perpendicular axes, around the shooter's normal. The fourth components of the first two:
// what is lower than this over the shooter's plane, plus the second times the distance, is on it.
uniform vec4 eyes[4 * MOST_EYES];
uniform int numberOfEyes;

void main()
{
  int eye = gl_InstanceID / 3;
  int face = gl_InstanceID % 3;
  vec3 sight = position - eyes[4 * eye].xyz;
  float a = dot(sight, eyes[4 * eye + 1 + face].xyz);
  float b = dot(sight, eyes[4 * eye + 1 + (face + 1) % 3].xyz);
  float c = dot(sight, eyes[4 * eye + 1 + (face + 2) % 3].xyz);
  // In front of the shooter, and nearer to this axis than to the others: a triangle of the square with corners (-2, -2) and (1, 1).
  gl_ClipDistance[0] = (a + b + c) / sqrt(3.0) - eyes[4 * eye].w - eyes[4 * eye + 1].w * length(sight);
  gl_ClipDistance[1] = a - b;
  gl_ClipDistance[2] = a - c;
  gl_Position = vec4(((2.0 * c + a) / 3.0 + float(2 * face - 2) * a) / 3.0,
    ((2.0 * b + a) / 3.0 + float(2 * eye + 1 - numberOfEyes) * a) / float(numberOfEyes), 0.0, a);
}
