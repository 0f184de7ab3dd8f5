// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkPatchMesher asks of SurfaceRemesher: lengths from its properties, or a number.
#ifndef SizedRemeshing_h
#define SizedRemeshing_h

#include "Mesher/SurfaceRemesher.h"

#include "vtkType.h"

#include <vector>

class vtkDataArray;

namespace LightTransport
{
namespace SizedRemeshing
{
/// Where lengths come from: the same everywhere, from the curvature, or from an array.
enum class LengthSource
{
  Uniform,
  Curvature,
  Array
};

/// The properties of vtkPatchMesher that bear on lengths, defaults filled in.
struct Settings
{
  LengthSource SizeField;
  double TargetEdgeLength;
  double MinimumEdgeLength;
  double ApproximationError;
  double Grading;
  bool CoarsePlanarRegions;
  vtkIdType TargetNumberOfPatches;
  int NumberOfIterations;
  /// The length at each input point; of no meaning unless the size field is an array.
  std::vector<double> LengthsOfPoints;
};

/**
 * The lengths of an array, one per tuple. Fails when it has several components. Whether its values
 * make sense is seen in Remesh(), for the points in use.
 */
Outcome ReadLengths(vtkDataArray* array, std::vector<double>& lengths);

/**
 * Remesh a surface that was built from the soup. `length` becomes the one that was used: the target
 * edge length, or that of as many equal triangles for an array, times what leads to the number of
 * patches if one was asked for. Fails when a length makes no sense or too many triangles would come
 * out.
 */
Outcome Remesh(SurfaceRemesher& remesher, const TriangleSoup& soup, const Settings& settings,
  const Monitor& monitor, double& length);
} // namespace SizedRemeshing
} // namespace LightTransport

#endif
