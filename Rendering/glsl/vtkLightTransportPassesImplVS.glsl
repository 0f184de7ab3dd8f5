  lightTransportVSOutput = lightTransportMC;
  lightTransportPositionVSOutput = (MCVCMatrix * vertexMC).xyz;
