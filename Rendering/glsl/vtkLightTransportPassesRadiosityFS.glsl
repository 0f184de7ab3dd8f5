// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
  gl_FragData[0] = vec4(LightTransportEncode(LightTransportRadiance()), gl_FragData[0].a);
