// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
uniform mat4 lightTransportToScene; // from view coordinates
uniform vec4 lightTransportLights[LIGHT_TRANSPORT_LIGHTS]; // what is towards a distant one; the place of another, and 1
uniform float lightTransportShadowBias;

// How far off coordinates of a fragment may be, of its distance from the eye.
const float LIGHT_TRANSPORT_ROUNDING = 4e-7;

float lightTransportLit[LIGHT_TRANSPORT_LIGHTS];

// Facets are lit on the side that is seen. A fragment of a line has no facet.
void LightTransportFindLitLights(vec3 positionVC)
{
  vec3 facet = mat3(lightTransportToScene) * cross(dFdx(positionVC), dFdy(positionVC));
  float size = length(facet);
  vec3 normal = size > 0.0 ? facet / size : vec3(0.0);
  float bias = lightTransportShadowBias + LIGHT_TRANSPORT_ROUNDING * length(positionVC);
  vec3 position = (lightTransportToScene * vec4(positionVC, 1.0)).xyz + bias * normal;
  for (int light = 0; light < LIGHT_TRANSPORT_LIGHTS; ++light)
  {
    vec4 place = lightTransportLights[light];
    vec3 towards = place.w > 0.0 ? place.xyz - position : place.xyz;
    float distance = length(towards);
    vec3 direction = towards / max(distance, 1e-30);
    bool isHidden = (size > 0.0 && dot(normal, direction) <= 0.0) ||
      LightTransportIsBlocked(position, direction, place.w > 0.0 ? distance - bias : 1e30);
    lightTransportLit[light] = isHidden ? 0.0 : 1.0;
  }
}
