// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec3 lightTransportMC;
out vec3 lightTransportVSOutput;
out vec3 lightTransportPositionVSOutput;
