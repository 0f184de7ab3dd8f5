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
/// Cell array, 1 component: the cell of the input that a cell came from.
constexpr const char* OriginalCellIds = "OriginalCellIds";
/// Field data, 1 value: the index that "TransmittedIrradiance" was computed for.
constexpr const char* RefractiveIndex = "RefractiveIndex";
///@{ Cell and point arrays, flux per unit area: what falls on a surface, directly or in all, what
/// has entered it, and what leaves it after scattering inside.
constexpr const char* DirectIrradiance = "DirectIrradiance";
constexpr const char* Irradiance = "Irradiance";
constexpr const char* TransmittedIrradiance = "TransmittedIrradiance";
constexpr const char* ScatteredIrradiance = "ScatteredIrradiance";
///@}
} // namespace ArrayNames
} // namespace LightTransport

#endif
