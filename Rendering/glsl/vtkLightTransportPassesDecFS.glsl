// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec3 lightTransportVSOutput;
flat in vec3 lightTransportBlockVSOutput;
in vec3 lightTransportPositionVSOutput;
uniform int lightTransportComponents;
uniform int lightTransportParallel;
uniform int lightTransportEncodeSRGB;
uniform int lightTransportShadingIsEncoded;
uniform float lightTransportExposure;
uniform float lightTransportRefractiveIndex;
uniform float lightTransportTransmittance;

#if LIGHT_TRANSPORT_IS_MAPPED
uniform sampler2D lightTransportMap;
#endif

// Radiant exitance of this fragment over pi.
vec3 LightTransportRadiance()
{
#if LIGHT_TRANSPORT_IS_MAPPED
  vec2 place = lightTransportVSOutput.xy;
  float size = float(textureSize(lightTransportMap, 0).x);
  float texels = size * max(length(dFdx(place)), length(dFdy(place)));
  vec3 value = SampleAtlas(lightTransportMap, place, size * lightTransportBlockVSOutput, log2(max(texels, 1.0))).rgb;
#else
  bool isGrey = LIGHT_TRANSPORT_IS_GROUPED == 0 && lightTransportComponents == 1;
  vec3 value = isGrey ? vec3(lightTransportVSOutput.x) : lightTransportVSOutput;
#endif
  return value / 3.14159265358979;
}

// Radiance as the picture stores it.
vec3 LightTransportEncode(vec3 radiance)
{
  vec3 exposed = max(lightTransportExposure * radiance, vec3(0.0));
  if (lightTransportEncodeSRGB == 0)
  {
    return exposed;
  }
  vec3 curved = 1.055 * pow(max(exposed, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(curved, 12.92 * exposed, vec3(lessThanEqual(exposed, vec3(0.0031308))));
}
