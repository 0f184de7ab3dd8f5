// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The patches that vtkPatchMesher is asked for: its properties, defaults filled in.
#ifndef PatchTarget_h
#define PatchTarget_h

#include "vtkType.h"

#include <vector>

namespace LightTransport
{
struct PatchTarget
{
  /// Where lengths come from: the same everywhere, from the curvature, or from an array.
  enum class LengthSource
  {
    Uniform,
    Curvature,
    Array
  };

  /// The default length is such a part of the diagonal of the bounding box.
  static constexpr double DefaultPartsOfDiagonal = 50.0;

  LengthSource SizeField;
  double TargetEdgeLength;
  /// Whether it is a default, which may be too long for small components.
  bool IsDefaultLength;
  double MinimumEdgeLength;
  double ApproximationError;
  double Grading;
  bool CoarsePlanarRegions;
  vtkIdType TargetNumberOfPatches;
  int NumberOfIterations;
  /// Whether patches may cross where the surface does not.
  bool AllowsCrossings;
  /// The length at each input point; of no meaning unless the size field is an array.
  std::vector<double> LengthsOfPoints;
};
} // namespace LightTransport

#endif
