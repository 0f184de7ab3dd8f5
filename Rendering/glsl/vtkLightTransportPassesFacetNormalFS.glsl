// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
  // VTK's shading has no normal here (it is switched off): that of the facet.
  vec3 lightTransportNormal = normalize(cross(dFdx(lightTransportPositionVSOutput), dFdy(lightTransportPositionVSOutput)));
