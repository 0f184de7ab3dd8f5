// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
in vec3 lightTransportVSOutput[];
flat in vec3 lightTransportBlockVSOutput[];
in vec3 lightTransportPositionVSOutput[];
out vec3 lightTransportGSOutput;
flat out vec3 lightTransportBlockGSOutput;
out vec3 lightTransportPositionGSOutput;
