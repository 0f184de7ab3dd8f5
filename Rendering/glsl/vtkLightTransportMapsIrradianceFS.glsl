// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What enters a sample of a surface per unit area, times the area. GetEntering says what that is, here or in the vertex shader.
in vec3 scenePosition;
flat in vec3 sceneNormal;
flat in vec2 shareOfAtlas;
uniform float weight;    // of a sample
uniform float countsArea; // 1 where the area is to be added, too

#ifdef HAS_BUMPS
uniform sampler2D bumps; // normals in tangent space
uniform float bumpScale;
in vec2 textureCoordinates;
in vec3 sceneTangent;

// As VTK's own shading has it.
vec3 GetBumpedNormal()
{
  vec3 bump = (texture(bumps, textureCoordinates).xyz * 2.0 - 1.0) * vec3(bumpScale, bumpScale, 1.0);
  vec3 tangent = sceneTangent - dot(sceneTangent, sceneNormal) * sceneNormal;
  float size = length(tangent);
  return size > 0.0 ? normalize(mat3(tangent / size, cross(sceneNormal, tangent / size), sceneNormal) * bump) : sceneNormal;
}
#else
vec3 GetBumpedNormal()
{
  return sceneNormal;
}
#endif

#ifdef IS_LIT_AT_CORNERS
in vec3 cornerLight;
#else
//VTK::LightTransport::Light
#endif

void main()
{
#ifdef IS_LIT_AT_CORNERS
  vec3 light = cornerLight;
#else
  vec3 light = GetEntering(scenePosition, sceneNormal, GetBumpedNormal());
#endif
  result[0] = weight * shareOfAtlas.x * vec4(light, countsArea);
}
