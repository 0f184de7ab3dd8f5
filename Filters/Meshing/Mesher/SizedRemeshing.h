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
/// The properties of vtkPatchMesher that bear on lengths, defaults filled in.
struct Settings
{
  int SizeField;
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
 * The lengths of an array, one per tuple. Throws MeshingRun::InputError when it has several
 * components. Whether its values make sense is seen in Remesh(), for the points in use.
 */
std::vector<double> ReadLengths(vtkDataArray* array);

/**
 * Remesh a surface that was built from the soup. Returns the length that was used: the target edge
 * length, or that of as many equal triangles for an array, times what leads to the number of
 * patches if one was asked for. Throws MeshingRun::InputError when a length makes no sense or
 * too many triangles would come out.
 */
double Remesh(SurfaceRemesher& remesher, const TriangleSoup& soup, const Settings& settings,
  const SurfaceRemesher::Monitor& monitor);
} // namespace SizedRemeshing
} // namespace LightTransport

#endif
