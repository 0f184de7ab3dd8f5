// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec3 lightTransportVSOutput;
in vec3 lightTransportPositionVSOutput;
uniform int lightTransportComponents;
uniform int lightTransportParallel;
uniform int lightTransportEncodeSRGB;
uniform int lightTransportShadingIsEncoded;
uniform float lightTransportExposure;
uniform float lightTransportRefractiveIndex;
uniform float lightTransportTransmittance;

// Radiant exitance of this fragment over pi.
vec3 LightTransportRadiance()
{
  vec3 value = lightTransportComponents == 1 ? vec3(lightTransportVSOutput.x) : lightTransportVSOutput;
  return value / 3.14159265358979;
}

// Fraction of unpolarised light that a smooth boundary reflects, seen from outside at this cosine.
float LightTransportFresnel(float cosine)
{
  float index = lightTransportRefractiveIndex;
  float inside = sqrt(max(index * index - 1.0 + cosine * cosine, 0.0));
  float parallel = (index * index * cosine - inside) / max(index * index * cosine + inside, 1e-9);
  float perpendicular = (cosine - inside) / max(cosine + inside, 1e-9);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
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
