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
  gl_FragData[0] = vec4(LightTransportEncode(lightTransportDirect + lightTransportWeight * LightTransportRadiance()), gl_FragData[0].a);
