  gl_FragData[0] = vec4(LightTransportEncode(LightTransportRadiance()), gl_FragData[0].a);
