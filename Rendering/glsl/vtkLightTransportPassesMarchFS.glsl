// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Light that is scattered once in a body, on the refracted way of what the eye sees (MarchedScattering.h). Four vectors a light: its
// place, or what is towards it, and 1 or 0; where it shines to, and the cosine of its cone; color, and exponent; attenuation.
uniform vec4 lightTransportSources[4 * LIGHT_TRANSPORT_MARCHED_LIGHTS];
// Of the medium, per length of the scene.
uniform vec3 lightTransportScattering;
uniform vec3 lightTransportExtinction;
uniform vec3 lightTransportAnisotropy;
uniform float lightTransportMediumIndex;
uniform int lightTransportBody;
uniform int lightTransportSteps;

// Times that the way of light may pass the surface of the body.
const int LIGHT_TRANSPORT_CROSSINGS = 16;
// Mean free paths after which nothing is left.
const float LIGHT_TRANSPORT_DARKNESS = 40.0;
// Part of light that is not followed on.
const float LIGHT_TRANSPORT_NOTHING = 1e-6;

// Henyey and Greenstein.
vec3 LightTransportGetPhase(float cosine)
{
  vec3 g = lightTransportAnisotropy;
  return (1.0 - g * g) / (12.5663706144 * pow(1.0 + g * g - 2.0 * g * cosine, vec3(1.5)));
}

// At normal incidence, at a distance along a direction towards the light.
vec3 LightTransportGetIrradiance(int light, vec3 towards, float distance)
{
  vec4 axis = lightTransportSources[4 * light + 1];
  vec4 color = lightTransportSources[4 * light + 2];
  vec3 attenuation = lightTransportSources[4 * light + 3].xyz;
  if (lightTransportSources[4 * light].w <= 0.0)
  {
    return color.rgb;
  }
  float along = dot(-towards, axis.xyz);
  float cone = axis.w <= 0.0 ? 1.0 : (along >= axis.w ? pow(max(along, 0.0), color.w) : 0.0);
  return color.rgb * cone / (attenuation.x + distance * (attenuation.y + distance * attenuation.z));
}

// The extinction of the clearest band.
float LightTransportGetClearest()
{
  return min(min(lightTransportExtinction.x, lightTransportExtinction.y), lightTransportExtinction.z);
}

// Inside a boundary, of the angle that has this cosine outside.
float LightTransportGetInnerCosine(float cosine)
{
  float index = lightTransportMediumIndex;
  return sqrt(index * index - 1.0 + cosine * cosine) / index;
}

float LightTransportGetTransmittance(float cosine)
{
  return lightTransportMediumIndex > 1.0 ? 1.0 - LightTransportFresnel(cosine, lightTransportMediumIndex) : 1.0;
}

// What of a light arrives at a place in the body, scattered towards a direction. The way to the light is straight; what refraction does
// to its length and strength is that of a flat surface where it passes.
vec3 LightTransportScatterOnce(int light, vec3 position, vec3 outgoing, float bias)
{
  vec4 place = lightTransportSources[4 * light];
  vec3 path = place.w > 0.0 ? place.xyz - position : place.xyz;
  float reach = place.w > 0.0 ? length(path) : 1e30;
  vec3 towards = normalize(path);
  float gone = 0.0;
  float apparent = reach;
  vec3 passed = vec3(1.0);
  bool isInside = true;
  for (int crossing = 0; crossing < LIGHT_TRANSPORT_CROSSINGS; ++crossing)
  {
    int met;
    float end = isInside ? min(reach - gone, LIGHT_TRANSPORT_DARKNESS / LightTransportGetClearest()) : reach - gone;
    float step = LightTransportTrace(position + gone * towards, towards, end, false, met);
    if (met < 0)
    {
      return isInside ? vec3(0.0) : passed * LightTransportGetIrradiance(light, towards, apparent);
    }
    if (LightTransportGetBody(met) != lightTransportBody)
    {
      return vec3(0.0);
    }
    vec3 normal = LightTransportGetNormal(met);
    normal = dot(normal, towards) < 0.0 ? -normal : normal;
    float cosine = clamp(dot(normal, towards), 1e-6, 1.0);
    float inner = LightTransportGetInnerCosine(cosine);
    passed *= LightTransportGetTransmittance(cosine);
    if (isInside)
    {
      float way = (crossing == 0 ? step : step + bias) * cosine / inner;
      passed *= exp(-lightTransportExtinction * way);
      apparent -= step - way / lightTransportMediumIndex;
    }
    if (max(max(passed.x, passed.y), passed.z) < LIGHT_TRANSPORT_NOTHING)
    {
      return vec3(0.0);
    }
    if (crossing == 0)
    {
      vec3 arriving = refract(-towards, normal, 1.0 / lightTransportMediumIndex);
      passed *= LightTransportGetPhase(dot(arriving, outgoing)) * cosine / inner;
    }
    isInside = !isInside;
    gone += step + bias;
  }
  return vec3(0.0);
}

