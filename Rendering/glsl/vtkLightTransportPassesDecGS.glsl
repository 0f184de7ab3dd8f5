// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec3 lightTransportVSOutput[];
in vec3 lightTransportPositionVSOutput[];
out vec3 lightTransportGSOutput;
out vec3 lightTransportPositionGSOutput;
