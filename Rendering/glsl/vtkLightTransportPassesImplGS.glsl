// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
    lightTransportGSOutput = lightTransportVSOutput[i];
    lightTransportBlockGSOutput = lightTransportBlockVSOutput[i];
    lightTransportPositionGSOutput = lightTransportPositionVSOutput[i];
