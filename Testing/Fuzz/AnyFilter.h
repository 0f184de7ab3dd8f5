// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The filters with any properties, as far as each run stays short: sizes are bounded where a
/// filter does all that is asked for, however long that takes (texels, iterations, patches,
/// photons, tolerances).
#ifndef AnyFilter_h
#define AnyFilter_h

#include "AnySurface.h"
#include "vtkSmartPointer.h"

class vtkAlgorithm;

namespace LightTransportFuzz
{
class Choices;

/// Where the input is.
struct Room
{
  double Low[3] = { 0.0, 0.0, 0.0 };
  double Size = 1.0;
};

struct FilterKind
{
  /// With a second input, where the filter has one.
  vtkSmartPointer<vtkAlgorithm> (*Make)(Choices& choices, const Room& room);
  bool TakesComposite;
  bool TakesAtlas;
  Needs Input;
};

const FilterKind& ChooseFilter(Choices& choices);
} // namespace LightTransportFuzz

#endif
