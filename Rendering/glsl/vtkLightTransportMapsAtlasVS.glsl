// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface, drawn where they lie in its atlas.
//VTK::System::Dec
in vec3 position;
in vec3 normal;
in vec2 place;
in vec2 share; // surface on a unit of the atlas, chart
uniform mat4 toScene;
uniform mat3 turn;
uniform vec2 shift;
out vec3 scenePosition;
flat out vec3 sceneNormal;
flat out vec2 shareOfAtlas;

void main()
{
  scenePosition = (toScene * vec4(position, 1.0)).xyz;
  sceneNormal = normalize(turn * normal);
  shareOfAtlas = share;
  gl_Position = vec4(2.0 * (place + shift) - 1.0, 0.0, 1.0);
}
