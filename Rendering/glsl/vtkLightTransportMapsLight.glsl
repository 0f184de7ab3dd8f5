// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What a light gives a place of a surface per unit area: what enters through a smooth boundary (Fresnel), where nothing is in the
// way. Coordinates are those of the world, from a place near by.
uniform float refractiveIndex;
uniform vec3 color;
uniform int isPositional;
uniform vec3 lightPosition;
uniform vec3 lightAxis;
uniform vec3 attenuation;
uniform float coneCosine;
uniform float exponent;
uniform sampler2D shadows;
uniform int hasShadows;
uniform int face;
uniform float bias;

// Where rasterisation rounds the corners of triangles to, in texels.
const float CORNER_ROUNDING = 1.0 / 64.0;

// How far along the axis the plane of the sample is that is seen at a place of the shadow map. Triangles so cast no shadow on
// themselves, however slanted, and need no bias for it.
float GetPlaneDepth(vec2 place, vec3 seen, vec3 normal)
{
  if (isPerspective == 0)
  {
    return seen.z - dot(normal.xy, frame.xy + place * frame.zw - seen.xy) / normal.z;
  }
  float slant = dot(normal, vec3(place * frame.zw, 1.0));
  return slant < 0.0 ? dot(normal, seen) / slant : seen.z;
}

// Between the four texels around.
float GetLitPart(vec3 position, vec3 facet)
{
  vec3 seen = TurnToView(position - viewOrigin);
  vec3 normal = TurnToView(facet);
  vec2 place = isPerspective != 0 ? seen.xy / (seen.z * frame.zw) : (seen.xy - frame.xy) / frame.zw;
  float size = float(textureSize(shadows, 0).x);
  float texel = 2.0 * max(frame.z, frame.w) / size * (isPerspective != 0 ? seen.z : 1.0);
  float slant = isPerspective != 0 ? dot(normal, seen) / seen.z : normal.z;
  float slope = length(normal.xy) / max(-slant, 1e-6);
  float allowed = bias + CORNER_ROUNDING * texel * slope;
  vec2 at = (0.5 * place + 0.5) * size - 0.5;
  vec2 first = floor(at);
  vec2 part = at - first;
  float lit = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    vec2 step = vec2(float(k & 1), float(k >> 1));
    vec2 where = clamp(first + step, 0.0, size - 1.0);
    float depth = range.x + texelFetch(shadows, ivec2(where), 0).r * (range.y - range.x);
    float plane = GetPlaneDepth((where + 0.5) / size * 2.0 - 1.0, seen, normal);
    vec2 share = mix(1.0 - part, part, step);
    lit += plane - allowed <= depth ? share.x * share.y : 0.0;
  }
  return lit;
}

// The face of a cube around the light through which it shines here.
int GetFace(vec3 path)
{
  vec3 along = abs(path);
  int axis = along.x >= along.y && along.x >= along.z ? 0 : (along.y >= along.z ? 1 : 2);
  return 2 * axis + (path[axis] >= 0.0 ? 0 : 1);
}

// On a triangle (facet: its normal) that may have bumps (normal).
vec3 GetEntering(vec3 position, vec3 facet, vec3 normal)
{
  vec3 towards = -lightAxis;
  float strength = 1.0;
  bool isSeen = true;
  if (isPositional != 0)
  {
    vec3 path = position - lightPosition;
    float distance = length(path);
    towards = -path / max(distance, 1e-30);
    strength = 1.0 / (attenuation.x + distance * (attenuation.y + distance * attenuation.z));
    isSeen = face < 0 || face == GetFace(path);
    if (coneCosine > 0.0)
    {
      float along = dot(-towards, lightAxis);
      strength *= along >= coneCosine ? pow(max(along, 0.0), exponent) : 0.0;
    }
  }
  float cosine = dot(normal, towards);
  if (!isSeen || cosine <= 0.0 || dot(facet, towards) <= 0.0 || strength <= 0.0)
  {
    return vec3(0.0);
  }
  float transmittance = refractiveIndex > 1.0 ? 1.0 - LightTransportFresnel(cosine, refractiveIndex) : 1.0;
  return color * (strength * cosine * transmittance * (hasShadows != 0 ? GetLitPart(position, facet) : 1.0));
}