// The integral of exp(-x) over a step from 0 on, over its length in x.
vec3 LightTransportGetMeanPassed(vec3 x)
{
  vec3 few = 1.0 - x * (0.5 - x * (1.0 / 6.0));
  vec3 many = (1.0 - exp(-x)) / max(x, vec3(1e-6));
  return mix(many, few, lessThan(x, vec3(0.01)));
}

// How far along a way light has come when a part of what it loses there is lost; all lengths in mean free paths.
float LightTransportGetStep(float part, float whole)
{
  return whole < 0.01 ? part * whole : -log(max(1.0 - part * (1.0 - exp(-whole)), 1e-20));
}

// Radiance towards the eye, all in view coordinates. In each step the clearest band loses as much.
vec3 LightTransportMarch(vec3 positionVC, vec3 normalVC, vec3 toEyeVC)
{
  mat3 turn = mat3(lightTransportToScene);
  float bias = LightTransportGetBias(positionVC);
  vec3 facet = LightTransportGetFacetNormal(positionVC);
  vec3 toEye = normalize(turn * toEyeVC);
  vec3 normal = normalize(turn * normalVC);
  vec3 along = refract(-toEye, normal, 1.0 / lightTransportMediumIndex);
  if (dot(normal, toEye) <= 0.0 || dot(along, facet) >= 0.0)
  {
    normal = facet;
    along = refract(-toEye, normal, 1.0 / lightTransportMediumIndex);
  }
  if (facet == vec3(0.0))
  {
    return vec3(0.0);
  }
  vec3 from = (lightTransportToScene * vec4(positionVC, 1.0)).xyz;
  float clearest = LightTransportGetClearest();
  // Rays begin within.
  float first = bias / max(-dot(along, facet), 0.01);
  int met;
  float whole = clearest * (first + LightTransportTrace(from + first * along, along, LIGHT_TRANSPORT_DARKNESS / clearest, false, met));
  vec3 sum = vec3(0.0);
  for (int k = 0; k < lightTransportSteps; ++k)
  {
    float steps = float(lightTransportSteps);
    float begin = LightTransportGetStep(float(k) / steps, whole) / clearest;
    float middle = LightTransportGetStep((float(k) + 0.5) / steps, whole) / clearest;
    float size = LightTransportGetStep(float(k + 1) / steps, whole) / clearest - begin;
    vec3 scattered = lightTransportScattering * size * exp(-lightTransportExtinction * begin) *
      LightTransportGetMeanPassed(lightTransportExtinction * size);
    for (int light = 0; light < LIGHT_TRANSPORT_MARCHED_LIGHTS; ++light)
    {
      sum += scattered * LightTransportScatterOnce(light, from + max(middle, first) * along, -along, bias);
    }
  }
  float cosine = clamp(dot(normal, toEye), 0.0, 1.0);
  return sum * LightTransportGetTransmittance(cosine) / (lightTransportMediumIndex * lightTransportMediumIndex);
}
