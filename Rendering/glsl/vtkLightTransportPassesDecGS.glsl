in vec3 lightTransportVSOutput[];
in vec3 lightTransportPositionVSOutput[];
out vec3 lightTransportGSOutput;
out vec3 lightTransportPositionGSOutput;
