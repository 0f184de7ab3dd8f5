// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtlasTexels_h
#define AtlasTexels_h

#include "Shared/Outcome.h"

#include <vector>

class vtkDataArray;

namespace LightTransport
{
/// Value x area and area of each texel in single precision, RGBA, areas relative to their mean; a
/// single component of the values three times. A failure where areas are negative, not finite or
/// all 0, or a value is not finite.
Outcome MakeAtlasTexels(std::vector<float>& rgba, vtkDataArray* values, vtkDataArray* areas);
} // namespace LightTransport

#endif
