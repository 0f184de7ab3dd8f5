// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Names of arrays that one filter writes and another one reads.
#ifndef ArrayNames_h
#define ArrayNames_h

namespace LightTransport
{
namespace ArrayNames
{
/// Point array, 2 components: where a point lies in the atlas of its surface, in [0, 1]^2.
constexpr const char* AtlasCoordinates = "AtlasCoordinates";
/// Field data, 1 value: the texels a side that the atlas of a surface was made for.
constexpr const char* AtlasResolution = "AtlasResolution";
///@{ Cell and point array, 1 component: the cell or point of the input that one came from.
constexpr const char* OriginalCellIds = "OriginalCellIds";
constexpr const char* OriginalPointIds = "OriginalPointIds";
///@}
/// Cell array of an atlas and texel map, 1 component: the chart that a cell or texel belongs to.
constexpr const char* ChartId = "ChartId";
///@{ Texel maps: place and normal of the surface in a texel (3 components), and its area there.
constexpr const char* TexelPosition = "Position";
constexpr const char* TexelNormal = "Normal";
constexpr const char* TexelArea = "Area";
///@}
/// Texel map, 1 component: the row of the links that a texel is, from 1 on; 0 for none.
constexpr const char* LinkRow = "LinkRow";
/// Point array, 1 component: the smooth group that the front of a surface has there.
constexpr const char* SmoothGroup = "SmoothGroup";
/// Cell and point array, (degree + 1)^2 components: what of each spherical harmonic of radiance
/// from afar enters a surface.
constexpr const char* RadianceTransfer = "RadianceTransfer";
/// Field data of an image, 4 values: xmin, xmax, ymin, ymax of what of it is to be seen.
constexpr const char* DisplayWindow = "DisplayWindow";
/// Behind the name of an array of surfaces of two sides: that of the back.
constexpr const char* BackSuffix = "Back";
/// Cell array, 1 component: why results of a polygon are to be doubted, as bits.
constexpr const char* SceneProblems = "SceneProblems";
/// Field data, 1 value: the index that "TransmittedIrradiance" was computed for.
constexpr const char* RefractiveIndex = "RefractiveIndex";
///@{ Cell and point arrays, flux per unit area: what falls on a surface, directly or in all, what
/// has entered it, and what leaves it after scattering inside.
constexpr const char* DirectIrradiance = "DirectIrradiance";
constexpr const char* DirectIrradianceError = "DirectIrradianceError";
constexpr const char* Irradiance = "Irradiance";
constexpr const char* TransmittedIrradiance = "TransmittedIrradiance";
constexpr const char* ScatteredIrradiance = "ScatteredIrradiance";
constexpr const char* ScatteredIrradianceError = "ScatteredIrradianceError";
constexpr const char* SingleScatteredIrradiance = "SingleScatteredIrradiance";
constexpr const char* SingleScatteredIrradianceError = "SingleScatteredIrradianceError";
///@}
} // namespace ArrayNames
} // namespace LightTransport

#endif
