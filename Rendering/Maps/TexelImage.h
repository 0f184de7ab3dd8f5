// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TexelImage_h
#define TexelImage_h

#include "Maps/AtlasDrawing.h"
#include "Shared/Outcome.h"
#include "Textures/FloatTextures.h"

class vtkImageData;

namespace LightTransport
{
/// The texels of a surface's atlas, as vtkSurfaceToAtlas makes them but that areas are counted by
/// samples: drawn, and read back once. Within a DeviceSession.
Outcome MakeTexelImage(AtlasDrawing& drawing, FloatTextures& engine, int size, vtkImageData* image);
} // namespace LightTransport

#endif
