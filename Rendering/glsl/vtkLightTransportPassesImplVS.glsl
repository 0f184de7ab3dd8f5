// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#if LIGHT_TRANSPORT_IS_MAPPED
  int lightTransportTexel = 2 * gl_VertexID;
  ivec2 lightTransportAt = ivec2(lightTransportTexel & ((1 << lightTransportPointWidthBits) - 1), lightTransportTexel >> lightTransportPointWidthBits);
  lightTransportVSOutput = texelFetch(lightTransportPoints, lightTransportAt, 0).xyz;
  lightTransportBlockVSOutput = texelFetch(lightTransportPoints, lightTransportAt + ivec2(1, 0), 0).xyz;
#elif LIGHT_TRANSPORT_IS_GROUPED
  // Points of no patch are black.
  int lightTransportGroup = int(lightTransportMC.x);
  ivec2 lightTransportAt = ivec2(lightTransportGroup & ((1 << lightTransportGroupWidthBits) - 1), lightTransportGroup >> lightTransportGroupWidthBits);
  lightTransportVSOutput = lightTransportGroup < 0 ? vec3(0.0) : texelFetch(lightTransportGroups, lightTransportAt, 0).xyz;
  lightTransportBlockVSOutput = vec3(0.0);
#elif LIGHT_TRANSPORT_IS_EMPTY
  lightTransportVSOutput = vec3(0.0);
  lightTransportBlockVSOutput = vec3(0.0);
#else
  lightTransportVSOutput = lightTransportMC;
  lightTransportBlockVSOutput = vec3(0.0);
#endif
  lightTransportPositionVSOutput = (MCVCMatrix * vertexMC).xyz;
