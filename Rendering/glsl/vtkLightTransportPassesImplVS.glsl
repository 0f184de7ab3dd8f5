// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
  lightTransportVSOutput = lightTransportMC;
  lightTransportPositionVSOutput = (MCVCMatrix * vertexMC).xyz;
