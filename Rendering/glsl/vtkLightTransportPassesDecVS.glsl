// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#if LIGHT_TRANSPORT_IS_MAPPED
// Two texels of each point: its place in the atlas, and the block of its chart.
uniform sampler2D lightTransportPoints;
uniform int lightTransportPointWidthBits;
#elif !LIGHT_TRANSPORT_IS_EMPTY
in vec3 lightTransportMC;
#endif
#if LIGHT_TRANSPORT_IS_GROUPED
uniform sampler2D lightTransportGroups;
uniform int lightTransportGroupWidthBits;
#endif
out vec3 lightTransportVSOutput;
flat out vec3 lightTransportBlockVSOutput;
out vec3 lightTransportPositionVSOutput;
