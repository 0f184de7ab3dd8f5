// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
uniform vec4 lightTransportLights[LIGHT_TRANSPORT_LIGHTS]; // what is towards a distant one; the place of another, and 1; -1 for one that is nowhere

float lightTransportLit[LIGHT_TRANSPORT_LIGHTS];

// Facets are lit on the side that is seen.
void LightTransportFindLitLights(vec3 positionVC)
{
  vec3 normal = LightTransportGetFacetNormal(positionVC);
  bool isFacet = normal != vec3(0.0);
  float bias = LightTransportGetBias(positionVC);
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
