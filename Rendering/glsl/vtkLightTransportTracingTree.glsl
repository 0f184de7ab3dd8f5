// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What rays meet of the triangles of a scene (TriangleTree.h).
#ifndef LIGHT_TRANSPORT_TRACING
#define LIGHT_TRANSPORT_TRACING
uniform sampler2D lightTransportTree;
uniform int lightTransportTreeWidthBits;
uniform int lightTransportTreeBoxes;
uniform mat4 lightTransportToScene; // from view coordinates
uniform float lightTransportRayBias;

// How far off coordinates of a fragment may be, of its distance from the eye.
const float LIGHT_TRANSPORT_ROUNDING = 4e-7;

// How far from a fragment rays begin.
float LightTransportGetBias(vec3 positionVC)
{
  return lightTransportRayBias + LIGHT_TRANSPORT_ROUNDING * length(positionVC);
}

// That of the facet, of length 1, towards the eye. Lines and points have none: across them their place is the same but for rounding,
// which is no normal.
vec3 LightTransportGetFacetNormal(vec3 positionVC)
{
  vec3 right = dFdx(positionVC);
  vec3 up = dFdy(positionVC);
  vec3 facet = mat3(lightTransportToScene) * cross(right, up);
  float size = length(facet);
  float rounding = LIGHT_TRANSPORT_ROUNDING * length(positionVC) * (length(right) + length(up));
  return size > rounding ? facet / size : vec3(0.0);
}

vec4 LightTransportGetTexel(int texel)
{
  return texelFetch(lightTransportTree, ivec2(texel & ((1 << lightTransportTreeWidthBits) - 1), texel >> lightTransportTreeWidthBits), 0);
}

// Right and up of a ray, and the ray.
mat3 LightTransportGetAxes(vec3 direction)
{
  vec3 aside = abs(direction.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 right = normalize(cross(aside, direction));
  return mat3(right, cross(direction, right), direction);
}

float LightTransportCross(vec2 a, vec2 b)
{
  return a.x * b.y - a.y * b.x;
}

// How far along a ray a triangle is, or a negative number. Corners are seen from the ray alike by all triangles that share them, so
// that none passes between two (S. Woop, C. Benthin, I. Wald, Watertight ray/triangle intersection, 2013).
float LightTransportMeet(int triangle, vec3 origin, mat3 axes, out bool isLast)
{
  int texel = 2 * lightTransportTreeBoxes + 3 * triangle;
  vec4 first = LightTransportGetTexel(texel);
  isLast = first.w > 0.0;
  vec3 a = (first.xyz - origin) * axes;
  vec3 b = (LightTransportGetTexel(texel + 1).xyz - origin) * axes;
  vec3 c = (LightTransportGetTexel(texel + 2).xyz - origin) * axes;
  vec3 parts = vec3(LightTransportCross(b.xy, c.xy), LightTransportCross(c.xy, a.xy), LightTransportCross(a.xy, b.xy));
  float whole = parts.x + parts.y + parts.z;
  bool isMet = whole != 0.0 && (all(greaterThanEqual(parts, vec3(0.0))) || all(lessThanEqual(parts, vec3(0.0))));
  return isMet ? dot(parts, vec3(a.z, b.z, c.z)) / whole : -1.0;
}

// How far the triangle is that is met first, up to a distance; or any, where that is enough. Its number; -1 for none.
float LightTransportTrace(vec3 origin, vec3 direction, float reach, bool isAnyEnough, out int met)
{
  met = -1;
  mat3 axes = LightTransportGetAxes(direction);
  vec3 inverse = 1.0 / mix(direction, vec3(1e-18), lessThan(abs(direction), vec3(1e-18)));
  for (int box = 0; box < lightTransportTreeBoxes;)
  {
    vec4 lower = LightTransportGetTexel(2 * box);
    vec4 upper = LightTransportGetTexel(2 * box + 1);
    vec3 there = (lower.xyz - origin) * inverse;
    vec3 beyond = (upper.xyz - origin) * inverse;
    vec3 begins = min(there, beyond);
    vec3 ends = max(there, beyond);
    float begin = max(max(begins.x, begins.y), begins.z);
    float end = min(min(ends.x, ends.y), ends.z);
    if (begin > end || end < 0.0 || begin > reach)
    {
      box = int(lower.w);
      continue;
    }
    bool isLast = upper.w < 0.0;
    for (int triangle = int(upper.w); !isLast; ++triangle)
    {
      float distance = LightTransportMeet(triangle, origin, axes, isLast);
      if (distance > 0.0 && distance < reach)
      {
        reach = distance;
        met = triangle;
        if (isAnyEnough)
        {
          return reach;
        }
      }
    }
    ++box;
  }
  return reach;
}

// Whether anything is in the way, up to a distance.
bool LightTransportIsBlocked(vec3 origin, vec3 direction, float reach)
{
  int met;
  LightTransportTrace(origin, direction, reach, true, met);
  return met >= 0;
}

vec3 LightTransportGetNormal(int triangle)
{
  int texel = 2 * lightTransportTreeBoxes + 3 * triangle;
  vec3 corner = LightTransportGetTexel(texel).xyz;
  return normalize(cross(LightTransportGetTexel(texel + 1).xyz - corner, LightTransportGetTexel(texel + 2).xyz - corner));
}

// The number of what a triangle is of.
int LightTransportGetBody(int triangle)
{
  return int(LightTransportGetTexel(2 * lightTransportTreeBoxes + 3 * triangle + 1).w);
}
#endif
