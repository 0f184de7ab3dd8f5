// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
  // What VTK's own shading has drawn is the light that the surface reflects at once.
  vec3 lightTransportDirect = gl_FragData[0].rgb;
  if (lightTransportShadingIsEncoded != 0)
  {
    lightTransportDirect = pow(max(lightTransportDirect, vec3(0.0)), vec3(2.2));
  }
  vec3 lightTransportToEye = lightTransportParallel != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-lightTransportPositionVSOutput);
  float lightTransportCosine = clamp(abs(dot(lightTransportNormal, lightTransportToEye)), 0.0, 1.0);
  float lightTransportWeight = (1.0 - LightTransportFresnel(lightTransportCosine, lightTransportRefractiveIndex)) / lightTransportTransmittance;
  vec3 lightTransportSum = lightTransportDirect + lightTransportWeight * LightTransportRadiance();
#ifdef LIGHT_TRANSPORT_MARCHED_LIGHTS
  lightTransportSum += LightTransportMarch(lightTransportPositionVSOutput, lightTransportNormal, lightTransportToEye);
#endif
  gl_FragData[0] = vec4(LightTransportEncode(lightTransportSum), gl_FragData[0].a);
