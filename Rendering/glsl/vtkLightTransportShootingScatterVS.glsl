//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause

// A vertex per pixel of the item buffer that lies above the horizon. The first pixel of a run that sees the same patch becomes a point
// at the texel of that patch; all others are clipped.
//VTK::LightTransport::Define

uniform sampler2D items;
// Of each eye point: the texel of its shooter, and the share of the shooter's power that one unit of weight carries.
uniform vec4 shooters[MOST_EYES];
uniform int resolution;
uniform ivec2 size;

flat out ivec2 shooter;
flat out float share;

// Runs end at multiples of this, so that no vertex works much longer than others.
const int LONGEST_RUN = 32;

// Proportional to the view factor of a pixel from the eye point (Beran-Koehn and Pavicic 1992).
float Weight(int column, int row)
{
  vec2 at = 3.0 * (vec2(column, row) + 0.5) / float(resolution) - 2.0;
  float square = 1.0 + dot(at, at);
  return (1.0 + at.x + at.y) / (square * square);
}

void main()
{
  // Row r of a face has r pixels above the horizon, its last ones: rows r and resolution - 1 - r together have resolution - 1.
  int length = resolution - 1;
  int perFace = resolution / 2 * length;
  int face = gl_VertexID / perFace;
  int pair = gl_VertexID % perFace / length;
  int place = gl_VertexID % length;
  int row = place < pair ? pair : length - pair;
  int first = resolution - row;
  int column = first + (place < pair ? place : place - pair);
  int eye = face / 3;
  ivec2 corner = ivec2(face % 3, eye) * resolution;
  float item = texelFetch(items, corner + ivec2(column, row), 0).x;
  bool begins = column == first || column % LONGEST_RUN == 0 || texelFetch(items, corner + ivec2(column - 1, row), 0).x != item;

  shooter = ivec2(shooters[eye].xy);
  share = 0.0;
  gl_PointSize = 1.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  // Nothing seen: 0. The back of a patch: negative.
  if (item > 0.0 && begins)
  {
    float weight = Weight(column, row);
    for (++column; column < resolution && column % LONGEST_RUN != 0; ++column)
    {
      if (texelFetch(items, corner + ivec2(column, row), 0).x != item)
      {
        break;
      }
      weight += Weight(column, row);
    }
    share = weight * shooters[eye].z;
    int index = int(item) - 1;
    ivec2 texel = ivec2(index % size.x, index / size.x);
    gl_Position = vec4(2.0 * (vec2(texel) + 0.5) / vec2(size) - 1.0, 0.0, 1.0);
  }
}
