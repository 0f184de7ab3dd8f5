// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#if LIGHT_TRANSPORT_IS_MAPPED
  int lightTransportTexel = 2 * gl_VertexID;
  ivec2 lightTransportAt = ivec2(lightTransportTexel & ((1 << lightTransportPointWidthBits) - 1), lightTransportTexel >> lightTransportPointWidthBits);
  lightTransportVSOutput = texelFetch(lightTransportPoints, lightTransportAt, 0).xyz;
  lightTransportBlockVSOutput = texelFetch(lightTransportPoints, lightTransportAt + ivec2(1, 0), 0).xyz;
#else
  lightTransportVSOutput = lightTransportMC;
  lightTransportBlockVSOutput = vec3(0.0);
#endif
  lightTransportPositionVSOutput = (MCVCMatrix * vertexMC).xyz;
