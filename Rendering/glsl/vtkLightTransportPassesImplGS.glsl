// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
    lightTransportGSOutput = lightTransportVSOutput[i];
    lightTransportPositionGSOutput = lightTransportPositionVSOutput[i];
