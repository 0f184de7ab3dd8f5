// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface, drawn where they lie in its atlas.
//VTK::System::Dec
//VTK::LightTransport::Define
in vec3 position;
in vec3 normal;
in vec2 place;
in vec3 share; // surface on a unit of the atlas, chart, number of the point
uniform mat4 toScene;
uniform mat3 turn;
uniform vec2 shift;
out vec3 scenePosition;
flat out vec3 sceneNormal;
flat out vec2 shareOfAtlas;

// A table of RGBA texels, 2^TABLE_WIDTH_BITS in a line.
vec4 GetEntry(sampler2D table, int entry)
{
  return texelFetch(table, ivec2(entry & ((1 << TABLE_WIDTH_BITS) - 1), entry >> TABLE_WIDTH_BITS), 0);
}

#ifdef IS_LIT_AT_CORNERS
//VTK::LightTransport::Light
out vec3 cornerLight;
#endif
#ifdef HAS_BUMPS
uniform sampler2D tangents; // two entries for each point: texture coordinates, tangent
out vec2 textureCoordinates;
out vec3 sceneTangent;
#endif

void main()
{
  scenePosition = (toScene * vec4(position, 1.0)).xyz;
  sceneNormal = normalize(turn * normal);
  shareOfAtlas = share.xy;
#ifdef IS_LIT_AT_CORNERS
  cornerLight = GetEntering(scenePosition, sceneNormal, sceneNormal);
#endif
#ifdef HAS_BUMPS
  int point = int(share.z + 0.5);
  textureCoordinates = GetEntry(tangents, 2 * point).xy;
  sceneTangent = mat3(toScene) * GetEntry(tangents, 2 * point + 1).xyz;
#endif
  gl_Position = vec4(2.0 * (place + shift) - 1.0, 0.0, 1.0);
}
