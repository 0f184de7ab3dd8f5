// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The texels of atlases as polygons: images with the point arrays "Position", "Normal", "Area" and
 * "ChartId", as vtkSurfaceToAtlas makes them, one or all blocks of composite data. A texel is a
 * parallelogram (TexelShape) of exactly its area; texels without surface (ChartId below 0, Area 0)
 * and ghosts are none.
 *
 * Of several ranks each may have all of an image, a part of it that has a border in common with the
 * next one, or nothing. What two of them have alike counts once, on the first of them. Where they
 * have something else at one place of the image, each has an atlas of its own.
 */
#ifndef TexelGathering_h
#define TexelGathering_h

#include "Scene/PolygonGathering.h"

namespace LightTransport
{
namespace TexelGathering
{
/// Whether any rank has an image. Collective.
bool HasImages(vtkDataObject* input, const Ranks& ranks);

/// Gather the texels, with their places in the atlas or without. Fails, on all ranks alike, for
/// images that are no texel images, and other data beside images. Collective.
Outcome Gather(vtkDataObject* input, const Ranks& ranks, bool withAtlas,
  GatheredPolygons& polygons);
} // namespace TexelGathering
} // namespace LightTransport

#endif
