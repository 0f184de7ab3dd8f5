    lightTransportGSOutput = lightTransportVSOutput[i];
    lightTransportPositionGSOutput = lightTransportPositionVSOutput[i];
