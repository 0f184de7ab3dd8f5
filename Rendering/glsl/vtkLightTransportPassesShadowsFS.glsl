// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
uniform mat4 lightTransportToScene; // from view coordinates
uniform vec4 lightTransportLights[LIGHT_TRANSPORT_LIGHTS]; // what is towards a distant one; the place of another, and 1; -1 for one that is nowhere
uniform float lightTransportShadowBias;

// How far off coordinates of a fragment may be, of its distance from the eye.
const float LIGHT_TRANSPORT_ROUNDING = 4e-7;

float lightTransportLit[LIGHT_TRANSPORT_LIGHTS];

// That of the facet, of length 1. Lines and points have none: across them their place is the same but for rounding, which is no
// normal.
vec3 LightTransportGetFacetNormal(vec3 positionVC)
{
  vec3 right = dFdx(positionVC);
  vec3 up = dFdy(positionVC);
  vec3 facet = mat3(lightTransportToScene) * cross(right, up);
  float size = length(facet);
  float rounding = LIGHT_TRANSPORT_ROUNDING * length(positionVC) * (length(right) + length(up));
  return size > rounding ? facet / size : vec3(0.0);
}

// Facets are lit on the side that is seen.
void LightTransportFindLitLights(vec3 positionVC)
{
  vec3 normal = LightTransportGetFacetNormal(positionVC);
  bool isFacet = normal != vec3(0.0);
  float bias = lightTransportShadowBias + LIGHT_TRANSPORT_ROUNDING * length(positionVC);
  vec3 position = (lightTransportToScene * vec4(positionVC, 1.0)).xyz;
  for (int light = 0; light < LIGHT_TRANSPORT_LIGHTS; ++light)
  {
    vec4 place = lightTransportLights[light];
    vec3 towards = place.w > 0.0 ? place.xyz - position : place.xyz;
    float distance = length(towards);
    vec3 direction = towards / max(distance, 1e-30);
    vec3 from = position + bias * (isFacet ? normal : direction);
    bool isHidden = place.w >= 0.0 && ((isFacet && dot(normal, direction) <= 0.0) ||
      LightTransportIsBlocked(from, direction, place.w > 0.0 ? distance - 2.0 * bias : 1e30));
    lightTransportLit[light] = isHidden ? 0.0 : 1.0;
  }
}
